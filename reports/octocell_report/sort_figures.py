# SPDX-License-Identifier: MIT
"""The sorts against each other, on the host and on the device: by number of pairs, by width of the
key, and by the order that the pairs come in."""

from __future__ import annotations

from collections.abc import Callable, Sequence
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

TABLE = "sort.csv"
NAMES = (
    *("sort_by_size.png", "sort_by_order.png"),
    *("sort_gpu_by_size.png", "sort_gpu_by_bits.png", "sort_gpu_by_order.png"),
    TABLE,
)
_COLUMNS, _LINES = 4, 15  # of facets; of text that one is high
_RATE = "10⁹ pairs a second"


def build(result: SortResult, folder: Path, inputs: Sequence[Path] = ()) -> list[str]:
    """Writes the figures that have something to show, and the table; returns their names."""
    host, device = result.on("cpu"), result.on("gpu")
    figures: dict[str, Callable[[], Figure | None]] = {
        "sort_by_size.png": lambda: draw_by_size(host),
        "sort_by_order.png": lambda: draw_by_order(host),
        "sort_gpu_by_size.png": lambda: draw_by_size(device),
        "sort_gpu_by_bits.png": lambda: draw_by_bits(device),
        "sort_gpu_by_order.png": lambda: draw_by_order(device),
    }
    names = []
    with staged_folder(folder, NAMES, inputs) as staging, plt.rc_context(style.RC):
        for name, draw in figures.items():
            figure = draw()
            if figure is None:
                continue
            figure.savefig(staging / name, dpi=style.DPI)
            plt.close(figure)
            names.append(name)
        frames.save(frame(result), staging / TABLE)
    return [*names, TABLE]


def draw_by_size(result: SortResult) -> Figure | None:
    """One facet per key width that was timed at most sizes, random order; None if nothing was."""
    rows = _timed(result, order="random")
    sizes = rows.groupby("bits")["n"].nunique()
    shown = list(sizes.index[(sizes == sizes.max()) | (sizes > 1)])
    if not shown:
        return None
    title = "Sorting pairs (32-bit key, 32-bit value), random order; higher is better"
    figure, axes = _grid(result, title, [f"{bits}-bit keys" for bits in shown])
    for ax, bits in zip(axes, shown, strict=True):
        _lines(ax, result, rows[rows["bits"] == bits], "n")
        sizes_met = sorted(set(rows["n"]))
        facets.logarithmic(ax, "x", "pairs", sizes_met, lambda n: _power(round(n)))
        facets.logarithmic(ax, "y", _RATE)
        _say_wrong(ax, [row for row in result.wrong if (row.bits, row.order) == (bits, "random")])
    return figure


def draw_by_bits(result: SortResult) -> Figure | None:
    """The largest size that was timed at most widths, random order; None if there is but one."""
    rows = _timed(result, order="random")
    widths = rows.groupby("n")["bits"].nunique()
    if widths.empty or widths.max() < 2:
        return None
    size = int(widths.index[widths == widths.max()].max())
    title = (
        f"Sorting {_power(size)} pairs (32-bit key, 32-bit value) by the width of the key, random "
        "order; higher is better"
    )
    figure, (ax,) = _grid(result, title, [""])
    here = rows[rows["n"] == size].sort_values("bits")
    _lines(ax, result, here, "bits")
    ax.set_xticks(sorted(set(here["bits"])))
    ax.set_xlabel("bits of the key")
    facets.logarithmic(ax, "y", _RATE)
    _say_wrong(ax, [row for row in result.wrong if (row.n, row.order) == (size, "random")])
    return figure


def draw_by_order(result: SortResult) -> Figure | None:
    """The largest size that was timed in several orders, one facet per key width."""
    rows = _timed(result)
    orders = rows.groupby(["n", "bits"])["order"].nunique().reset_index()
    several = orders[orders["order"] > 1]
    if several.empty:
        return None
    size = int(several["n"].max())
    shown = list(several["bits"][several["n"] == size])
    title = (
        f"Sorting {_power(size)} pairs (32-bit key, 32-bit value) by the order that they come in; "
        "further right is better"
    )
    rows = rows[(rows["n"] == size) & rows["bits"].isin(shown)]
    met = [order for order in ORDERS if order in set(rows["order"])]
    figure, axes = _grid(result, title, [f"{bits}-bit keys" for bits in shown], len(met))
    for ax, bits in zip(axes, shown, strict=True):
        _orders(ax, result, rows[rows["bits"] == bits], met)
        _say_wrong(ax, [row for row in result.wrong if (row.bits, row.n) == (bits, size)])
    return figure


