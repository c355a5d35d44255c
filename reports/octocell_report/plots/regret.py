# SPDX-License-Identifier: MIT
"""The plan against the best choice that could have been forced, scene by scene."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from octocell_report import ablation, style, words
from octocell_report.ablation import TARGET
from octocell_report.load import Result
from octocell_report.plots import facets
from octocell_report.style import Look

_LOOKS = {
    "within": Look(f"within {TARGET:.2f}", style.BLUE, "o"),
    "above": Look(f"above {TARGET:.2f}, beyond the noise", style.VERMILLION, "o"),
    "unclear": Look(f"interval holds {TARGET:.2f}", style.ORANGE, "o"),
    "unknown": Look("too few rounds to judge", style.GREY, "o"),
}
_SAME = Look("hollow: the best came to the same plan", style.FAINT, "o", hollow=True)


def draw(result: Result) -> Figure | None:
    """None without a choice to hold the plan against."""
    regrets = ablation.regrets(result)
    if regrets.empty:
        return None
    every = {b: list(found.itertuples()) for b, found in regrets.groupby("backend", sort=False)}
    met = set(regrets["verdict"])
    figure, axes = facets.grid(
        facets.caption("ablation_regret"),
        list(every),
        [len(found) for found in every.values()],
        1.3,
        key=[look.entry for look in (*(_LOOKS[v] for v in _LOOKS if v in met), _SAME)],
        sharex=True,
    )
    for ax, found in zip(axes, every.values(), strict=True):
        _facet(ax, found)
    low = min(0.97, *(ratio.low for ratio in regrets["regret"])) / 1.01
    high = max(1.2, *(ratio.high for ratio in regrets["regret"])) * 1.02
    axes[0].set_xlim(low, high)
    facets.linear(axes[-1], "time planned / time of the best forced choice")
    return figure


def _facet(ax: Axes, found: list[Any]) -> None:
    """Hollow where the best came to the same plan: there is no better one to be had."""
    facets.rows(ax, [regret.title for regret in found])
    ax.axvline(1.0, color=style.INK, linewidth=1)
    ax.axvline(TARGET, color=style.VERMILLION, linewidth=1.4, linestyle="--")
    for y, regret in enumerate(found):
        look, ratio = _LOOKS[regret.verdict], regret.regret
        look = Look("", look.colour, look.marker, hollow=regret.same_plan)
        facets.interval(ax, y, ratio.low, ratio.median, ratio.high, look)
        text = f"{words.times(ratio.median)}  {regret.choice}"
        facets.margin(ax, y, text, color=style.FAINT if regret.same_plan else style.INK)
