# SPDX-License-Identifier: MIT
"""The page's tables: what stands in each cell, in both languages, and what it is sorted by."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from statistics import median

from octocell_report import dynamic, gpu_runs, tables, words
from octocell_report.language import Said, say
from octocell_report.load import Impl, Place, Result, Row
from octocell_report.tables import DYNAMIC, Ratio


@dataclass(frozen=True)
class Cell:
    text: str | Said
    small: str = ""  # below the text
    css: str = ""
    value: float | None = None  # what it is sorted by, if not by its text


@dataclass(frozen=True)
class Line:
    cells: list[Cell]
    css: str = ""


@dataclass(frozen=True)
class Table:
    title: str | Said
    columns: Sequence[tuple[Said, str]]  # heading, css
    lines: list[Line]


def column(key: str, css: str = "") -> tuple[Said, str]:
    return say(f"column_{key}"), css


def _number(value: float | None, css: str = "") -> Cell:
    known = value is not None and not math.isnan(value)
    return Cell(words.number(value), css=css, value=value if known else None)


def run_name(run: str) -> Said:
    return say(f"run_{run}")


def times(result: Result) -> list[Table]:
    """One table per scene: implementations at each size, all runs at rest."""
    found = [_scene_times(result, scene) for scene in result.scenes if result.sizes(scene)]
    return [table for table in found if table.lines]


def _scene_times(result: Result, scene: str) -> Table:
    runs = tables.runs(result)
    labels, cells = words.labels(result), tables.correctness(result)
    lines = []
    for n in result.sizes(scene):
        place, first = Place(scene, n), True
        for impl in result.impls:
            rows = {
                row.run: row
                for row in result.rows
                if row.impl == impl and row.place == place and row.run in runs
            }
            if not rows:
                continue
            state = cells[impl, place].state
            size = Cell(words.size(n), css="size", value=n)
            line = [size, Cell(labels[impl], css="text"), *_times(result, rows, runs)]
            lines.append(Line(line, f"{state} first" if first else state))
            first = False
    columns = [
        column("spheres"),
        column("implementation", "text"),
        *((say("column_run_ms", run=run_name(run)), "") for run in runs),
        *map(column, ("ns", "candidates", "uncertain_pairs")),
    ]
    return Table(scene, columns, lines)


def _times(result: Result, rows: dict[str, Row], runs: list[str]) -> list[Cell]:
    warm = rows.get("warm") or next(iter(rows.values()))
    uncertain_pairs = (
        words.NONE if warm.uncertain_pairs is None else words.grouped(warm.uncertain_pairs)
    )
    return [
        *(_time(rows.get(run)) for run in runs),
        _number(tables.ns_per_sphere(warm) if warm.counts else None),
        _number(tables.candidates_per_pair(result, warm)),
        Cell(uncertain_pairs, value=warm.uncertain_pairs),
    ]


def _time(row: Row | None) -> Cell:
    """A time that is not bare stands behind its verdict, in brackets."""
    if row is None:
        return Cell(words.NONE, css="none")
    if row.status == "skipped":
        return Cell(say("skipped"), css="none")
    if row.counts:
        spread = words.spread(row.round_ms)
        return Cell(words.number(row.median_ms), spread, "time", row.median_ms)
    return Cell(_verdict(row), f"({words.number(row.median_ms)} ms)", "bad")


def _verdict(row: Row) -> Said:
    if row.status != "wrong":
        return say("cell_negative_control_exact")
    return say(
        "cell_negative_control" if row.negative_control else "cell_wrong", losses=words.losses(row)
    )


def speedups(result: Result) -> dict[str, Table]:
    """By run: every exact row of ours against each library's fastest, with its spread."""
    found = {}
    for run in (*tables.runs(result), DYNAMIC):
        ratios = tables.ratios(result, run)
        if ratios:
            found[run] = _speedups(result, run, ratios)
    return found


def _speedups(result: Result, run: str, ratios: list[Ratio]) -> Table:
    labels = words.labels(result)
    moving = any(ratio.motion not in (None, ratio.place.scene) for ratio in ratios)
    columns = [
        column("scene", "text"),
        column("spheres"),
        *([column("motion", "text")] if moving else []),
        column("implementation", "text"),
        column("against", "text"),
        *map(column, ("median", "range", "rounds")),
    ]
    lines = [
        Line(
            [
                Cell(ratio.place.scene, css="text"),
                Cell(words.size(ratio.place.n), value=ratio.place.n),
                *([Cell(ratio.motion or words.NONE, css="text")] if moving else []),
                Cell(labels[ratio.impl], css="text"),
                Cell(labels[ratio.reference], css="text"),
                Cell(words.ratio(ratio.median), css="time", value=ratio.median),
                Cell(_ratio_range(ratio), value=min(ratio.rounds)),
                Cell(str(len(ratio.rounds)), value=len(ratio.rounds)),
            ]
        )
        for ratio in ratios
    ]
    return Table(run_name(run), columns, lines)


