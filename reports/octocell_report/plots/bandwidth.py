# SPDX-License-Identifier: MIT
"""How near each stage on a device comes to the speed at which its memory copies."""

from collections.abc import Sequence
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from octocell_report import bandwidth, style, words
from octocell_report.load import STAGES, Result
from octocell_report.plots import facets
from octocell_report.style import Look

_COPY: dict[str, Any] = {"color": style.INK, "linewidth": 1.4, "linestyle": (0, (5, 2))}
_LINES = 14  # of text that a facet over sizes is high
_UNIT = "10⁹ bytes a second"


def draw(result: Result, looks: dict[str, Look]) -> Figure | None:
    """One facet per scene at its largest size; a bar per stage and backend."""
    rates = _rates(result)
    rates = facets.at_largest(rates[(rates["run"] == "warm") & rates["best"]])
    if rates.empty:
        return None
    rates = rates.assign(at=rates["scene"].map(result.scenes.index)).sort_values(["at", "order"])
    places = {f"{s} {words.size(n)}": r for (_, s, n), r in rates.groupby(["at", "scene", "n"])}
    shown = [looks[label] for label in looks if (rates["label"] == label).any()]
    each = rates["backend"].nunique() + 0.2
    heights = [here["stage"].nunique() for here in places.values()]
    key = [Patch(color=look.colour, label=look.label) for look in shown]
    figure, axes = _grid(result, "bandwidth", list(places), heights, each, key)
    for ax, here in zip(axes, places.values(), strict=True):
        _bars(ax, result, here, looks)
    return figure


def draw_by_size(result: Result, looks: dict[str, Look]) -> Figure | None:
    """The plain scene over all sizes: a line per stage, a facet per run and implementation that is
    the fastest of its backend at the largest size."""
    rates = _rates(result)
    rates = rates[rates["scene"] == bandwidth.SCENE].sort_values(["order", "n"], kind="stable")
    best = facets.at_largest(rates[(rates["run"] == "warm") & rates["best"]])["label"].unique()
    shown = {
        f"{looks[label].label}, {run}": here
        for label in best
        for run in bandwidth.RUNS
        if (here := rates[(rates["label"] == label) & (rates["run"] == run)])["n"].nunique() > 1
    }
    if not shown:
        return None
    every = pd.concat(shown.values())
    key = [_look(stage).entry for stage in _stages(every)]
    lines = [_LINES] * len(shown)
    figure, axes = _grid(result, "bandwidth_by_size", list(shown), lines, 1, key, sharey=True)
    for ax, here in zip(axes, shown.values(), strict=True):
        _curves(ax, result, here)
    return figure


def _rates(result: Result) -> pd.DataFrame:
    """Those that are known, of rows in which one of a stage is."""
    rates = bandwidth.frame(result)
    rates = rates[rates["gbps"].notna()]
    return rates[rates["row"].isin(rates["row"][rates["stage"] != bandwidth.ALL])]


def _stages(rates: pd.DataFrame) -> list[str]:
    """In the order in which they run; all of them last."""
    return sorted(rates["stage"].unique(), key=lambda s: (*STAGES, s, bandwidth.ALL).index(s))


def _grid(
    result: Result,
    name: str,
    names: list[str],
    rows: Sequence[float],
    each: float,
    key: list[Any],
    **options: Any,
) -> tuple[Figure, list[Axes]]:
    if result.gpu:
        copied = words.grouped(result.gpu.copy_gbps)
        label = f"copy on this {result.gpu.name}: {copied} GB/s (read and written)"
        key = [*key, Line2D([], [], label=label, **_COPY)]
    return facets.grid(facets.caption(name), names, rows, each, columns=2, key=key, **options)


def _bars(ax: Axes, result: Result, rates: pd.DataFrame, looks: dict[str, Look]) -> None:
    stages, labels = _stages(rates), list(rates["label"].unique())
    facets.rows(ax, stages)
    height = 0.84 / len(labels)
    for rate in rates.itertuples():
        y = stages.index(rate.stage) - 0.42 + height * (labels.index(rate.label) + 0.5)
        colour = looks[rate.label].colour
        face, ink = ("white", style.FAINT) if rate.tiny else (colour, style.INK)
        ax.barh(y, rate.gbps, 0.86 * height, facecolor=face, edgecolor=colour, linewidth=0.9)
        box = {"facecolor": "white", "edgecolor": "none", "pad": 0.4}
        facets.beside(ax, rate.gbps, y, _said(rate), color=ink, bbox=box)
    if result.gpu:
        ax.axvline(result.gpu.copy_gbps, **_COPY)
    ax.set_xlim(0, 1.36 * max(rates["gbps"].max(), result.gpu.copy_gbps if result.gpu else 0.0))
    facets.linear(ax, _UNIT)


def _said(rate: Any) -> str:
    text = words.number(rate.gbps)
    if not pd.isna(rate.share):
        text += f" · {words.percent(100 * rate.share)} %"
    return f"{text} · only {words.count(rate.least_bytes)} bytes" if rate.tiny else text


def _look(stage: str) -> Look:
    whole = stage == bandwidth.ALL
    colour = style.INK if whole else style.stage_colour(stage)
    return Look(stage, colour, "o", ":" if whole else "-")


def _curves(ax: Axes, result: Result, rates: pd.DataFrame) -> None:
    for stage in _stages(rates):
        look, here = _look(stage), rates[rates["stage"] == stage]
        ax.plot(here["n"], here["gbps"], **look.shape)
        hollow = look.dot | {"markerfacecolor": "white", "linestyle": "none"}
        ax.plot(here["n"][here["tiny"]], here["gbps"][here["tiny"]], **hollow)
    if result.gpu:
        ax.axhline(result.gpu.copy_gbps, **_COPY)
    facets.logarithmic(ax, "x", "spheres", sorted(set(rates["n"])), lambda n: words.size(round(n)))
    facets.logarithmic(ax, "y", _UNIT)
