# SPDX-License-Identifier: MIT
"""Who is wrong where: what each implementation that errs loses and invents, scene by scene."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from octocell_report import style, words
from octocell_report.load import Result
from octocell_report.style import Look

_ACROSS = 9  # scenes side by side; more go into a band below
_WIDTH, _HEIGHT = 1.0, 0.44  # inches, of a cell
_FILLS = {  # and inks
    "wrong": (style.VERMILLION, "white"),
    "control": ("#fbe3c0", "#7a3a00"),
    "exact": (style.EXACT_FILL, style.INK),
    "": ("#eceef0", style.INK),  # not run here
}


def draw(result: Result, looks: dict[str, Look]) -> Figure | None:
    """Those that err on scenes where any does, and one line for all others; None if none errs."""
    frame = result.frame
    wrong = frame[frame["status"] == "wrong"]
    if wrong.empty:
        return None
    scenes = [scene for scene in result.scenes if (wrong["scene"] == scene).any()]
    bands = [scenes[at : at + _ACROSS] for at in range(0, len(scenes), _ACROSS)]
    impls = [label for label in looks if (wrong["label"] == label).any()]
    lines = len(impls) + 1
    figure, axes = plt.subplots(
        len(bands),
        1,
        squeeze=False,
        layout="constrained",
        figsize=(4.2 + _WIDTH * len(bands[0]), len(bands) * _HEIGHT * (lines + 2) + 0.4),
    )
    for ax, band in zip(axes[:, 0], bands, strict=True):
        for y, impl in enumerate(impls):
            of_impl = frame[frame["label"] == impl]
            for x, scene in enumerate(band):
                _cell(ax, x, y, 1, *_state(of_impl[of_impl["scene"] == scene]))
        others = len(looks) - len(impls)
        _cell(ax, 0, len(impls), len(band), "exact", "exact wherever they ran" if others else "")
        names = [*(looks[impl].label for impl in impls), f"{others} others"]
        _frame(ax, band, names, len(bands[0]))
    figure.suptitle(
        f"Wrong answers: {words.MINUS}missed +invented ×twice, the worst of each scene's sizes",
        x=0.01,
        ha="left",
        fontsize=12.5,
    )
    return figure


def _state(rows: pd.DataFrame) -> tuple[str, str]:
    """The kind of the cell, and its text."""
    wrong = rows[rows["status"] == "wrong"]
    if wrong.empty:
        return ("exact", "exact") if rows["ran"].any() else ("", "")
    lost = wrong[["missed", "false", "duplicates"]].fillna(0).sum(axis=1)
    worst = wrong.loc[lost.idxmax()]
    kind = "control" if worst["negative_control"] else "wrong"
    return kind, f"{words.losses(worst)}\n{words.size(worst['n'])}"


def _cell(ax: Axes, x: int, y: int, width: int, kind: str, text: str) -> None:
    fill, ink = _FILLS[kind]
    ax.add_patch(Rectangle((x, y), width, 1, facecolor=fill, edgecolor="white", linewidth=1.5))
    look: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 9, "linespacing": 1.05}
    ax.text(x + width / 2, y + 0.5, text, color=ink, **look)


def _frame(ax: Axes, scenes: list[str], names: list[str], columns: int) -> None:
    ax.set(xlim=(0, columns), ylim=(len(names), 0))
    ax.set_xticks([x + 0.5 for x in range(len(scenes))], [s.replace("(", "\n(") for s in scenes])
    ax.set_yticks([y + 0.5 for y in range(len(names))], names)
    ax.tick_params(length=0, labeltop=True, labelbottom=False)
    ax.grid(visible=False)
    ax.spines[:].set_visible(False)
