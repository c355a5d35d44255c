# SPDX-License-Identifier: MIT
"""What the plots, the page and the README show, as numbers: one function per question."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median

import numpy as np

from octocell_report import spread, words
from octocell_report.load import DEVICE_RUNS, RUNS, Group, Impl, Place, Result, Row

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


@dataclass(frozen=True)
class Ratio:
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


def fastest(rows: list[Row], family: str) -> Row | None:
    """The fastest exact baseline of a family among the rows of one group and run."""
    fits = [
        row
        for row in rows
        if row.kind == "baseline" and row.counts and words.family(row.impl.backend) == family
    ]
    return min(fits, key=lambda row: row.median_ms, default=None)


def round_ratios(reference: Row, row: Row) -> tuple[float, ...]:
    """reference / row for the rounds that both have; empty where the row took no time."""
    return spread.ratios(reference.round_ms, row.round_ms)


def ratios(result: Result, run: str, kind: str = "backend") -> list[Ratio]:
    """Every exact row of that kind against the fastest exact baseline of each library.

    Our backends have no run of an update: they search again. So their warm rows, measured in
    the same rounds, are held against the baselines' updates.
    """
    found = []
    for group in result.groups:
        here = result.at(group.place, run)
        own = [row for row in here if row.kind == kind]
        if not own and run in UPDATES:
            own = [row for row in result.at(group.place, "warm") if row.kind == kind]
        for motion in dict.fromkeys(_motion(row) for row in here):
            theirs = [row for row in here if _motion(row) == motion]
            ours = [row for row in own if run in UPDATES or _motion(row) == motion]
            found += _held_against(result, run, ours, theirs)
    return found


def _held_against(result: Result, run: str, ours: list[Row], theirs: list[Row]) -> list[Ratio]:
    found = []
    for name in families(result):
        reference = fastest(theirs, name)
        for row in ours:
            if reference is None or not row.counts:
                continue
            rounds = round_ratios(reference, row)
            if rounds:
                head = (row.impl, row.place, run, name, reference.impl, rounds, row.run)
                found.append(Ratio(*head, _motion(reference)))
    return found


def _motion(row: Row) -> str | None:
    return row.motion.scene if row.motion else None


@dataclass(frozen=True)
class Cell:
    """One entry of the correctness matrix, over all runs of one implementation at one place."""

    state: str  # exact | wrong | negative control | skipped | unavailable | absent
    text: str


def cell(rows: list[Row], group: Group) -> Cell:
    """Wrong beats exact beats skipped: one bad run is enough."""
    if group.unavailable is not None:
        return Cell("unavailable", "no scene")
    if not rows:
        return Cell("absent", "")
    wrong = [row for row in rows if row.status == "wrong"]
    if wrong:
        worst = max(wrong, key=lambda r: (r.missed or 0) + (r.false or 0) + (r.duplicates or 0))
        return Cell("negative_control" if worst.negative_control else "wrong", words.losses(worst))
    if any(row.status == "ok" for row in rows):
        return Cell("exact", "exact")
    return Cell("skipped", words.short_reason(rows[0].reason, 24))


def correctness(result: Result) -> dict[tuple[Impl, Place], Cell]:
    return {
        (impl, group.place): cell(
            [row for row in result.rows if row.impl == impl and row.place == group.place], group
        )
        for impl in result.impls
        for group in result.groups
    }


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


def candidates_per_pair(result: Result, row: Row) -> float:
    """Pairs looked at for each true pair; NaN where either is unknown or there is none."""
    truth = next(g.truth_pairs for g in result.groups if g.place == row.place)
    return row.candidates / truth if row.candidates is not None and truth else math.nan


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
