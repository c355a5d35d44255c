# SPDX-License-Identifier: MIT
"""The tables as data frames, for the CSV files: plain numbers, nothing rounded."""

from __future__ import annotations

from collections.abc import Mapping
from operator import attrgetter
from pathlib import Path
from statistics import median

import numpy as np
import pandas as pd

from octocell_report import bandwidth, tables, words
from octocell_report.load import DEVICE_RUNS, RUNS, Result
from octocell_report.spread import Estimate

_CALLED = {  # columns that CSV files call otherwise
    "label": "implementation",
    "label_ref": "reference",
    "family_ref": "against",
    "beyond_bytes": "bytes_per_sphere_beyond",
    "ms": "median_ms",
    "gbps": "gigabytes_per_second",
    "share": "share_of_copy",
    "tiny": "too_little_to_tell",
}
_TIMES = (
    "scene n label method rule threads run motion status negative_control missed false duplicates "
    "median_ms min_ms max_ms rounds plan_ms ns_per_sphere candidates_per_pair uncertain_pairs "
    "beyond_bytes device_bytes"
)


def _picked(frame: pd.DataFrame, columns: str) -> pd.DataFrame:
    return frame[columns.split()].rename(columns=_CALLED)


def times(result: Result) -> pd.DataFrame:
    """Every row that ran; a time stands next to its status."""
    return _picked(result.frame[result.frame["ran"]], _TIMES)


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


def ratios(result: Result) -> pd.DataFrame:
    """How many times as fast as each library's fastest, over the rounds."""
    found = tables.speedups(result)
    rounds = found["ratios"]
    return _picked(found, "scene n run own_run motion label family_ref label_ref").assign(
        times_as_fast_median=rounds.map(median),
        min=rounds.map(min),
        max=rounds.map(max),
        rounds=rounds.map(len),
    )


def stages(result: Result) -> pd.DataFrame:
    """A fused stage names the stage that holds its time and has none of its own."""
    rows = result.frame[["scene", "n", "label", "run", "status"]]
    found = result.stages.join(rows, on="row")
    return _picked(found, "scene n label run status stage median_ms fused_into")


def rates(result: Result) -> pd.DataFrame:
    """What a stage must move, by the time that it took."""
    found = bandwidth.frame(result)
    found = found[(found["stage"] != bandwidth.ALL) & (found["least_bytes"] > 0)]
    found = found.assign(copy_gigabytes_per_second=result.gpu.copy_gbps if result.gpu else None)
    columns = "scene n label run stage least_bytes ms gbps copy_gigabytes_per_second share tiny"
    return _picked(found, columns)


def motion(result: Result) -> pd.DataFrame:
    """A line per frame of a moving scene, over the rounds."""
    rows = result.frame
    rows = rows.assign(course=rows.groupby(["scene", "n", "motion"], sort=False).ngroup())
    columns = ["scene", "n", "motion", "label", "status", "course", "order"]
    found = result.motion_frames.join(rows[columns], on="row")
    found = found.sort_values(["course", "order", "row", "frame"])
    return _picked(found, "scene n motion label status frame warmup median_ms min_ms max_ms")


def correctness(result: Result) -> pd.DataFrame:
    """What happened in the worst run of each implementation (lines) at each place (columns)."""
    rows = result.frame
    lost = rows[["missed", "false", "duplicates"]].fillna(0).sum(axis=1)
    rank = (lost + 1).where(rows["status"] == "wrong", rows["ran"] - 1)
    worst = rows.assign(rank=rank).sort_values("rank", ascending=False, kind="stable")
    worst = worst.drop_duplicates(["order", "group"])
    worst["text"] = [
        words.losses(row)
        if row.status == "wrong"
        else "exact"
        if row.ran
        else words.short_reason(row.reason, 24)
        for row in worst.itertuples()
    ]
    table = worst.pivot(index=["order", "label"], columns="group", values="text").fillna("")
    names = {
        f"{group.scene} {group.n}": table.get(index, "")
        if group.unavailable is None
        else "no scene"
        for index, group in enumerate(result.groups)
    }
    return table.assign(**names).reset_index()[["label", *names]].rename(columns=_CALLED)


def skipped(result: Result) -> pd.DataFrame:
    return _picked(result.frame[~result.frame["ran"]], "scene n label run reason")


def unavailable(result: Result) -> pd.DataFrame:
    return pd.DataFrame(
        {"scene": group.scene, "spec": group.spec, "reason": group.unavailable}
        for group in result.groups
        if group.unavailable is not None
    )


_FRAMES = {
    **{"times": times, "slopes": slopes, "ratios": ratios, "stages": stages, "bandwidth": rates},
    **{"frames": motion, "correctness": correctness},
    **{"skipped": skipped, "unavailable": unavailable},
}
NAMES = tuple(_FRAMES)  # of the CSV files, without their ending


def all_frames(result: Result) -> dict[str, pd.DataFrame]:
    """By name; a question without an answer in this result has an empty frame."""
    return {name: frame(result) for name, frame in _FRAMES.items()}


def write(tables: Mapping[str, pd.DataFrame], folder: Path) -> None:
    """Each as NAME.csv; an empty one has no file."""
    for name, table in tables.items():
        if not table.empty:
            save(table, folder / f"{name}.csv")


def save(table: pd.DataFrame, path: Path) -> None:
    with np.errstate(invalid="ignore"):  # numbers that no integer can hold stay what they are
        _spread(table).convert_dtypes().to_csv(path, index=False)


def _spread(table: pd.DataFrame) -> pd.DataFrame:
    """With three columns for each of estimates: median, low, high."""
    found = {}
    for name, column in table.items():
        if column.map(lambda value: isinstance(value, Estimate)).any():
            for part in ("median", "low", "high"):
                found[f"{name}_{part}"] = column.map(attrgetter(part), "ignore")
        else:
            found[name] = column
    return pd.DataFrame(found)
