# SPDX-License-Identifier: MIT
"""How things look: one colour per backend (Okabe and Ito), one marker per implementation."""

from collections import Counter
from dataclasses import dataclass
from itertools import cycle
from typing import Any

import matplotlib

matplotlib.use("Agg")

from matplotlib.colors import to_hex, to_rgb
from matplotlib.lines import Line2D

from octocell_report import words
from octocell_report.load import STAGES, Result
from octocell_report.predicates import PREDICATES

BLUE, VERMILLION, ORANGE, PURPLE = "#0072B2", "#D55E00", "#E69F00", "#CC79A7"
YELLOW, GREEN, SKY, BLACK = "#F0E442", "#009E73", "#56B4E9", "#000000"
GREY, WINE = "#999999", "#882255"  # not theirs
INK, FAINT, GRID = "#1f2328", "#6a737d", "#e3e6ea"
EXACT_FILL, NO_ERROR_FILL = "#cfe6f5", "#eaf4ee"  # behind what is exact; what has no error
APART_FILL = "#f1f2f4"  # behind what is apart from the rest: warm-up frames, slower than 1
FONT, DPI, SMALL = "DejaVu Sans", 144, 9.5  # SMALL: points, of numbers beside marks

# Ours look the same in every report; the others share what is left. Yellow lines are too pale.
_BACKENDS = ("impl_cpu", "impl_thrust", "impl_cuda_custom", "impl_thrust_cuda")
_OURS = dict(zip(_BACKENDS, (BLUE, VERMILLION, GREEN, ORANGE), strict=True))
_OWNERS = dict(zip((*_BACKENDS, "FCL", "Bullet"), "osDp^v", strict=True))
COLOURS = (BLUE, VERMILLION, ORANGE, PURPLE, GREEN, BLACK, SKY, GREY, WINE)
MARKERS = (*"osD^vP<>Xphd*8H", (4, 1, 0), (6, 1, 0))
_DASHES = ((5, 1.5), (1.2, 1.2), (6, 1.5, 1.2, 1.5), (9, 2), (6, 1.5, 1.2, 1.5, 1.2, 1.5))
_LINES = ("-", *((0, dashes) for dashes in _DASHES))
_SHADES = (0.0, 0.45, 0.7, 0.25, 0.58, 0.13)  # towards black, by variant of one backend

_STAGE_COLOURS = (SKY, ORANGE, GREEN, YELLOW, BLUE, VERMILLION, PURPLE, BLACK, GREY)
_STAGES = dict(zip(STAGES, _STAGE_COLOURS, strict=True))
# How a pair is tested. Exact is the one dark colour, libraries are black.
_TEST_COLOURS = (BLUE, SKY, PURPLE, ORANGE, YELLOW, GREEN, VERMILLION, WINE, GREY)
_PREDICATES = dict(zip(PREDICATES, _TEST_COLOURS, strict=True))

RC: dict[str, Any] = {
    **{"font.family": FONT, "font.size": 11},
    **{"axes.titlesize": 12.5, "axes.titleweight": "bold", "axes.titlelocation": "left"},
    **{"axes.spines.top": False, "axes.spines.right": False},
    **{"axes.edgecolor": FAINT, "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK},
    **{"axes.grid": True, "axes.axisbelow": True, "grid.color": GRID, "grid.linewidth": 0.8},
    **{"lines.linewidth": 2, "lines.markersize": 6.5, "hatch.linewidth": 0.6},
    **{"legend.frameon": False, "legend.fontsize": 10.5, "figure.titlesize": 12.5},
    **{"figure.facecolor": "white", "savefig.facecolor": "white", "text.color": INK},
    "text.parse_math": False,  # names come from data: a dollar sign in one is a dollar sign
    "svg.fonttype": "none",  # letters stay text
    "svg.hashsalt": "octocell",  # ids in SVG files: the same in every run
}


@dataclass(frozen=True)
class Look:
    label: str
    colour: str
    marker: Any
    line: Any = "-"
    hollow: bool = False

    @property
    def dot(self) -> dict[str, Any]:
        """Its marker, as Matplotlib takes it."""
        face = "white" if self.hollow else self.colour
        return {"color": self.colour, "marker": self.marker, "markerfacecolor": face}

    @property
    def shape(self) -> dict[str, Any]:
        """Its line with markers."""
        return self.dot | {"linestyle": self.line}

    @property
    def entry(self) -> Line2D:
        """Its entry in a key."""
        return Line2D([], [], label=self.label, **self.shape)


def looks(result: Result) -> dict[str, Look]:
    """By label, in table order: the same for one implementation in every plot of one report."""
    impls = result.frame.drop_duplicates("label").sort_values("order")
    titles, backends = words.titles(result), impls["backend"].unique()
    left = cycle(c for c in COLOURS if c not in {_OURS.get(backend) for backend in backends})
    bases = {backend: _OURS.get(backend) or next(left) for backend in backends}
    met: Counter[str] = Counter()
    found = {}
    for index, (backend, label) in enumerate(zip(impls["backend"], impls["label"], strict=True)):
        base = bases[backend]
        shade = _SHADES[met[backend] % len(_SHADES)]
        line = _LINES[met[base] % len(_LINES)]
        marker = MARKERS[index % len(MARKERS)]
        found[label] = Look(titles[label], darker(base, shade), marker, line)
        met.update((backend, base))
    return found


def darker(colour: str, by: float) -> str:
    """0 leaves the colour, 1 is black."""
    red, green, blue = (part * (1 - by) for part in to_rgb(colour))
    return str(to_hex((red, green, blue)))


def luminance(colour: str) -> float:
    """0 black .. 1 white, as the eye weighs it."""
    red, green, blue = to_rgb(colour)
    return float(0.2126 * red**2.2 + 0.7152 * green**2.2 + 0.0722 * blue**2.2)


def ink_on(colour: str) -> str:
    return INK if luminance(colour) > 0.25 else "white"


def dark(colour: str) -> str:
    """As dark as small text needs it on white."""
    while luminance(colour) > 0.15:
        colour = darker(colour, 0.05)
    return colour


def stage_colour(stage: str) -> str:
    return _STAGES.get(stage, FAINT)


def predicate_colour(predicate: str | None) -> str:
    """Black for libraries, by their names or None: they come as they are."""
    return _PREDICATES.get(predicate or "", BLACK)


def owner_marker(owner: str, index: int) -> Any:
    """Of a backend of ours, or of a library; others by their place in the table."""
    return _OWNERS.get(owner, MARKERS[index % len(MARKERS)])
