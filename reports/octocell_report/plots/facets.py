# SPDX-License-Identifier: MIT
"""What all plots are made of: facets under one title and above one key, and marks in them."""

import textwrap
from collections.abc import Callable, Iterable, Sequence
from statistics import mean, median
from typing import Any

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.gridspec import SubplotSpec
from matplotlib.patches import Rectangle
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, MaxNLocator, NullLocator

from octocell_report import style, words
from octocell_report.style import Look
from octocell_report.texts import how, title

_WIDTH = 12.5  # inches; of every figure, so that type is as large in one as in another
_LETTERS = 125  # of a line that is as wide
_LINE = 0.25  # inches that a line of text takes
_AROUND = 3.2  # lines of a facet's name, tick labels and axis label
_KEY_COLUMNS = 4
_COLUMN = 48  # points; of numbers in the margin


def caption(name: str) -> str:
    """What a picture is called and how it is read: it may travel alone."""
    return "\n".join([title(name).en, *textwrap.wrap(how(name).en, _LETTERS)])


def grid(
    text: str,
    names: Sequence[str],
    rows: Sequence[float],
    each: float = 1.0,
    columns: int = 1,
    key: Sequence[Artist] = (),
    key_columns: int = _KEY_COLUMNS,
    **options: Any,
) -> tuple[Figure, list[Axes]]:
    """Below a text one facet a name, with so many rows, each so many lines of text high. Options
    are those of subplots."""
    columns = min(columns, len(names))
    heights = [max(rows[at : at + columns]) for at in range(0, len(names), columns)]
    lines = sum(each * height + _AROUND for height in heights)
    above_and_below = 1 + text.count("\n") + -(-len(key) // key_columns)
    figure, axes = plt.subplots(
        len(heights),
        columns,
        figsize=(_WIDTH, _LINE * (lines + above_and_below)),
        height_ratios=heights,
        squeeze=False,
        layout="constrained",
        **options,
    )
    for ax, name in zip(axes.flat, names, strict=False):
        ax.set_title(name)
    for unused in axes.flat[len(names) :]:
        unused.set_visible(False)
    figure.suptitle(text, x=0.01, ha="left")
    if key:
        figure.legend(handles=list(key), loc="outside lower left", ncols=key_columns)
    return figure, list(axes.flat[: len(names)])


def at_largest(rows: pd.DataFrame, by: Sequence[str] = ("scene",)) -> pd.DataFrame:
    """Those at the largest size at which one of them ran, scene by scene."""
    ran = rows["n"].where(rows["ran"] & (rows["n"] > 0))
    return rows[rows["n"] == ran.groupby([rows[name] for name in by]).transform("max")]


def rows(ax: Axes, names: Sequence[str], inks: Iterable[str] = ()) -> None:
    """Names down the left, the first on top; rows are alike in height in facets side by side."""
    spec = _spec(ax)
    heights: Any = spec.get_gridspec().get_height_ratios()
    room = heights[spec.rowspan.start]
    ax.set_ylim(max(len(names), room) - 0.4, -0.6)
    ax.set_yticks(range(len(names)), names)
    ax.tick_params(axis="y", length=0)
    ax.grid(axis="y", visible=False)
    for label, ink in zip(ax.get_yticklabels(), inks, strict=False):
        label.set_color(ink)


def _spec(ax: Axes) -> SubplotSpec:
    """Its place in the grid."""
    spec = ax.get_subplotspec()
    assert spec is not None
    return spec


def beside(ax: Axes, x: float, y: float, text: str, **look: Any) -> None:
    """Text right of a mark."""
    known: dict[str, Any] = {"xytext": (5, 0), "textcoords": "offset points", "va": "center"}
    known |= {"fontsize": style.SMALL, "linespacing": 1.1}
    ax.annotate(text, (x, y), **known | look)


def apart(heights: Sequence[float], least: float) -> list[float]:
    """Shares of an axis, lowest first, moved as little as they must be to be so far apart
    (isotonic regression)."""
    blocks: list[list[float]] = []  # neighbours that touch move together
    for place, height in enumerate(heights):
        blocks.append([height - least * place])
        while len(blocks) > 1 and mean(blocks[-2]) > mean(blocks[-1]):
            blocks[-2:] = [blocks[-2] + blocks[-1]]
    moved = [mean(block) for block in blocks for _ in block]
    low, high = least / 2, 1 - least * (len(moved) - 0.5)  # all of them stay within the axis
    return [min(max(at, low), high) + least * place for place, at in enumerate(moved)]


def mark_wrong(bars: Iterable[Rectangle], exact: Iterable[bool]) -> None:
    """Pale and hatched those that are not exact."""
    for bar, right in zip(bars, exact, strict=True):
        if not right:
            bar.set(hatch="////", edgecolor="white", alpha=0.55)


def linear(ax: Axes, label: str) -> None:
    """An axis of numbers, across."""
    ax.xaxis.set_major_locator(MaxNLocator(6))
    ax.xaxis.set_major_formatter(FuncFormatter(words.tick))
    ax.set_xlabel(label)


def logarithmic(
    ax: Axes,
    which: str,
    label: str,
    at: Sequence[float] = (),
    text: Callable[[float], str] = words.tick,
) -> None:
    """The axis x or y, after the marks; ticks there, or as many as there is room for."""
    inner = which == "y" and not _spec(ax).is_first_col()
    ax.set(**{f"{which}scale": "log", f"{which}label": "" if inner else label})
    axis = getattr(ax, f"{which}axis")
    low, high = sorted(axis.get_view_interval())
    subs = (1.0, 2.0, 5.0) if high < 300 * low else (1.0,)
    axis.set_major_locator(FixedLocator(at) if at else LogLocator(subs=subs, numticks=9))
    axis.set_major_formatter(FuncFormatter(lambda value, _: text(value)))
    axis.set_minor_locator(NullLocator())


def band(
    ax: Axes, xs: Sequence[float], rounds: Sequence[Sequence[float]], look: Look, **more: Any
) -> None:
    """A line through the medians of the rounds, a band from the lowest to the highest round."""
    low, high = list(map(min, rounds)), list(map(max, rounds))
    ax.fill_between(xs, low, high, color=look.colour, alpha=0.2, linewidth=0)
    ax.plot(xs, list(map(median, rounds)), **look.shape | more)


def legend(ax: Axes, **look: Any) -> None:
    """Right of the facet."""
    ax.legend(loc="center left", bbox_to_anchor=(1.005, 0.5), **look)


def interval(ax: Axes, y: float, low: float, middle: float, high: float, look: Look) -> None:
    """A mark on a line across."""
    ax.plot([low, high], [y, y], color=look.colour, solid_capstyle="butt")
    ax.plot([middle], [y], **look.dot, markersize=7.5, markeredgewidth=1.6)


def margin(ax: Axes, y: float, text: str, column: int = 0, **look: Any) -> None:
    """Text right of the facet, in a column there."""
    at = {"xycoords": ("axes fraction", "data"), "xytext": (8 + _COLUMN * column, 0)}
    beside(ax, 1, y, text, annotation_clip=False, **at | look)


def table(ax: Axes, across: Sequence[str], down: Sequence[str], inks: Iterable[str] = ()) -> None:
    """Axes for cells: names above and left of them, and nothing else."""
    rows(ax, down, inks)
    ax.set_xlim(-0.5, len(across) - 0.5)
    ax.set_ylim(len(down) - 0.5, -0.5)
    ax.set_xticks(range(len(across)), across)
    ax.tick_params(length=0, labeltop=True, labelbottom=False)
    ax.grid(visible=False)
    ax.spines[:].set_visible(False)


def cell(ax: Axes, x: int, y: int, text: str, fill: str, edge: str = "white", **look: Any) -> None:
    known: dict[str, Any] = {"ha": "center", "va": "center", "linespacing": 1.0}
    known |= {"color": style.ink_on(fill), "fontsize": style.SMALL}
    box: dict[str, Any] = {"facecolor": fill, "edgecolor": edge, "linewidth": 1.2}
    above = 2 if edge not in ("white", style.GRID) else 1  # neighbours do not hide such an edge
    ax.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, zorder=above, **box))
    ax.text(x, y, text, **known | look)
