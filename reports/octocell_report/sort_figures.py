# SPDX-License-Identifier: MIT
"""The sorts against each other, on the host and on the device: by number of pairs, by width of the
key, and by the order that the pairs come in."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import Any

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from octocell_report import frames, style, words
from octocell_report.context import gpu_of
from octocell_report.files import staged_folder
from octocell_report.plots import facets
from octocell_report.sort import ORDERS, TITLES, Sort, SortResult, SortRow, frame
from octocell_report.style import Look

_COLUMNS, _LINES = 4, 15  # of facets; of text that one is high
_RATE = "10⁹ pairs a second"


def draw_by_size(result: SortResult) -> Figure | None:
    """One facet per key width that was timed at most sizes, random order; None if nothing was."""
    rows = _timed(result, order="random")
    sizes = rows.groupby("bits")["n"].transform("nunique")
    rows = rows[(sizes == sizes.max()) | (sizes > 1)]
    wrong = [row for row in result.wrong if row.order == "random"]
    return _curves(result, rows, "n", "random order", wrong)


def draw_by_bits(result: SortResult) -> Figure | None:
    """The largest size that was timed at most widths, random order; None if there is but one."""
    rows = _timed(result, order="random")
    widths = rows.groupby("n")["bits"].transform("nunique")
    size = rows["n"][widths == widths.max()].max()
    rows = rows[(rows["n"] == size) & (widths > 1)].sort_values("bits")
    wrong = [row for row in result.wrong if (row.n, row.order) == (size, "random")]
    return _curves(result, rows, "bits", "by the width of the key, random order", wrong)


def _curves(
    result: SortResult, rows: pd.DataFrame, across: str, title: str, wrong: list[SortRow]
) -> Figure | None:
    """A line per sort; a facet per width over sizes, or per size over widths."""
    if rows.empty:
        return None
    other, called = ("bits", "{}-bit keys") if across == "n" else ("n", "{} pairs")
    shown = dict(list(rows.groupby(other)))
    names = [called.format(_power(value) if other == "n" else value) for value in shown]
    figure, axes = _grid(result, f"{title}; higher is better", names)
    ticks = sorted(set(rows[across]))
    for ax, (value, here) in zip(axes, shown.items(), strict=True):
        for label, look in _looks(result).items():
            of_sort = here[here["label"] == label]
            facets.band(ax, of_sort[across], of_sort["rates"], look)
        if across == "n":
            facets.logarithmic(ax, "x", "pairs", ticks, lambda n: _power(round(n)))
        else:
            ax.set(xticks=ticks, xlabel="bits of the key")
        facets.logarithmic(ax, "y", _RATE)
        _say_wrong(ax, [row for row in wrong if getattr(row, other) == value])
    return figure


def draw_by_order(result: SortResult) -> Figure | None:
    """The largest size that was timed in several orders, one facet per key width."""
    rows = _timed(result)
    rows = rows[rows.groupby(["n", "bits"])["order"].transform("nunique") > 1]
    if rows.empty:
        return None
    size = rows["n"].max()
    rows = rows[rows["n"] == size]
    orders = [order for order in ORDERS if order in set(rows["order"])]
    bits = dict(list(rows.groupby("bits")))
    title = f"{_power(size)} pairs, by the order that they come in; further right is better"
    figure, axes = _grid(result, title, [f"{width}-bit keys" for width in bits], len(orders))
    for ax, (width, here) in zip(axes, bits.items(), strict=True):
        _orders(ax, _looks(result), here, orders)
        _say_wrong(ax, [row for row in result.wrong if (row.bits, row.n) == (width, size)])
    return figure


def _timed(result: SortResult, **fixed: Any) -> pd.DataFrame:
    """Rows with a time, ascending by size."""
    rows = result.timed(**fixed)
    lines = [(_label(row.sort), row.n, row.bits, row.order, row.rates) for row in rows]
    return pd.DataFrame(lines, columns=["label", "n", "bits", "order", "rates"])


def _label(sort: Sort) -> str:
    title = TITLES.get(sort.algorithm, sort.algorithm)
    return f"{title}, {sort.threads} threads" if sort.threads > 1 else title


def _looks(result: SortResult) -> dict[str, Look]:
    """One colour and marker per algorithm; several threads are dashed and hollow."""
    algorithms = list(dict.fromkeys(sort.algorithm for sort in result.sorts))
    met, found = {row.sort for row in result.timed()}, {}
    for sort in (sort for sort in result.sorts if sort in met):
        place, several = algorithms.index(sort.algorithm), sort.threads > 1
        colour = style.COLOURS[place % len(style.COLOURS)]
        marker, line = style.MARKERS[place % len(style.MARKERS)], "--" if several else "-"
        found[_label(sort)] = Look(_label(sort), colour, marker, line, several)
    return found


def _grid(
    result: SortResult, title: str, names: list[str], rows: int = 1
) -> tuple[Figure, list[Axes]]:
    """Below the facets stands what must be known when the figure travels alone."""
    figure, axes = facets.grid(
        f"Sorting pairs (32-bit key, 32-bit value), {title}\n"
        "marks: median of the rounds; bands and bars: slowest to fastest round",
        names,
        [rows] * len(names),
        _LINES / rows,
        _COLUMNS,
        [look.entry for look in _looks(result).values()],
        **{"sharex": True, "sharey": True},
    )
    (legend,) = figure.legends
    legend.set_title(_footnote(result))
    legend.set_alignment("left")
    legend.get_title().set(fontsize=style.SMALL, color=style.FAINT)
    return figure, axes


def _orders(ax: Axes, looks: dict[str, Look], rows: pd.DataFrame, orders: list[str]) -> None:
    facets.rows(ax, [order.replace("_", "\n") for order in orders])
    for between in range(1, len(orders)):
        ax.axhline(between - 0.5, color=style.GRID, linewidth=1)
    labels = list(looks)
    for row in rows.itertuples():
        y = orders.index(row.order) - 0.4 + 0.8 * (labels.index(row.label) + 0.5) / len(labels)
        low, *_, high = sorted(row.rates)
        facets.interval(ax, y, low, median(row.rates), high, looks[row.label])
    facets.logarithmic(ax, "x", _RATE)


def _power(n: int) -> str:
    """Sizes of the presets are powers of two."""
    exponent = int(n).bit_length() - 1
    if n != 1 << exponent:
        return words.grouped(n)
    return f"2{str(exponent).translate(str.maketrans('0123456789', '⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


def _say_wrong(ax: Axes, rows: list[SortRow]) -> None:
    """A wrong answer has no place on the axes; its name stands in red on them."""
    if rows:
        sorts = dict.fromkeys(TITLES.get(row.algorithm, row.algorithm) for row in rows)
        text = "WRONG: " + ", ".join(sorts)
        ax.text(0.5, 0.02, text, transform=ax.transAxes, ha="center", color=style.VERMILLION)


def _footnote(result: SortResult) -> str:
    """On what it was measured, what is to be known of the times, and what was left out."""
    context, gpu = result.context, gpu_of(result.context)
    machine = context["machine"]
    where = f"{machine['cpu']}, {machine['cores']} cores; {context['compiler']}"
    how = (
        "all but our radix sort: keys and values packed into 64-bit numbers and unpacked again, "
        "inside the time"
    )
    if all(row.device == "gpu" for row in result.rows):
        copied = f", copies {words.grouped(gpu.copy_gbps)} GB/s (read and written)" if gpu else ""
        where = f"{gpu.name if gpu else 'a GPU that is not named'}{copied}"
        how = (
            "time on the device, between two events; input restored and answers checked outside; "
            "CUB is told the number of pairs, ours read it on the device"
        )
    skips: dict[str, dict[str, None]] = {}
    for row in result.rows:
        if row.status == "skipped":
            skips.setdefault(row.reason or "", {})[TITLES.get(row.algorithm, row.algorithm)] = None
    commit = context["commit"][:12] + (", uncommitted changes" if context["dirty"] else "")
    unfinished = "" if context["finished"] else "; INTERRUPTED: not all rows were run"
    left_out = [f"left out: {', '.join(names)}: {reason}" for reason, names in skips.items()]
    where += f"; commit {commit}; {context['date'][:10]}{unfinished}"
    return "\n".join([where, how, *left_out])


_DRAWS = {  # by name: the device, and the function
    "sort_by_size.png": ("cpu", draw_by_size),
    "sort_by_order.png": ("cpu", draw_by_order),
    "sort_gpu_by_size.png": ("gpu", draw_by_size),
    "sort_gpu_by_bits.png": ("gpu", draw_by_bits),
    "sort_gpu_by_order.png": ("gpu", draw_by_order),
}
TABLE = "sort.csv"
NAMES = (*_DRAWS, TABLE)


def build(result: SortResult, folder: Path, inputs: Sequence[Path] = ()) -> list[str]:
    """Writes the figures that have something to show, and the table; returns their names."""
    with staged_folder(folder, NAMES, inputs) as staging, plt.rc_context(style.RC):
        for name, (device, draw) in _DRAWS.items():
            figure = draw(result.on(device))
            if figure is not None:
                figure.savefig(staging / name, dpi=style.DPI)
                plt.close(figure)
        frames.save(frame(result), staging / TABLE)
        return [name for name in NAMES if (staging / name).exists()]
