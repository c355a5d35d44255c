# SPDX-License-Identifier: MIT
"""How things look: one colour per backend (Okabe and Ito), one marker per implementation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.patheffects as effects
from matplotlib.colors import to_hex, to_rgb

from octocell_report import words
from octocell_report.load import Impl, Result

BLUE, VERMILLION, ORANGE, PURPLE = "#0072B2", "#D55E00", "#E69F00", "#CC79A7"
YELLOW, GREEN, SKY, BLACK = "#F0E442", "#009E73", "#56B4E9", "#000000"
GREY, WINE = "#999999", "#882255"  # not theirs; for a ninth and a tenth backend
INK, FAINT, GRID = "#1f2328", "#6a737d", "#e3e6ea"
EXACT_FILL, NO_ERROR_FILL = "#cfe6f5", "#eaf4ee"  # behind what is exact; what has no error

# Ours look the same in every report; the others share what is left.
_OURS = {
    "impl_cpu": BLUE,
    "impl_thrust": VERMILLION,
    "impl_cuda_custom": GREEN,
    "impl_thrust_cuda": ORANGE,
}
_COLOURS = (BLUE, VERMILLION, ORANGE, PURPLE, YELLOW, GREEN, SKY, BLACK, GREY, WINE)
_MARKERS = (
    "o",
    "s",
    "D",
    "^",
    "v",
    "P",
    "<",
    ">",
    "X",
    "p",
    "h",
    "d",
    "*",
    "8",
    "H",
    (4, 1, 0),
    (6, 1, 0),
)
_LINES = (
    "-",
    (0, (5, 1.5)),
    (0, (1.2, 1.2)),
    (0, (6, 1.5, 1.2, 1.5)),
    (0, (9, 2)),
    (0, (6, 1.5, 1.2, 1.5, 1.2, 1.5)),
)
_SHADES = (0.0, 0.45, 0.7, 0.25, 0.58, 0.13)  # towards black, by variant of one backend

_STAGES = {
    "bounds": SKY,
    "cell_ids": ORANGE,
    "sort": GREEN,
    "cell_index": YELLOW,
    "pair_tests": BLUE,
    "resolve": VERMILLION,
    "build": PURPLE,
    "update": BLACK,
    "query": GREY,
}

DPI = 144

RC: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 11.5,
    "axes.titlesize": 14,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.edgecolor": FAINT,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.8,
    "text.color": INK,
    "text.parse_math": False,  # names come from data: a dollar sign in one is a dollar sign
    "xtick.color": INK,
    "ytick.color": INK,
    "legend.frameon": False,
    "legend.fontsize": 11,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "hatch.linewidth": 0.6,
    "svg.hashsalt": "octocell",  # ids in SVG files: the same in every run
}


@dataclass(frozen=True)
class Look:
    label: str
    colour: str
    marker: Any
    line: Any

    @property
    def outline(self) -> list[Any]:
        """A dark rim where the colour alone is too light on white."""
        if luminance(self.colour) < 0.6:
            return []
        return [effects.Stroke(linewidth=3.4, foreground="#7a7300"), effects.Normal()]

    @property
    def edge(self) -> str:
        return "#7a7300" if luminance(self.colour) > 0.6 else self.colour

    @property
    def ink(self) -> str:
        return dark(self.colour)


def looks(result: Result) -> dict[Impl, Look]:
    """The same for one implementation in every plot of one report."""
    titles = words.titles(result)
    backends = list(dict.fromkeys(impl.backend for impl in result.impls))
    bases = _bases(backends)
    met: dict[str, int] = dict.fromkeys(backends, 0)
    found = {}
    for index, impl in enumerate(result.impls):
        variant, met[impl.backend] = met[impl.backend], met[impl.backend] + 1
        turn, base = bases[impl.backend]
        found[impl] = Look(
            label=titles[impl],
            colour=darker(base, _SHADES[variant % len(_SHADES)]),
            marker=_MARKERS[index % len(_MARKERS)],
            line=_LINES[(variant + turn) % len(_LINES)],
        )
    return found


def _bases(backends: list[str]) -> dict[str, tuple[int, str]]:
    """By backend: its colour, and how often the colours were used up before it came."""
    ours = {backend: (0, _OURS[backend]) for backend in backends if backend in _OURS}
    left = [colour for colour in _COLOURS if all(colour != own for _, own in ours.values())]
    others = [backend for backend in backends if backend not in ours]
    turns = {b: divmod(index, len(left)) for index, b in enumerate(others)}
    return ours | {b: (turn, left[place]) for b, (turn, place) in turns.items()}


def darker(colour: str, by: float) -> str:
    """0 leaves the colour, 1 is black."""
    red, green, blue = to_rgb(colour)
    return str(to_hex((red * (1 - by), green * (1 - by), blue * (1 - by))))


def luminance(colour: str) -> float:
    """0 black .. 1 white, as the eye weighs it."""
    red, green, blue = to_rgb(colour)
    return float(0.2126 * red**2.2 + 0.7152 * green**2.2 + 0.0722 * blue**2.2)


def ink_on(colour: str) -> str:
    return INK if luminance(colour) > 0.25 else "white"


def stage_colour(stage: str) -> str:
    return _STAGES.get(stage, FAINT)


# How a pair is tested. Exact is the one dark colour, libraries are black.
_PREDICATES = {
    "exact": BLUE,
    "q16_exact": SKY,
    "f64": PURPLE,
    "f32": ORANGE,
    "f32_sqrt": YELLOW,
    "q16_cell": GREEN,
    "gram_f32": VERMILLION,
    "f16_cell": WINE,
    "aabb_only": GREY,
}
_OWNERS = {
    "impl_cpu": "o",
    "impl_thrust": "s",
    "impl_cuda_custom": "D",
    "impl_thrust_cuda": "p",
    "FCL": "^",
    "Bullet": "v",
}


def predicate_colour(predicate: str | None) -> str:
    """Black for libraries, by their names or None: they come as they are."""
    return _PREDICATES.get(predicate or "", BLACK)


def owner_marker(owner: str, index: int) -> Any:
    """Of a backend of ours, or of a library; others by their place in the table."""
    return _OWNERS.get(owner, _MARKERS[index % len(_MARKERS)])


def dark(colour: str) -> str:
    """As dark as small text needs it on white."""
    by = 0.0
    while luminance(darker(colour, by)) > 0.15:
        by += 0.05
    return darker(colour, by)
