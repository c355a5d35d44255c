# SPDX-License-Identifier: MIT
"""One file per plot; each draws from a result and returns a figure, or nothing to show."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from octocell_report import style
from octocell_report.error import Study
from octocell_report.load import Result
from octocell_report.plots import (
    bandwidth,
    butterfly,
    correctness,
    dynamic,
    error_map,
    front,
    memory,
    regret,
    skips,
    speed,
    stages,
    steps,
    time,
)

_RUNS = ("warm", "cold", "first_update", "update")
_SIDES = ("backend", "device", "baseline")
DRAWS: dict[str, Callable[..., Figure | None]] = {
    "front": lambda result, looks: front.draw(result),
    **{f"time_{run}": partial(time.draw, run=run) for run in _RUNS},
    **{f"stages_{side}": partial(stages.draw, side=side) for side in _SIDES},
    "stages_per_sphere": stages.draw_per_sphere,
    "bandwidth": bandwidth.draw,
    "bandwidth_by_size": bandwidth.draw_by_size,
    **{f"speed_{run}": partial(speed.draw, run=run) for run in _RUNS},
    "dynamic": dynamic.draw,
    "correctness": correctness.draw,
    "memory": memory.draw,
}
_ABLATION = {
    "ablation_skips": skips.draw,
    "ablation_steps": steps.draw,
    "ablation_regret": regret.draw,
}
_ERROR = {
    "error_pareto": butterfly.draw_rates,
    "error_depth": butterfly.draw_depths,
    "error_map": error_map.draw,
}
# Every name that draw_all() may use: a build replaces or removes these and nothing else. The same
# for the other two.
NAMES, ABLATION_NAMES, ERROR_NAMES = tuple(DRAWS), tuple(_ABLATION), tuple(_ERROR)


def draw_all(result: Result) -> Iterator[tuple[str, Figure]]:
    """Name and figure, one at a time; the figure is closed when the next one is asked for."""
    yield from _drawn(DRAWS, result, style.looks(result))


def draw_ablation(result: Result) -> Iterator[tuple[str, Figure]]:
    """The same for what planned rows and their variants show."""
    yield from _drawn(_ABLATION, result)


def draw_error(study: Study) -> Iterator[tuple[str, Figure]]:
    """The same for run time against error."""
    yield from _drawn(_ERROR, study)


def _drawn(
    draws: Mapping[str, Callable[..., Figure | None]], *shown: Any
) -> Iterator[tuple[str, Figure]]:
    with plt.rc_context(style.RC):
        for name, draw in draws.items():
            figure = draw(*shown)
            if figure is not None:
                yield name, figure
                plt.close(figure)
