# SPDX-License-Identifier: MIT
"""What the marks of the error study mean: shapes, colours, and predicates in words."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from octocell_report import style
from octocell_report.error import Series, Study
from octocell_report.predicates import MEANINGS


class Frame(NamedTuple):
    """A figure's size, and the margins left of and below its facets; in inches."""

    width: float
    height: float
    left: float
    bottom: float


def looks(study: Study) -> dict[Series, tuple[str, Any]]:
    """Colour by predicate, marker by backend or library; the same in all plots of the study."""
    owners = list(dict.fromkeys(owner_of(series) for series in study.series))
    markers = {owner: style.owner_marker(owner, index) for index, owner in enumerate(owners)}
    return {s: (style.predicate_colour(s.predicate), markers[owner_of(s)]) for s in study.series}


def owner_of(series: Series) -> str:
    return series.backend if series.predicate else series.lane


def draw(figure: Figure, study: Study, title: str, frame: Frame) -> None:
    """Title above, axis and meanings below, in the margins of the frame."""
    figure.text(0.012, 1 - 0.14 / frame.height, title, fontsize=15, weight="bold", va="top")
    figure.text(
        0.012,
        1 - 0.48 / frame.height,
        "Left is faster; the further from the green strip, the worse; in it nothing is wrong. "
        "Bold: worst error, median time of the scenes; pale: single scenes.",
        fontsize=11,
        va="top",
    )
    left = frame.left / frame.width
    figure.text(
        left + (1 - left) / 2,
        (frame.bottom - 0.32) / frame.height,
        "time per sphere [ns] of the whole search, logarithmic; dashed: the fastest that is exact; "
        "lines join backends with the same test",
        ha="center",
        va="top",
    )
    _markers(figure, study, frame)
    _meanings(figure, study, frame)


def _markers(figure: Figure, study: Study, frame: Frame) -> None:
    met = {owner_of(series): look[1] for series, look in looks(study).items()}
    handles = [
        Line2D(
            [], [], color=style.FAINT, marker=marker, linestyle="none", markersize=9.5, label=owner
        )
        for owner, marker in met.items()
    ]
    figure.legend(
        handles=handles,
        loc="upper left",
        bbox_to_anchor=(0.005, (frame.bottom - 0.62) / frame.height),
        ncols=len(handles),
        columnspacing=1.6,
        handletextpad=0.3,
    )


def _meanings(figure: Figure, study: Study, frame: Frame) -> None:
    """What the predicates are, in columns."""
    predicates = study.predicates
    columns = max(1, round(frame.width / 4.9))
    lines = math.ceil(len(predicates) / columns)
    for number, predicate in enumerate(predicates):
        column, line = divmod(number, lines)
        note = figure.text(
            0.012 + column / columns * 0.985,
            (frame.bottom - 1.22 - 0.24 * line) / frame.height,
            predicate,
            color=style.dark(style.predicate_colour(predicate)),
            weight="bold",
            fontsize=10,
            va="top",
        )
        box = note.get_window_extent(figure.canvas.get_renderer())  # type: ignore[attr-defined]
        figure.text(
            (box.x1 + 6) / figure.bbox.width,
            (frame.bottom - 1.22 - 0.24 * line) / frame.height,
            MEANINGS[predicate],
            fontsize=10,
            va="top",
        )
