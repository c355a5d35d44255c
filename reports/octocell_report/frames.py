# SPDX-License-Identifier: MIT
"""The tables as data frames, for the CSV files: plain numbers, nothing rounded."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from statistics import median

import numpy as np
import pandas as pd

from octocell_report import bandwidth, tables, words
from octocell_report.load import DEVICE_RUNS, Result
from octocell_report.spread import Estimate

_TIMES = [
    *("scene", "n", "implementation", "method", "rule", "threads", "run", "motion", "status"),
    *("negative_control", "missed", "false", "duplicates", "median_ms", "min_ms", "max_ms"),
    *("rounds", "plan_ms", "ns_per_sphere", "candidates_per_pair", "uncertain_pairs"),
    *("bytes_per_sphere_beyond", "device_bytes"),
]


def times_frame(result: Result) -> pd.DataFrame:
    """Every row that ran; a time stands next to its status."""
    return _rows(result)[result.frame["ran"]][_TIMES]


def _rows(result: Result) -> pd.DataFrame:
    names = {"label": "implementation", "beyond_bytes": "bytes_per_sphere_beyond"}
    return result.frame.rename(columns=names)


def slopes_frame(result: Result) -> pd.DataFrame:
    labels = words.labels(result)
    return pd.DataFrame(
        {
            "scene": scene,
            "run": run,
            "implementation": labels[impl],
            "sizes": len(rows),
            "slope": tables.slope(rows),
        }
        for run in (*tables.runs(result), *DEVICE_RUNS)
        for scene in result.scenes
        for impl, rows in tables.curves(result, scene, run).items()
        if tables.slope(rows) is not None
    )


def ratios_frame(result: Result) -> pd.DataFrame:
    found = tables.speedups(result)
    columns = ["scene", "n", "run", "own_run", "motion", "label", "family_ref", "label_ref"]
    names = {"label": "implementation", "family_ref": "against", "label_ref": "reference"}
    spans = found["ratios"].map(
        lambda rounds: (median(rounds), min(rounds), max(rounds), len(rounds))
    )
    spans = pd.DataFrame(
        [*spans], found.index, columns=["times_as_fast_median", "min", "max", "rounds"]
    )
    return found[columns].rename(columns=names).join(spans)


def stages_frame(result: Result) -> pd.DataFrame:
    """Long form; a fused stage names the stage that holds its time and has none of its own."""
    columns = ["scene", "n", "implementation", "run", "status"]
    found = result.stages.join(_rows(result)[columns], on="row")
    return found[[*columns, "stage", "median_ms", "fused_into"]]


def bandwidth_frame(result: Result) -> pd.DataFrame:
    """Long form; what a stage must move over the time that it took."""
    labels = words.labels(result)
    return pd.DataFrame(
        {
            "scene": rate.row.place.scene,
            "n": rate.row.place.n,
            "implementation": labels[rate.row.impl],
            "run": rate.row.run,
            "stage": rate.stage,
            "least_bytes": rate.least_bytes,
            "median_ms": rate.ms,
            "gigabytes_per_second": rate.gbps,
            "copy_gigabytes_per_second": result.gpu.copy_gbps if result.gpu else None,
            "share_of_copy": rate.share,
            "too_little_to_tell": rate.tiny,
        }
        for row in bandwidth.rows(result)
        for rate in bandwidth.rates(result, row)
    )


def motion_frame(result: Result) -> pd.DataFrame:
    """Long form, one line per frame: over the rounds."""
    columns = ["scene", "n", "motion", "implementation", "status"]
    rows = _rows(result)
    courses = rows.groupby(["scene", "n", "motion"], sort=False).ngroup().rename("course")
    found = result.motion_frames.join(rows[[*columns, "order"]].join(courses), on="row")
    found = found.sort_values(["course", "order", "row", "frame"])
    return found[[*columns, "frame", "warmup", "median_ms", "min_ms", "max_ms"]]


def correctness_frame(result: Result) -> pd.DataFrame:
    labels = words.labels(result)
    cells = tables.correctness(result)
    return pd.DataFrame(
        {
            "implementation": labels[impl],
            **{f"{g.scene} {g.n}": cells[impl, g.place].text for g in result.groups},
        }
        for impl in result.impls
    )


def skipped_frame(result: Result) -> pd.DataFrame:
    rows = _rows(result)[~result.frame["ran"]]
    return rows[["scene", "n", "implementation", "run", "reason"]]


def unavailable_frame(result: Result) -> pd.DataFrame:
    return pd.DataFrame(
        {"scene": group.scene, "spec": group.spec, "reason": group.unavailable}
        for group in result.groups
        if group.unavailable is not None
    )


_FRAMES = {
    "times": times_frame,
    "slopes": slopes_frame,
    "ratios": ratios_frame,
    "stages": stages_frame,
    "bandwidth": bandwidth_frame,
    "frames": motion_frame,
    "correctness": correctness_frame,
    "skipped": skipped_frame,
    "unavailable": unavailable_frame,
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
        table.convert_dtypes().to_csv(path, index=False)


def estimate(name: str, value: Estimate | None) -> dict[str, float | None]:
    """An estimate as columns."""
    return {
        f"{name}_median": value.median if value else None,
        f"{name}_low": value.low if value else None,
        f"{name}_high": value.high if value else None,
    }
