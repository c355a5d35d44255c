# SPDX-License-Identifier: MIT
"""From nothing skipped to the plan: what each further skip saves, one facet per scene."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from octocell_report import ablation, style, tables, words
from octocell_report.ablation import WORTH_TELLING, Step, Study
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
    shown = {study.key: ablation.steps(study) for study in ablation.studies(result)}
    studies = [study for study in ablation.studies(result) if shown[study.key]]
    if not studies:
        return None
    kinds = {step.kind for steps in shown.values() for step in steps}
    figure, axes = facets.grid(
        "Skips allowed one after the other, from none to all: median time, all in the same rounds\n"
        "beside a bar: what the step changes, where it is beyond the noise and "
        f"{100 * WORTH_TELLING:.0f} % of the start; grey name: the plan of that step does not take "
        "it",
        _titles(studies),
        [len(shown[study.key]) + 2 for study in studies],
        0.94,
        _COLUMNS,
        [Patch(color=f, label=t) for k, (f, t) in _KINDS.items() if k != "joint" or k in kinds],
        key_columns=6,
    )
    for ax, study in zip(axes, studies, strict=True):
        _facet(ax, study, shown[study.key])
    return figure


def _titles(studies: list[Study]) -> list[str]:
    several = len({study.key.backend for study in studies}) > 1
    return [f"{s.key.backend}\n{s.title}" if several else s.title for s in studies]


def _facet(ax: Axes, study: Study, steps: list[Step]) -> None:
    """A bar for the start and for the plan; those of steps hang between before and after."""
    first, last = steps[0].before, tables.ns_per_sphere(study.base)
    names = [NOTHING, *(f"+ {step.skip}" for step in steps), PLANNED]
    facets.rows(ax, names, [style.INK, *(style.INK if s.taken else style.FAINT for s in steps)])
    for y, value, kind in ((0, first, "start"), (len(steps) + 1, last, "planned")):
        ax.barh(y, value, color=_KINDS[kind][0], height=0.74)
        facets.beside(ax, value, y, words.number(value))
    for y, step in enumerate(steps, start=1):
        ax.plot([step.before] * 2, [y - 1.37, y + 0.37], color=style.FAINT, linewidth=0.8)
        _step(ax, y, step)
    ax.set_xlim(0, 1.24 * max(first, last, *(step.after or 0.0 for step in steps)))
    facets.linear(ax, "ns per sphere")


def _step(ax: Axes, y: int, step: Step) -> None:
    if step.after is None:
        wrong = step.row.status == "wrong"
        text = f"wrong {words.losses(step.row)}" if wrong else "skipped"
        facets.beside(ax, step.before, y, text, color=style.VERMILLION if wrong else style.FAINT)
        return
    colour = _KINDS[step.kind][0]
    ax.barh(y, step.change, left=step.before, color=colour, height=0.74, zorder=2)
    if step.told:
        text = f"{words.MINUS if step.change < 0 else '+'}{words.number(abs(step.change))}"
        ink = style.FAINT if step.kind == "joint" else style.darker(colour, 0.25)
        facets.beside(ax, max(step.before, step.after), y, text, color=ink)
