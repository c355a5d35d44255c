# SPDX-License-Identifier: MIT
"""Who is exact where: implementations down, scenes and sizes across."""

from __future__ import annotations

import textwrap
from typing import NamedTuple

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from octocell_report import style, tables, words
from octocell_report.load import Group, Impl, Place, Result
from octocell_report.style import Look
from octocell_report.tables import Cell

_HEADING = 12.5  # points
_LETTER = 0.72 / 72  # inches, of the widest bold letters, for one point of height
_BAND = 12  # columns side by side; more go into a band below, or the text gets too small
_WIDE_BAND = 8  # the same where a single column has a long name
_LONG = 9  # letters

# fill, ink, what it means
STATES = {
    "exact": (style.EXACT_FILL, style.INK, "exact: the very same pairs as the truth"),
    "wrong": (style.VERMILLION, "white", f"wrong: {words.MINUS}missed +false ×duplicates"),
    "negative_control": (
        "#fbe3c0",
        "#7a3a00",
        "negative control: a wrong rule, kept to show what it loses",
    ),
    "skipped": ("#e4e6e9", "#4b535b", "skipped"),
    "unavailable": ("#f4f5f6", "#4b535b", "scene not there"),
    "absent": ("white", style.INK, "not in this run"),
}


def draw(result: Result, looks: dict[Impl, Look]) -> Figure | None:
    impls, cells = result.impls, tables.correctness(result)
    if not impls:
        return None
    bands = _bands(result)
    columns = max(len(band) for band in bands)
    width = min(1.6, max(0.9, 11.0 / columns))  # inches a column: few are wide, for their names
    headings = [_headings(band, width) for band in bands]
    height = 0.43 * len(impls) + 1.0
    figure, axes = plt.subplots(
        len(bands),
        1,
        figsize=(3.7 + width * max(columns, 3), height * len(bands) + 1.2),
        squeeze=False,
        layout="constrained",
    )
    size = min(_HEADING, *(heading.fitting for band in headings for heading in band))
    for ax, band, above in zip(axes[:, 0], bands, headings, strict=True):
        _matrix(ax, looks, impls, band, cells, columns)
        for heading in above:
            _write(ax, heading, len(impls), size)
    met = {cell.state for cell in cells.values()}
    handles = [
        Patch(facecolor=fill, edgecolor=style.FAINT, linewidth=0.5, label=meaning)
        for state, (fill, _, meaning) in STATES.items()
        if state in met
    ]
    figure.suptitle("Pairs against the truth, over all runs", x=0.01, ha="left", fontsize=14)
    figure.legend(handles=handles, loc="outside lower left", ncols=2)
    return figure


def _bands(result: Result) -> list[list[Group]]:
    """Groups in rows of as many as have room, a scene kept together where it fits."""
    bands: list[list[Group]] = [[]]
    most = _WIDE_BAND if _has_long_name(result) else _BAND
    for scene in result.scenes:
        groups = sorted((g for g in result.groups if g.scene == scene), key=lambda g: g.n)
        if bands[-1] and len(bands[-1]) + len(groups) > most:
            bands.append([])
        for group in groups:
            if len(bands[-1]) == most:
                bands.append([])
            bands[-1].append(group)
    return bands


def _has_long_name(result: Result) -> bool:
    single = [scene for scene in result.scenes if sum(g.scene == scene for g in result.groups) == 1]
    return any(len(line) >= _LONG for scene in single for line in _lines(scene, _LONG))


def _matrix(
    ax: Axes,
    looks: dict[Impl, Look],
    impls: list[Impl],
    band: list[Group],
    cells: dict[tuple[Impl, Place], Cell],
    columns: int,
) -> None:
    for x, group in enumerate(band):
        for y, impl in enumerate(impls):
            _cell(ax, x, y, cells[impl, group.place])
        size = words.NONE if group.unavailable is not None else words.size(group.n)
        ax.text(x + 0.5, -0.12, size, ha="center", va="bottom", fontsize=11)
    ax.set_xlim(0, columns)
    ax.set_ylim(len(impls), -1.3)
    ax.set_xticks([])
    ax.set_yticks([y + 0.5 for y in range(len(impls))], [looks[impl].label for impl in impls])
    ax.tick_params(axis="y", length=0)
    ax.grid(visible=False)
    for spine in ax.spines.values():
        spine.set_visible(False)


class _Heading(NamedTuple):
    """The name of a scene over its first column."""

    column: int
    lines: list[str]
    fitting: float  # the largest type, in points, for which its columns have room


def _headings(band: list[Group], width: float) -> list[_Heading]:
    found = []
    for x, group in enumerate(band):
        if x == 0 or band[x - 1].scene != group.scene:
            room = width * sum(other.scene == group.scene for other in band)
            lines = _lines(group.scene, int(room / (_LETTER * _HEADING)))
            found.append(_Heading(x, lines, room / (_LETTER * max(map(len, lines)))))
    return found


def _lines(scene: str, letters: int) -> list[str]:
    """Parameters, or the latter half of the words, stand on a second line where one is too long."""
    if len(scene) <= letters:
        return [scene]
    name, bracket, parameters = scene.partition("(")
    if bracket:
        return [name, bracket + parameters]
    breaks = [place + 1 for place, letter in enumerate(scene) if letter == "_"]
    middle = min(breaks, key=lambda place: abs(2 * place - len(scene)), default=len(scene))
    return [line for line in (scene[:middle], scene[middle:]) if line]


def _write(ax: Axes, heading: _Heading, rows: int, size: float) -> None:
    x, name = heading.column, "\n".join(heading.lines)
    ax.text(x + 0.06, -0.72, name, va="bottom", weight="bold", fontsize=size, linespacing=1.0)
    ax.plot([x, x], [-1.3, rows], color=style.INK, linewidth=1.4, clip_on=False)


def _cell(ax: Axes, x: int, y: int, cell: Cell) -> None:
    fill, ink, _ = STATES[cell.state]
    ax.add_patch(Rectangle((x, y), 1, 1, facecolor=fill, edgecolor="white", linewidth=1.5))
    text = cell.text
    if cell.state == "skipped":
        text = "\n".join(textwrap.wrap(text, 12, max_lines=2, placeholder="…"))
    elif len(text) > 9:
        text = text.replace(" +", "\n+", 1)
    ax.text(
        x + 0.5,
        y + 0.5,
        text,
        ha="center",
        va="center",
        color=ink,
        linespacing=1.0,
        fontsize=9 if "\n" in text else 10,
        weight="bold" if cell.state == "wrong" else "normal",
    )
