# SPDX-License-Identifier: MIT
"""How near each stage on a device comes to the speed at which its memory copies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import (
    FixedLocator,
    FuncFormatter,
    LogLocator,
    MaxNLocator,
    NullFormatter,
    NullLocator,
)

from octocell_report import bandwidth, style, words
from octocell_report.bandwidth import Rate
from octocell_report.load import Impl, Result, Row
from octocell_report.style import Look

_MEANING = "the least bytes that a stage must read and write, by its time"
_TINY = f"hollow: so few bytes that copying them takes less than {bandwidth.LAUNCH_US:g} µs"
_COPY: dict[str, Any] = {"color": style.INK, "linewidth": 1.4, "linestyle": (0, (5, 2))}


def draw(result: Result, looks: dict[Impl, Look]) -> Figure | None:
    """One facet per scene at its largest size; a bar per stage and backend."""
    rows = {place: bandwidth.best(result, place) for place in bandwidth.places(result)}
    if not rows:
        return None
    columns = min(2, len(rows))
    lines = math.ceil(len(rows) / columns)
    bars = max(sum(len(bandwidth.rates(result, r)) for r in here) for here in rows.values())
    figure, axes = plt.subplots(
        lines,
        columns,
        figsize=(2.0 + 6.0 * columns, (0.27 * bars + 1.6) * lines + 1.3),
        squeeze=False,
        layout="constrained",
    )
    for ax, (place, here) in zip(axes.flat, rows.items(), strict=False):
        _facet(ax, result, looks, here)
        ax.set_title(f"{place.scene}, {words.size(place.n)} spheres")
    for ax in list(axes.flat)[len(rows) :]:
        ax.set_visible(False)
    impls = list(dict.fromkeys(row.impl for here in rows.values() for row in here))
    handles = [Patch(color=looks[impl].colour, label=looks[impl].label) for impl in impls]
    every = [rate for here in rows.values() for row in here for rate in _rates(result, row)]
    _finish(figure, result, handles, every, "Bandwidth at each scene's largest size, warm")
    return figure


def _rates(result: Result, row: Row) -> list[Rate]:
    """The stages', then that of all together where it can be told."""
    whole = bandwidth.whole(result, row)
    return bandwidth.rates(result, row) + ([whole] if whole else [])


def _facet(ax: Axes, result: Result, looks: dict[Impl, Look], rows: list[Row]) -> None:
    rates = {row.impl: {rate.stage: rate for rate in _rates(result, row)} for row in rows}
    every = [rate for here in rates.values() for rate in here.values()]
    stages = bandwidth.met([rate for rate in every if rate.stage != bandwidth.ALL])
    stages += [bandwidth.ALL] if any(rate.stage == bandwidth.ALL for rate in every) else []
    end = max([rate.gbps for rate in every] + [result.gpu.copy_gbps if result.gpu else 0.0])
    step = 0.84 / len(rates)
    for place, stage in enumerate(stages):
        for index, (impl, here) in enumerate(rates.items()):
            if stage in here:
                y = place - 0.42 + step * (index + 0.5)
                _bar(ax, looks[impl], here[stage], y, step, end)
    if result.gpu:
        ax.axvline(result.gpu.copy_gbps, **_COPY)
    ax.set_xlim(0, end * 1.36)
    ax.set_ylim(len(stages) - 0.4, -0.6)
    ax.set_yticks(range(len(stages)), stages)
    ax.tick_params(axis="y", length=0)
    ax.grid(axis="y", visible=False)
    ax.xaxis.set_major_locator(MaxNLocator(6))
    ax.xaxis.set_major_formatter(FuncFormatter(words.tick))
    ax.set_xlabel("10⁹ bytes a second")


def _bar(ax: Axes, look: Look, rate: Rate, y: float, height: float, end: float) -> None:
    face: dict[str, Any] = {"facecolor": "white"} if rate.tiny else {"facecolor": look.colour}
    ax.barh(y, rate.gbps, height=0.86 * height, edgecolor=look.edge, linewidth=0.9, **face)
    text = words.number(rate.gbps)
    if rate.share is not None:
        text += f" · {words.percent(100 * rate.share)} %"
    if rate.tiny:
        text += f" · only {words.count(rate.least_bytes)} bytes"
    ink = style.FAINT if rate.tiny else style.INK
    box = {"facecolor": "white", "edgecolor": "none", "pad": 0.4}
    ax.text(rate.gbps + 0.012 * end, y, text, va="center", fontsize=9.5, color=ink, bbox=box)


