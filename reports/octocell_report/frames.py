# SPDX-License-Identifier: MIT
"""The tables as data frames, for the CSV files: plain numbers, nothing rounded."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from statistics import median

import numpy as np
import pandas as pd

from octocell_report import bandwidth, dynamic, tables, words
from octocell_report.load import DEVICE_RUNS, RUNS, Result
from octocell_report.spread import Estimate


def times_frame(result: Result) -> pd.DataFrame:
    """Every row that ran; a time stands next to its status."""
    labels = words.labels(result)
    return pd.DataFrame(
        {
            "scene": row.place.scene,
            "n": row.place.n,
            "implementation": labels[row.impl],
            "method": row.impl.method,
            "rule": row.impl.rule,
            "threads": row.impl.threads,
            "run": row.run,
            "motion": row.motion.scene if row.motion else None,
            "status": row.status,
            "negative_control": row.negative_control,
            "missed": row.missed,
            "false": row.false,
            "duplicates": row.duplicates,
            "median_ms": row.median_ms,
            "min_ms": min(row.round_ms),
            "max_ms": max(row.round_ms),
            "rounds": len(row.round_ms),
            "plan_ms": row.plan_ms,
            "ns_per_sphere": tables.ns_per_sphere(row),
            "candidates_per_pair": tables.candidates_per_pair(result, row),
            "uncertain_pairs": row.uncertain_pairs,
            "bytes_per_sphere_beyond": tables.beyond_bytes(row),
            "device_bytes": row.device_bytes,
        }
        for row in result.rows
        if row.status != "skipped"
    )


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
    labels = words.labels(result)
    return pd.DataFrame(
        {
            "scene": ratio.place.scene,
            "n": ratio.place.n,
            "run": ratio.run,
            "own_run": ratio.own_run,
            "motion": ratio.motion,
            "implementation": labels[ratio.impl],
            "against": ratio.family,
            "reference": labels[ratio.reference],
            "times_as_fast_median": ratio.median,
            "min": min(ratio.rounds),
            "max": max(ratio.rounds),
            "rounds": len(ratio.rounds),
        }
        for run in RUNS
        for ratio in tables.ratios(result, run)
    )


def stages_frame(result: Result) -> pd.DataFrame:
    """Long form; a fused stage names the stage that holds its time and has none of its own."""
    labels = words.labels(result)
    found = []
    for row in result.rows:
        head = {
            "scene": row.place.scene,
            "n": row.place.n,
            "implementation": labels[row.impl],
            "run": row.run,
            "status": row.status,
        }
        for stage, ms in row.stage_ms.items():
            found.append(head | {"stage": stage, "median_ms": median(ms), "fused_into": None})
        for stage, host in row.fused.items():
            found.append(head | {"stage": stage, "median_ms": None, "fused_into": host})
    return pd.DataFrame(found)


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
    labels = words.labels(result)
    return pd.DataFrame(
        {
            "scene": course.place.scene,
            "n": course.place.n,
            "motion": course.motion,
            "implementation": labels[row.impl],
            "status": row.status,
            "frame": index,
            "warmup": index < row.motion.warmup,
            "median_ms": median(times),
            "min_ms": min(times),
            "max_ms": max(times),
        }
        for course, rows in dynamic.courses(result).items()
        for row in rows
        if row.motion
        for index, times in enumerate(zip(*row.motion.frame_ms, strict=True))
    )


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
    labels = words.labels(result)
    return pd.DataFrame(
        {
            "scene": row.place.scene,
            "n": row.place.n,
            "implementation": labels[row.impl],
            "run": row.run,
            "reason": row.reason,
        }
        for row in result.rows
        if row.status == "skipped"
    )


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