def _timed(result: SortResult, **fixed: Any) -> pd.DataFrame:
    """Rows with a time, ascending by size."""
    columns = ["label", "n", "bits", "order", "rates"]
    rows = result.timed(**fixed)
    lines = [(_label(row.sort), row.n, row.bits, row.order, row.rates) for row in rows]
    return pd.DataFrame(lines, columns=columns)


def _label(sort: Sort) -> str:
    title = TITLES.get(sort.algorithm, sort.algorithm)
    return f"{title}, {sort.threads} threads" if sort.threads > 1 else title


def _looks(result: SortResult) -> dict[str, Look]:
    """One colour and marker per algorithm; several threads are dashed and hollow."""
    algorithms = list(dict.fromkeys(sort.algorithm for sort in result.sorts))
    found = {}
    for sort in result.sorts:
        place, several = algorithms.index(sort.algorithm) % len(style.COLOURS), sort.threads > 1
        colour, marker = style.COLOURS[place], style.MARKERS[place]
        label = _label(sort)
        found[label] = Look(label, colour, marker, "--" if several else "-", several)
    met = set(_timed(result)["label"])
    return {label: look for label, look in found.items() if label in met}


def _grid(
    result: SortResult, title: str, names: list[str], rows: int = 1
) -> tuple[Figure, list[Axes]]:
    """Below the key stands what must be known when the figure travels alone."""
    figure, axes = facets.grid(
        f"{title}\nmarks: median of the rounds; bands and bars: slowest to fastest round",
        names,
        [rows] * len(names),
        _LINES / rows,
        columns=_COLUMNS,
        key=[look.entry for look in _looks(result).values()],
        sharex=True,
        sharey=True,
    )
    (legend,) = figure.legends
    legend.set_title(_footnote(result))
    legend.set_alignment("left")
    legend.get_title().set(fontsize=style.SMALL, color=style.FAINT)
    return figure, axes


def _lines(ax: Axes, result: SortResult, rows: pd.DataFrame, across: str) -> None:
    for label, look in _looks(result).items():
        here = rows[rows["label"] == label]
        if not here.empty:
            facets.band(ax, here[across], here["rates"], look)


def _orders(ax: Axes, result: SortResult, rows: pd.DataFrame, orders: list[str]) -> None:
    facets.rows(ax, [order.replace("_", "\n") for order in orders])
    for between in range(1, len(orders)):
        ax.axhline(between - 0.5, color=style.GRID, linewidth=1)
    looks = _looks(result)
    labels = list(looks)
    for row in rows.itertuples():
        y = orders.index(row.order) - 0.4 + 0.8 * (labels.index(row.label) + 0.5) / len(labels)
        rates = row.rates
        facets.interval(ax, y, min(rates), median(rates), max(rates), looks[row.label])
    facets.logarithmic(ax, "x", _RATE)


def _power(n: int) -> str:
    """Sizes of the presets are powers of two."""
    exponent = n.bit_length() - 1
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
    context = result.context
    commit = context["commit"][:12] + (", uncommitted changes" if context["dirty"] else "")
    unfinished = "" if context["finished"] else "; INTERRUPTED: not all rows were run"
    skips: dict[str, dict[str, None]] = {}
    for row in result.rows:
        if row.status == "skipped":
            skips.setdefault(row.reason or "", {})[TITLES.get(row.algorithm, row.algorithm)] = None
    where, how = _conditions(result)
    lines = [
        f"{where}; commit {commit}; {context['date'][:10]}{unfinished}",
        how,
        *(f"left out: {', '.join(titles)}: {reason}" for reason, titles in skips.items()),
    ]
    return "\n".join(lines)


def _conditions(result: SortResult) -> tuple[str, str]:
    """On what it was measured, and what is to be known of the times."""
    if all(row.device == "gpu" for row in result.rows):
        gpu = gpu_of(result.context)
        copied = f", copies {words.grouped(gpu.copy_gbps)} GB/s (read and written)" if gpu else ""
        return (
            f"{gpu.name if gpu else 'a GPU that is not named'}{copied}",
            "time on the device, between two events; input restored and answers checked outside; "
            "CUB is told the number of pairs, ours read it on the device",
        )
    machine = result.context["machine"]
    return (
        f"{machine['cpu']}, {machine['cores']} cores; {result.context['compiler']}",
        "all but our radix sort: keys and values packed into 64-bit numbers and unpacked again, "
        "inside the time",
    )
