# SPDX-License-Identifier: MIT
"""Errors per million true pairs: series down, scenes across, by class."""

from __future__ import annotations

import math
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize, to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from octocell_report import style, words
from octocell_report.error import MILLION, Point, Series, Study
from octocell_report.groups import Place

COLOURS = LinearSegmentedColormap.from_list(
    "errors", ["#fff3dc", style.ORANGE, style.VERMILLION, "#6b2400"]
)
_TICKS = (1, 10, 100, 1000, 10_000, 100_000, 1_000_000)


def draw(study: Study) -> Figure | None:
    """None without a series."""
    if not study.series:
        return None
    rows, places = study.series, [group.place for group in study.groups]
    size = (4.6 + 1.02 * max(len(places), 5), 1.9 + 0.33 * (len(rows) + _breaks(rows)))
    figure, ax = plt.subplots(figsize=size, layout="constrained")
    norm = Normalize(0, math.log10(5 * MILLION))
    held = {(point.series, point.row.place): point for point in study.points}
    heights = _heights(rows)
    for series, y in zip(rows, heights, strict=True):
        for x, place in enumerate(places):
            _cell(ax, x, y, held.get((series, place)), norm)
    _frame(ax, study, rows, places, heights)
    _bar(figure, ax, norm)
    figure.suptitle(
        f"Errors per million true pairs, as {words.MINUS}lost +invented",
        x=0.01,
        ha="left",
        fontsize=14,
    )
    figure.legend(
        handles=[
            Patch(facecolor=style.EXACT_FILL, label="exact, as claimed"),
            Patch(facecolor=style.NO_ERROR_FILL, label="0: no error here, though none is claimed"),
            Patch(facecolor="white", edgecolor=style.GRID, label="empty: not run"),
        ],
        loc="outside lower left",
        ncols=3,
    )
    return figure


def _breaks(rows: list[Series]) -> float:
    return 0.25 * (len({series.predicate for series in rows}) - 1)


def _heights(rows: list[Series]) -> list[float]:
    """Where each row begins: a little room between predicates."""
    found, y = [], 0.0
    for above, series in zip([None, *rows], rows, strict=False):
        y += 0.25 if above is not None and above.predicate != series.predicate else 0.0
        found.append(y)
        y += 1.0
    return found


def _cell(ax: Axes, x: int, y: float, point: Point | None, norm: Normalize) -> None:
    box: dict[str, Any] = {"edgecolor": "white", "linewidth": 1.2}
    if point is None:
        ax.add_patch(
            Rectangle((x, y), 1, 1, facecolor="white", edgecolor=style.GRID, linewidth=0.6)
        )
        return
    fill = style.NO_ERROR_FILL if point.errors == 0 else to_hex(COLOURS(norm(_height(point))))
    if point.errors == 0 and point.claimed:
        fill = style.EXACT_FILL
    broken = point.errors > 0 and point.claimed and point.series.predicate is not None
    if broken:
        box = {"edgecolor": style.BLACK, "linewidth": 2.2, "zorder": 3}
    ax.add_patch(Rectangle((x, y), 1, 1, facecolor=fill, **box))
    text = text_of(point)
    look: dict[str, Any] = {"fontsize": 9 if len(text) <= 10 else 7.8, "zorder": 4}
    ax.text(x + 0.5, y + 0.5, text, ha="center", va="center", color=style.ink_on(fill), **look)


def text_of(point: Point) -> str:
    if point.errors == 0:
        return "exact" if point.claimed else "0"
    parts = ((words.MINUS, point.missed), ("+", point.false))
    return " ".join(sign + words.rate(point.rate(count)) for sign, count in parts if count)


def _height(point: Point) -> float:
    return math.log10(max(1.0, point.rate(point.errors)))


def _frame(
    ax: Axes, study: Study, rows: list[Series], places: list[Place], heights: list[float]
) -> None:
    several = len({place.n for place in places}) > 1
    names = [place.scene.replace("(", "\n(") for place in places]
    if several:
        names = [
            f"{name}\n{words.size(place.n)}" for name, place in zip(names, places, strict=True)
        ]
    top = 0.35 + 0.6 * max(name.count("\n") + 1 for name in names)
    classes = [group.scene_class or "" for group in study.groups]
    for x in range(len(places)):
        ax.text(x + 0.5, -0.15, names[x], ha="center", va="bottom", fontsize=9.5, linespacing=1.0)
        if x == 0 or classes[x - 1] != classes[x]:
            ax.text(x + 0.06, -top, classes[x], va="bottom", fontsize=12, weight="bold")
            ax.plot(
                [x, x], [-top - 0.7, heights[-1] + 1], color=style.INK, linewidth=1.4, clip_on=False
            )
    ax.set_xlim(0, len(places))
    ax.set_ylim(heights[-1] + 1, -top - 0.8)
    ax.set_xticks([])
    ax.set_yticks([y + 0.5 for y in heights], [series.label for series in rows])
    for tick, series in zip(ax.get_yticklabels(), rows, strict=True):
        tick.set_color(style.dark(style.predicate_colour(series.predicate)))
    ax.tick_params(axis="y", length=0)
    ax.grid(visible=False)
    for spine in ax.spines.values():
        spine.set_visible(False)


def _bar(figure: Figure, ax: Axes, norm: Normalize) -> None:
    bar = figure.colorbar(ScalarMappable(norm, COLOURS), ax=ax, fraction=0.025, pad=0.01, aspect=34)
    bar.set_ticks(
        [math.log10(tick) for tick in _TICKS], labels=[words.rate(tick) for tick in _TICKS]
    )
    bar.outline.set_visible(False)  # type: ignore[operator]
    bar.set_label("lost and invented, per million (logarithmic)")
