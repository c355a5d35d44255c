# SPDX-License-Identifier: MIT
"""Bytes per sphere beyond input and output, at each scene's largest size."""

from __future__ import annotations

import math

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from octocell_report import style, tables, words
from octocell_report.load import Impl, Result, Row
from octocell_report.style import Look

_COLUMNS = 3


def draw(result: Result, looks: dict[Impl, Look]) -> Figure | None:
    needs = {place: tables.memory(result, place) for place in tables.measured_memory(result)}
    impls = [i for i in result.impls if any(i in need for need in needs.values())]
    if not impls:
        return None
    columns = min(_COLUMNS, len(needs))
    lines = math.ceil(len(needs) / columns)
    figure, axes = plt.subplots(
        lines,
        columns,
        figsize=(3.6 + 3.5 * columns, (0.34 * len(impls) + 1.1) * lines + 0.6),
        squeeze=False,
        sharey=True,
        layout="constrained",
    )
    for ax, (place, need) in zip(axes.flat, needs.items(), strict=False):
        _facet(ax, looks, impls, need)
        ax.set_title(f"{place.scene}, {words.size(place.n)}")
        ax.set_xlabel("bytes per sphere")
    for ax in list(axes.flat)[len(needs) :]:
        ax.set_visible(False)
    figure.suptitle(
        "Memory per sphere beyond input and output\n"
        "growth of resident memory in a process of its own; hatched: not exact there",
        x=0.01,
        ha="left",
        fontsize=12.5,
    )
    return figure


def _facet(ax: Axes, looks: dict[Impl, Look], impls: list[Impl], need: dict[Impl, Row]) -> None:
    values = {impl: tables.beyond_bytes(row) or 0.0 for impl, row in need.items()}
    longest = max(max(values.values()), 1.0)
    for y, impl in enumerate(impls):
        if impl not in values:
            why = "skipped or not measured"
            ax.text(longest * 0.01, y, why, va="center", color=style.FAINT, fontsize=10)
            continue
        look, exact = looks[impl], need[impl].counts
        ax.barh(
            y,
            values[impl],
            height=0.66,
            color=look.colour if exact else "white",
            edgecolor=look.edge,
            hatch=None if exact else "////",
            linewidth=0.8,
        )
        end = max(values[impl], 0) + 0.02 * longest
        ax.text(end, y, words.grouped(values[impl]), va="center", fontsize=10)
    ax.set_xlim(min(0.0, *values.values()) * 1.1, longest * 1.25)
    ax.set_ylim(len(impls) - 0.4, -0.6)
    ax.set_yticks(range(len(impls)), [looks[impl].label for impl in impls])
    ax.tick_params(axis="y", length=0)
    ax.grid(axis="y", visible=False)
    ax.xaxis.set_major_locator(MaxNLocator(4))
