# SPDX-License-Identifier: MIT
"""Tables on what a scene's kind does to the time: beside libraries, by scene, frame by frame.

Ratios are taken within interleaved rounds; behind the median stands its 99 % interval.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from statistics import median, mode

import pandas as pd

from octocell_report import dynamic, tables, words
from octocell_report.fields import ReportError
from octocell_report.load import Group, Impl, Place, Result, Row
from octocell_report.markdown import table
from octocell_report.spread import SHARE, Estimate, estimate, ratios

PLANNED = "planned"
WITHOUT_FLAGS = "_without_flags"  # ends the name of a scene whose flags only say who moves

_INTERVAL = f"in brackets their {SHARE} % interval"


def against(result: Result) -> str:
    """Every baseline beside our plan, at the first scene, cold."""
    place = result.groups[0].place
    rows = result.at(place, "cold")
    ours = [row for row in rows if row.impl.method == PLANNED and row.counts]
    theirs = [row for row in rows if row.kind == "baseline" and row.status != "skipped"]
    if not (ours and theirs):
        raise ReportError("block 'against' needs cold rows of a plan and of a baseline")
    best = min(ours, key=lambda row: row.median_ms)
    labels = words.labels(result)
    lines = [[labels[best.impl], words.number(best.median_ms), words.NONE]]
    for row in theirs:
        if row.counts:
            times = ratio(row.round_ms, best.round_ms)
            lines.append([labels[row.impl], words.number(row.median_ms), _shown(times)])
        else:
            lines.append([labels[row.impl], words.verdict(row), words.NONE])
    note = (
        f"{_title(_group(result, place))}, {words.grouped(place.n)} spheres, cold, "
        f"{best.impl.threads} thread, median of {len(best.round_ms)} interleaved rounds. Times as "
        f"long: its time by that of the first row, median of the rounds, {_INTERVAL}."
    )
    return table(
        pd.DataFrame(lines, columns=["implementation", "time [ms]", "times as long"]), note
    )


def kinds_cold(result: Result) -> str:
    return _kinds(result, "cold")


def kinds_warm(result: Result) -> str:
    return _kinds(result, "warm")


def _kinds(result: Result, run: str) -> str:
    """Every scene beside the first, at the size that most scenes have."""
    by_place = _planned(result, run)
    size = mode(place.n for place in by_place) if by_place else 0
    first = next((place for place in by_place if place.n == size), None)
    if first is None or len(by_place) < 2:
        raise ReportError(f"block 'kinds_{run}' needs {run} rows of a plan on two scenes")
    met = Counter(impl for rows in by_place.values() for impl in rows)
    impls = [impl for impl in result.impls if 2 * met[impl] > len(by_place)]
    reference = words.place(first)
    header = ["scene", "spheres", "pairs"]
    for impl in impls:
        header += [f"{impl.backend} [ms]", f"of {reference}"]
    lines = []
    for place, rows in by_place.items():
        group = _group(result, place)
        cells = [_title(group), words.grouped(place.n), words.grouped(group.truth_pairs or 0)]
        for impl in impls:
            cells += _kind(result, rows.get(impl), by_place[first].get(impl))
        lines.append(cells)
    note = (
        f"{run.capitalize()}, the planned default, hosts with one thread; median of the rounds. "
        f"Of {reference}: time per sphere and true pair by the time per sphere and true pair "
        f"there, median over the rounds, {_INTERVAL}."
    )
    return table(pd.DataFrame(lines, columns=header), note)


def _kind(result: Result, row: Row | None, first: Row | None) -> list[str]:
    """The time, and what it is of the first scene's."""
    if row is None or not row.counts:
        return [words.verdict(row) if row else words.NONE, words.NONE]
    time = words.number(row.median_ms)
    if row is first:
        return [time, "1"]
    if first is None or not first.counts:
        return [time, words.NONE]
    return [time, _shown(ratio(_per_output(result, row), _per_output(result, first)))]


def _per_output(result: Result, row: Row) -> tuple[float, ...]:
    group = _group(result, row.place)
    return tuple(ms / (group.n + (group.truth_pairs or 0)) for ms in row.round_ms)


def frames(result: Result) -> str:
    """A frame that may take over from the last, by the same frame searched again."""
    rows = [row for row in result.rows if row.run == tables.DYNAMIC and row.counts]
    again = dynamic.searched_again(result)
    found = [row for row in rows if (row.impl, row.place) in again]
    if not found:
        raise ReportError(
            f"block 'frames' needs moving scenes with the variant '{dynamic.REBUILT}'"
        )
    header = [
        "scene",
        "implementation",
        "frame [ms]",
        "of searching again",
        "of the same without flags",
    ]
    lines = []
    for row in found:
        times = ratio(row.round_ms, again[row.impl, row.place].round_ms)
        without_flags = [
            r for r in found if r.impl == row.impl and r.place == _without_flags(row.place)
        ]
        beside = (
            _shown(ratio(row.round_ms, without_flags[0].round_ms)) if without_flags else words.NONE
        )
        labels = [row.place.scene, row.impl.backend, words.number(row.median_ms)]
        lines.append([*labels, _shown(times), beside])
    motion = found[0].motion
    count = f", {len(motion.by_frame)} frames, the first {motion.warmup} left out" if motion else ""
    note = (
        f"{words.grouped(found[0].place.n)} spheres{count}; a round's time is its median frame. "
        f"Ratios are medians over the rounds, {_INTERVAL}. Of searching again: the same rows, "
        "interleaved, with no frame taking over from the last. Of the same without flags: the same "
        "spheres move, but nothing says that the others stand; measured one after the other."
    )
    return table(pd.DataFrame(lines, columns=header), note)


def _without_flags(place: Place) -> Place:
    return Place(place.scene + WITHOUT_FLAGS, place.n)


def _planned(result: Result, run: str) -> dict[Place, dict[Impl, Row]]:
    """By place, in the order of the file: rows of plans with the fewest threads that ran."""
    found: dict[Place, dict[Impl, Row]] = {}
    for group in result.groups:
        for row in result.at(group.place, run):
            ran = row.status != "skipped" and row.impl.method == PLANNED
            if ran and row.impl.threads == 1 and not row.impl.predicate:
                found.setdefault(group.place, {})[row.impl] = row
    return found


def _group(result: Result, place: Place) -> Group:
    return next(group for group in result.groups if group.place == place)


def _title(group: Group) -> str:
    """'poly:n=1000,seed=1,ratio=1000000' -> 'poly, ratio 1 000 000'; of a file its name."""
    name, colon, parameters = group.spec.partition(":")
    if not colon:
        return Path(name).stem
    pairs = [text.partition("=") for text in parameters.split(",")]
    told = [f"{key} {_value(value)}" for key, _, value in pairs if key not in ("n", "seed")]
    return ", ".join([name, *told])


def _value(text: str) -> str:
    return words.grouped(int(text)) if text.isdigit() else text


def ratio(times: tuple[float, ...], of: tuple[float, ...]) -> Estimate:
    return estimate(ratios(times, of))


def _shown(ratio: Estimate) -> str:
    """1.04 (1.03 to 1.06)."""
    if median((ratio.low, ratio.high)) >= 9.995:
        low, middle, high = map(words.number, (ratio.low, ratio.median, ratio.high))
    else:
        low, middle, high = (f"{value:.2f}" for value in (ratio.low, ratio.median, ratio.high))
    return f"{middle} ({low} to {high})"
