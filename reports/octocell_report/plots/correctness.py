# SPDX-License-Identifier: MIT
"""Who is exact where: implementations down, scenes and sizes across."""

from __future__ import annotations

import textwrap

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from octocell_report import style, tables, words
from octocell_report.load import Group, Impl, Place, Result
from octocell_report.style import Look
from octocell_report.tables import Cell

_BAND = 12  # columns side by side; more go into a band below, or the text gets too small

# fill, ink, what it means
STATES = {
    "exact": (style.EXACT_FILL, style.INK, "exact: the very same pairs as the truth"),
    "wrong": (style.VERMILLION, "white", f"wrong: {words.MINUS}missed +false ×duplicates"),
    "exhibit": ("#fbe3c0", "#7a3a00", "exhibit: a wrong rule, kept to show what it loses"),
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
    height = 0.43 * len(impls) + 1.0
    figure, axes = plt.subplots(
        len(bands),
        1,
        figsize=(3.7 + 0.9 * max(columns, 4), height * len(bands) + 1.2),
        squeeze=False,
        layout="constrained",
    )
    for ax, band in zip(axes[:, 0], bands, strict=True):
        _matrix(ax, looks, impls, band, cells, columns)
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
    """Groups in rows of at most _BAND, a scene kept together where it fits."""
    bands: list[list[Group]] = [[]]
    for scene in result.scenes:
        groups = sorted((g for g in result.groups if g.scene == scene), key=lambda g: g.n)
        if bands[-1] and len(bands[-1]) + len(groups) > _BAND:
            bands.append([])
        for group in groups:
            if len(bands[-1]) == _BAND:
                bands.append([])
            bands[-1].append(group)
    return bands


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
        if x == 0 or band[x - 1].scene != group.scene:
            sizes = sum(other.scene == group.scene for other in band)
            ax.text(x + 0.06, -0.72, va="bottom", weight="bold", **_heading(group.scene, sizes))
            ax.plot([x, x], [-1.3, len(impls)], color=style.INK, linewidth=1.4, clip_on=False)
    ax.set_xlim(0, columns)
    ax.set_ylim(len(impls), -1.3)
    ax.set_xticks([])
    ax.set_yticks([y + 0.5 for y in range(len(impls))], [looks[impl].label for impl in impls])
    ax.tick_params(axis="y", length=0)
    ax.grid(visible=False)
    for spine in ax.spines.values():
        spine.set_visible(False)


def _heading(scene: str, columns: int) -> dict[str, object]:
    """The scene's name and its size of type: on a second line, and smaller, where it must be."""
    if len(scene) <= 7 * columns:
        return {"s": scene, "fontsize": 12.5}
    name, bracket, parameters = scene.partition("(")
    lines = [name, bracket + parameters] if bracket and columns == 1 else [scene]
    size = min(10.0, 90.0 * columns / max(map(len, lines)))
    return {"s": "\n".join(lines), "fontsize": size, "linespacing": 1.0}


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
