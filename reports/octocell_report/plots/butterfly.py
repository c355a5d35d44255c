# SPDX-License-Identifier: MIT
"""Time across, what is missed upwards, what is false downwards; between them a strip without error.

One column per class of scenes. A bold mark is the worst scene of its series, or its median time
where none has an error; pale marks are the single scenes.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import matplotlib.patheffects as effects
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter, NullLocator

from octocell_report import style, words
from octocell_report.error import MILLION, Point, Series, Study, Summary
from octocell_report.plots import key
from octocell_report.plots.key import Frame
from octocell_report.plots.labels import Placer
from octocell_report.predicates import EXACT

Measure = Callable[[Point], float | None]  # None where the point has no such error

_LEFT, _RIGHT, _TOP, _BOTTOM = 1.75, 0.15, 1.5, 2.2  # inches around the facets
_UP, _DOWN, _LANE, _HEAD = 3.4, 2.9, 0.27, 0.42  # inches
_BOLD, _PALE = 10.5, 5.5  # points
_FRONTS = {True: "GPU", False: "CPU"}
_HALO = [effects.withStroke(linewidth=3, foreground="white")]


@dataclass(frozen=True)
class Side:
    """What one of the two panels shows."""

    measure: Measure
    label: str


@dataclass(frozen=True)
class Butterfly:
    title: str
    up: Side
    down: Side
    tick: Callable[[float], str]
    floor: float = 0.0  # smaller measures are drawn there
    ceiling: float = math.inf  # and larger ones there

    def height(self, value: float) -> float:
        return min(max(value, self.floor), self.ceiling)


def draw(study: Study, butterfly: Butterfly) -> Figure | None:
    """None where nothing has an error that could be shown."""
    limits = _limits(study, butterfly)
    if limits is None:
        return None
    lanes = _lanes(study)
    strip = _HEAD + _LANE * len(lanes)
    width = {1: 8.2, 2: 5.6}.get(len(study.classes), 4.35)
    size = (_LEFT + width * len(study.classes) + _RIGHT, _TOP + _UP + strip + _DOWN + _BOTTOM)
    figure, axes = plt.subplots(
        3,
        len(study.classes),
        figsize=size,
        squeeze=False,
        sharex=True,
        sharey="row",
        height_ratios=[_UP, strip, _DOWN],
        gridspec_kw={
            "left": _LEFT / size[0],
            "right": 1 - _RIGHT / size[0],
            "top": 1 - _TOP / size[1],
            "bottom": _BOTTOM / size[1],
            "hspace": 0.0,
            "wspace": 0.06,
        },
    )
    _scales(study, axes, limits, butterfly, lanes)
    for column, name in enumerate(study.classes):
        _Facet(figure, study, name, list(axes[:, column]), butterfly, lanes).draw()
    key.draw(figure, study, butterfly.title, Frame(*size, _LEFT, _BOTTOM))
    return figure


def _lanes(study: Study) -> list[str]:
    """Those that are without error on some scene, from the top."""
    met = {point.series.lane for point in study.points if point.errors == 0}
    return [s for s in dict.fromkeys(series.lane for series in study.series) if s in met]


def _limits(study: Study, butterfly: Butterfly) -> tuple[float, float] | None:
    values = [
        butterfly.height(value)
        for point in study.points
        for side in (butterfly.up, butterfly.down)
        if (value := side.measure(point)) is not None
    ]
    if not values:
        return None
    low, high = math.log10(min(values)), math.log10(max(values))
    return 10 ** (math.floor(low) - 0.05 * max(high - low, 2)), 10 ** (
        high + 0.1 * max(high - low, 2)
    )


def _short_tick(value: float, _: object = None) -> str:
    return words.size(round(value)) if value >= 1000 else words.tick(value)


def _scales(
    study: Study, axes: Any, limits: tuple[float, float], butterfly: Butterfly, lanes: list[str]
) -> None:
    every = [point.ns for point in study.points]
    low, high = (math.log10(limit) for limit in limits)
    step = max(1, math.ceil((high - low) / 8))
    ticks = [10.0**k for k in range(math.ceil(low), math.floor(high) + 1, step)]
    for ax in axes[[0, 2]].flat:
        ax.set_yscale("log")
        ax.yaxis.set_major_locator(FixedLocator(ticks))
        ax.yaxis.set_minor_locator(NullLocator())
        ax.yaxis.set_major_formatter(FuncFormatter(lambda y, _: butterfly.tick(y)))
    for ax in axes[0]:  # above it the fronts' labels
        ax.set_ylim(limits[0], limits[1] * (limits[1] / limits[0]) ** 0.3)
    for ax in axes[2]:
        ax.set_ylim(limits[1], limits[0])
    for ax in axes.flat:
        ax.set_xscale("log")
        ax.set_xlim(min(every) / 2.2, max(every) * 1.8)
        ax.xaxis.set_major_locator(LogLocator(numticks=8))
        ax.xaxis.set_major_formatter(FuncFormatter(_short_tick))
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.tick_params(length=0)
    head = _HEAD / _LANE
    for ax in axes[1]:
        ax.set_facecolor(style.NO_ERROR_FILL)
        ax.set_ylim(len(lanes) - 0.45, -0.55 - head)
        ax.yaxis.set_major_locator(FixedLocator(list(range(len(lanes)))))
        ax.yaxis.set_major_formatter(FuncFormatter(lambda y, _: lanes[round(y)]))
        ax.grid(axis="x", color="white")
    for tick, lane in zip(axes[1, 0].get_yticklabels(), lanes, strict=True):
        tick.set_color(style.dark(style.predicate_colour(lane)))
        tick.set_fontweight("bold" if lane == EXACT else "normal")
    axes[0, 0].set_ylabel(butterfly.up.label)
    axes[2, 0].set_ylabel(butterfly.down.label)


class _Facet:
    """One class of scenes."""

    def __init__(
        self,
        figure: Figure,
        study: Study,
        name: str,
        axes: list[Axes],
        butterfly: Butterfly,
        lanes: list[str],
    ) -> None:
        self.figure, self.study, self.name, self.butterfly, self.lanes = (
            figure,
            study,
            name,
            butterfly,
            lanes,
        )
        self.up, self.strip, self.down = axes
        self.summaries = study.summaries(name)
        self.looks = key.looks(study)

    def draw(self) -> None:
        places = [group.scene for group in self.study.groups if group.scene_class == self.name]
        scenes = textwrap.fill(", ".join(dict.fromkeys(places)), 54, break_long_words=False)
        self.up.set_title(self.name, pad=36)
        look: dict[str, Any] = {"xytext": (0, 33), "textcoords": "offset points", "va": "top"}
        look |= {"xycoords": "axes fraction", "color": style.FAINT, "fontsize": 10.5}
        self.up.annotate(scenes, (0, 1), **look)
        self._zero()
        fronts = self._fronts()
        self._panel(self.up, self.butterfly.up, fronts)
        self._panel(self.down, self.butterfly.down, [])

    def _zero(self) -> None:
        """The strip: pale where a scene has no error, bold where none of the class has."""
        pairs = self.study.pairs(self.name)
        bound = words.rate(3 * MILLION / pairs) if pairs else words.NONE
        self.strip.text(
            0.015,
            -0.62,
            f"0 of {words.count(pairs)} true pairs wrong:\nbelow {bound} per million (95 %: 3/N)",
            transform=self.strip.get_yaxis_transform(),
            va="bottom",
            fontsize=9.5,
            color="#2d6a4a",
            linespacing=1.05,
            bbox={"facecolor": style.NO_ERROR_FILL, "edgecolor": "none", "pad": 1.5},
            zorder=2,
        )
        for summary in self.summaries:
            lane = summary.series.lane
            for point in summary.points:
                if point.errors == 0:
                    self._mark(
                        self.strip, summary.series, point.ns, self.lanes.index(lane), bold=False
                    )
            if summary.errors == 0:
                self._mark(
                    self.strip, summary.series, summary.ns, self.lanes.index(lane), bold=True
                )

    def _fronts(self) -> list[Any]:
        """Lines that nothing exact lies left of."""
        found = []
        fronts = self.study.fronts(self.name)
        every = [point.ns for point in self.study.points]
        middle = math.sqrt(min(every) * max(every))
        for number, (on_device, summary) in enumerate(fronts.items()):
            for ax in (self.up, self.strip, self.down):
                ax.axvline(
                    summary.ns, color=style.INK, linewidth=1.2, linestyle=(0, (4, 2)), zorder=1
                )
            name, how = summary.series.backend, summary.series.predicate
            how = f"{how}, " if how else ""
            text = (
                f"fastest exact, {_FRONTS[on_device]}:\n{name}\n{how}{words.number(summary.ns)} ns"
            )
            late = summary.ns > middle and len(fronts) == 1
            note = self.up.annotate(
                text,
                (summary.ns, 1),
                xycoords=("data", "axes fraction"),
                xytext=(-5 if late else 5, -4 - 40 * number),  # one below the other
                textcoords="offset points",
                ha="right" if late else "left",
                va="top",
                fontsize=9.5,
                linespacing=1.1,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1},  # over other lines
            )
            found.append(note)
        return found

    def _panel(self, ax: Axes, side: Side, texts: list[Any]) -> None:
        placer = Placer(self.figure, ax)
        for text in texts:
            placer.text(text)
        lines: dict[str, list[tuple[float, float]]] = {}
        for summary in self.summaries:
            worst = self._marks(ax, summary, side.measure, placer)
            if worst is not None:
                name = summary.series.predicate or summary.series.backend
                lines.setdefault(name, []).append(worst)
        for name, marks in lines.items():
            marks.sort()
            line: dict[str, Any] = {"linewidth": 1.3, "alpha": 0.5, "zorder": 2}
            ax.plot(*zip(*marks, strict=True), color=style.predicate_colour(name), **line)
        for name, marks in sorted(lines.items(), key=lambda item: -item[1][0][1]):
            look: dict[str, Any] = {"fontsize": 10.5, "weight": "bold", "path_effects": _HALO}
            anchors = [*_gaps(marks), *marks[::-1]]
            placer.label(name, anchors, color=style.dark(style.predicate_colour(name)), **look)

    def _marks(
        self, ax: Axes, summary: Summary, measure: Measure, placer: Placer
    ) -> tuple[float, float] | None:
        """Every scene pale; bold the worst error, at the median time, and where that is: times of
        single scenes differ by more than tests do."""
        found = [
            (self.butterfly.height(value), point.ns)
            for point in summary.points
            if (value := measure(point)) is not None
        ]
        for value, ns in found:
            self._mark(ax, summary.series, ns, value, bold=False)
            placer.mark(ns, value, _PALE, 1.0)
        if not found:
            return None
        value = max(found)[0]
        self._mark(ax, summary.series, summary.ns, value, bold=True)
        placer.mark(summary.ns, value, _BOLD, 20.0)
        return summary.ns, value

    def _mark(self, ax: Axes, series: Series, x: float, y: float, bold: bool) -> None:
        colour, marker = self.looks[series]
        look: dict[str, Any] = {"markersize": _PALE, "alpha": 0.4, "zorder": 3}
        look["markeredgewidth"] = 0.0
        if bold and series.predicate == EXACT:
            look = {"markersize": _BOLD + 2, "zorder": 6}
            look |= {"markeredgecolor": style.INK, "markeredgewidth": 1.8}
        elif bold:
            look = {"markersize": _BOLD, "zorder": 5}
            look |= {"markeredgecolor": style.dark(colour), "markeredgewidth": 1.0}
        ax.plot([x], [y], marker=marker, color=colour, linestyle="none", **look)


def _gaps(marks: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The middles of wide gaps between neighbours, where a label hides none of the marks."""
    return [
        (math.sqrt(x * next_x), math.sqrt(y * next_y))
        for (x, y), (next_x, next_y) in pairwise(marks)
        if next_x > 8 * x
    ]
