# SPDX-License-Identifier: MIT
"""Time of single frames of moving scenes, warm-up frames marked apart."""

from __future__ import annotations

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

from octocell_report import dynamic, words
from octocell_report.load import Impl, Place, Result, Row
from octocell_report.motion import Motion
from octocell_report.style import Look

_WARMUP_FILL = "#f1f2f4"


def draw(result: Result, looks: dict[Impl, Look]) -> Figure | None:
    """One facet per course: exact rows alone; None if no row has frames."""
    courses = {
        course: [row for row in rows if row.counts and row.median_ms > 0]
        for course, rows in dynamic.courses(result).items()
    }
    courses = {course: rows for course, rows in courses.items() if rows}
    if not courses:
        return None
    again = dynamic.searched_again(result)
    lines = max(len(rows) for rows in courses.values()) + len({impl for impl, _ in again})
    height = max(3.5, 0.265 * lines + 1.2)
    figure, axes = plt.subplots(
        len(courses),
        1,
        figsize=(12.5, height * len(courses) + 0.6),
        squeeze=False,
        layout=ConstrainedLayoutEngine(hspace=0.04, h_pad=0.08),
    )
    figure.suptitle(
        "Time per frame of moving scenes: move, follow or rebuild, find all pairs\n"
        "lines: median of the rounds; bands: fastest to slowest round; on grey, hollow: warm-up",
        x=0.01,
        ha="left",
        fontsize=12.5,
    )
    for ax, (course, rows) in zip(axes[:, 0], courses.items(), strict=True):
        _facet(ax, looks, rows, again)
        ax.set_title(course.title)
    return figure


def _facet(
    ax: Axes, looks: dict[Impl, Look], rows: list[Row], again: dict[tuple[Impl, Place], Row]
) -> None:
    """The legend stands beside it, slowest first, as the lines do."""
    ax.set_yscale("log")
    for row in sorted(rows, key=lambda r: r.median_ms, reverse=True):
        look = looks[row.impl]
        beside = again.get((row.impl, row.place))
        if beside and beside.motion:
            _searched_again(ax, look, beside.motion, beside.median_ms)
        if row.motion:
            steady = f"{look.label}   {words.number(row.median_ms)} ms"
            _course(ax, look, row.motion, steady)
    warmup = min(row.motion.warmup for row in rows if row.motion)
    if warmup:
        ax.axvspan(-0.5, warmup - 0.5, color=_WARMUP_FILL, zorder=0, linewidth=0)
    ax.set_xlim(-0.5, max(len(r.motion.by_frame) for r in rows if r.motion) - 0.5)
    ax.xaxis.set_major_locator(MaxNLocator(12, integer=True))
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.yaxis.set_major_formatter(FuncFormatter(words.tick))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.set_xlabel("frame")
    ax.set_ylabel("time [ms]")
    ax.legend(
        loc="center left", bbox_to_anchor=(1.005, 0.5), title="steady median", alignment="left"
    )


def _searched_again(ax: Axes, look: Look, motion: Motion, median_ms: float) -> None:
    label = f"the same, searched again   {words.number(median_ms)} ms"
    ax.plot(
        motion.by_frame, color=look.colour, linestyle="--", linewidth=1.3, alpha=0.7, label=label
    )


def _course(ax: Axes, look: Look, motion: Motion, label: str) -> None:
    times, warmup = motion.by_frame, motion.warmup
    frames = range(len(times))
    lowest = [min(t) for t in zip(*motion.frame_ms, strict=True)]
    highest = [max(t) for t in zip(*motion.frame_ms, strict=True)]
    ax.fill_between(frames, lowest, highest, color=look.colour, alpha=0.22, linewidth=0)
    shape = {"marker": look.marker, "markersize": 6, "markeredgecolor": look.edge}
    ax.plot(
        frames[warmup:],
        times[warmup:],
        color=look.colour,
        linestyle=look.line,
        linewidth=2,
        path_effects=look.outline or None,
        label=label,
        **shape,
    )
    ax.plot(
        frames[: warmup + 1],
        times[: warmup + 1],
        color=look.colour,
        linestyle=":",
        linewidth=1.2,
    )
    ax.plot(frames[:warmup], times[:warmup], linestyle="none", markerfacecolor="white", **shape)
