# SPDX-License-Identifier: MIT
"""Errors per million true pairs: series down, scenes across, a facet per class of scenes."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, LogNorm, to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from octocell_report import style, words
from octocell_report.error import MILLION, Study
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
    if study.points.empty:
        return None
    scenes = dict(list(study.scenes.groupby("scene_class", sort=False)))
    height = study.points["series"].nunique()
    figure, axes = facets.grid(
        facets.caption("error_map"),
        list(scenes),
        [height] * len(scenes),
        1.4,
        len(scenes),
        [Patch(facecolor=fill, edgecolor=style.GRID, label=m) for fill, m in _MEANINGS.items()],
        sharey=True,
        width_ratios=[len(here) for here in scenes.values()],
    )
    for ax, here in zip(axes, scenes.values(), strict=True):
        _facet(ax, study, here)
    figure.align_titles()
    return figure


def _facet(ax: Axes, study: Study, scenes: pd.DataFrame) -> None:
    several = study.scenes["n"].nunique() > 1
    places = list(scenes[["scene", "n"]].itertuples(index=False))
    series = study.points.drop_duplicates("series")
    inks = [style.dark(style.predicate_colour(predicate)) for predicate in series["predicate"]]
    headings = [words.place(place) if several else place.scene for place in places]
    facets.table(ax, headings, list(series["series"]), inks)
    ax.tick_params(axis="x", rotation=90, labelsize=style.SMALL)
    known = {(point.series, point.scene, point.n): point for point in study.points.itertuples()}
    above = None
    for y, (name, predicate) in enumerate(zip(series["series"], series["predicate"], strict=True)):
        for x, place in enumerate(places):
            _cell(ax, x, y, known.get((name, *place)))
        if y and predicate != above:
            ax.axhline(y - 0.5, color=style.FAINT, linewidth=0.8)
        above = predicate


def _cell(ax: Axes, x: int, y: int, point: Any) -> None:
    if point is None:
        facets.cell(ax, x, y, "", "white", style.GRID)
        return
    fill = to_hex(_COLOURS(_NORM(max(1.0, point.errors_per_million))))
    if point.errors == 0:
        fill = style.EXACT_FILL if point.claims_exact else style.NO_ERROR_FILL
    broken = point.errors > 0 and point.claims_exact and point.predicate is not None
    look: dict[str, Any] = {"weight": "bold", "zorder": 4} if broken else {}
    edge = style.BLACK if broken else "white"
    facets.cell(ax, x, y, text_of(point).replace(" ", "\n"), fill, edge, fontsize=8, **look)


def text_of(point: Any) -> str:
    if point.errors == 0:
        return "exact" if point.claims_exact else "0"
    parts = ((words.MINUS, point.missed_per_million), ("+", point.false_per_million))
    return " ".join(sign + words.rate(rate) for sign, rate in parts if rate)
