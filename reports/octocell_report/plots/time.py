# SPDX-License-Identifier: MIT
"""Time against the number of spheres, one facet per scene, both axes logarithmic."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator

from octocell_report import style, tables, words
from octocell_report.load import Impl, Result, Row
from octocell_report.style import Look

MEANING = {
    "cold": "cold: everything made from nothing",
    "warm": "warm: found from nothing, in memory already touched",
    "first_update": "first update: as update, the first after the structure was built",
    "update": "update: structure stands, every sphere re-announced",
}

_LANE_FILL = "#f6f7f9"
_LANE = 0.075  # of the axes' height: one line of text on one wrong implementation


def draw(result: Result, looks: dict[Impl, Look], run: str) -> Figure | None:
    """None if no scene has rows at two sizes or more."""
    scenes = [s for s in result.scenes if _sizes(result, s, run) > 1]
    if not scenes:
        return None
    lines = max(len(_shown(result, scene, run)) for scene in scenes)
    height = max(3.5, 0.265 * lines + 1.2)
    figure, axes = plt.subplots(
        len(scenes),
        1,
        figsize=(12.5, height * len(scenes) + 0.6),
        squeeze=False,
        layout=ConstrainedLayoutEngine(hspace=0.04, h_pad=0.08),
    )
    figure.suptitle(
        f"Time to find all pairs, {MEANING[run]}\nlines: median of the rounds; "
        "bands: fastest to slowest round; n^b: fitted slope",
        x=0.01,
        ha="left",
        fontsize=12.5,
    )
    for ax, scene in zip(axes[:, 0], scenes, strict=True):
        _facet(ax, result, looks, scene, run)
    return figure


def _shown(result: Result, scene: str, run: str) -> list[Impl]:
    curves = tables.curves(result, scene, run)
    return list(dict.fromkeys([*curves, *(r.impl for r in tables.marked(result, scene, run))]))


def _sizes(result: Result, scene: str, run: str) -> int:
    rows = [r for rows in tables.curves(result, scene, run).values() for r in rows]
    return len({row.place.n for row in rows + tables.marked(result, scene, run)})


def _facet(ax: Axes, result: Result, looks: dict[Impl, Look], scene: str, run: str) -> None:
    curves = tables.curves(result, scene, run)
    marked = tables.marked(result, scene, run)
    for impl, rows in curves.items():
        _line(ax, looks[impl], rows)
    sizes = sorted(
        {r.place.n for rows in curves.values() for r in rows} | {r.place.n for r in marked}
    )
    ax.set_xscale("log")
    ax.set_yscale("log")
    _marks(ax, looks, marked)
    margin = (sizes[-1] / sizes[0]) ** 0.09
    ax.set_xlim(sizes[0] / margin, sizes[-1] * margin)
    ax.xaxis.set_major_locator(FixedLocator(sizes))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda n, _: words.size(round(n))))
    ax.yaxis.set_major_formatter(FuncFormatter(words.tick))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.set_title(scene)
    ax.set_xlabel("spheres")
    ax.set_ylabel("time [ms]")
    _legend(ax, looks, curves, marked, sizes[-1])


def _line(ax: Axes, look: Look, rows: list[Row]) -> None:
    sizes = [row.place.n for row in rows]
    lowest, highest = [min(r.total_ms) for r in rows], [max(r.total_ms) for r in rows]
    ax.fill_between(sizes, lowest, highest, color=look.colour, alpha=0.22, linewidth=0)
    ax.plot(
        sizes,
        [row.median_ms for row in rows],
        color=look.colour,
        linestyle=look.line,
        linewidth=2,
        marker=look.marker,
        markersize=7,
        markeredgecolor=look.edge,
        path_effects=look.outline or None,
    )


def _marks(ax: Axes, looks: dict[Impl, Look], marked: list[Row]) -> None:
    """Hollow and crossed, no line; the losses stand in a lane of their own at the bottom."""
    impls = list(dict.fromkeys(row.impl for row in marked))
    letters = 10.5 if len({row.place.n for row in marked}) < 7 else 8.5  # or they run together
    for row in marked:
        _crossed(ax, looks[row.impl], row.place.n, row.median_ms)
    low, high = ax.get_ylim()
    share = _LANE * len(impls) + (0.03 if impls else 0)
    bottom = low / (high / low) ** (share / (1 - share))
    ax.set_ylim(bottom, high)
    if impls:
        ax.axhspan(bottom, low, color=_LANE_FILL, zorder=0, linewidth=0)
    for row in marked:
        n, lane = row.place.n, (impls.index(row.impl) + 0.5) * _LANE + 0.015
        at = bottom * (high / bottom) ** lane
        text = words.losses(row) if row.status == "wrong" else "exact here"
        box = {"facecolor": _LANE_FILL, "edgecolor": "none", "pad": 1}
        ax.plot([n, n], [at, row.median_ms], color=style.FAINT, linewidth=0.8, linestyle=":")
        ax.text(
            n,
            at,
            text,
            color=looks[row.impl].ink,
            ha="center",
            va="center",
            fontsize=letters,
            bbox=box,
        )


def _crossed(ax: Axes, look: Look, x: float, y: float) -> None:
    for mark in _hollow(look):
        ax.plot([x], [y], zorder=4, **mark)


def _hollow(look: Look) -> list[dict[str, Any]]:
    """The two parts of a mark for what is not exact: its outline, and a cross in it."""
    rim = {"linestyle": "none", "markeredgecolor": look.edge, "markeredgewidth": 1.6}
    return [
        rim | {"marker": look.marker, "markersize": 10, "markerfacecolor": "white"},
        rim | {"marker": "x", "markersize": 6},
    ]


def _legend(
    ax: Axes, looks: dict[Impl, Look], curves: dict[Impl, list[Row]], marked: list[Row], last: int
) -> None:
    """Beside the facet, slowest first, so that entries stand as the line ends do."""

    def reach(impl: Impl) -> float:
        fit = tables.power_law(curves[impl])
        return fit[0] * last ** fit[1] if fit else curves[impl][-1].median_ms

    handles: list[Any] = []
    texts = []
    for impl in sorted(curves, key=reach, reverse=True):
        look, b = looks[impl], tables.slope(curves[impl])
        texts.append(f"{look.label}   " + ("one size" if b is None else f"n^{b:.2f}"))
        handles.append(
            Line2D(
                [],
                [],
                color=look.colour,
                linestyle=look.line,
                linewidth=2,
                marker=look.marker,
                markersize=7,
                markeredgecolor=look.edge,
                path_effects=look.outline or None,
            )
        )
    for impl in dict.fromkeys(row.impl for row in marked):
        look = looks[impl]
        handles.append(tuple(Line2D([], [], **mark) for mark in _hollow(look)))
        texts.append(f"{look.label}   {words.MINUS}missed +false")
    ax.legend(handles, texts, loc="center left", bbox_to_anchor=(1.005, 0.5), handlelength=3)
