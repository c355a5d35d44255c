# SPDX-License-Identifier: MIT
"""How near a device's stages come to the speed at which its memory copies."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median

import pandas as pd

from octocell_report.context import Gpu
from octocell_report.load import STAGES, Impl, Place, Result, Row

RUNS = ("warm", "cold_cache")  # the runs with stage marks whose time is the device's own
LAUNCH_US = 5.0  # what a kernel costs that does nothing, roughly
ALL = "all stages"
SCENE = "gas"  # the plain scene: only its rates are looked at over all sizes


def frame(result: Result) -> pd.DataFrame:
    """A line per stage of an exact row of a device, then one of all its stages together.

    The columns of Result.frame, and
        row          index of the row in Result.frame
        stage ms     its name, or ALL, and the median of the rounds
        least_bytes gbps share   what it must move; by its time; that by the measured copy: above 1
                     if a cache held what the stage reads; NA, NaN if unknown
        tiny         so few bytes that copying them takes less than a launch: the rate says nothing
        best         no other row of that backend and run is faster there
    """
    rows = result.frame
    rows = rows[rows["run"].isin(RUNS) & rows["counts"] & rows["device_bytes"].notna()]
    stages = result.stages.query("median_ms > 0")[["row", "stage", "median_ms", "least_bytes"]]
    sums = stages.groupby("row")[["median_ms", "least_bytes"]].agg(lambda of: of.sum(skipna=False))
    whole = sums.assign(stage=ALL).reset_index()
    every = pd.concat([stages, whole]).rename(columns={"median_ms": "ms"})
    found = every.merge(rows, left_on="row", right_index=True).sort_values("row", kind="stable")
    known = found["least_bytes"].where(found["least_bytes"] > 0).astype(float)
    copy = result.gpu.copy_gbps if result.gpu else math.nan
    fastest = rows.groupby(["scene", "n", "run", "backend"])["median_ms"].idxmin()
    return found.assign(
        gbps=known / (found["ms"] * 1e6),
        share=known / (found["ms"] * 1e6) / copy,
        tiny=known < copy * LAUNCH_US * 1e3,
        best=found["row"].isin(fastest),
    )


@dataclass(frozen=True)
class Rate:
    row: Row
    stage: str
    least_bytes: int
    ms: float  # median of the rounds
    gpu: Gpu | None

    @property
    def gbps(self) -> float:
        return self.least_bytes / (self.ms * 1e6)

    @property
    def share(self) -> float | None:
        """Of the measured copy; above 1 if a cache held what the stage reads."""
        return self.gbps / self.gpu.copy_gbps if self.gpu else None

    @property
    def tiny(self) -> bool:
        """So few bytes that a launch takes longer than to copy them: the rate says nothing."""
        return bool(self.gpu and self.least_bytes < self.gpu.copy_gbps * LAUNCH_US * 1e3)


def rows(result: Result) -> list[Row]:
    """Exact rows of a device with a time and a least number of bytes for some stage."""
    return [
        row
        for row in result.rows
        if row.run in RUNS and row.counts and row.device_bytes is not None and _staged(row)
    ]


def _staged(row: Row) -> list[str]:
    """Stages that ran and have to move something, in the order in which they run."""
    times = {stage: median(ms) for stage, ms in row.stage_ms.items()}
    return [stage for stage, ms in times.items() if ms > 0 and row.stage_bytes.get(stage, 0) > 0]


def rates(result: Result, row: Row) -> list[Rate]:
    """One for each stage of a row that these are known of."""
    return [
        Rate(row, stage, row.stage_bytes[stage], median(row.stage_ms[stage]), result.gpu)
        for stage in _staged(row)
    ]


def whole(result: Result, row: Row) -> Rate | None:
    """Over all its stages; None unless the bytes of each that took time are known."""
    staged = _staged(row)
    if not staged or any(stage not in row.stage_bytes for stage in row.stage_ms):
        return None
    time = sum(median(ms) for ms in row.stage_ms.values())
    least = sum(row.stage_bytes[stage] for stage in row.stage_ms)
    return Rate(row, ALL, least, time, result.gpu)


def best(result: Result, place: Place, run: str = "warm") -> list[Row]:
    """The fastest of each device backend there, in table order."""
    found: dict[str, Row] = {}
    for row in rows(result):
        if row.place == place and row.run == run:
            other = found.get(row.impl.backend)
            if other is None or row.median_ms < other.median_ms:
                found[row.impl.backend] = row
    order = list(dict.fromkeys(impl.backend for impl in result.impls))
    return sorted(found.values(), key=lambda row: order.index(row.impl.backend))


def places(result: Result) -> list[Place]:
    """Each scene that has such rows, at the largest size that it has them at."""
    known = {id(row) for row in rows(result) if row.run == "warm"}
    found = (result.largest(scene, lambda row: id(row) in known) for scene in result.scenes)
    return [place for place in found if place]


def over_sizes(result: Result, impl: Impl, run: str) -> list[Row]:
    """Rows of the plain scene, ascending."""
    found = [r for r in rows(result) if (r.impl, r.run, r.place.scene) == (impl, run, SCENE)]
    return sorted(found, key=lambda row: row.place.n)


def met(every: list[Rate]) -> list[str]:
    """Names of stages, in the order in which they run."""
    names = {rate.stage for rate in every}
    return [stage for stage in STAGES if stage in names] + sorted(names - set(STAGES))
