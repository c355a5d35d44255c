# SPDX-License-Identifier: MIT
"""The sorts against each other, on the host and on the device: by number of pairs, by width of the
key, and by the order that the pairs come in."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

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
    rows = result.frame[result.frame["order"] == "random"]
    sizes = _timed(rows).groupby("bits")["n"].nunique()
    shown = sizes.index[(sizes == sizes.max()) | (sizes > 1)]
    title = "random order; higher is better"
    return _draw(result, rows[rows["bits"].isin(shown)], "bits", title, partial(_lines, across="n"))


def draw_by_bits(result: SortResult) -> Figure | None:
    """The largest size that was timed at most widths, random order; None if there is but one."""
    rows = result.frame[result.frame["order"] == "random"]
    widths = _timed(rows).groupby("n")["bits"].nunique()
    size = widths.index[(widths == widths.max()) & (widths > 1)].max()
    title = "by the width of the key, random order; higher is better"
    return _draw(result, rows[rows["n"] == size], "n", title, partial(_lines, across="bits"))


def draw_by_order(result: SortResult) -> Figure | None:
    """The largest size that was timed in several orders, one facet per key width."""
    rows = result.frame
    orders = _timed(rows).groupby(["n", "bits"])["order"].nunique().reset_index()
    shown = orders[orders["order"] > 1]
    shown = shown[shown["n"] == shown["n"].max()][["n", "bits"]]
    title = "by the order that they come in; further right is better"
    return _draw(result, rows.merge(shown, on=["n", "bits"]), "bits", title, _orders)


def _timed(rows: pd.DataFrame) -> pd.DataFrame:
    return rows[rows["status"] == "ok"]


def _draw(
    result: SortResult, rows: pd.DataFrame, by: str, title: str, draw: Callable[..., None]
) -> Figure | None:
    """A facet per value of a column; what must be known when the figure travels alone is below."""
    timed, looks = _timed(rows), _looks(result)
    if timed.empty:
        return None
    shown, high = dict(list(timed.groupby(by))), timed["order"].nunique()
    figure, axes = facets.grid(
        f"Sorting pairs (32-bit key, 32-bit value), {title}\n"
        "marks: median of the rounds; bands and bars: slowest to fastest round",
        [_name(here) for here in shown.values()],
        [high] * len(shown),
        _LINES / high,
        _COLUMNS,
        [look.entry for look in looks.values()],
        sharex=True,
        sharey=True,
    )
    (legend,) = figure.legends
    legend.set_title(_footnote(result))
    legend.set_alignment("left")
    legend.get_title().set(fontsize=style.SMALL, color=style.FAINT)
    for ax, (value, here) in zip(axes, shown.items(), strict=True):
        draw(ax, here, looks, timed)
        wrong = rows["title"][(rows["status"] == "wrong") & (rows[by] == value)].unique()
        if len(wrong):  # a wrong answer has no place on the axes
            look: dict[str, Any] = {"ha": "center", "color": style.VERMILLION}
            ax.text(0.5, 0.02, f"WRONG: {', '.join(wrong)}", transform=ax.transAxes, **look)
    return figure


def _looks(result: SortResult) -> dict[str, Look]:
    """One colour and marker per algorithm; several threads are dashed and hollow."""
    sorts, found = result.frame.drop_duplicates("label"), {}
    timed = set(_timed(result.frame)["label"])
    places = pd.factorize(sorts["algorithm"])[0]
    for place, sort in zip(places, sorts.itertuples(), strict=True):
        if sort.label in timed:
            colour = style.COLOURS[place % len(style.COLOURS)]
            marker, several = style.MARKERS[place % len(style.MARKERS)], sort.threads > 1
            line = "--" if several else "-"
            found[sort.label] = Look(sort.label, colour, marker, line, several)
    return found


def _name(rows: pd.DataFrame) -> str:
    """What is the same for all of them."""
    widths = [f"{bits}-bit keys" for bits in rows["bits"].unique()]
    sizes = [f"{_power(n)} pairs" for n in rows["n"].unique()]
    return ", ".join(called[0] for called in (widths, sizes) if len(called) == 1)


def _lines(
    ax: Axes, rows: pd.DataFrame, looks: dict[str, Look], every: pd.DataFrame, across: str
) -> None:
    for label, here in rows.sort_values(across).groupby("label"):
        facets.band(ax, here[across], here["rates"], looks[label])
    ticks = sorted(set(every[across]))
    if across == "n":
        facets.logarithmic(ax, "x", "pairs", ticks, lambda n: _power(round(n)))
    else:
        ax.set(xticks=ticks, xlabel="bits of the key")
    facets.logarithmic(ax, "y", _RATE)


def _orders(ax: Axes, rows: pd.DataFrame, looks: dict[str, Look], every: pd.DataFrame) -> None:
    """A row per order; in it the sorts, one below the other."""
    orders, labels = sorted(set(every["order"]), key=lambda o: (*ORDERS, o).index(o)), list(looks)
    facets.rows(ax, [order.replace("_", "\n") for order in orders])
    for row in rows.itertuples():
        y = orders.index(row.order) - 0.4 + 0.8 * (labels.index(row.label) + 0.5) / len(labels)
        span = min(row.rates), median(row.rates), max(row.rates)
        facets.interval(ax, y, *span, looks[row.label])
    for between in range(1, len(orders)):
        ax.axhline(between - 0.5, color=style.GRID, linewidth=1)
    facets.logarithmic(ax, "x", _RATE)


def _power(n: int) -> str:
    """Sizes of the presets are powers of two."""
    exponent = int(n).bit_length() - 1
    if n != 1 << exponent:
        return words.grouped(n)
    return f"2{str(exponent).translate(str.maketrans('0123456789', '⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


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
