# SPDX-License-Identifier: MIT
"""Time against how many pairs are wrong: the plot that the error study is made for."""

from __future__ import annotations

from matplotlib.figure import Figure

from octocell_report import words
from octocell_report.error import Point, Study
from octocell_report.plots import butterfly
from octocell_report.plots.butterfly import Butterfly, Side


def draw(study: Study) -> Figure | None:
    return butterfly.draw(
        study,
        Butterfly(
            title="Run time against error: what a simpler overlap test saves, and gets wrong",
            up=Side(_missed, "LOST, per million true pairs"),
            down=Side(_false, "INVENTED, per million true pairs"),
            tick=words.rate,
        ),
    )


def _missed(point: Point) -> float | None:
    return point.rate(point.missed) if point.missed else None


def _false(point: Point) -> float | None:
    return point.rate(point.false) if point.false else None
