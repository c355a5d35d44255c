# SPDX-License-Identifier: MIT
"""Where the time goes: stacked bars, one colour per stage."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, MaxNLocator

from octocell_report import style, tables, words
from octocell_report.load import STAGES, Impl, Place, Result, Row
from octocell_report.style import Look

RUN = "warm"
Bar = tuple[str, Row | None]  # what stands left of it, and what it shows

_CUT = 3.0  # a bar longer than this many medians of its axis is cut, and says so


def draw(result: Result, looks: dict[Impl, Look], side: str) -> Figure | None:
    """One facet per scene at the largest size that this side ran at; milliseconds."""
    impls = result.impls_of(side)
    every = tables.largest(result, RUN, impls)
    places = [place for place in every if _staged(result, place, impls)]
    if not places:
        return None
    columns = min(2, len(places))
    lines = math.ceil(len(places) / columns)
    height = 0.5 * len(impls) + 1.1
    figure, axes = plt.subplots(
        lines,
        columns,
        figsize=(3.4 + 5.3 * columns, height * lines + 1.0),
        squeeze=False,
        sharey=True,
        layout="constrained",
    )
    for ax, place in zip(axes.flat, places, strict=False):
        rows = {row.impl: row for row in result.at(place, RUN)}
        bars = [(looks[impl].label, rows.get(impl)) for impl in impls]
        _bars(ax, bars, _Scale.of(bars, per_sphere=False))
        ax.set_title(f"{place.scene}, {words.size(place.n)} spheres")
        ax.set_xlabel("time, warm [ms]")
    for ax in list(axes.flat)[len(places) :]:
        ax.set_visible(False)
    shown = [r for p in places for r in result.at(p, RUN) if r.impl in impls]
    _finish(figure, shown, "Stages at each scene's largest size, warm")
    return figure


def draw_per_sphere(result: Result, looks: dict[Impl, Look]) -> Figure | None:
    """One facet per implementation of ours, one bar per scene; one scale per backend."""
    ours = {side: result.impls_of(side) for side in ("backend", "device")}
    places = {i: tables.largest(result, RUN, side) for side in ours.values() for i in side}
    rows = {(r.impl, r.place): r for r in result.rows if r.run == RUN and r.stage_ms}
    impls = [impl for impl in places if any((impl, p) in rows for p in places[impl])]
    if not impls:
        return None
    most = max(len(places[impl]) for impl in impls)
    figure, axes = plt.subplots(
        len(impls),
        1,
        figsize=(12.5, (0.5 * most + 1.1) * len(impls) + 1.0),
        squeeze=False,
        layout="constrained",
    )
    every = {(r.impl, r.place): r for r in result.rows if r.run == RUN}
    bars = {i: [(words.place(p), every.get((i, p))) for p in places[i]] for i in impls}
    for ax, impl in zip(axes[:, 0], impls, strict=True):
        alike = [bar for other in impls if other.backend == impl.backend for bar in bars[other]]
        _bars(ax, bars[impl], _Scale.of(alike, per_sphere=True))
        ax.set_title(looks[impl].label)
        ax.set_xlabel("time per sphere, warm [ns]")
    shown = [row for (impl, _), row in rows.items() if impl in impls]
    _finish(
        figure, shown, "The same per sphere: how the scene changes the cost; one scale per backend"
    )
    return figure


def _staged(result: Result, place: Place, impls: list[Impl]) -> bool:
    return any(row.impl in impls and row.stage_ms for row in result.at(place, RUN))


@dataclass(frozen=True)
class _Scale:
    """The horizontal axis of one facet, or of several that are to be compared."""

    per_sphere: bool  # nanoseconds per sphere, else milliseconds
    end: float  # the longest bar drawn; longer ones are cut there, and say so
    room: float  # the axis' length in bars' ends: room for the text behind them
    letters: float  # the share of end that a percentage needs

    @staticmethod
    def of(bars: list[Bar], per_sphere: bool) -> _Scale:
        lengths = [_marked_ms(row) * _unit(row, per_sphere) for _, row in bars if row]
        lengths = [length for length in lengths if length > 0] or [1.0]
        limit = _CUT * median(lengths)
        end = max(length for length in lengths if length <= limit)
        end = min(limit, 1.2 * end) if max(lengths) > limit else end
        return _Scale(per_sphere, end, *((1.3, 0.055) if per_sphere else (1.75, 0.12)))


def _unit(row: Row, per_sphere: bool) -> float:
    return 1e6 / row.place.n if per_sphere else 1.0


def _marked_ms(row: Row) -> float:
    return sum(median(ms) for ms in row.stage_ms.values())


def _bars(ax: Axes, bars: list[Bar], scale: _Scale) -> None:
    """Labels down the left; a row that did not run says why where its bar would be."""
    ax.set_xlim(0, scale.end * scale.room)
    ax.set_ylim(len(bars) - 0.4, -0.6)
    ax.set_yticks(range(len(bars)), [label for label, _ in bars])
    ax.xaxis.set_major_locator(MaxNLocator(6))
    ax.xaxis.set_major_formatter(FuncFormatter(words.tick))
    ax.grid(axis="y", visible=False)
    ax.tick_params(axis="y", length=0)
    for y, (_, row) in enumerate(bars):
        if row is not None and row.stage_ms:
            _stack(ax, y, row, scale)
            continue
        ax.text(scale.end * 0.01, y, _why_empty(row), va="center", color=style.FAINT, fontsize=10.5)


def _why_empty(row: Row | None) -> str:
    if row is None:
        return "not in this run"
    if row.status == "skipped":
        return f"skipped: {words.short_reason(row.reason, 48)}"
    return "no stages measured"


def _stack(ax: Axes, y: float, row: Row, scale: _Scale) -> None:
    left, unit, end = 0.0, _unit(row, scale.per_sphere), scale.end
    whole = _marked_ms(row) * unit
    for stage, ms in row.stage_ms.items():
        width = median(ms) * unit
        seen = min(width, end - left)
        if seen <= 0:
            break
        colour = style.stage_colour(stage)
        ax.barh(
            y,
            seen,
            left=left,
            height=0.62,
            color=colour,
            edgecolor="white",
            linewidth=0.8,
            hatch=None if row.counts else "////",
            alpha=1.0 if row.counts else 0.55,
        )
        if seen > scale.letters * end and row.counts:
            ax.text(
                left + seen / 2,
                y,
                f"{100 * width / whole:.0f}%",
                ha="center",
                va="center",
                color=style.ink_on(colour),
                fontsize=9.5,
            )
        left += seen
    ax.text(
        left + 0.012 * end,
        y,
        _after(row, whole > end * 1.001),
        va="center",
        fontsize=10,
        linespacing=1.15,
    )


def _after(row: Row, cut: bool) -> str:
    """What stands behind the bar: the unmarked total, what is fused, and what is wrong."""
    each = words.number(tables.ns_per_sphere(row))
    lines = [f"{words.number(row.median_ms)} ms · {each} ns/sphere"]
    if cut:
        lines[0] = "» cut: " + lines[0]
    if not row.counts:
        lines.append(words.verdict(row))
    lines += [f"{stage} is inside {host}" for stage, host in row.fused.items()]
    return "\n".join(lines)


def _finish(figure: Figure, rows: list[Row], title: str) -> None:
    met = {stage for row in rows for stage in row.stage_ms}
    order = [stage for stage in STAGES if stage in met] + sorted(met - set(STAGES))
    handles = [Patch(color=style.stage_colour(stage), label=stage) for stage in order]
    if any(row.stage_ms and not row.counts for row in rows):
        hatched = Patch(facecolor="#dddddd", edgecolor="white", hatch="////", label="not exact")
        handles.append(hatched)
    figure.suptitle(
        f"{title}\nbars: runs with stage marks; text: total of runs without marks",
        x=0.01,
        ha="left",
        fontsize=12.5,
    )
    figure.legend(handles=handles, loc="outside lower left", ncols=len(handles), fontsize=11.5)
