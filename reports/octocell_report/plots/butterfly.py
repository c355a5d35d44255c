# SPDX-License-Identifier: MIT
"""Time across, what is missed upwards, what is false downwards; between them a strip without error.

One column per class of scenes. A bold mark is the worst scene of its series at the median time of
the scenes; pale marks are the single scenes.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import pandas as pd
from adjustText import adjust_text
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.text import Text

from octocell_report import style, words
from octocell_report.error import MILLION, Study
from octocell_report.plots import facets
from octocell_report.predicates import EXACT, MEANINGS
from octocell_report.style import Look

TIE = 1e-9  # what is nearer to touching than float32 can tell is drawn here, ties among it
FAR = 10.0  # and what is wider than this; radii of 0 have any gap
_KEY_COLUMNS = 3
BOLD, PALE = 9.5, 5.0  # sizes of marks
_LINES = 11  # of text that a panel has room for
_UP_OR_DOWN: dict[str, Any] = {
    **{"only_move": "y", "avoid_self": False, "explode_radius": 0, "iter_lim": 500},
    "prevent_crossings": False,  # it would swap names
}
_TIE_BREAK = 1e-3  # names that start at the very same height would move alike


@dataclass(frozen=True)
class Chart:
    title: str
    up: pd.Series[float]  # of the study's points; NaN where one has no such error
    down: pd.Series[float]
    up_label: str
    down_label: str
    tick: Callable[[float], str]


def draw_rates(study: Study) -> Figure | None:
    """How many pairs are wrong: the plot that the error study is made for."""
    missed, false = (study.points[f"{of}_per_million"] for of in ("missed", "false"))
    return _draw(
        study,
        Chart(
            "Run time against error: what a simpler overlap test saves, and gets wrong",
            missed.where(missed > 0),
            false.where(false > 0),
            "LOST, per million true pairs",
            "INVENTED, per million true pairs",
            words.rate,
        ),
    )


def draw_depths(study: Study) -> Figure | None:
    """How bad the worst pair is: a miss by rounding and one of deep overlap differ."""
    points = study.points
    return _draw(
        study,
        Chart(
            "How bad the worst pair is: deepest overlap lost, widest gap invented",
            points["worst_missed_depth"].clip(TIE, FAR).where(points["missed_per_million"] > 0),
            points["worst_false_gap"].clip(TIE, FAR).where(points["false_per_million"] > 0),
            "deepest pair lost / (rᵢ + rⱼ)",
            "widest gap invented / (rᵢ + rⱼ)",
            _share,
        ),
    )


def _share(value: float) -> str:
    """A share of the sum of the radii."""
    if value <= TIE or value >= FAR:
        return "≤ 1e-9" if value <= TIE else "≥ 10"
    return f"{value:g}" if value >= 0.01 else f"{value:.0e}".replace("e-0", "e-")


def _draw(study: Study, chart: Chart) -> Figure | None:
    """None where nothing has an error that could be shown."""
    points = study.points.assign(up=chart.up, down=chart.down)
    errors = [*chart.up.dropna(), *chart.down.dropna()]
    if not errors:
        return None
    looks, lanes = _looks(points), _lanes(points)
    classes = list(study.scenes["scene_class"].unique())
    columns = len(classes)
    figure, axes = facets.grid(
        f"{chart.title}\nleft is faster, dashed the fastest that is exact; the further from the "
        "green strip, the worse\nbold: worst error, median time of the scenes; pale: single scenes",
        [*classes, *[""] * 2 * columns],
        [lines for lines in (_LINES, len(lanes) + 2, _LINES) for _ in classes],
        columns=columns,
        key=_key(points, looks),
        key_columns=_KEY_COLUMNS,
        sharex=True,
        sharey="row",
    )
    up, strip, down = (axes[at : at + columns] for at in range(0, 3 * columns, columns))
    for at, name in enumerate(classes):
        _strip(strip[at], study, name, looks, lanes)
        _fronts(study, name, (up[at], strip[at], down[at]))
    labels = [
        _panel(ax, points[points["scene_class"] == name].assign(error=points[of]), looks)
        for panels, of in ((up, "up"), (down, "down"))
        for ax, name in zip(panels, classes, strict=True)
    ]
    _headings(study, up)
    _scales(chart, errors, up, down)
    figure.draw_without_rendering()  # labels are moved in the final layout
    figure.set_layout_engine("none")
    for ax, texts in zip((*up, *down), labels, strict=True):
        adjust_text(texts, ax=ax, **_UP_OR_DOWN)
    return figure


def _looks(points: pd.DataFrame) -> dict[str, Look]:
    """By series: colour by predicate, marker by backend or library."""
    series = points.drop_duplicates("series")
    owners = list(_owner(series).unique())
    return {
        row.series: Look(
            row.predicate or row.backend,
            style.predicate_colour(row.predicate),
            style.owner_marker(owner, owners.index(owner)),
            "none",
        )
        for row, owner in zip(series.itertuples(), _owner(series), strict=True)
    }


def _owner(points: pd.DataFrame) -> pd.Series[str]:
    return points["backend"].where(points["predicate"].notna(), points["lane"])


def _lanes(points: pd.DataFrame) -> list[str]:
    """Those that are without error on some scene, from the top."""
    met = set(points[points["errors"] == 0]["lane"])
    return [lane for lane in points["lane"].unique() if lane in met]


def _key(points: pd.DataFrame, looks: dict[str, Look]) -> list[Line2D]:
    """What shapes and colours mean."""
    owners = {o: looks[s].marker for o, s in zip(_owner(points), points["series"], strict=True)}
    shapes = [Look(owner, style.FAINT, marker, "none") for owner, marker in owners.items()]
    tests = [
        Look(f"{name}: {MEANINGS[name]}", style.predicate_colour(name), "none")
        for name in points["predicate"].dropna().unique()
    ]
    lines = max(len(shapes), -(-len(tests) // (_KEY_COLUMNS - 1)))
    blank = Look(" ", "none", "none", "none")
    first = [*shapes, *[blank] * (lines - len(shapes)), *tests]
    return [look.entry for look in (*first, *[blank] * (_KEY_COLUMNS * lines - len(first)))]


def _panel(ax: Axes, points: pd.DataFrame, looks: dict[str, Look]) -> list[Text]:
    """The marks of one class; the names of its tests, which are yet to be moved apart."""
    worst: dict[str, list[tuple[float, float]]] = {}
    for series, here in points.groupby("series", sort=False):
        look, met = looks[series], here.dropna(subset="error")
        if len(met):
            _mark(ax, look, met["ns_per_sphere"], met["error"], bold=False)
            mark = here["ns_per_sphere"].median(), met["error"].max()
            worst.setdefault(look.label, []).append(mark)
            _mark(ax, look, [mark[0]], [mark[1]], bold=True)
    for name, marks in worst.items():
        marks.sort()
        colour = style.predicate_colour(name)
        ax.plot(*zip(*marks, strict=True), color=colour, linewidth=1.3, alpha=0.5)
    ours = [marks[-1][0] for name, marks in worst.items() if name in MEANINGS]
    theirs = [marks[0][0] for name, marks in worst.items() if name not in MEANINGS]
    return [
        _label(ax, name, max(ours) if name in MEANINGS else min(theirs), marks[-1][1], index)
        for index, (name, marks) in enumerate(worst.items())
    ]


def _label(ax: Axes, name: str, x: float, y: float, index: int) -> Text:
    """Right of all marks of ours; left of those of libraries, which are slow."""
    ours = name in MEANINGS
    return ax.text(
        x,
        y * (1 + _TIE_BREAK * index),
        f"  {name}" if ours else f"{name}  ",
        ha="left" if ours else "right",
        va="center",
        color=style.dark(style.predicate_colour(name)),
        weight="bold",
        path_effects=[withStroke(linewidth=3, foreground="white")],
        in_layout=False,
    )


def _mark(ax: Axes, look: Look, x: Any, y: Any, bold: bool) -> None:
    """Exact is the largest, with a rim of ink."""
    exact = look.label == EXACT
    known: dict[str, Any] = {"markersize": PALE, "alpha": 0.4, "markeredgewidth": 0, "zorder": 3}
    if bold:
        rim = style.INK if exact else style.dark(look.colour)
        known = {"markersize": BOLD + 2 * exact, "markeredgewidth": 1 + exact, "zorder": 5 + exact}
        known["markeredgecolor"] = rim
    ax.plot(x, y, **look.shape | known)


def _strip(ax: Axes, study: Study, name: str, looks: dict[str, Look], lanes: list[str]) -> None:
    """Pale where a scene has no error, bold where none of the class has."""
    ax.set_facecolor(style.NO_ERROR_FILL)
    facets.rows(ax, lanes, [style.dark(style.predicate_colour(lane)) for lane in lanes])
    ax.set_ylim(len(lanes) - 0.4, -2)
    points = study.points[study.points["scene_class"] == name]
    for (series, lane), here in points.groupby(["series", "lane"], sort=False):
        right = here[here["errors"] == 0]["ns_per_sphere"]
        if len(right):
            _mark(ax, looks[series], right, [lanes.index(lane)] * len(right), bold=False)
        if len(right) == len(here):
            _mark(ax, looks[series], [right.median()], [lanes.index(lane)], bold=True)
    scenes = study.scenes
    pairs = int(scenes[scenes["scene_class"] == name]["true_pairs"].sum())
    bound = words.rate(3 * MILLION / pairs) if pairs else words.NONE
    text = f"0 of {words.count(pairs)} true pairs wrong:\nbelow {bound} per million (95 %: 3/N)"
    known: dict[str, Any] = {"fontsize": style.SMALL, "color": style.dark(style.GREEN)}
    known["bbox"] = {"facecolor": style.NO_ERROR_FILL, "edgecolor": "none", "pad": 1}
    ax.annotate(text, (0.015, 0.97), xycoords="axes fraction", va="top", **known)


def _fronts(study: Study, name: str, panels: tuple[Axes, ...]) -> None:
    """Lines that nothing exact lies left of."""
    for front in study.fronts.query("scene_class == @name").itertuples():
        for ax in panels:
            ax.axvline(front.ns, color=style.INK, linewidth=1.2, linestyle="--", zorder=1)
        at: dict[str, Any] = {"xycoords": ("data", "axes fraction"), "ha": "center", "va": "bottom"}
        panels[0].annotate(front.place, (front.ns, 1), fontsize=style.SMALL, **at)


def _headings(study: Study, panels: list[Axes]) -> None:
    """Under the name of each class its scenes, and the fastest that is exact."""
    texts = {}
    for name, here in study.scenes.groupby("scene_class", sort=False):
        scenes = ", ".join(here["scene"].unique())
        lines = textwrap.wrap(scenes, 144 // len(panels), break_long_words=False)
        fronts = study.fronts.query("scene_class == @name").itertuples()
        lines += [f"{front.place}: {front.series}, {words.number(front.ns)} ns" for front in fronts]
        texts[name] = lines
    height = 15 + 13 * max(map(len, texts.values()))  # points
    for ax, (name, lines) in zip(panels, texts.items(), strict=True):
        at: dict[str, Any] = {"xycoords": "axes fraction", "textcoords": "offset points"}
        look: dict[str, Any] = {"va": "top", "fontsize": style.SMALL, "color": style.FAINT}
        look["in_layout"] = False
        ax.annotate("\n".join(lines), (0, 1), xytext=(0, height), **at, **look)
        ax.set_title(name, pad=height + 4)


def _scales(chart: Chart, errors: list[float], up: list[Axes], down: list[Axes]) -> None:
    """The same up and down."""
    low, high = math.log10(min(errors)), math.log10(max(errors))
    powers = range(math.ceil(low), math.floor(high) + 1, math.ceil((high - low + 1) / 6))
    room = 0.08 * (high - low + 2)
    limits = 10 ** (low - room), 10 ** (high + room)
    up[0].set_ylim(*limits)
    down[0].set_ylim(*reversed(limits))
    for ax in (*up, *down):
        facets.logarithmic(ax, "x", "", text=_short)
        facets.logarithmic(ax, "y", "", [10.0**power for power in powers], chart.tick)
        ax.tick_params(length=0)
    for ax in down:
        ax.set_xlabel("time per sphere [ns]")
    up[0].set_ylabel(chart.up_label)
    down[0].set_ylabel(chart.down_label)


def _short(value: float) -> str:
    return words.size(round(value)) if value >= 1000 else words.tick(value)