def _ratio_range(ratio: Ratio) -> str:
    return f"{words.ratio(min(ratio.rounds))} .. {words.ratio(max(ratio.rounds))}"


def gpu(result: Result) -> Table | None:
    """The runs of each backend on a device, side by side, and its memory; None without one."""
    labels = words.labels(result)
    every = gpu_runs.all_runs(result)
    met = [run for run in gpu_runs.RUNS if any(run in runs.rows for runs in every)]
    lines = []
    for runs in every:
        line = [
            Cell(runs.place.scene, css="text"),
            Cell(words.size(runs.place.n), value=runs.place.n),
            Cell(labels[runs.impl], css="text"),
            *(_device_time(runs, run) for run in met),
            _number(runs.bytes_per_sphere),
        ]
        lines.append(Line(line))
    columns = [
        column("scene", "text"),
        column("spheres"),
        column("implementation", "text"),
        *((say("column_run_ms", run=run_name(run)), "") for run in met),
        column("device_bytes"),
    ]
    return Table(say("gpu_table"), columns, lines) if lines else None


def _device_time(runs: gpu_runs.Runs, run: str) -> Cell:
    """Below it how much of the warm run's time it is."""
    cell, ratio = _time(runs.rows.get(run)), runs.to_warm(run)
    if run == "warm" or ratio is None:
        return cell
    return replace(cell, small=words.ratio(ratio))


def frames(result: Result) -> Table | None:
    """Steady-state medians of moving scenes; None without any."""
    labels = words.labels(result)
    named = any(course.motion != course.place.scene for course in dynamic.courses(result))
    lines = []
    for course, rows in dynamic.courses(result).items():
        for row in rows:
            assert row.motion
            every = row.motion.by_frame
            warmup, count = row.motion.warmup, len(every)
            line = [
                Cell(course.place.scene, css="text"),
                Cell(words.size(course.place.n), value=course.place.n),
                *([Cell(course.motion, css="text")] if named else []),
                Cell(labels[row.impl], css="text"),
                _time(row),
                _number(median(every[:1])) if row.counts else Cell(words.NONE, css="none"),
                Cell(say("frames_count", frames=count, warmup=warmup), value=count),
            ]
            lines.append(Line(line, "" if row.counts else "wrong"))
    columns = [
        column("scene", "text"),
        column("spheres"),
        *([column("motion", "text")] if named else []),
        column("implementation", "text"),
        *map(column, ("steady", "first", "frames")),
    ]
    return Table(say("frames_table"), columns, lines) if lines else None


def skipped(result: Result) -> Table | None:
    """Rows that were skipped alike share a line; None without any."""
    labels = words.labels(result)
    places: dict[tuple[Impl, str], dict[str, None]] = {}
    runs: dict[tuple[Impl, str], dict[str, None]] = {}
    for row in result.rows:
        if row.status == "skipped":
            key = row.impl, row.reason or ""
            places.setdefault(key, {})[words.place(row.place)] = None
            runs.setdefault(key, {})[row.run] = None
    lines = [
        Line(
            [
                Cell(labels[impl], css="text"),
                Cell(", ".join(places[impl, reason]), css="text wrap"),
                Cell(_run_names(list(runs[impl, reason])), css="text"),
                Cell(reason, css="text wrap"),
            ]
        )
        for impl, reason in places
    ]
    names = ("implementation", "where", "runs", "why")
    columns = [column(name, "text") for name in names]
    return Table(say("skipped_title"), columns, lines) if lines else None


def _run_names(runs: list[str]) -> Said:
    names = [run_name(run) for run in runs]
    return Said(", ".join(name.en for name in names), "、".join(name.zh for name in names))


def unavailable(result: Result) -> Table | None:
    """Scenes that could not be loaded; None without any."""
    lines = [
        Line(
            [
                Cell(group.scene, css="text"),
                Cell(group.spec, css="text"),
                Cell(group.unavailable, css="text wrap"),
            ]
        )
        for group in result.groups
        if group.unavailable is not None
    ]
    columns = [column(name, "text") for name in ("scene", "spec", "why")]
    return Table(say("unavailable_title"), columns, lines) if lines else None
