# SPDX-License-Identifier: MIT
"""Errors per million true pairs: series down, scenes across, a facet per class of scenes."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, LogNorm, to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from octocell_report import style, words
from octocell_report.error import MILLION, Point, Study
from octocell_report.load import Group
from octocell_report.plots import facets

_COLOURS = LinearSegmentedColormap.from_list(
    "errors", ["#fff3dc", style.ORANGE, style.VERMILLION, "#6b2400"]
)
_NORM = LogNorm(1, 5 * MILLION)
_MEANINGS = {
    style.EXACT_FILL: "exact, as claimed",
    style.NO_ERROR_FILL: "0: no error here, though none is claimed",
    "white": "empty: not run",
}


def draw(study: Study) -> Figure | None:
    """None without a series."""
    if not study.series:
        return None
    groups = {c: [g for g in study.groups if g.scene_class == c] for c in study.classes}
    figure, axes = facets.grid(
        f"Errors per million true pairs, as {words.MINUS}lost +invented; darker: more",
        study.classes,
        [len(study.series)] * len(groups),
        1.4,
        len(groups),
        [Patch(facecolor=fill, edgecolor=style.GRID, label=m) for fill, m in _MEANINGS.items()],
        sharey=True,
        width_ratios=[len(here) for here in groups.values()],
    )
    for ax, here in zip(axes, groups.values(), strict=True):
        _facet(ax, study, here)
    figure.align_titles()
    return figure


def _facet(ax: Axes, study: Study, groups: list[Group]) -> None:
    inks = [style.dark(style.predicate_colour(series.predicate)) for series in study.series]
    headings = [_heading(study, group) for group in groups]
    facets.table(ax, headings, [series.label for series in study.series], inks)
    ax.tick_params(axis="x", rotation=90, labelsize=style.SMALL)
    held = {(point.series, point.row.place): point for point in study.points}
    for y, series in enumerate(study.series):
        for x, group in enumerate(groups):
            _cell(ax, x, y, held.get((series, group.place)))
        if y and series.predicate != study.series[y - 1].predicate:
            ax.axhline(y - 0.5, color=style.FAINT, linewidth=0.8)


def _heading(study: Study, group: Group) -> str:
    several = len({other.n for other in study.groups}) > 1
    return words.place(group.place) if several else group.scene


def _cell(ax: Axes, x: int, y: int, point: Point | None) -> None:
    if point is None:
        facets.cell(ax, x, y, "", "white", style.GRID)
        return
    fill = to_hex(_COLOURS(_NORM(max(1.0, point.rate(point.errors)))))
    if point.errors == 0:
        fill = style.EXACT_FILL if point.claimed else style.NO_ERROR_FILL
    broken = point.errors > 0 and point.claimed and point.series.predicate is not None
    look: dict[str, Any] = {"weight": "bold", "zorder": 4} if broken else {}
    edge = style.BLACK if broken else "white"
    facets.cell(ax, x, y, text_of(point).replace(" ", "\n"), fill, edge, fontsize=8, **look)


def text_of(point: Point) -> str:
    if point.errors == 0:
        return "exact" if point.claimed else "0"
    parts = ((words.MINUS, point.missed), ("+", point.false))
    return " ".join(sign + words.rate(point.rate(count)) for sign, count in parts if count)
