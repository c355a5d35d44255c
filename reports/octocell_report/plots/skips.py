# SPDX-License-Identifier: MIT
"""What it costs to forbid a skip: scenes down, skips across, one map per backend."""

import math
from typing import Any

from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, Normalize, to_hex
from matplotlib.figure import Figure

from octocell_report import ablation, style, words
from octocell_report.load import Result
from octocell_report.plots import facets

# Blue where the skip does harm, white where it does nothing, orange where it saves time.
_COLOURS = LinearSegmentedColormap.from_list("skips", [style.BLUE, "white", style.VERMILLION])
_LEAST = math.log(1.5)  # a map of noise alone shall stay pale


def draw(result: Result) -> Figure | None:
    """None without a variant that forbids one skip."""
    effects = ablation.effects(result)
    if effects.empty:
        return None
    skips = list(effects["skip"].unique())
    every = dict(list(effects.groupby("backend", sort=False)))
    figure, axes = facets.grid(
        facets.caption("ablation_skips"),
        list(every),
        [here["study"].nunique() for here in every.values()],
        1.2,
    )
    ratios = [ratio.median for ratio in effects["by_planned"].dropna()]
    limit = max([_LEAST, *(abs(math.log(ratio)) for ratio in ratios)])
    for ax, here in zip(axes, every.values(), strict=True):
        names = [skip.replace("_", "\n") for skip in skips]
        facets.table(ax, names, list(here.drop_duplicates("study")["title"]))
        studies = list(here["study"].unique())
        for effect in here.itertuples():
            at = skips.index(effect.skip), studies.index(effect.study)
            _cell(ax, *at, effect, Normalize(-limit, limit))
    return figure


def _cell(ax: Axes, x: int, y: int, effect: Any, norm: Normalize) -> None:
    """A time that may not stand bare gives no ratio; its verdict stands instead."""
    weight = "bold" if effect.taken else "normal"
    if effect.by_planned is not None:
        fill = to_hex(_COLOURS(norm(math.log(effect.by_planned.median))))
        quiet = not effect.taken and style.luminance(fill) > 0.5
        ink = style.FAINT if quiet else style.ink_on(fill)
        text = words.times(effect.by_planned.median)
        facets.cell(ax, x, y, text, fill, style.GRID, color=ink, weight=weight, fontsize=10.5)
    elif effect.status == "wrong":
        text, red = f"wrong\n{words.losses(effect)}", style.VERMILLION
        facets.cell(ax, x, y, text, "white", red, color=red, weight="bold", fontsize=8.5)
    else:
        facets.cell(ax, x, y, "skipped", style.GRID, color=style.FAINT, fontsize=8.5)
