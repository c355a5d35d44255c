# SPDX-License-Identifier: MIT
"""The plan against the best choice that could have been forced, scene by scene."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator

from octocell_report import ablation, style, words
from octocell_report.ablation import TARGET, Regret
from octocell_report.load import Result
from octocell_report.spread import SHARE

_TICKS = (0.5, 0.6, 0.7, 0.8, 0.9, 1, TARGET, 1.2, 1.35, 1.5, 1.75, 2, 2.5, 3, 4, 5, 7, 10, 20, 50)
_COLOURS = {
    "within": style.BLUE,
    "above": style.VERMILLION,
    "unclear": style.ORANGE,
    "unknown": style.GREY,
}
_MEANINGS = {
    "within": f"within {TARGET:.2f}",
    "above": f"above {TARGET:.2f}, beyond the noise",
    "unclear": f"interval holds {TARGET:.2f}",
    "unknown": "too few rounds to judge",
}


def draw(result: Result) -> Figure | None:
    """None without a choice to hold the plan against."""
    every = {b: ablation.regrets(studies) for b, studies in ablation.backends(result).items()}
    every = {backend: found for backend, found in every.items() if found}
    if not every:
        return None
    lines = sum(len(found) for found in every.values())
    figure, axes = plt.subplots(
        len(every),
        1,
        figsize=(11.5, 0.34 * lines + 1.0 * len(every) + 1.4),
        squeeze=False,
        sharex=True,
        height_ratios=[len(found) + 1 for found in every.values()],
        layout="constrained",
    )
    _axis(axes[0, 0], [regret for found in every.values() for regret in found])
    for ax, (backend, found) in zip(axes[:, 0], every.items(), strict=True):
        _facet(ax, found)
        ax.set_title(backend)
    axes[-1, 0].set_xlabel("time planned / time of the best forced choice (logarithmic)")
    _finish(figure, {regret.verdict for found in every.values() for regret in found})
    return figure


def _axis(ax: Axes, found: list[Regret]) -> None:
    low = min(0.97, *(regret.ratio.low for regret in found))
    high = max(1.2, *(regret.ratio.high for regret in found))
    ax.set_xscale("log")
    ax.set_xlim(low / 1.01, high * 1.02)
    ticks: list[float] = []
    for tick in _TICKS:  # those that stand clear of the one before; the target always
        clear = not ticks or tick / ticks[-1] > (high / low) ** 0.045
        if low <= tick <= high and (clear or tick == TARGET):
            ticks.append(tick)
    ax.xaxis.set_major_locator(FixedLocator(ticks))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    ax.xaxis.set_minor_formatter(NullFormatter())


def _facet(ax: Axes, found: list[Regret]) -> None:
    ax.axvline(1.0, color=style.INK, linewidth=1)
    ax.axvline(TARGET, color=style.VERMILLION, linewidth=1.4, linestyle="--")
    for y, regret in enumerate(found):
        _mark(ax, y, regret)
    ax.set_ylim(len(found) - 0.4, -0.6)
    ax.set_yticks(range(len(found)), [regret.study.title for regret in found])
    ax.tick_params(axis="y", length=0)
    ax.tick_params(axis="x", labelbottom=True)
    ax.grid(axis="y", visible=False)


def _mark(ax: Axes, y: int, regret: Regret) -> None:
    """Hollow where the best came to the same plan: there is no better one to be had."""
    colour = _COLOURS[regret.verdict]
    ax.plot([regret.ratio.low, regret.ratio.high], [y, y], color=colour, linewidth=2.2)
    look: dict[str, Any] = {"markerfacecolor": "white"} if regret.same_plan else {}
    ax.plot(
        [regret.ratio.median], [y], "o", color=colour, markersize=8, markeredgewidth=1.8, **look
    )
    text = f"{words.times(regret.ratio.median)}  {ablation.choice(regret.best)}"
    where: dict[str, Any] = {"xycoords": ("axes fraction", "data"), "fontsize": 10.5}
    ink = style.FAINT if regret.same_plan else style.INK
    ax.annotate(text, (1.01, y), va="center", ha="left", annotation_clip=False, color=ink, **where)


def _finish(figure: Figure, met: set[str]) -> None:
    figure.suptitle(
        "The plan against the best of all methods and variants, found after the fact; dashed: the "
        f"target {TARGET:.2f}\nmarks: median ratio over the rounds; lines: its {SHARE} % interval "
        "(bootstrap over rounds); right: ratio and best choice",
        x=0.01,
        ha="left",
        fontsize=12.5,
    )
    dot: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": 8}
    handles = [
        Line2D([], [], color=_COLOURS[verdict], label=text, **dot)
        for verdict, text in _MEANINGS.items()
        if verdict in met
    ]
    hollow = "hollow: the best came to the same plan, so the ratio is chance or the cost of a test"
    dot |= {"markerfacecolor": "white", "markeredgewidth": 1.8}
    handles.append(Line2D([], [], color=style.FAINT, label=hollow, **dot))
    figure.legend(handles=handles, loc="outside lower left", ncols=2)
