# SPDX-License-Identifier: MIT
"""The tables as data frames, for the CSV files: plain numbers, nothing rounded."""

from collections.abc import Mapping
from operator import attrgetter
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
import pandas as pd

from octocell_report import bandwidth, page_tables, tables, words
from octocell_report.load import DEVICE_RUNS, RUNS, Result
from octocell_report.spread import Estimate

# The columns of CSV files that choose from frames, and what files call otherwise than frames do.
_COLUMNS = {
    "times": "scene n label method rule threads run motion status negative_control missed false "
    "duplicates median_ms min_ms max_ms rounds plan_ms ns_per_sphere candidates_per_pair "
    "uncertain_pairs beyond_bytes device_bytes",
    "stages": "scene n label run status stage median_ms fused_into",
    "bandwidth": "scene n label run stage least_bytes ms gbps copy_gigabytes_per_second share tiny",
    "frames": "scene n motion label status frame warmup median_ms min_ms max_ms",
    "skipped": "scene n label run reason",
    "ratios": "scene n run own_run motion label family_ref label_ref times_as_fast_median min max "
    "rounds",
}
_CALLED = {
    **{"label": "implementation", "label_ref": "reference", "family_ref": "against"},
    **{"beyond_bytes": "bytes_per_sphere_beyond", "ms": "median_ms"},
    **{"gbps": "gigabytes_per_second", "share": "share_of_copy", "tiny": "too_little_to_tell"},
}
NAMES = ("slopes", "correctness", "unavailable", *_COLUMNS)  # of the files, without their ending


def all_frames(result: Result) -> dict[str, pd.DataFrame]:
    """By name; a question without an answer in this result has an empty frame."""
    rows, rates = result.frame, bandwidth.frame(result)
    rows = rows.assign(course=rows.groupby(["scene", "n", "motion"], sort=False).ngroup())
    where = rows[["scene", "n", "motion", "label", "run", "status", "course", "order"]]
    moving = result.motion_frames.join(where, on="row")
    ratios = tables.speedups(result)
    spans = {name: ratios["ratios"].map(of) for name, of in (("min", min), ("max", max))}
    known = {
        "times": rows[rows["ran"]],
        "stages": result.stages.join(where, on="row"),
        "bandwidth": rates[(rates["stage"] != bandwidth.ALL) & (rates["least_bytes"] > 0)].assign(
            copy_gigabytes_per_second=result.gpu.copy_gbps if result.gpu else None
        ),
        "frames": moving.sort_values(["course", "order", "row", "frame"]),
        "skipped": rows[~rows["ran"]],
        "ratios": ratios.assign(
            times_as_fast_median=ratios["ratios"].map(median),
            rounds=ratios["ratios"].map(len),
            **spans,
        ),
    }
    return {
        "slopes": slopes(result),
        "correctness": correctness(result),
        "unavailable": page_tables.unavailable(result),
        **{
            name: frame[_COLUMNS[name].split()].rename(columns=_CALLED)
            for name, frame in known.items()
        },
    }


def slopes(result: Result) -> pd.DataFrame:
    """The exponent b of time = a n^b, fitted to the medians of exact rows of two sizes or more."""
    rows = result.frame
    fits = rows["counts"] & (rows["n"] > 0) & (rows["median_ms"] > 0)
    rows = rows[fits & (rows["run"] != tables.DYNAMIC)].sort_values("n", kind="stable")
    runs = [run for run in RUNS if run not in DEVICE_RUNS] + [*DEVICE_RUNS]
    keys = [rows["run"].map(runs.index), rows["scene"].map(result.scenes.index), rows["order"]]
    return pd.DataFrame(
        {
            **curve[["scene", "run", "label"]].iloc[0].rename(_CALLED),
            "sizes": len(curve),
            "slope": np.polyfit(np.log(curve["n"]), np.log(curve["median_ms"]), 1)[0],
        }
        for _, curve in rows.groupby(keys)
        if curve["n"].nunique() > 1
    )


def correctness(result: Result) -> pd.DataFrame:
    """What happened in the worst run of each implementation (lines) at each place (columns)."""
    rows = result.frame
    rank = (rows["errors"] + 1).where(rows["status"] == "wrong", rows["ran"] - 1)
    worst = rows.assign(rank=rank).sort_values("rank", ascending=False, kind="stable")
    worst = worst.drop_duplicates(["order", "group"])

    def text(row: Any) -> str:
        if row.status == "wrong":
            return words.losses(row)
        return "exact" if row.ran else words.short_reason(row.reason, 24)

    worst = worst.assign(text=list(map(text, worst.itertuples())))
    table = worst.pivot(index=["order", "label"], columns="group", values="text").fillna("")
    names = {
        f"{group.scene} {group.n}": table.get(index, "")
        if group.unavailable is None
        else "no scene"
        for index, group in enumerate(result.groups)
    }
    return table.assign(**names).reset_index()[["label", *names]].rename(columns=_CALLED)


def write(tables: Mapping[str, pd.DataFrame], folder: Path) -> None:
    """Each as NAME.csv; an empty one has no file."""
    for name, table in tables.items():
        if not table.empty:
            save(table, folder / f"{name}.csv")


def save(table: pd.DataFrame, path: Path) -> None:
    """An estimate takes three columns: median, low, high."""
    found = {}
    for name, column in table.items():
        if column.map(lambda value: isinstance(value, Estimate)).any():
            for part in ("median", "low", "high"):
                found[f"{name}_{part}"] = column.map(attrgetter(part), "ignore")
        else:
            found[name] = column
    with np.errstate(invalid="ignore"):  # numbers that no integer can hold stay what they are
        pd.DataFrame(found).convert_dtypes().to_csv(path, index=False)
