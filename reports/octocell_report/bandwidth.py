# SPDX-License-Identifier: MIT
"""How near a device's stages come to the speed at which its memory copies."""

import math

import pandas as pd

from octocell_report.load import Result

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
    whole = stages.groupby("row")[["median_ms", "least_bytes"]].sum().assign(stage=ALL)
    unknown = stages["least_bytes"].isna().groupby(stages["row"]).any()
    whole = whole.assign(least_bytes=whole["least_bytes"].mask(unknown)).reset_index()
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
