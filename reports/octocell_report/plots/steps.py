# SPDX-License-Identifier: MIT
"""From nothing skipped to the plan: what each further skip saves, one facet per scene."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from octocell_report import ablation, style, words
from octocell_report.load import Result
from octocell_report.plan import NOTHING, PLANNED
from octocell_report.plots import facets

_COLUMNS = 3
_KINDS = {
    "start": ("#b8bec6", "nothing skipped"),
    "saved": (style.GREEN, "saved by the step"),
    "lost": (style.VERMILLION, "lost by the step"),
    "joint": ("#cdb4d4", "several steps at once"),
    "noise": ("#dfe3e8", "step within the noise"),
    "planned": (style.BLUE, "planned"),
}


def draw(result: Result) -> Figure | None:
    """None without a study that begins with nothing skipped."""
    steps = ablation.steps(result)
    if steps.empty:
        return None
    studies = dict(list(steps.groupby(["backend", "title"], sort=False)))
    several = steps["backend"].nunique() > 1
    met = {*_KINDS} - {"joint"} | {*steps["kind"]}
    figure, axes = facets.grid(
        facets.caption("ablation_steps"),
        [f"{backend}\n{title}" if several else title for backend, title in studies],
        [len(here) + 2 for here in studies.values()],
        0.94,
        _COLUMNS,
        [Patch(color=fill, label=text) for kind, (fill, text) in _KINDS.items() if kind in met],
        key_columns=6,
    )
    for ax, here in zip(axes, studies.values(), strict=True):
        _facet(ax, list(here.itertuples()))
    return figure


def _facet(ax: Axes, steps: list[Any]) -> None:
    """A bar for the start and for the plan; those of steps hang between before and after."""
    first, last = steps[0].before, steps[0].planned.ns_per_sphere
    names = [NOTHING, *(f"+ {step.skip}" for step in steps), PLANNED]
    facets.rows(ax, names, [style.INK, *(style.INK if s.taken else style.FAINT for s in steps)])
    for y, value, kind in ((0, first, "start"), (len(steps) + 1, last, "planned")):
        ax.barh(y, value, color=_KINDS[kind][0], height=0.74)
        facets.beside(ax, value, y, words.number(value))
    for y, step in enumerate(steps, start=1):
        ax.plot([step.before] * 2, [y - 1.37, y + 0.37], color=style.FAINT, linewidth=0.8)
        _step(ax, y, step)
    ax.set_xlim(0, 1.24 * max(first, last, *(step.after for step in steps if step.timed)))
    facets.linear(ax, "ns per sphere")


def _step(ax: Axes, y: int, step: Any) -> None:
    if not step.timed:
        wrong = step.status == "wrong"
        text = f"wrong {words.losses(step)}" if wrong else "skipped"
        facets.beside(ax, step.before, y, text, color=style.VERMILLION if wrong else style.FAINT)
        return
    colour = _KINDS[step.kind][0]
    ax.barh(y, step.change, left=step.before, color=colour, height=0.74, zorder=2)
    if step.told:
        text = f"{words.MINUS if step.change < 0 else '+'}{words.number(abs(step.change))}"
        ink = style.FAINT if step.kind == "joint" else style.darker(colour, 0.25)
        facets.beside(ax, max(step.before, step.after), y, text, color=ink)
