# SPDX-License-Identifier: MIT
"""Time against how bad the worst pair is: a miss by rounding and one of deep overlap differ."""

from __future__ import annotations

from matplotlib.figure import Figure

from octocell_report.error import Point, Study
from octocell_report.plots import butterfly
from octocell_report.plots.butterfly import Butterfly, Side

TIE = 1e-9  # what is nearer to touching than float32 can tell is drawn here, ties among it
FAR = 10.0  # and what is wider than this; radii of 0 have any gap


def draw(study: Study) -> Figure | None:
    return butterfly.draw(
        study,
        Butterfly(
            title="How bad the worst pair is: deepest overlap lost, widest gap invented",
            up=Side(_depth, "deepest pair lost / (rᵢ + rⱼ)"),
            down=Side(_gap, "widest gap invented / (rᵢ + rⱼ)"),
            tick=_tick,
            floor=TIE,
            ceiling=FAR,
        ),
    )


def _depth(point: Point) -> float | None:
    return point.depth if point.missed else None


def _gap(point: Point) -> float | None:
    return point.gap if point.false else None


def _tick(value: float) -> str:
    """A share of the sum of the radii: per cent where that reads well."""
    if value <= TIE * 1.01:
        return "≤ 1e-9"
    if value >= FAR:
        return "≥ 10"
    return f"{value:g}" if value >= 0.01 else f"{value:.0e}".replace("e-0", "e-")
