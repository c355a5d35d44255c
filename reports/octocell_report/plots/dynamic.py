# SPDX-License-Identifier: MIT
"""Time of single frames of moving scenes, warm-up frames marked apart."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from octocell_report import dynamic, style, words
from octocell_report.load import Result, Row
from octocell_report.plots import facets
from octocell_report.style import Look

_LEAST = 12  # lines of text that a facet is high
Line = tuple[Look, Row, Row | None]  # a row, and the same frames searched again


def draw(result: Result, looks: dict[str, Look]) -> Figure | None:
    """One facet per course: exact rows alone; None if no row has frames."""
    again = dynamic.searched_again(result)
    lines: dict[str, list[Line]] = {}
    for course, rows in dynamic.courses(result).items():
        for row in sorted(rows, key=lambda row: -row.median_ms):
            if row.counts and row.median_ms > 0:
                line = looks[result.labels[row.impl]], row, again.get((row.impl, row.place))
                lines.setdefault(course.title, []).append(line)
    if not lines:
        return None
    figure, axes = facets.grid(
        "Time per frame of moving scenes: move, follow or rebuild, find all pairs\n"
        "lines: median of the rounds; bands: fastest to slowest round; on grey, hollow: warm-up",
        list(lines),
        [
            max(_LEAST, len(here) + sum(line[2] is not None for line in here))
            for here in lines.values()
        ],
    )
    for ax, here in zip(axes, lines.values(), strict=True):
        _facet(ax, here)
    return figure


def _facet(ax: Axes, lines: list[Line]) -> None:
    """The legend stands beside it, slowest first, as the lines do."""
    for look, row, again in lines:
        if again and again.motion:
            label = f"the same, searched again   {words.number(again.median_ms)} ms"
            times = again.motion.by_frame
            ax.plot(times, color=look.colour, linestyle="--", linewidth=1.3, alpha=0.7, label=label)
        _frames(ax, look, row)
    warmup = min(row.motion.warmup for _, row, _ in lines if row.motion)
    if warmup:
        ax.axvspan(-0.5, warmup - 0.5, color=style.APART_FILL, zorder=0, linewidth=0)
    ax.set_xlim(-0.5, max(len(row.motion.by_frame) for _, row, _ in lines if row.motion) - 0.5)
    ax.xaxis.set_major_locator(MaxNLocator(12, integer=True))
    ax.set_xlabel("frame")
    facets.logarithmic(ax, "y", "time [ms]")
    ax.legend(
        loc="center left", bbox_to_anchor=(1.005, 0.5), title="steady median", alignment="left"
    )


def _frames(ax: Axes, look: Look, row: Row) -> None:
    assert row.motion is not None
    rounds, warmup = list(zip(*row.motion.frame_ms, strict=True)), row.motion.warmup
    frames = list(range(len(rounds)))
    early = {"linestyle": ":", "linewidth": 1.2, "markerfacecolor": "white"}
    facets.band(ax, frames[: warmup + 1], rounds[: warmup + 1], look, **early)
    label = f"{look.label}   {words.number(row.median_ms)} ms"
    facets.band(ax, frames[warmup:], rounds[warmup:], look, label=label)
