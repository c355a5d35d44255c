# SPDX-License-Identifier: MIT
"""The README's tables of a device's rows: its runs beside other backends, and its stages."""

from __future__ import annotations

from statistics import median

import pandas as pd

from octocell_report import bandwidth, tables, words
from octocell_report.bandwidth import Rate
from octocell_report.fields import ReportError
from octocell_report.load import Place, Result, Row
from octocell_report.markdown import table

SCENE = "gas"  # the plain scene, as in the table of speeds
OURS = "impl_cuda_custom"
OTHERS = ("impl_thrust_cuda", "impl_cpu")
EXTRA_RUNS = {"graph": "graph", "transfers": "with transfers"}  # of ours, beside warm
STAGE_SIZES = (1_000_000, 10_000_000)


def speed(result: Result) -> str:
    """By size: ours hot, as a graph, with transfers; beside Thrust and our own CPU backend."""
    places = [Place(SCENE, n) for n in result.sizes(SCENE) if n > 0]
    places = [p for p in places if any(r.impl.backend == OURS for r in result.at(p, "warm"))]
    if not places:
        raise ReportError(f"block 'gpu_speed' needs warm rows of {OURS} on {SCENE}")
    others = [b for b in OTHERS if any(_of(result, place, b) for place in places)]
    header = ["spheres", f"{OURS} [ms]", *(f"{name} [ms]" for name in EXTRA_RUNS.values())]
    header += [f"{backend} [ms]" for backend in others] + [f"vs {backend}" for backend in others]
    lines = [_speeds(result, place, others) for place in places]
    taken = [row for p in places for b in (OURS, *others) if (row := fastest(result, p, b))]
    labels = words.labels(result)
    names = ", ".join(f"`{name}`" for name in dict.fromkeys(labels[r.impl] for r in taken))
    note = (
        f"Scene {SCENE}, warm, median of the rounds; of each backend the fastest exact variant at "
        f"that size ({names}). Ratios are its time by ours, warm, within interleaved rounds, "
        f"median; above 1 ours is faster. {words.NONE}: not measured."
    )
    return table(pd.DataFrame(lines, columns=header), note)


def _speeds(result: Result, place: Place, others: list[str]) -> list[str]:
    ours = fastest(result, place, OURS)
    cells = [words.grouped(place.n), _time(result, place, OURS)]
    for run in EXTRA_RUNS:
        rows = [r for r in result.at(place, run) if ours and r.impl == ours.impl]
        cells.append(_shown(rows[0]) if rows else words.NONE)
    cells += [_time(result, place, backend) for backend in others]
    return cells + [_ratio(fastest(result, place, backend), ours) for backend in others]


def _of(result: Result, place: Place, backend: str) -> list[Row]:
    """Default rows that ran."""
    rows = result.at(place, "warm")
    return [
        r
        for r in rows
        if r.impl.backend == backend and r.status != "skipped" and not r.negative_control
    ]


def fastest(result: Result, place: Place, backend: str) -> Row | None:
    rows = [row for row in _of(result, place, backend) if row.counts]
    return min(rows, key=lambda row: row.median_ms, default=None)


def _time(result: Result, place: Place, backend: str) -> str:
    """What is not exact has no time, but does not go unsaid either."""
    row = fastest(result, place, backend)
    wrong = _of(result, place, backend) if row is None else []
    return _shown(row or wrong[0]) if row or wrong else words.NONE


def _shown(row: Row) -> str:
    if row.status == "skipped":
        return "skipped"
    return words.number(row.median_ms) if row.counts else f"**{words.verdict(row)}**"


def _ratio(reference: Row | None, row: Row | None) -> str:
    rounds = tables.round_ratios(reference, row) if reference and row else ()
    return words.ratio(median(rounds)) if rounds else words.NONE


def stages(result: Result) -> str:
    """Time, share and bandwidth of each stage, at two sizes side by side."""
    rows = _staged(result)
    if not rows:
        raise ReportError(f"block 'gpu_stages' needs stages with bytes of {OURS} on {SCENE}")
    header = ["stage"]
    for row in rows:
        header += [f"{words.size(row.place.n)}: ms", "share", "GB/s"]
        header += ["of copy"] if result.gpu else []
    names = list(dict.fromkeys(stage for row in rows for stage in row.stage_ms))
    lines = [[f"`{s}`", *(c for row in rows for c in _stage(result, row, s))] for s in names]
    lines.append([bandwidth.ALL, *(c for row in rows for c in _stage(result, row, None))])
    labels = words.labels(result)
    variants = ", ".join(f"`{name}`" for name in dict.fromkeys(labels[row.impl] for row in rows))
    held = [f"`{s}` is inside `{host}`" for s, host in rows[-1].fused.items()]
    copied = (
        f"; of copy: by the {words.grouped(result.gpu.copy_gbps)} GB/s that a copy on this "
        f"{result.gpu.name} reads and writes"
        if result.gpu
        else ""
    )
    note = (
        f"{variants}, scene {SCENE}, warm, runs with stage marks, median of the rounds. GB/s: the "
        f"least bytes that the stage must read and write, by its time{copied}."
    )
    if any(rate.tiny for row in rows for rate in bandwidth.rates(result, row)):
        limit = f"{bandwidth.LAUNCH_US:g}"
        note += f" In brackets: so few bytes that copying them takes less than {limit} µs."
    return table(
        pd.DataFrame(lines, columns=header), " ".join([note, *(f"{text}." for text in held)])
    )


def _staged(result: Result) -> list[Row]:
    """The fastest at each of the two sizes, or at the two largest that there are."""
    found = {}
    for n in result.sizes(SCENE):
        for row in bandwidth.best(result, Place(SCENE, n)):
            if row.impl.backend == OURS:
                found[n] = row
    sizes = [n for n in STAGE_SIZES if n in found]
    return [found[n] for n in (sizes if len(sizes) == len(STAGE_SIZES) else list(found)[-2:])]


def _stage(result: Result, row: Row, stage: str | None) -> list[str]:
    """A stage's cells at one size; those of all stages together without a name."""
    times = {name: median(ms) for name, ms in row.stage_ms.items()}
    every = {rate.stage: rate for rate in bandwidth.rates(result, row)}
    rate = every.get(stage) if stage else bandwidth.whole(result, row)
    time = times.get(stage) if stage else sum(times.values())
    share = f"{words.percent(100 * time / sum(times.values()))} %" if time else words.NONE
    return [words.number(time), share, *_rate(result, rate)]


def _rate(result: Result, rate: Rate | None) -> list[str]:
    cells = [words.number(rate.gbps if rate else None)]
    if result.gpu:
        share = rate.share if rate else None
        cells.append(words.NONE if share is None else f"{words.percent(100 * share)} %")
    return [f"({cell})" for cell in cells] if rate and rate.tiny else cells