def draw_by_size(result: Result, looks: dict[Impl, Look]) -> Figure | None:
    """The plain scene over all sizes: a facet per backend and run, a line per stage."""
    place = next((p for p in bandwidth.places(result) if p.scene == bandwidth.SCENE), None)
    if place is None:
        return None
    facets = {
        (best.impl, run): rows
        for best in bandwidth.best(result, place)
        for run in bandwidth.RUNS
        if len(rows := bandwidth.over_sizes(result, best.impl, run)) > 1
    }
    if not facets:
        return None
    columns = min(2, len(facets))
    lines = math.ceil(len(facets) / columns)
    figure, axes = plt.subplots(
        lines,
        columns,
        figsize=(2.0 + 6.0 * columns, 4.2 * lines + 1.4),
        squeeze=False,
        sharey=True,
        layout="constrained",
    )
    every = []
    for ax, ((impl, run), rows) in zip(axes.flat, facets.items(), strict=False):
        rates = [rate for row in rows for rate in _rates(result, row)]
        _lines(ax, result, rates)
        ax.set_title(f"{looks[impl].label}, {run}")
        every += rates
    for ax in axes[:, 0]:
        ax.set_ylabel("10⁹ bytes a second")
    for ax in list(axes.flat)[len(facets) :]:
        ax.set_visible(False)
    stages = [stage for stage in bandwidth.met(every) if stage != bandwidth.ALL]
    handles = [_handle(stage) for stage in [*stages, bandwidth.ALL]]
    title = f"Bandwidth over the sizes of {bandwidth.SCENE}; cold_cache: the cache holds none of it"
    _finish(figure, result, handles, every, title)
    return figure


def _colour(stage: str) -> str:
    return style.INK if stage == bandwidth.ALL else style.stage_colour(stage)


def _handle(stage: str) -> Line2D:
    dashes = ":" if stage == bandwidth.ALL else "-"
    return Line2D([], [], color=_colour(stage), linestyle=dashes, marker="o", label=stage)


def _lines(ax: Axes, result: Result, rates: list[Rate]) -> None:
    sizes = sorted({rate.row.place.n for rate in rates})
    for stage in dict.fromkeys(rate.stage for rate in rates):
        here = [rate for rate in rates if rate.stage == stage]
        shape: dict[str, Any] = {"color": _colour(stage), "linewidth": 2}
        dashes = ":" if stage == bandwidth.ALL else "-"
        ax.plot([r.row.place.n for r in here], [r.gbps for r in here], linestyle=dashes, **shape)
        for rate in here:
            face = "white" if rate.tiny else _colour(stage)
            ax.plot([rate.row.place.n], [rate.gbps], "o", color=_colour(stage), mfc=face, ms=6.5)
    if result.gpu:
        ax.axhline(result.gpu.copy_gbps, **_COPY)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.xaxis.set_major_locator(FixedLocator(sizes))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda n, _: words.size(round(n))))
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
    ax.yaxis.set_major_formatter(FuncFormatter(words.tick))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.tick_params(axis="y", labelleft=True)
    ax.set_xlabel("spheres")


def _finish(
    figure: Figure, result: Result, handles: Sequence[Artist], rates: list[Rate], title: str
) -> None:
    if result.gpu:
        copied = words.grouped(result.gpu.copy_gbps)
        label = f"copy on this {result.gpu.name}: {copied} GB/s (read and written)"
        handles = [*handles, Line2D([], [], label=label, **_COPY)]
    notes = [title, _MEANING, *([_TINY] if any(rate.tiny for rate in rates) else [])]
    figure.suptitle("\n".join(notes), x=0.01, ha="left", fontsize=12.5)
    figure.legend(handles=handles, loc="outside lower left", ncols=4)
