# SPDX-License-Identifier: MIT
"""The sorts against each other, on the host and on the device: by number of pairs, by width of the
key, and by the order that the pairs come in."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter, NullLocator

from octocell_report import frames, style, words
from octocell_report.context import gpu_of
from octocell_report.files import staged_folder
from octocell_report.sort import ORDERS, TITLES, Sort, SortResult, SortRow, frame

TABLE = "sort.csv"
NAMES = (
    *("sort_by_size.png", "sort_by_order.png"),
    *("sort_gpu_by_size.png", "sort_gpu_by_bits.png", "sort_gpu_by_order.png"),
    TABLE,
)

_COLOURS = (
    *(style.BLUE, style.VERMILLION, style.ORANGE, style.PURPLE, style.GREEN, style.BLACK),
    *(style.SKY, style.GREY),
)
_MARKERS = ("o", "s", "D", "^", "v", "P", "X", "h")
_COLUMNS = 4  # of facets


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


@dataclass(frozen=True)
class _Look:
    label: str
    colour: str
    marker: str
    line: str


def _looks(result: SortResult) -> dict[Sort, _Look]:
    """One colour and marker per algorithm; several threads are dashed and hollow."""
    algorithms = list(dict.fromkeys(sort.algorithm for sort in result.sorts))
    found = {}
    for sort in result.sorts:
        place = algorithms.index(sort.algorithm) % len(_COLOURS)
        label = TITLES.get(sort.algorithm, sort.algorithm)
        if sort.threads > 1:
            label += f", {sort.threads} threads"
        line = "--" if sort.threads > 1 else "-"
        found[sort] = _Look(label, _COLOURS[place], _MARKERS[place], line)
    return found


def _face(sort: Sort, look: _Look) -> str:
    return "white" if sort.threads > 1 else look.colour


def draw_by_size(result: SortResult) -> Figure | None:
    """One facet per key width that was timed at most sizes, random order; None if nothing was."""
    sizes_of: dict[int, set[int]] = {}
    for row in result.timed(order="random"):
        sizes_of.setdefault(row.bits, set()).add(row.n)
    most = max(map(len, sizes_of.values()), default=0)
    shown = sorted(bits for bits, met in sizes_of.items() if len(met) == most or len(met) > 1)
    if not shown:
        return None
    figure, axes = _facets(len(shown))
    for ax, bits in zip(axes, shown, strict=False):
        rows = result.timed(order="random", bits=bits)
        for sort, look in _looks(result).items():
            _line(ax, sort, look, [row for row in rows if row.sort == sort])
        sizes = sorted({row.n for row in result.rows if row.order == "random"})
        _size_axis(ax, sizes)
        _rate_axis(ax)
        ax.set_title(f"{bits}-bit keys")
        _say_wrong(ax, [r for r in result.wrong if r.bits == bits and r.order == "random"])
    axes[0].set_ylabel("10⁹ pairs a second")
    _finish(
        figure,
        axes,
        result,
        "Sorting pairs (32-bit key, 32-bit value), random order; higher is better\n"
        "lines: median of the rounds; bands: slowest to fastest round",
    )
    return figure


def draw_by_bits(result: SortResult) -> Figure | None:
    """The largest size that was timed at most widths, random order; None if there is but one."""
    widths_of: dict[int, set[int]] = {}
    for row in result.timed(order="random"):
        widths_of.setdefault(row.n, set()).add(row.bits)
    most = max(map(len, widths_of.values()), default=0)
    if most < 2:
        return None
    size = max(n for n, met in widths_of.items() if len(met) == most)
    figure, axes = _facets(1)
    ax = axes[0]
    rows = sorted(result.timed(order="random", n=size), key=lambda row: row.bits)
    for sort, look in _looks(result).items():
        _line(ax, sort, look, [row for row in rows if row.sort == sort], lambda row: row.bits)
    ax.xaxis.set_major_locator(FixedLocator(sorted(widths_of[size])))
    ax.set_xlabel("bits of the key")
    _rate_axis(ax)
    _say_wrong(ax, [r for r in result.wrong if r.n == size and r.order == "random"])
    ax.set_ylabel("10⁹ pairs a second")
    _finish(
        figure,
        axes,
        result,
        f"Sorting {_power(size)} pairs (32-bit key, 32-bit value) by the width of the key, random "
        "order; higher is better\nlines: median of the rounds; bands: slowest to fastest round",
    )
    return figure


def draw_by_order(result: SortResult) -> Figure | None:
    """The largest size that was timed in several orders, one facet per key width."""
    orders: dict[tuple[int, int], set[str]] = {}
    for row in result.timed():
        orders.setdefault((row.n, row.bits), set()).add(row.order)
    several = {place for place, met in orders.items() if len(met) > 1}
    if not several:
        return None
    largest = max(n for n, _ in several)
    shown = sorted(bits for n, bits in several if n == largest)
    figure, axes = _facets(len(shown))
    for ax, bits in zip(axes, shown, strict=False):
        rows = result.timed(n=largest, bits=bits)
        met = list(dict.fromkeys([o for o in ORDERS if o in orders[largest, bits]]))
        _order_marks(ax, result, rows, met)
        _rate_axis(ax)
        ax.set_title(f"{bits}-bit keys")
        _say_wrong(ax, [r for r in result.wrong if r.bits == bits and r.n == largest])
    axes[0].set_ylabel("10⁹ pairs a second")
    _finish(
        figure,
        axes,
        result,
        f"Sorting {_power(largest)} pairs (32-bit key, 32-bit value) by the order they come in; "
        "higher is better\nmarks: median of the rounds; bars: slowest to fastest round",
    )
    return figure


def _facets(count: int) -> tuple[Figure, list[Axes]]:
    """At most four in a row; the legend goes below."""
    columns = min(count, _COLUMNS)
    rows = -(-count // columns)
    figure, grid = plt.subplots(
        rows,
        columns,
        figsize=(max(12.5, 4.1 * columns), 3.7 * rows + 1.9),
        squeeze=False,
        sharey=True,
        layout="constrained",
    )
    axes = list(grid.flat)
    for unused in axes[count:]:
        unused.set_visible(False)
    for row in grid[1:]:
        row[0].set_ylabel("10⁹ pairs a second")
    return figure, axes[:count]


def _line(
    ax: Axes,
    sort: Sort,
    look: _Look,
    rows: list[SortRow],
    place: Callable[[SortRow], int] = lambda row: row.n,
) -> None:
    if not rows:
        return
    places = [place(row) for row in rows]
    ax.fill_between(
        places,
        [min(row.rates) for row in rows],
        [max(row.rates) for row in rows],
        color=look.colour,
        alpha=0.15,
        linewidth=0,
    )
    ax.plot(
        places,
        [median(row.rates) for row in rows],
        color=look.colour,
        linestyle=look.line,
        marker=look.marker,
        markerfacecolor=_face(sort, look),
        markersize=6,
        linewidth=1.8,
    )


def _order_marks(ax: Axes, result: SortResult, rows: list[SortRow], orders: list[str]) -> None:
    looks = _looks(result)
    step = 0.8 / len(looks)
    for index, (sort, look) in enumerate(looks.items()):
        for row in (r for r in rows if r.sort == sort and r.order in orders):
            x = orders.index(row.order) - 0.4 + step * (index + 0.5)
            ax.plot([x, x], [min(row.rates), max(row.rates)], color=look.colour, linewidth=2)
            ax.plot(
                [x],
                [median(row.rates)],
                color=look.colour,
                marker=look.marker,
                markerfacecolor=_face(sort, look),
                markersize=7,
            )
    for between in range(1, len(orders)):
        ax.axvline(between - 0.5, color=style.GRID, linewidth=1)
    ax.set_xlim(-0.5, len(orders) - 0.5)
    ax.set_xticks(range(len(orders)), [order.replace("_", "\n") for order in orders])
    ax.tick_params(axis="x", length=0)
    ax.grid(axis="x", visible=False)


def _power(n: int) -> str:
    """Sizes of the presets are powers of two."""
    exponent = n.bit_length() - 1
    if n != 1 << exponent:
        return words.grouped(n)
    return f"2{str(exponent).translate(str.maketrans('0123456789', '⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


def _size_axis(ax: Axes, sizes: list[int]) -> None:
    ax.set_xscale("log")
    ax.set_xlim(sizes[0] / 1.5, sizes[-1] * 1.5)
    ax.xaxis.set_major_locator(FixedLocator(sizes))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: _power(round(x))))
    ax.set_xlabel("pairs")


def _rate_axis(ax: Axes) -> None:
    ax.set_yscale("log")
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.yaxis.set_major_formatter(FuncFormatter(words.tick))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.yaxis.set_minor_locator(NullLocator())
    ax.tick_params(axis="y", labelleft=True)


def _say_wrong(ax: Axes, rows: list[SortRow]) -> None:
    """A wrong answer has no place on the axes; its name stands in red above them."""
    if rows:
        sorts = dict.fromkeys(TITLES.get(r.sort.algorithm, r.sort.algorithm) for r in rows)
        text = "WRONG: " + ", ".join(sorts)
        ax.text(0.5, 0.02, text, transform=ax.transAxes, ha="center", color=style.VERMILLION)


def _finish(figure: Figure, axes: list[Axes], result: SortResult, title: str) -> None:
    """Title, key, and what must be known when the figure travels alone."""
    figure.suptitle(title, x=0.01, ha="left", fontsize=12.5)
    handles = []
    for sort, look in _looks(result).items():
        if not any(row.sort == sort for row in result.timed()):
            continue
        handles += axes[0].plot(
            [],
            [],
            color=look.colour,
            linestyle=look.line,
            marker=look.marker,
            markerfacecolor=_face(sort, look),
            label=look.label,
        )
    figure.legend(handles=handles, loc="outside lower left", ncols=4, title=_footnote(result))
    figure.legends[0].get_title().set_fontsize(10)
    figure.legends[0].get_title().set_color(style.FAINT)
    figure.legends[0].set_alignment("left")


def _footnote(result: SortResult) -> str:
    context = result.context
    commit = context["commit"][:12] + (", uncommitted changes" if context["dirty"] else "")
    unfinished = "" if context["finished"] else "; INTERRUPTED: not all rows were run"
    skips: dict[str, dict[str, None]] = {}
    for row in result.rows:
        if row.status == "skipped":
            title = TITLES.get(row.sort.algorithm, row.sort.algorithm)
            skips.setdefault(row.reason or "", {})[title] = None
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
