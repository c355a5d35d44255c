# SPDX-License-Identifier: MIT
"""Time across, what is missed upwards, what is false downwards; between them a strip without error.

One column per class of scenes. A bold mark is the worst scene of its series at the median time of
the scenes; pale marks are the single scenes.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from octocell_report import style, words
from octocell_report.error import MILLION, Study
from octocell_report.plots import facets
from octocell_report.predicates import EXACT, MEANINGS
from octocell_report.style import Look

TIE = 1e-9  # what is nearer to touching than float32 can tell is drawn here, ties among it
FAR = 10.0  # and what is wider than this; radii of 0 have any gap
BOLD, PALE = 9.5, 5.0  # sizes of marks
_LINES = 11  # of text that a panel has room for
_KINDS = ("missed_per_million", "false_per_million")
_NAME = 0.07  # of a panel's height, that a name takes
_Names = dict[str, tuple[float, float]]  # of tests and libraries: where their marks end


def draw_rates(study: Study) -> Figure | None:
    """How many pairs are wrong: the plot that the error study is made for."""
    labels = ["LOST, per million true pairs", "INVENTED, per million true pairs"]
    return _draw(study, "error_pareto", study.points[[*_KINDS]], labels, words.rate)


def draw_depths(study: Study) -> Figure | None:
    """How bad the worst pair is: a miss by rounding and one of deep overlap differ."""
    labels = ["deepest pair lost / (rᵢ + rⱼ)", "widest gap invented / (rᵢ + rⱼ)"]
    worst = study.points[["worst_missed_depth", "worst_false_gap"]].clip(TIE, FAR)
    return _draw(study, "error_depth", worst, labels, _share)


def _share(value: float) -> str:
    """A share of the sum of the radii."""
    if value <= TIE or value >= FAR:
        return "≤ 1e-9" if value <= TIE else "≥ 10"
    return f"{value:g}" if value >= 0.01 else f"{value:.0e}".replace("e-0", "e-")


def _draw(
    study: Study,
    name: str,
    sizes: pd.DataFrame,
    labels: list[str],
    tick: Callable[[float], str],
) -> Figure | None:
    """The sizes are those of what each point misses, and of what it invents; None if none does."""
    up_down = [
        sizes.iloc[:, side].where(study.points[kind] > 0) for side, kind in enumerate(_KINDS)
    ]
    errors = pd.concat(up_down).dropna()
    if errors.empty:
        return None
    looks, lanes = _looks(study.points), _lanes(study.points)
    classes = list(study.scenes["scene_class"].unique())
    figure, axes = facets.grid(
        facets.caption(name),
        [*classes, *[""] * 2 * len(classes)],
        [lines for lines in (_LINES, len(lanes) + 2, _LINES) for _ in classes],
        columns=len(classes),
        key=_key(study.points, looks),
        key_columns=2,
        sharex=True,
        sharey="row",
    )
    names: dict[Axes, _Names] = {}
    for at, name in enumerate(classes):
        up, strip, down = axes[at :: len(classes)]
        here = study.points[study.points["scene_class"] == name]
        _strip(strip, here, looks, lanes)
        _fronts(study, name, (up, strip, down))
        for ax, error in zip((up, down), up_down, strict=True):
            names[ax] = _panel(ax, here.assign(error=error), looks)
    _headings(study, axes[: len(classes)])
    _scales(errors, list(names)[::2], list(names)[1::2], labels, tick)
    for ax, ends in names.items():
        _write(ax, ends)
    return figure


def _looks(points: pd.DataFrame) -> dict[str, Look]:
    """By series: colour by predicate, marker by backend or library."""
    owners, found = list(_owners(points).unique()), {}
    for row, owner in zip(points.itertuples(), _owners(points), strict=True):
        marker = style.owner_marker(owner, owners.index(owner))
        name, colour = row.predicate or row.backend, style.predicate_colour(row.predicate)
        found[row.series] = Look(name, colour, marker, "none")
    return found


def _owners(points: pd.DataFrame) -> pd.Series[str]:
    return points["backend"].where(points["predicate"].notna(), points["lane"])


def _lanes(points: pd.DataFrame) -> list[str]:
    """Those that are without error on some scene, from the top."""
    met = set(points["lane"][points["errors"] == 0])
    return [lane for lane in points["lane"].unique() if lane in met]


def _key(points: pd.DataFrame, looks: dict[str, Look]) -> list[Line2D]:
    """What shapes and colours mean."""
    owners = {o: looks[s].marker for o, s in zip(_owners(points), points["series"], strict=True)}
    shapes = [Look(owner, style.FAINT, marker, "none") for owner, marker in owners.items()]
    tests = [
        Look(f"{test}: {MEANINGS[test]}", style.predicate_colour(test), "")
        for test in points["predicate"].dropna().unique()
    ]
    return [look.entry for look in (*shapes, *tests)]


def _panel(ax: Axes, points: pd.DataFrame, looks: dict[str, Look]) -> _Names:
    """The marks of one class. Names belong right of all marks of ours, left of those of libraries,
    which are slow."""
    worst: dict[str, list[tuple[float, float]]] = {}
    for series, here in points.groupby("series", sort=False):
        look, met = looks[series], here.dropna(subset="error")
        if len(met):
            _mark(ax, look, met["ns_per_sphere"], met["error"], bold=False)
            ns, error = here["ns_per_sphere"].median(), met["error"].max()
            _mark(ax, look, [ns], [error], bold=True)
            worst.setdefault(look.label, []).append((ns, error))
    for name, marks in worst.items():
        marks.sort()
        colour = style.predicate_colour(name)
        ax.plot(*zip(*marks, strict=True), color=colour, linewidth=1.3, alpha=0.5)
    ours = [marks[-1][0] for name, marks in worst.items() if name in MEANINGS]
    theirs = [marks[0][0] for name, marks in worst.items() if name not in MEANINGS]
    return {
        name: (max(ours) if name in MEANINGS else min(theirs), marks[-1][1])
        for name, marks in worst.items()
    }


def _write(ax: Axes, names: _Names) -> None:
    """Names at their heights, or as near to them as the others let them be."""
    to_share = ax.transData + ax.transAxes.inverted()
    heights = {name: to_share.transform(end)[1] for name, end in names.items()}
    order = sorted(heights, key=heights.__getitem__)
    for name, height in zip(order, facets.apart(sorted(heights.values()), _NAME), strict=True):
        text, side = (f"  {name}", "left") if name in MEANINGS else (f"{name}  ", "right")
        look: dict[str, Any] = {"weight": "bold", "color": style.dark(style.predicate_colour(name))}
        look |= {"path_effects": [withStroke(linewidth=3, foreground="white")], "in_layout": False}
        at = ax.get_xaxis_transform()
        ax.text(names[name][0], height, text, transform=at, ha=side, va="center", **look)


def _mark(ax: Axes, look: Look, xs: Any, ys: Any, bold: bool) -> None:
    """Exact is the largest, with a rim of ink."""
    exact = look.label == EXACT
    known: dict[str, Any] = {"markersize": PALE, "alpha": 0.4, "markeredgewidth": 0, "zorder": 3}
    if bold:
        known = {"markersize": BOLD + 2 * exact, "markeredgewidth": 1 + exact, "zorder": 5 + exact}
        known["markeredgecolor"] = style.INK if exact else style.dark(look.colour)
    ax.plot(xs, ys, **look.shape | known)


def _strip(ax: Axes, points: pd.DataFrame, looks: dict[str, Look], lanes: list[str]) -> None:
    """Pale where a scene has no error, bold where none of the class has."""
    ax.set_facecolor(style.NO_ERROR_FILL)
    facets.rows(ax, lanes, [style.dark(style.predicate_colour(lane)) for lane in lanes])
    ax.set_ylim(len(lanes) - 0.4, -2)
    for (series, lane), here in points.groupby(["series", "lane"], sort=False):
        right = here["ns_per_sphere"][here["errors"] == 0]
        if len(right):
            _mark(ax, looks[series], right, [lanes.index(lane)] * len(right), bold=False)
        if len(right) == len(here):
            _mark(ax, looks[series], [right.median()], [lanes.index(lane)], bold=True)
    pairs = int(points.drop_duplicates(["scene", "n"])["true_pairs"].sum())
    bound = words.rate(3 * MILLION / pairs) if pairs else words.NONE
    text = f"0 of {words.count(pairs)} true pairs wrong:\nbelow {bound} per million (95 %: 3/N)"
    known: dict[str, Any] = {"fontsize": style.SMALL, "color": style.dark(style.GREEN)}
    known["bbox"] = {"facecolor": style.NO_ERROR_FILL, "edgecolor": "none", "pad": 1}
    ax.annotate(text, (0.015, 0.97), xycoords="axes fraction", va="top", **known)


def _fronts(study: Study, scene_class: str, panels: tuple[Axes, ...]) -> None:
    """Lines that nothing exact lies left of."""
    at: dict[str, Any] = {"xycoords": ("data", "axes fraction"), "ha": "center", "va": "bottom"}
    for front in study.fronts[study.fronts["scene_class"] == scene_class].itertuples():
        for ax in panels:
            ax.axvline(front.ns, color=style.INK, linewidth=1.2, linestyle="--", zorder=1)
        panels[0].annotate(front.place, (front.ns, 1), fontsize=style.SMALL, **at)


def _headings(study: Study, panels: list[Axes]) -> None:
    """Under the name of each class its scenes, and the fastest that is exact."""
    texts, fronts = {}, study.fronts
    for name, here in study.scenes.groupby("scene_class", sort=False):
        scenes = ", ".join(here["scene"].unique())
        texts[name] = textwrap.wrap(scenes, 144 // len(panels), break_long_words=False)
        for front in fronts[fronts["scene_class"] == name].itertuples():
            texts[name].append(f"{front.place}: {front.series}, {words.number(front.ns)} ns")
    height = 15 + 13 * max(map(len, texts.values()))  # points
    look: dict[str, Any] = {"va": "top", "fontsize": style.SMALL, "color": style.FAINT}
    look |= {"xycoords": "axes fraction", "textcoords": "offset points", "in_layout": False}
    for ax, (name, lines) in zip(panels, texts.items(), strict=True):
        ax.annotate("\n".join(lines), (0, 1), xytext=(0, height), **look)
        ax.set_title(name, pad=height + 4)


def _scales(
    errors: pd.Series[float],
    up: list[Axes],
    down: list[Axes],
    labels: list[str],
    tick: Callable[[float], str],
) -> None:
    """The same up and down."""
    low, high = math.log10(errors.min()), math.log10(errors.max())
    powers = range(math.ceil(low), math.floor(high) + 1, math.ceil((high - low + 1) / 6))
    room = 0.08 * (high - low + 2)
    limits = 10 ** (low - room), 10 ** (high + room)
    up[0].set_ylim(*limits)
    down[0].set_ylim(*reversed(limits))
    for panels, label in zip((up, down), labels, strict=True):
        for ax in panels:
            facets.logarithmic(ax, "x", "", text=words.rate)
            facets.logarithmic(ax, "y", label, [10.0**power for power in powers], tick)
            ax.tick_params(length=0)
    for ax in down:
        ax.set_xlabel("time per sphere [ns]")
