# SPDX-License-Identifier: MIT
"""What it costs to forbid a skip: scenes down, skips across, one map per backend."""

from __future__ import annotations

import math
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize, to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from octocell_report import ablation, style, words
from octocell_report.ablation import Effect, Study
from octocell_report.load import Result

# Blue where the skip does harm, white where it does nothing, orange where it saves time.
COLOURS = LinearSegmentedColormap.from_list("skips", [style.BLUE, "white", style.VERMILLION])
_LEAST = math.log(1.5)  # a map of noise alone shall stay pale
_TICKS = (1.1, 1.2, 1.5, 2, 3, 5, 10, 20, 50, 100, 200, 500)


def draw(result: Result) -> Figure | None:
    """None without a variant that forbids one skip."""
    every = ablation.backends(result)
    skips = ablation.skips_of(ablation.studies(result))
    if not skips:
        return None
    figure, axes = plt.subplots(
        len(every),
        1,
        figsize=(4.1 + 0.92 * max(len(skips), 6), 0.36 * _lines(every) + 0.9 * len(every) + 1.1),
        squeeze=False,
        height_ratios=[len(studies) + 1 for studies in every.values()],
        layout="constrained",
    )
    norm = _norm(every)
    for ax, (backend, studies) in zip(axes[:, 0], every.items(), strict=True):
        _map(ax, studies, skips, norm)
        ax.set_title(backend, pad=34)
    _bar(figure, list(axes[:, 0]), norm)
    figure.suptitle(
        "Time with one skip forbidden / time planned, median of the rounds\n"
        "bold: the plan takes the skip; grey: the scene does not need it, so 1 is right",
        x=0.01,
        ha="left",
        fontsize=12.5,
    )
    return figure


def _lines(every: dict[str, list[Study]]) -> int:
    return sum(len(studies) for studies in every.values())


def _norm(every: dict[str, list[Study]]) -> Normalize:
    """Of the logarithm, alike to both sides of 1."""
    effects = [
        e for studies in every.values() for study in studies for e in ablation.effects(study)
    ]
    reach = [abs(math.log(effect.ratio.median)) for effect in effects if effect.ratio]
    limit = max([_LEAST, *reach])
    return Normalize(-limit, limit)


def _map(ax: Axes, studies: list[Study], skips: list[str], norm: Normalize) -> None:
    for y, study in enumerate(studies):
        for effect in ablation.effects(study):
            _cell(ax, skips.index(effect.skip), y, effect, norm)
    ax.set_xlim(0, len(skips))
    ax.set_ylim(len(studies), 0)
    ax.set_xticks([x + 0.5 for x in range(len(skips))], [skip.replace("_", "\n") for skip in skips])
    ax.set_yticks([y + 0.5 for y in range(len(studies))], [study.title for study in studies])
    ax.tick_params(length=0, top=False, labeltop=True, labelbottom=False)
    ax.grid(visible=False)
    for spine in ax.spines.values():
        spine.set_visible(False)


def _cell(ax: Axes, x: int, y: int, effect: Effect, norm: Normalize) -> None:
    if effect.ratio is None:
        _unmeasured(ax, x, y, effect)
        return
    fill = to_hex(COLOURS(norm(math.log(effect.ratio.median))))
    box: dict[str, Any] = {"facecolor": fill, "edgecolor": style.GRID, "linewidth": 0.8}
    ax.add_patch(Rectangle((x, y), 1, 1, **box))
    quiet = not effect.taken and style.luminance(fill) > 0.5
    ax.text(
        x + 0.5,
        y + 0.5,
        words.times(effect.ratio.median),
        ha="center",
        va="center",
        fontsize=10 if quiet else 11,
        color=style.FAINT if quiet else style.ink_on(fill),
        weight="bold" if effect.taken else "normal",
    )


def _unmeasured(ax: Axes, x: int, y: int, effect: Effect) -> None:
    """A time that may not stand bare gives no ratio; its verdict stands instead."""
    wrong = effect.row.status == "wrong"
    text = f"wrong\n{words.losses(effect.row)}" if wrong else "skipped"
    fill = "white" if wrong else style.GRID
    edge = style.VERMILLION if wrong else "white"
    box: dict[str, Any] = {"facecolor": fill, "edgecolor": edge, "linewidth": 1.6, "zorder": 3}
    ax.add_patch(Rectangle((x + 0.02, y + 0.04), 0.96, 0.92, **box))
    ink = style.VERMILLION if wrong else style.FAINT
    look: dict[str, Any] = {"fontsize": 8.5, "weight": "bold" if wrong else "normal", "zorder": 4}
    ax.text(x + 0.5, y + 0.5, text, ha="center", va="center", color=ink, linespacing=0.95, **look)


def _bar(figure: Figure, axes: list[Axes], norm: Normalize) -> None:
    bar = figure.colorbar(
        ScalarMappable(norm, COLOURS), ax=axes, fraction=0.03, pad=0.015, aspect=28
    )
    limit = float(norm.vmax or 0.0)
    ticks = [1.0]
    for tick in _TICKS:  # those that stand clear of the one before
        if limit >= math.log(tick) > math.log(ticks[-1]) + 0.1 * limit:
            ticks.append(tick)
    both = [*(1 / tick for tick in ticks[1:]), *ticks]
    bar.set_ticks([math.log(tick) for tick in both], labels=[f"{tick:.2g}" for tick in both])
    bar.outline.set_visible(False)  # type: ignore[operator]
    bar.set_label("without it / planned (logarithmic)")
