# SPDX-License-Identifier: MIT
"""What it costs to forbid a skip: scenes down, skips across, one map per backend."""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, Normalize, to_hex
from matplotlib.figure import Figure

from octocell_report import ablation, style, words
from octocell_report.ablation import Effect
from octocell_report.load import Result
from octocell_report.plots import facets

# Blue where the skip does harm, white where it does nothing, orange where it saves time.
_COLOURS = LinearSegmentedColormap.from_list("skips", [style.BLUE, "white", style.VERMILLION])
_LEAST = math.log(1.5)  # a map of noise alone shall stay pale


def draw(result: Result) -> Figure | None:
    """None without a variant that forbids one skip."""
    every = ablation.backends(result)
    skips = ablation.skips_of(ablation.studies(result))
    if not skips:
        return None
    figure, axes = facets.grid(
        "Time with one skip forbidden / time planned, median of the rounds: orange, the skip saves "
        "time; blue, it costs some\nbold: the plan takes the skip; grey: the scene does not need "
        "it, so 1 is right",
        list(every),
        [len(studies) for studies in every.values()],
        1.2,
    )
    effects = {
        backend: [ablation.effects(study) for study in studies]
        for backend, studies in every.items()
    }
    ratios = [e.ratio.median for here in effects.values() for row in here for e in row if e.ratio]
    limit = max([_LEAST, *(abs(math.log(ratio)) for ratio in ratios)])
    for ax, (backend, studies) in zip(axes, every.items(), strict=True):
        names = [skip.replace("_", "\n") for skip in skips]
        facets.table(ax, names, [study.title for study in studies])
        for y, here in enumerate(effects[backend]):
            for effect in here:
                _cell(ax, skips.index(effect.skip), y, effect, Normalize(-limit, limit))
    return figure


def _cell(ax: Axes, x: int, y: int, effect: Effect, norm: Normalize) -> None:
    """A time that may not stand bare gives no ratio; its verdict stands instead."""
    weight = "bold" if effect.taken else "normal"
    if effect.ratio is not None:
        fill = to_hex(_COLOURS(norm(math.log(effect.ratio.median))))
        quiet = not effect.taken and style.luminance(fill) > 0.5
        ink = style.FAINT if quiet else style.ink_on(fill)
        text = words.times(effect.ratio.median)
        facets.cell(ax, x, y, text, fill, style.GRID, color=ink, weight=weight, fontsize=10.5)
    elif effect.row.status == "wrong":
        text, red = f"wrong\n{words.losses(effect.row)}", style.VERMILLION
        facets.cell(ax, x, y, text, "white", red, color=red, weight="bold", fontsize=8.5)
    else:
        facets.cell(ax, x, y, "skipped", style.GRID, color=style.FAINT, fontsize=8.5)
