# SPDX-License-Identifier: MIT
"""Speed against the baselines: ratios taken round by round, so that drift cancels."""

from dataclasses import replace
from statistics import median
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from octocell_report import style, tables, words
from octocell_report.load import Place, Result
from octocell_report.plots import facets
from octocell_report.style import Look

_COLUMNS = 2
_MOST = 24  # facets
_GLYPHS = {"^": "▲ ", "v": "▼ "}  # of markers, where there is one


def draw(result: Result, looks: dict[str, Look], run: str) -> Figure | None:
    """A facet per scene and size, a line per implementation, a mark per library."""
    found = tables.speedups(result)
    found = _fewer(found[found["run"] == run])
    if found.empty:
        return None
    places = dict(list(found.groupby(["scene", "n"], sort=False)))
    markers = {
        family: style.owner_marker(words.family_title(family), index)
        for index, family in enumerate(found["family_ref"].unique())
    }
    figure, axes = facets.grid(
        facets.caption(f"speed_{run}"),
        [words.place(Place(*place)) for place in places],
        [here["label"].nunique() for here in places.values()],
        columns=_COLUMNS,
    )
    every = [ratio for rounds in found["ratios"] for ratio in rounds]
    for ax, here in zip(axes, places.values(), strict=True):
        ax.set_xlim(min(0.8, *every) / 1.25, max(1.25, *every) * 1.25)
        _facet(ax, here, looks, markers)
    return figure


def _fewer(found: pd.DataFrame) -> pd.DataFrame:
    """Two sizes of each scene where all would make the figure too tall."""
    places = found[["scene", "n"]].drop_duplicates().sort_values("n")
    kept = places if len(places) <= _MOST else places.groupby("scene").tail(2)
    return found.merge(kept, on=["scene", "n"])


def _facet(ax: Axes, rows: pd.DataFrame, looks: dict[str, Look], markers: dict[str, Any]) -> None:
    labels, met = list(rows["label"].unique()), [*rows["family_ref"].unique()]
    facets.rows(ax, [looks[label].label for label in labels])
    ax.axvline(1, color=style.INK, linewidth=1.2)
    ax.axvspan(ax.get_xlim()[0], 1, color=style.APART_FILL, zorder=0)
    for row in rows.itertuples():
        y, column, middle = labels.index(row.label), met.index(row.family_ref), median(row.ratios)
        look = replace(looks[row.label], marker=markers[row.family_ref])
        at = y + 0.3 * (column - (len(met) - 1) / 2)  # one below the other
        facets.interval(ax, at, min(row.ratios), middle, max(row.ratios), look)
        facets.margin(ax, y, words.ratio(middle), column)
    for column, family in enumerate(met):
        title = _GLYPHS.get(markers[family], "") + words.family_title(family)
        facets.margin(ax, -0.9, title, column, color=style.FAINT)
    references = ", ".join(rows["label_ref"].unique())
    facets.logarithmic(ax, "x", references, text=lambda x: f"{words.tick(x)}×")
    ax.xaxis.label.set(fontsize=style.SMALL, color=style.FAINT)
