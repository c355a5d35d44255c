# SPDX-License-Identifier: MIT
"""cast="nearest": what rounding to float32 changes, against fractions."""

from __future__ import annotations

from typing import Any

import numpy as np
import octocell
import pytest
from exact import exact_pairs
from numpy.typing import NDArray

Numbers = NDArray[np.float64]


def grid(step: float, radius: float) -> Numbers:
    """Neighbors that touch, as nearly as float64 can say."""
    places = np.stack(np.meshgrid(*[np.arange(5) * step] * 3), axis=-1).reshape(-1, 3)
    return np.hstack([places, np.full((125, 1), radius)])


def cloud(scale: float) -> Numbers:
    random = np.random.default_rng(7)
    spheres = random.uniform(0, 4, (150, 4)) * scale
    spheres[:, 3] *= 0.1
    return spheres


SCENES = {
    "tenths": grid(0.1, 0.05),
    "thirds": grid(1 / 3, 1 / 6),
    "one": np.array([[0.1, 0, 0, 0.1], [0.3, 0, 0, 0.1]]),
    "whole": grid(1.0, 0.5),
    "just apart": grid(1.0, np.nextafter(0.5, 0)),
    "cloud": cloud(1.0),
    "tiny": cloud(1e-44),
    "huge": cloud(1e36),
    "below float32": cloud(1e-300),
    "subnormal": cloud(1e-310),
    "points": np.zeros((4, 4)),
    "empty": np.empty((0, 4)),
}


@pytest.mark.parametrize("spheres", SCENES.values(), ids=SCENES)
def test_changed_decisions_are_counted_exactly(spheres: Numbers) -> None:
    before = {tuple(pair) for pair in exact_pairs(spheres).tolist()}
    after = {tuple(pair) for pair in exact_pairs(spheres.astype(np.float32)).tolist()}
    for sort in (True, False):
        found = octocell.pairs(spheres, cast="nearest", sort=sort, threads=2)
        assert set(found) == after
        assert found.rounding == (len(before - after), len(after - before))
        assert found.rounding is not None
        assert found.rounding.changed == len(before ^ after)
    assert octocell.Finder().find(spheres, cast="nearest").rounding == found.rounding


def test_some_scenes_do_change() -> None:
    """Else the test above would say nothing."""
    changed = {name: octocell.pairs(s, cast="nearest").rounding for name, s in SCENES.items()}
    assert changed["one"] == (1, 0) and changed["just apart"] == (0, 300)
    assert changed["whole"] == changed["points"] == (0, 0)


def test_numbers_that_need_no_rounding_report_none() -> None:
    assert octocell.pairs(np.zeros((3, 4), np.float32)).rounding is None
    assert octocell.pairs(np.zeros((3, 4), np.float32), cast="nearest").rounding == (0, 0)
    whole = np.array([[2**24 + 1, 0, 0], [2**24 - 1, 0, 0]])
    assert octocell.pairs(whole, 0.25, cast="nearest").rounding == (0, 0)
    assert octocell.pairs(whole, 0.5, cast="nearest").rounding == (0, 1)  # 2 apart; rounded, 1
    assert octocell.pairs(whole, 1, cast="nearest").rounding == (0, 0)


@pytest.mark.parametrize(
    ("sphere", "says"),
    [
        ([0.0, 1e39, 0, 1], r"sphere 1: x=0 y=1e\+39"),
        ([0.0, 0, 0, -1e-60], "sphere 1: .* r=-1e-60"),
        ([0.0, np.nan, 0, 1], "sphere 1: x=0 y=nan"),
    ],
)
def test_what_float32_cannot_hold_is_named(sphere: list[Any], says: str) -> None:
    with pytest.raises(octocell.InvalidSphere, match=says):
        octocell.pairs(np.array([[0, 0, 0, 1.0], sphere]), cast="nearest")
