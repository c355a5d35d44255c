# SPDX-License-Identifier: MIT
"""The answer in one picture: time per sphere of ours, and of each library's fastest."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from octocell_report import front, style, words
from octocell_report.load import Result

_OURS = (style.BLUE, style.SKY, style.GREEN)
_OTHERS = (style.VERMILLION, style.PURPLE, style.BLACK, style.GREY)
_LEAST_GAP = 0.055  # between names at the ends of lines, of the height


def draw(result: Result) -> Figure | None:
    """Left the first scene over its sizes, right all scenes at their largest, if there are more."""
    times = front.best(result)
    if times.empty:
        return None
    colours = _colours(list(times.columns))
    scene = times.index[0][0]
    curves, largest = times.loc[scene], front.at_largest(times)
    parts = [len(curves) > 1, len(largest) > 1 or len(curves) == 1]
    height = max(3.4 if parts[0] else 0, 0.5 * len(largest) + 1.3 if parts[1] else 0)
    figure, axes = plt.subplots(
        1,
        sum(parts),
        figsize=(12.5, height),
        squeeze=False,
        layout="constrained",
        width_ratios=[1.15, 1] if all(parts) else None,
    )
    if parts[0]:
        _over_sizes(axes[0, 0], curves, colours)
        axes[0, 0].set_title(scene)
    if parts[1]:
        _by_scene(axes[0, -1], largest, colours, named=not parts[0])
    return figure


def _colours(contenders: list[str]) -> dict[str, str]:
    ours = [who for who in contenders if front.is_ours(who)]
    others = [who for who in contenders if not front.is_ours(who)]
    pairs = [(ours, _OURS), (others, _OTHERS)]
    return {who: cycle[k % len(cycle)] for part, cycle in pairs for k, who in enumerate(part)}


def _over_sizes(ax: Axes, curves: pd.DataFrame, colours: dict[str, str]) -> None:
    sizes = list(curves.index)
    for who, colour in colours.items():
        known = curves[who].dropna()
        ax.plot(known.index, known, color=colour, marker="o", linewidth=2.4, markersize=6)
    ax.set(xscale="log", yscale="log", xlabel="spheres", ylabel="ns per sphere")
    ax.xaxis.set_major_locator(FixedLocator(sizes))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda n, _: words.size(round(n))))
    ax.yaxis.set_major_formatter(FuncFormatter(words.tick))
    ax.set_xlim(sizes[0] * 0.8, sizes[-1] * (sizes[-1] / sizes[0]) ** 0.02)
    ends = {who: curves[who].dropna().iloc[-1] for who in colours if curves[who].notna().any()}
    low, high = np.log(ax.get_ylim())
    at = {who: (np.log(ns) - low) / (high - low) for who, ns in ends.items()}
    for who, y in _apart(at).items():
        text = f"{who}  {words.number(ends[who])}"
        ax.text(1.015, y, text, color=style.dark(colours[who]), weight="bold", va="center",
                transform=ax.transAxes)  # fmt: skip


def _apart(at: dict[str, float]) -> dict[str, float]:
    """Moved up until no two are nearer than the least gap."""
    found: dict[str, float] = {}
    for who, y in sorted(at.items(), key=lambda item: item[1]):
        found[who] = max([y, *(other + _LEAST_GAP for other in found.values())])
    return found


def _by_scene(ax: Axes, largest: pd.DataFrame, colours: dict[str, str], named: bool) -> None:
    """One line a scene; beside each library's mark how many times ours it takes."""
    ratios = front.ratios(largest)
    for y, place in enumerate(largest.index):
        known, by_ours = largest.loc[place].dropna(), ratios.loc[place].dropna().sort_values()
        ax.plot([known.min(), known.max()], [y, y], color=style.GRID, linewidth=3, zorder=1)
        for who, ns in known.items():
            ax.plot(ns, y, "o", color=colours[who], markersize=8)
        for rank, (who, ratio) in enumerate(by_ours.items(), 1):
            last = rank == len(by_ours)
            ax.annotate(
                words.ratio(ratio),
                (known[who], y),
                (7 if last else -7, 0),
                textcoords="offset points",
                ha="left" if last else "right",
                va="center",
                fontsize=9.5,
                color=style.dark(colours[who]),
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1},
            )
    ax.margins(x=0.14)
    ax.set(xscale="log", xlabel="ns per sphere", ylim=(len(largest) - 0.5, -0.75))
    ax.set_yticks(range(len(largest)), [f"{scene} {words.size(n)}" for scene, n in largest.index])
    ax.tick_params(axis="y", length=0)
    ax.xaxis.set_major_formatter(FuncFormatter(words.tick))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.grid(axis="y", visible=False)
    ax.spines["left"].set_visible(False)
    ax.set_title("each scene at its largest size")
    if named:
        marks = [
            ax.plot([], [], "o", color=colour, label=who)[0] for who, colour in colours.items()
        ]
        ax.legend(handles=marks, loc="upper left", bbox_to_anchor=(1, 1))
