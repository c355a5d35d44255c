# SPDX-License-Identifier: MIT
"""Time of single frames of moving scenes, warm-up frames marked apart."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from octocell_report import style, tables, words
from octocell_report.load import Place, Result
from octocell_report.plots import facets
from octocell_report.style import Look

_LEAST = 12  # lines of text that a facet is high
_COURSE = ["scene", "n", "motion"]
Line = tuple[Look, Any, Any]  # a row of Result.frame, and the same frames searched again or None


def draw(result: Result, looks: dict[str, Look]) -> Figure | None:
    """One facet per scene, size and motion: exact rows alone; None if no row has frames."""
    rows, again = result.frame, tables.searched_again(result)
    moving = rows[rows["motion"].notna() & rows["counts"] & (rows["median_ms"] > 0)]
    lines: dict[str, list[Line]] = {}
    for (scene, n, motion), here in moving.groupby(_COURSE, sort=False):
        title = words.place(Place(scene, n)) + (f", {motion}" if motion != scene else "")
        lines[title] = [
            (looks[row.label], row, again.get(row.Index))
            for row in here.sort_values("median_ms", ascending=False, kind="stable").itertuples()
        ]
    if not lines:
        return None
    figure, axes = facets.grid(
        facets.caption("dynamic"),
        list(lines),
        [max(_LEAST, sum(2 if line[2] else 1 for line in here)) for here in lines.values()],
    )
    for ax, here in zip(axes, lines.values(), strict=True):
        _facet(ax, here)
    return figure


def _facet(ax: Axes, lines: list[Line]) -> None:
    """The legend stands beside it, slowest first, as the lines do."""
    for look, row, again in lines:
        if again and again.frames:
            label = f"the same, searched again   {words.number(again.median_ms)} ms"
            times = again.frames.by_frame
            ax.plot(times, color=look.colour, linestyle="--", linewidth=1.3, alpha=0.7, label=label)
        _frames(ax, look, row)
    warmup = min(row.frames.warmup for _, row, _ in lines)
    if warmup:
        ax.axvspan(-0.5, warmup - 0.5, color=style.APART_FILL, zorder=0, linewidth=0)
    ax.set_xlim(-0.5, max(len(row.frames.by_frame) for _, row, _ in lines) - 0.5)
    ax.xaxis.set_major_locator(MaxNLocator(12, integer=True))
    ax.set_xlabel("frame")
    facets.logarithmic(ax, "y", "time [ms]")
    facets.legend(ax, title="steady median", alignment="left")


def _frames(ax: Axes, look: Look, row: Any) -> None:
    rounds, warmup = list(zip(*row.frames.frame_ms, strict=True)), row.frames.warmup
    frames = list(range(len(rounds)))
    early = {"linestyle": ":", "linewidth": 1.2, "markerfacecolor": "white"}
    facets.band(ax, frames[: warmup + 1], rounds[: warmup + 1], look, **early)
    label = f"{look.label}   {words.number(row.median_ms)} ms"
    facets.band(ax, frames[warmup:], rounds[warmup:], look, label=label)
