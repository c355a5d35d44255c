# SPDX-License-Identifier: MIT
"""Where the time goes: stacked bars, one colour per stage."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from octocell_report import style, words
from octocell_report.load import STAGES, Result
from octocell_report.plots import facets
from octocell_report.style import Look

RUN = "warm"
_EACH = 1.3  # lines of text that a bar takes: two are beside it at times
_CUT = 3.0  # a bar longer than this many medians of its axis is cut, and says so
_ROOM = 1.4  # the axis' length in longest bars: room for the text behind them
_LETTERS = 0.055  # the share of the longest bar that a percentage needs


def draw(result: Result, looks: dict[str, Look], side: str) -> Figure | None:
    """One facet per scene at the largest size that this side ran at; milliseconds."""
    rows, parts = _largest(result, looks, [side])
    rows = rows.sort_values(["at", "order"])
    name, unit = f"stages_{side}", "time, warm [ms]"
    return _draw(name, unit, rows, parts, facet="place", bar="title", alike="place")


def draw_per_sphere(result: Result, looks: dict[str, Look]) -> Figure | None:
    """One facet per implementation of ours, one bar per scene; one scale per backend."""
    rows, parts = _largest(result, looks, ["backend", "device"])
    unit, parts = "time per sphere, warm [ns]", parts.mul(1e6 / rows["n"], axis=0)
    rows = rows.sort_values(["order", "at"])
    name = "stages_per_sphere"
    return _draw(name, unit, rows, parts, facet="title", bar="place", alike="backend")


def _largest(
    result: Result, looks: dict[str, Look], sides: list[str]
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Warm rows of each scene at its side's largest size; milliseconds of their stages, a column
    for each."""
    frame, stages = result.frame, result.stages
    warm = frame[(frame["run"] == RUN) & frame["side"].isin(sides)]
    rows = facets.at_largest(warm, ("side", "scene"))
    timed = stages[stages["row"].isin(rows.index) & stages["fused_into"].isna()]
    parts = timed.pivot(index="row", columns="stage", values="median_ms").reindex(rows.index)
    named = {
        "at": rows["scene"].map(result.scenes.index),
        "title": [looks[label].label for label in rows["label"]],
        "place": [f"{row.scene} {words.size(row.n)}" for row in rows.itertuples()],
    }
    order = sorted(parts, key=lambda stage: (*STAGES, stage).index(stage))
    return rows.assign(**named), parts[order]


def _draw(
    name: str, unit: str, rows: pd.DataFrame, parts: pd.DataFrame, facet: str, bar: str, alike: str
) -> Figure | None:
    """Facets where one of the bars has stages; those alike in a column have one scale."""
    staged = parts.notna().any(axis=1).reindex(rows.index)
    rows = rows[rows[facet].isin(rows[facet][staged])]
    if rows.empty:
        return None
    whole = parts.loc[rows.index].sum(axis=1)
    shown = dict(list(rows.groupby(facet, sort=False)))
    key = [Patch(color=style.stage_colour(stage), label=stage) for stage in parts]
    if not rows["counts"][staged].all():
        key.append(Patch(facecolor="#dddddd", edgecolor="white", hatch="////", label="not exact"))
    figure, axes = facets.grid(
        facets.caption(name),
        list(shown),
        list(map(len, shown.values())),
        _EACH,
        key=key,
        key_columns=len(key),
    )
    for ax, here in zip(axes, shown.values(), strict=True):
        lengths = whole[(rows[alike] == here[alike].iloc[0]) & (whole > 0)]
        end = min(lengths.max(), _CUT * lengths.median())
        _bars(ax, list(here[bar]), here, parts.loc[here.index], end)
        facets.linear(ax, unit)
    return figure


def _bars(ax: Axes, names: list[str], rows: pd.DataFrame, parts: pd.DataFrame, end: float) -> None:
    """A row that did not run says why where its bar would be."""
    facets.rows(ax, names)
    ax.set_xlim(0, _ROOM * end)
    whole = parts.sum(axis=1)
    ends = parts.fillna(0.0).cumsum(axis=1).clip(upper=end)
    widths = ends.diff(axis=1).fillna(ends)
    for stage in parts:
        colour, width = style.stage_colour(stage), widths[stage]
        look: dict[str, Any] = {"color": colour, "edgecolor": "white", "linewidth": 0.8}
        bars = ax.barh(range(len(rows)), width, left=ends[stage] - width, height=0.62, **look)
        shares = (100 * parts[stage] / whole).map("{:.0f}%".format)
        shares = shares.where((width > _LETTERS * end) & rows["counts"], "")
        ink = style.ink_on(colour)
        ax.bar_label(bars, shares, label_type="center", color=ink, fontsize=style.SMALL)
        facets.mark_wrong(bars, rows["counts"])
    for y, row in enumerate(rows.itertuples()):
        ink = style.INK if whole[row.Index] > 0 else style.FAINT
        text = _after(row, whole[row.Index], end)
        facets.beside(ax, ends.loc[row.Index].max(), y, text, color=ink)


def _after(row: Any, length: float, end: float) -> str:
    """What stands behind the bar: the unmarked total, what is fused, and what is wrong."""
    if not length > 0:
        reason = words.short_reason(row.reason, 48)
        return "no stages measured" if row.ran else f"skipped: {reason}"
    total = f"{words.number(row.median_ms)} ms · {words.number(row.ns_per_sphere)} ns/sphere"
    lines = [f"» cut: {total}" if length > 1.001 * end else total]
    lines += [] if row.counts else [words.verdict(row)]
    return "\n".join([*lines, *(f"{stage} is inside {of}" for stage, of in row.fused.items())])
