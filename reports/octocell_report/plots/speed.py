# SPDX-License-Identifier: MIT
"""Speed against the baselines: ratios taken round by round, so that drift cancels."""

from __future__ import annotations

from dataclasses import dataclass

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from octocell_report import style, tables, words
from octocell_report.load import Impl, Place, Result
from octocell_report.style import Look
from octocell_report.tables import Ratio

_INCHES = 0.24  # a line of the figure
_MOST = 24  # groups


def draw(result: Result, looks: dict[Impl, Look], run: str) -> Figure | None:
    """One line per group; one panel per library; a mark right of 1 is faster than it."""
    found = tables.ratios(result, run)
    if not found:
        return None
    found, some = _fewer(result, found)
    families = [f for f in tables.families(result) if any(r.family == f for r in found)]
    places = list(dict.fromkeys(r.place for r in found))
    impls = [i for i in result.impls if any(r.impl == i for r in found)]
    rows = _layout(found, places, impls)
    figure, axes = plt.subplots(
        1,
        len(families),
        figsize=(2.2 + 6.4 * len(families), rows.height * _INCHES + 2.2),
        squeeze=False,
        sharey=True,
        layout="constrained",
    )
    for ax, family in zip(axes[0], families, strict=True):
        _panel(ax, looks, [r for r in found if r.family == family], rows)
        ax.set_title(f"against {words.family_title(family)}'s fastest", pad=10)
    own = words.run(found[0].own_run)
    _key(figure, [looks[impl] for impl in impls], f"{own} against {words.run(run)}{some}")
    return figure


def _fewer(result: Result, found: list[Ratio]) -> tuple[list[Ratio], str]:
    """Two sizes of each scene where all would make the figure too tall, and words that say so."""
    if len({r.place for r in found}) <= _MOST:
        return found, ""
    kept = set()
    for scene in result.scenes:
        kept |= set(sorted({r.place for r in found if r.place.scene == scene})[-2:])
    return [r for r in found if r.place in kept], ", two largest sizes (all: in the table)"


def _key(figure: Figure, shown: list[Look], runs: str) -> None:
    """The title and the marks' names, on top: the figure can be tall."""
    handles = [
        Line2D([], [], color=look.colour, marker=look.marker, markersize=8, label=look.label)
        for look in shown
    ]
    figure.legend(
        handles=handles,
        loc="outside upper left",
        ncols=min(4, len(handles)),
        alignment="left",
        title=f"Speed, {runs}: baseline time / our time, round by round\n"
        "marks: median; bars: lowest to highest round; grey names: the baseline of that line",
        title_fontsize=12.5,
    )


@dataclass(frozen=True)
class _Rows:
    """Where each mark stands, in lines from the top; a group has as many as it needs."""

    marks: dict[tuple[Place, Impl], float]
    middles: dict[Place, float]
    rules: list[float]  # between scenes
    height: float


def _layout(found: list[Ratio], places: list[Place], impls: list[Impl]) -> _Rows:
    marks: dict[tuple[Place, Impl], float] = {}
    middles: dict[Place, float] = {}
    rules, y = [], 0.0
    for index, place in enumerate(places):
        if index and places[index - 1].scene != place.scene:
            rules.append(y)
        there = [i for i in impls if any(r.impl == i and r.place == place for r in found)]
        marks |= {(place, impl): y + 0.9 + k for k, impl in enumerate(there)}
        middles[place] = y + 0.9 + (len(there) - 1) / 2
        y += len(there) + 0.8
    return _Rows(marks, middles, rules, y)


def _panel(ax: Axes, looks: dict[Impl, Look], found: list[Ratio], rows: _Rows) -> None:
    for ratio in found:
        _mark(ax, looks[ratio.impl], ratio, rows.marks[ratio.place, ratio.impl])
    low = min(0.8, *(min(r.rounds) for r in found)) / 1.25
    high = max(1.25, *(max(r.rounds) for r in found))
    ax.set_xscale("log")
    ax.set_xlim(low, high * (high / low) ** 0.24)
    ax.axvline(1, color=style.INK, linewidth=1.2)
    ax.axvspan(low, 1, color="#f1f2f4", zorder=0)
    ax.set_ylim(rows.height, 0)
    ax.set_yticks(list(rows.middles.values()), [words.place(place) for place in rows.middles])
    ax.tick_params(axis="y", length=0)
    ax.tick_params(axis="x", labeltop=True)
    ax.grid(axis="y", visible=False)
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0,) if high / low > 300 else (1.0, 2.0, 5.0)))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{words.tick(x)}×"))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.set_xlabel("\u25c2 slower than the baseline     times as fast     faster \u25b8")
    for y in rows.rules:
        ax.axhline(y, color=style.FAINT, linewidth=0.7)
    for place, reference in {r.place: r.reference for r in found}.items():
        ax.annotate(
            looks[reference].label,
            (1, rows.middles[place]),
            xycoords=("axes fraction", "data"),
            xytext=(5, 0),
            textcoords="offset points",
            va="center",
            fontsize=9.5,
            color=style.FAINT,
        )


def _mark(ax: Axes, look: Look, ratio: Ratio, y: float) -> None:
    ax.plot([min(ratio.rounds), max(ratio.rounds)], [y, y], color=look.colour, linewidth=2.2)
    ax.plot([ratio.median], [y], marker=look.marker, markersize=7, color=look.colour)
    ax.annotate(
        words.ratio(ratio.median),
        (max(ratio.rounds), y),
        xytext=(7, 0),
        textcoords="offset points",
        va="center",
        fontsize=10,
        color=look.ink,
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.6},
    )
