# SPDX-License-Identifier: MIT
"""From nothing skipped to the plan: what each further skip saves, one facet per scene."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from octocell_report import ablation, style, tables, words
from octocell_report.ablation import WORTH_TELLING, Step, Study
from octocell_report.load import Result
from octocell_report.plan import NOTHING, PLANNED

_COLUMNS = 3
_FILLS = {
    "start": "#b8bec6",
    "saved": style.GREEN,
    "lost": style.VERMILLION,
    "joint": "#cdb4d4",
    "noise": "#dfe3e8",
    "planned": style.BLUE,
}
_MEANINGS = {
    "start": "nothing skipped",
    "saved": "saved by the step",
    "lost": "lost by the step",
    "joint": "several steps at once",
    "noise": "step within the noise",
    "planned": "planned",
}


def draw(result: Result) -> Figure | None:
    """None without a study that begins with nothing skipped."""
    shown = [study for study in ablation.studies(result) if ablation.steps(study)]
    if not shown:
        return None
    columns = min(len(shown), _COLUMNS)
    lines = -(-len(shown) // columns)
    most = max(len(ablation.steps(study)) for study in shown) + 2
    figure, grid = plt.subplots(
        lines,
        columns,
        figsize=(max(4.3 * columns + 1.2, 8.5), (0.235 * most + 1.0) * lines + 1.2),
        squeeze=False,
        layout="constrained",
    )
    several = len({study.key.backend for study in shown}) > 1
    for ax, study in zip(grid.flat, shown, strict=False):
        _facet(ax, study)
        ax.set_title(f"{study.key.backend}\n{study.title}" if several else study.title, fontsize=12)
    for unused in list(grid.flat)[len(shown) :]:
        unused.set_visible(False)
    _finish(figure, {step.kind for study in shown for step in ablation.steps(study)})
    return figure


def _facet(ax: Axes, study: Study) -> None:
    steps = ablation.steps(study)
    first, last = steps[0].before, tables.ns_per_sphere(study.base)
    _total(ax, 0, first, "start")
    for y, step in enumerate(steps, start=1):
        _step(ax, y, step)
    _total(ax, len(steps) + 1, last, "planned")
    levels = [first, last, *(step.after for step in steps if step.after is not None)]
    ax.set_xlim(0, 1.24 * max(levels))  # room for numbers
    ax.set_ylim(len(steps) + 1.6, -0.6)
    names = [NOTHING, *(f"+ {step.skip}" for step in steps), PLANNED]
    ax.set_yticks(range(len(names)), names, fontsize=10.5)
    for label, step in zip(ax.get_yticklabels()[1:], steps, strict=False):
        label.set_color(style.INK if step.taken else style.FAINT)
    ax.tick_params(axis="y", length=0)
    ax.tick_params(axis="x", labelsize=10.5)
    ax.grid(axis="y", visible=False)
    ax.set_xlabel("ns per sphere", fontsize=10.5)


def _total(ax: Axes, y: int, value: float, kind: str) -> None:
    ax.barh([y], [value], color=_FILLS[kind], height=0.74)
    _write(ax, y, value, words.number(value), style.INK)


def _step(ax: Axes, y: int, step: Step) -> None:
    """The bar hangs between the time before and the time after."""
    ax.plot([step.before] * 2, [y - 1.37, y + 0.37], color=style.FAINT, linewidth=0.8, zorder=0.9)
    if step.after is None:
        wrong = step.row.status == "wrong"
        text = f"wrong {words.losses(step.row)}" if wrong else "skipped"
        _write(ax, y, step.before, text, style.VERMILLION if wrong else style.FAINT)
        return
    low, high = sorted((step.before, step.after))
    ax.barh([y], [high - low], left=low, color=_FILLS[step.kind], height=0.74)
    if step.told:
        sign = words.MINUS if step.change < 0 else "+"
        _write(ax, y, high, f"{sign}{words.number(high - low)}", _ink(step.kind))


def _ink(kind: str) -> str:
    return style.FAINT if kind == "joint" else style.darker(_FILLS[kind], 0.25)


def _write(ax: Axes, y: int, x: float, text: str, ink: str) -> None:
    look: dict[str, Any] = {"xytext": (4, 0), "textcoords": "offset points", "fontsize": 10}
    ax.annotate(text, (x, y), va="center", ha="left", color=ink, **look)


def _finish(figure: Figure, kinds: set[str]) -> None:
    figure.suptitle(
        "Skips allowed one after the other, from none to all: median time, all in the same rounds\n"
        "beside a bar: what the step changes, where it is beyond the noise and "
        f"{100 * WORTH_TELLING:.0f} % of the start; "
        "grey name: the plan of that step does not take it",
        x=0.01,
        ha="left",
        fontsize=12.5,
    )
    handles = [
        Patch(facecolor=_FILLS[kind], label=text)
        for kind, text in _MEANINGS.items()
        if kind != "joint" or kind in kinds
    ]
    figure.legend(handles=handles, loc="outside lower left", ncols=3)
