# SPDX-License-Identifier: MIT
"""The sorts against each other, on the host and on the device: by number of pairs, by width of the
key, and by the order that the pairs come in."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from statistics import median

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from octocell_report import frames, style, words
from octocell_report.files import staged_folder
from octocell_report.plots import facets
from octocell_report.sort import ORDERS, SortResult, table
from octocell_report.style import Look

_COLUMNS, _LINES = 4, 15  # of facets; of text that one is high
_RATE = "10⁹ pairs a second"


def draw_by_size(result: SortResult) -> Figure | None:
    """One facet per key width that was timed at most sizes, random order; None if nothing was."""
    frame = result.frame[result.frame["order"] == "random"]
    rows = frame[frame["status"] == "ok"]
    sizes = rows.groupby("bits")["n"].transform("nunique")
    rows = rows[(sizes == sizes.max()) | (sizes > 1)]
    return _curves(result, rows, "n", "random order", _wrong(frame))


def draw_by_bits(result: SortResult) -> Figure | None:
    """The largest size that was timed at most widths, random order; None if there is but one."""
    frame = result.frame[result.frame["order"] == "random"]
    rows = frame[frame["status"] == "ok"]
    widths = rows.groupby("n")["bits"].transform("nunique")
    size = rows["n"][widths == widths.max()].max()
    rows = rows[(rows["n"] == size) & (widths > 1)].sort_values("bits")
    wrong = _wrong(frame[frame["n"] == size])
    return _curves(result, rows, "bits", "by the width of the key, random order", wrong)


def _curves(
    result: SortResult, rows: pd.DataFrame, across: str, title: str, wrong: pd.DataFrame
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
            of_sort = here[here["label"] == label].sort_values(across)
            facets.band(ax, of_sort[across], of_sort["rates"], look)
        if across == "n":
            facets.logarithmic(ax, "x", "pairs", ticks, lambda n: _power(round(n)))
        else:
            ax.set(xticks=ticks, xlabel="bits of the key")
        facets.logarithmic(ax, "y", _RATE)
        _say_wrong(ax, wrong[wrong[other] == value])
    return figure


def draw_by_order(result: SortResult) -> Figure | None:
    """The largest size that was timed in several orders, one facet per key width."""
    rows = result.frame[result.frame["status"] == "ok"]
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
        wrong = _wrong(result.frame)
        _say_wrong(ax, wrong[(wrong["bits"] == width) & (wrong["n"] == size)])
    return figure


def _wrong(rows: pd.DataFrame) -> pd.DataFrame:
    return rows[rows["status"] == "wrong"]


def _looks(result: SortResult) -> dict[str, Look]:
    """One colour and marker per algorithm; several threads are dashed and hollow."""
    sorts, found = result.frame.drop_duplicates("label"), {}
    timed = set(result.frame[result.frame["status"] == "ok"]["label"])
    places = pd.factorize(sorts["algorithm"])[0]
    for place, sort in zip(places, sorts.itertuples(), strict=True):
        if sort.label in timed:
            colour = style.COLOURS[place % len(style.COLOURS)]
            marker, several = style.MARKERS[place % len(style.MARKERS)], sort.threads > 1
            line = "--" if several else "-"
            found[sort.label] = Look(sort.label, colour, marker, line, several)
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


def _say_wrong(ax: Axes, rows: pd.DataFrame) -> None:
    """A wrong answer has no place on the axes; its name stands in red on them."""
    if len(rows):
        text = f"WRONG: {', '.join(rows['title'].unique())}"
        ax.text(0.5, 0.02, text, transform=ax.transAxes, ha="center", color=style.VERMILLION)


def _footnote(result: SortResult) -> str:
    """On what it was measured, what is to be known of the times, and what was left out."""
    context, gpu = result.context, result.context.gpu
    where = f"{context.machine.cpu}, {context.machine.cores} cores; {context.compiler}"
    how = (
        "all but our radix sort: keys and values packed into 64-bit numbers and unpacked again, "
        "inside the time"
    )
    if (result.frame["device"] == "gpu").all():
        copied = f", copies {words.grouped(gpu.copy_gbps)} GB/s (read and written)" if gpu else ""
        where = f"{gpu.name if gpu else 'a GPU that is not named'}{copied}"
        how = (
            "time on the device, between two events; input restored and answers checked outside; "
            "CUB is told the number of pairs, ours read it on the device"
        )
    skipped = result.frame[result.frame["status"] == "skipped"]
    left_out = [
        f"left out: {', '.join(titles.unique())}: {reason}"
        for reason, titles in skipped.groupby("reason", sort=False)["title"]
    ]
    commit = context.commit[:12] + (", uncommitted changes" if context.dirty else "")
    unfinished = "" if context.finished else "; INTERRUPTED: not all rows were run"
    where += f"; commit {commit}; {context.date[:10]}{unfinished}"
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
        frames.save(table(result), staging / TABLE)
        return [name for name in NAMES if (staging / name).exists()]
