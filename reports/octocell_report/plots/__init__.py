# SPDX-License-Identifier: MIT
"""One file per plot; each draws from a result and returns a figure, or nothing to show."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from octocell_report import style, tables
from octocell_report.load import Impl, Result
from octocell_report.plots import bandwidth, correctness, dynamic, memory, speed, stages, time
from octocell_report.style import Look

# Every name that draw_all() may use: a build replaces or removes these and nothing else.
NAMES = (
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


def draw_all(result: Result) -> Iterator[tuple[str, Figure]]:
    """Name and figure, one at a time; the figure is closed when the next one is asked for."""
    with plt.rc_context(style.RC):
        for name, draw in _plans(result, style.looks(result)).items():
            figure = draw()
            if figure is None:
                continue
            yield name, figure
            plt.close(figure)


def _plans(result: Result, looks: dict[Impl, Look]) -> dict[str, Callable[[], Figure | None]]:
    runs = tables.runs(result)
    return {
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
