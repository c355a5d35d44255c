# SPDX-License-Identifier: MIT
"""Bytes per sphere beyond input and output, at each scene's largest size."""

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from octocell_report import style, words
from octocell_report.load import Place, Result
from octocell_report.plots import facets
from octocell_report.style import Look

_COLUMNS = 2


def draw(result: Result, looks: dict[str, Look]) -> Figure | None:
    """Of each implementation the run that needed most."""
    rows = facets.at_largest(result.frame[result.frame["beyond_bytes"].notna()])
    if rows.empty:
        return None
    rows = rows.sort_values("beyond_bytes").drop_duplicates(["scene", "label"], keep="last")
    places = {Place(*at): here for at, here in rows.groupby(["scene", "n"], sort=False)}
    shown = [place for scene in result.scenes for place in places if place.scene == scene]
    figure, axes = facets.grid(
        facets.caption("memory"),
        [words.place(place) for place in shown],
        [len(places[place]) for place in shown],
        columns=_COLUMNS,
    )
    for ax, place in zip(axes, shown, strict=True):
        _facet(ax, places[place].sort_values("order"), looks)
    return figure


def _facet(ax: Axes, rows: pd.DataFrame, looks: dict[str, Look]) -> None:
    needs, here = rows["beyond_bytes"], [looks[label] for label in rows["label"]]
    facets.rows(ax, [look.label for look in here])
    bars = ax.barh(range(len(rows)), needs, height=0.66, color=[look.colour for look in here])
    ax.bar_label(bars, list(map(words.grouped, needs)), padding=4, fontsize=style.SMALL)
    facets.mark_wrong(bars, rows["counts"])
    ax.set_xlim(min(0.0, 1.1 * needs.min()), 1.2 * max(needs.max(), 1.0))
    facets.linear(ax, "bytes per sphere")
