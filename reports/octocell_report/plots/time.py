# SPDX-License-Identifier: MIT
"""Time against the number of spheres, one facet per scene, both axes logarithmic."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from octocell_report import words
from octocell_report.load import Result
from octocell_report.plots import facets
from octocell_report.style import Look

_LEAST = 12  # lines of text that a facet is high


def draw(result: Result, looks: dict[str, Look], run: str) -> Figure | None:
    """None if no scene has rows at two sizes or more."""
    frame = result.frame
    rows = frame[(frame["run"] == run) & frame["ran"] & (frame["n"] > 0) & (frame["median_ms"] > 0)]
    met = rows.groupby("scene")[["n", "label"]].nunique()
    scenes = [scene for scene in result.scenes if scene in met.index and met["n"][scene] > 1]
    if not scenes:
        return None
    figure, axes = facets.grid(
        facets.caption(f"time_{run}"),
        scenes,
        [max(_LEAST, met["label"][scene]) for scene in scenes],
    )
    for ax, scene in zip(axes, scenes, strict=True):
        _facet(ax, rows[rows["scene"] == scene].sort_values("n"), looks)
    return figure


def _facet(ax: Axes, rows: pd.DataFrame, looks: dict[str, Look]) -> None:
    """The legend stands beside it, slowest first, so that its entries stand as the line ends do."""
    sizes = sorted(set(rows["n"]))
    curves = {label: here for label, here in rows[rows["counts"]].groupby("label", sort=False)}
    fits = {label: _power_law(here) for label, here in curves.items()}
    for label in sorted(curves, key=lambda label: -np.polyval(fits[label], np.log(sizes[-1]))):
        here, look = curves[label], looks[label]
        slope = f"n^{fits[label][0]:.2f}" if here["n"].nunique() > 1 else "one size"
        facets.band(ax, here["n"], here["round_ms"], look, label=f"{look.label}   {slope}")
    for label, here in rows[~rows["counts"]].groupby("label", sort=False):
        _hollow(ax, here, looks[label])
    facets.logarithmic(ax, "x", "spheres", sizes, lambda n: words.size(round(n)))
    facets.logarithmic(ax, "y", "time [ms]")
    facets.legend(ax, handlelength=3)


def _power_law(rows: pd.DataFrame) -> Any:
    """b and log a of median_ms = a n^b by least squares on logarithms; b is 0 at one size."""
    return np.polyfit(np.log(rows["n"]), np.log(rows["median_ms"]), min(1, rows["n"].nunique() - 1))


def _hollow(ax: Axes, rows: pd.DataFrame, look: Look) -> None:
    """Marks without a line for what is not exact; the worst of it stands in the legend."""
    worst = rows.loc[rows["errors"].idxmax()]
    told = words.losses(worst) if worst.status == "wrong" else "exact here"
    several = "up to " if len(rows) > 1 and worst.status == "wrong" else ""
    shape = look.dot | {"markerfacecolor": "white", "linestyle": "none", "markersize": 8}
    ax.plot(rows["n"], rows["median_ms"], label=f"{look.label}   {several}{told}", **shape)
