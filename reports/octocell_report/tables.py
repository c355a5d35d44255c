# SPDX-License-Identifier: MIT
"""What the plots, the page and the README show, as numbers: one function per question."""

from __future__ import annotations

import math
from statistics import median
from typing import NamedTuple

import numpy as np
import pandas as pd

from octocell_report import spread, words
from octocell_report.load import DEVICE_RUNS, RUNS, Impl, Place, Result, Row

UPDATES = ("first_update", "update")
DYNAMIC = "dynamic"


def curves(result: Result, scene: str, run: str) -> dict[Impl, list[Row]]:
    """Rows whose time may stand bare, ascending by size, for sizes above zero."""
    found: dict[Impl, list[Row]] = {impl: [] for impl in result.impls}
    for row in sorted(result.rows, key=lambda r: r.place.n):
        fits = row.place.scene == scene and row.run == run and row.place.n > 0
        if fits and row.counts and row.median_ms > 0:
            found[row.impl].append(row)
    return {impl: rows for impl, rows in found.items() if rows}


def marked(result: Result, scene: str, run: str) -> list[Row]:
    """Rows that ran but may not show a bare time: wrong ones, and negative controls."""
    return [
        row
        for row in result.rows
        if row.place.scene == scene
        and row.run == run
        and row.place.n > 0
        and row.status != "skipped"
        and not row.counts
        and row.median_ms > 0
    ]


def slope(rows: list[Row]) -> float | None:
    """The exponent b of time = a n^b, fitted to the medians; None below two sizes."""
    fit = power_law(rows)
    return None if fit is None else fit[1]


def power_law(rows: list[Row]) -> tuple[float, float] | None:
    """(a, b) of median_ms = a n^b by least squares on logarithms."""
    if len({row.place.n for row in rows}) < 2:
        return None
    sizes = np.log([row.place.n for row in rows])
    times = np.log([row.median_ms for row in rows])
    b, log_a = np.polyfit(sizes, times, 1)
    return math.exp(log_a), float(b)


class Ratio(NamedTuple):
    """How many times as fast as the reference; above 1 is faster."""

    impl: Impl
    place: Place
    run: str  # of the reference
    family: str  # of the reference: fcl, bullet
    reference: Impl
    rounds: tuple[float, ...]  # reference / row, round by round: the two were interleaved
    own_run: str  # of the row: the same, or warm where only the reference updates
    motion: str | None  # how the spheres move, in dynamic runs

    @property
    def median(self) -> float:
        return median(self.rounds)


def families(result: Result) -> list[str]:
    """The libraries that the baselines come from, in table order."""
    backends = [impl.backend for impl in result.impls_of("baseline")]
    return list(dict.fromkeys(words.family(backend) for backend in backends))


def round_ratios(reference: Row, row: Row) -> tuple[float, ...]:
    """reference / row for the rounds that both have; empty where the row took no time."""
    return spread.ratios(reference.round_ms, row.round_ms)


def speedups(result: Result) -> pd.DataFrame:
    """Every exact row of ours against the fastest exact baseline of each library, by run.

    The columns of Result.frame for the row, the same with `_ref` for the baseline, and `ratios`,
    one per round: how many times as fast the row is. Our backends have no run of an update: they
    search again. So their warm rows, measured in the same rounds, stand beside the baselines'
    updates; `own_run` says so.
    """
    where = ["scene", "n", "run", "motion"]
    exact = result.frame[result.frame["counts"]].reset_index(names="row")
    exact["own_run"] = exact["run"]
    ours = exact[exact["kind"] == "backend"]
    again = [ours[ours["run"] == "warm"].assign(run=run) for run in UPDATES]
    theirs = exact[exact["kind"] == "baseline"].sort_values("median_ms", kind="stable")
    fastest = theirs.drop_duplicates([*where, "family"])
    found = pd.concat([ours, *again]).merge(fastest, on=where, suffixes=("", "_ref"))
    rounds = zip(found["round_ms_ref"], found["round_ms"], strict=True)
    found["ratios"] = pd.Series([spread.ratios(*pair) for pair in rounds], dtype=object)
    order = {"run": RUNS, "motion": [*found["motion"].unique()], "family_ref": families(result)}
    return found[found["ratios"].map(len) > 0].sort_values(
        ["run", "group", "motion", "family_ref", "row"],
        key=lambda keys: keys.map(order[keys.name].index) if keys.name in order else keys,
    )


def ratios(result: Result, run: str) -> list[Ratio]:
    found = speedups(result)
    impls = dict(enumerate(result.impls))
    return [
        Ratio(
            impls[r.order],
            Place(r.scene, r.n),
            r.run,
            r.family_ref,
            impls[r.order_ref],
            r.ratios,
            r.own_run,
            r.motion,
        )
        for r in found[found["run"] == run].itertuples()
    ]


def beyond_bytes(row: Row) -> float | None:
    """Bytes per sphere beyond input and output, on the host: None for a device's row."""
    if row.device_bytes is not None:
        return None
    if row.peak_bytes is None or row.place.n == 0:
        return None
    return (row.peak_bytes - (row.output_bytes or 0)) / row.place.n


def memory(result: Result, place: Place) -> dict[Impl, Row]:
    """For each implementation measured there, its run that needed most."""
    found: dict[Impl, Row] = {}
    for row in result.rows:
        need = beyond_bytes(row)
        if row.place != place or need is None:
            continue
        best = found.get(row.impl)
        if best is None or need > (beyond_bytes(best) or 0.0):
            found[row.impl] = row
    return found


def ns_per_sphere(row: Row) -> float:
    """NaN without spheres or without a time."""
    return row.median_ms * 1e6 / row.place.n if row.place.n else math.nan


def runs(result: Result) -> list[str]:
    """Which kinds of run at rest the result holds, of those that are no device's own."""
    held = {row.run for row in result.rows}
    return [run for run in RUNS if run in held and run not in (DYNAMIC, *DEVICE_RUNS)]


def largest(result: Result, run: str, impls: list[Impl]) -> list[Place]:
    """Each scene at the largest size at which one of these has a row of that run that ran."""

    def fits(row: Row) -> bool:
        return row.impl in impls and row.run == run and row.status != "skipped"

    return [p for scene in result.scenes if (p := result.largest(scene, fits))]


def measured_memory(result: Result) -> list[Place]:
    """Each scene at the largest size at which memory was measured on the host."""

    def fits(row: Row) -> bool:
        return beyond_bytes(row) is not None

    return [p for scene in result.scenes if (p := result.largest(scene, fits))]


def compared(result: Result, scene: str, run: str) -> Place | None:
    """The largest size at which most sides have an exact row: a device may go on alone."""
    sides = result.sides
    met: dict[Place, set[str]] = {}
    for row in result.rows:
        if row.place.scene == scene and row.run == run and row.counts and row.place.n > 0:
            met.setdefault(row.place, set()).add(sides[row.impl])
    return max(met, key=lambda place: (len(met[place]), place.n), default=None)
