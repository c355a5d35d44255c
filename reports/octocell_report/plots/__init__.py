# SPDX-License-Identifier: MIT
"""One file per plot; each draws from a result and returns a figure, or nothing to show."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from octocell_report import style, tables
from octocell_report.error import Study
from octocell_report.load import Impl, Result
from octocell_report.plots import (
    bandwidth,
    correctness,
    depth,
    dynamic,
    error_map,
    front,
    memory,
    pareto,
    regret,
    skips,
    speed,
    stages,
    steps,
    time,
)
from octocell_report.style import Look

# Every name that draw_all() may use: a build replaces or removes these and nothing else.
NAMES = (
    "front",
    *(f"time_{run}" for run in ("warm", "cold", "first_update", "update")),
    "stages_backend",
    "stages_device",
    "stages_baseline",
    "stages_per_sphere",
    "bandwidth",
    "bandwidth_by_size",
    *(f"speed_{run}" for run in ("warm", "cold", "first_update", "update")),
    "dynamic",
    "correctness",
    "memory",
)
# The same for draw_ablation().
ABLATION_NAMES = ("ablation_skips", "ablation_steps", "ablation_regret")
# The same for draw_error().
ERROR_NAMES = ("error_pareto", "error_depth", "error_map")


def draw_all(result: Result) -> Iterator[tuple[str, Figure]]:
    """Name and figure, one at a time; the figure is closed when the next one is asked for."""
    yield from _drawn(_plans(result, style.looks(result)))


def draw_ablation(result: Result) -> Iterator[tuple[str, Figure]]:
    """The same for what planned rows and their variants show."""
    plans = (partial(skips.draw, result), partial(steps.draw, result), partial(regret.draw, result))
    yield from _drawn(dict(zip(ABLATION_NAMES, plans, strict=True)))


def draw_error(study: Study) -> Iterator[tuple[str, Figure]]:
    """The same for run time against error."""
    plans = (partial(plot.draw, study) for plot in (pareto, depth, error_map))
    yield from _drawn(dict(zip(ERROR_NAMES, plans, strict=True)))


def _drawn(plans: Mapping[str, Callable[[], Figure | None]]) -> Iterator[tuple[str, Figure]]:
    with plt.rc_context(style.RC):
        for name, draw in plans.items():
            figure = draw()
            if figure is None:
                continue
            yield name, figure
            plt.close(figure)


def _plans(result: Result, looks: dict[Impl, Look]) -> dict[str, Callable[[], Figure | None]]:
    runs = tables.runs(result)
    return {
        "front": partial(front.draw, result),
        **{f"time_{run}": partial(time.draw, result, looks, run) for run in runs},
        "stages_backend": partial(stages.draw, result, looks, "backend"),
        "stages_device": partial(stages.draw, result, looks, "device"),
        "stages_baseline": partial(stages.draw, result, looks, "baseline"),
        "stages_per_sphere": partial(stages.draw_per_sphere, result, looks),
        "bandwidth": partial(bandwidth.draw, result, looks),
        "bandwidth_by_size": partial(bandwidth.draw_by_size, result, looks),
        **{f"speed_{run}": partial(speed.draw, result, looks, run) for run in runs},
        "dynamic": partial(dynamic.draw, result, looks),
        "correctness": partial(correctness.draw, result, looks),
        "memory": partial(memory.draw, result, looks),
    }
