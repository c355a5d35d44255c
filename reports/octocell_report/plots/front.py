# SPDX-License-Identifier: MIT
"""The answer in one picture: time per sphere of ours, and of each library's fastest."""

from itertools import cycle

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from octocell_report import front, style, words
from octocell_report.load import Place, Result
from octocell_report.plots import facets
from octocell_report.style import Look

_OURS = (style.BLUE, style.SKY, style.GREEN)
_OTHERS = (style.VERMILLION, style.PURPLE, style.BLACK, style.GREY)
_HEIGHT = 14  # of the curves, in lines of text, at least
_NAME = 0.06  # of the height, that a name at the end of a line takes


def draw(result: Result) -> Figure | None:
    """Left the first scene over its sizes, right all scenes at their largest, if there are more."""
    times = front.best(result)
    if times.empty:
        return None
    looks = _looks(list(times.columns))
    scene = times.index[0][0]
    curves, largest = times.loc[scene], front.at_largest(times)
    over_sizes = len(curves) > 1
    by_scene = len(largest) > 1 or not over_sizes
    names = [scene] * over_sizes + ["each scene at its largest size"] * by_scene
    figure, axes = facets.grid(
        "",
        names,
        [max(_HEIGHT * over_sizes, 2 * len(largest))] * len(names),
        columns=len(names),
        key=[] if over_sizes else [look.entry for look in looks.values()],
    )
    if over_sizes:
        _over_sizes(axes[0], curves, looks)
    if by_scene:
        _by_scene(axes[-1], largest, looks)
    return figure


def _looks(contenders: list[str]) -> dict[str, Look]:
    ours = [who for who in contenders if front.is_ours(who)]
    others = [who for who in contenders if not front.is_ours(who)]
    pairs = [*zip(ours, cycle(_OURS)), *zip(others, cycle(_OTHERS))]
    return {who: Look(who, colour, "o") for who, colour in pairs}


def _over_sizes(ax: Axes, curves: pd.DataFrame, looks: dict[str, Look]) -> None:
    for who, look in looks.items():
        ax.plot(curves[who].dropna(), **look.shape)
    facets.logarithmic(ax, "x", "spheres", list(curves.index), lambda n: words.size(round(n)))
    facets.logarithmic(ax, "y", "ns per sphere")
    ends = curves[list(looks)].ffill().iloc[-1].dropna().sort_values()
    to_share = ax.transData + ax.transAxes.inverted()
    heights = [to_share.transform((1, ns))[1] for ns in ends]
    for (who, ns), height in zip(ends.items(), facets.apart(heights, _NAME), strict=True):
        text, ink = f"{who}  {words.number(ns)}", style.dark(looks[str(who)].colour)
        ax.text(1.01, height, text, color=ink, weight="bold", va="center", transform=ax.transAxes)


def _by_scene(ax: Axes, largest: pd.DataFrame, looks: dict[str, Look]) -> None:
    """One line a scene; beside each library's mark how many times ours it takes."""
    ratios = front.ratios(largest)
    facets.rows(ax, [words.place(Place(*place)) for place in largest.index])
    ax.set_ylim(len(largest) - 0.5, -0.5)
    for y, place in enumerate(largest.index):
        known, by_ours = largest.loc[place].dropna(), ratios.loc[place].dropna().sort_values()
        ax.plot([known.min(), known.max()], [y, y], color=style.GRID, linewidth=3, zorder=1)
        for who, ns in known.items():
            ax.plot(ns, y, **looks[str(who)].dot, markersize=8)
        for who, ratio in by_ours.items():
            last, ink = who == by_ours.index[-1], style.dark(looks[str(who)].colour)
            side = {"ha": "left", "xytext": (8, 0)} if last else {"ha": "right", "xytext": (-8, 0)}
            box = {"facecolor": "white", "edgecolor": "none", "pad": 1}
            facets.beside(ax, known[who], y, words.ratio(ratio), color=ink, bbox=box, **side)
    ax.margins(x=0.14)
    facets.logarithmic(ax, "x", "ns per sphere")
