# SPDX-License-Identifier: MIT
"""Who is wrong where: what each implementation that errs loses and invents, scene by scene."""

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from octocell_report import style, words
from octocell_report.load import Result
from octocell_report.plots import facets
from octocell_report.style import Look

_ACROSS = 9  # scenes side by side; more go into a band below
_CONTROL_FILL, _NOT_RUN_FILL = "#fbe3c0", "#eceef0"


def draw(result: Result, looks: dict[str, Look]) -> Figure | None:
    """Those that err on scenes where any does, and one line for all others; None if none errs."""
    frame = result.frame
    wrong = frame[frame["status"] == "wrong"]
    if wrong.empty:
        return None
    scenes = [scene for scene in result.scenes if (wrong["scene"] == scene).any()]
    bands = [scenes[at : at + _ACROSS] for at in range(0, len(scenes), _ACROSS)]
    lines = {look.label: [label] for label, look in looks.items() if label in set(wrong["label"])}
    others = set(looks) - set(wrong["label"])
    lines |= {f"{len(others)} others": [*others]} if others else {}
    figure, axes = facets.grid(
        facets.caption("correctness"),
        [""] * len(bands),
        [len(lines)] * len(bands),
        each=1.6,
    )
    for ax, band in zip(axes, bands, strict=True):
        facets.table(ax, band, list(lines))
        ax.set_xlim(-0.5, max(len(bands[0]), _ACROSS // 2) - 0.5)
        for x, scene in enumerate(band):
            for y, labels in enumerate(lines.values()):
                here = frame["label"].isin(labels) & (frame["scene"] == scene)
                _cell(ax, x, y, frame[here])
    return figure


def _cell(ax: Axes, x: int, y: int, rows: pd.DataFrame) -> None:
    wrong = rows[rows["status"] == "wrong"]
    if wrong.empty:
        ran = rows["ran"].any()
        facets.cell(ax, x, y, "exact" if ran else "", style.EXACT_FILL if ran else _NOT_RUN_FILL)
        return
    worst = wrong.loc[wrong["errors"].idxmax()]
    fill = _CONTROL_FILL if worst["negative_control"] else style.VERMILLION
    text = f"{words.losses(worst)}\n{words.size(worst['n'])}"
    facets.cell(ax, x, y, text, fill, fontsize=8.5)
