# SPDX-License-Identifier: MIT
"""Whatever cannot be used is refused, by an exception that says what and where."""

from __future__ import annotations

import pickle
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import octocell
import pytest

FOUR = np.array([[0, 0, 0, 1], [3.5, 3, 0, 1], [5, 2, 0, 1], [5, 4, 0, 1]], np.float32)
CENTERS, RADII = FOUR[:, :3].copy(), FOUR[:, 3].copy()


@pytest.mark.parametrize(("column", "value"), [(0, np.nan), (2, -np.inf), (3, np.inf), (3, -0.5)])
def test_an_invalid_sphere_is_named(column: int, value: float) -> None:
    spheres = np.tile(FOUR, (50, 1))
    spheres[150, column] = spheres[170, column] = value
    rounded = {"cast": "nearest"}
    calls: list[Callable[[], Any]] = [
        lambda: octocell.pairs(spheres),
        lambda: octocell.pairs(spheres[:, :3], spheres[:, 3]),
        lambda: octocell.pairs(spheres.astype(np.float64), **rounded),
        lambda: octocell.count(spheres),
        lambda: octocell.plan(spheres),
        lambda: list(octocell.chunks(spheres)),
        lambda: octocell.Finder().find(spheres),
        lambda: octocell.verify(spheres, None, [[0, 1]]),
    ]
    for call in calls:
        with pytest.raises(ValueError, match=r"^sphere 150: x=") as caught:
            call()
        assert type(caught.value) is octocell.InvalidSphere and caught.value.index == 150
    again = pickle.loads(pickle.dumps(caught.value))
    assert (str(again), again.index) == (str(caught.value), 150)


def test_rounding_must_be_asked_for() -> None:
    message = re.escape('pass float32, or cast="nearest"')
    for centers, radii in [
        (CENTERS.astype(np.float64), 1),
        (CENTERS, RADII.astype(np.float64)),
        (CENTERS, np.float64(1)),
        ([[0.1, 0, 0]], 1),
        (CENTERS, [0.1] * 4),
        (np.array([[2**24 + 1, 0, 0]]), 1),
        (np.array([[-(2**63), 0, 0]]), 1),
        (CENTERS.astype(np.longdouble), 1),
    ]:
        with pytest.raises(TypeError, match=message):
            octocell.pairs(centers, radii)
    assert octocell.pairs(CENTERS, 0.1).count == 0  # a Python number takes the arrays' type


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: octocell.pairs(CENTERS), r"shape \(4, 3\): must be \(N, 4\), x y z r"),
        (lambda: octocell.pairs(FOUR, 1), r"shape \(4, 4\): must be \(N, 3\)"),
        (lambda: octocell.pairs(RADII), r"shape \(4,\)"),
        (lambda: octocell.pairs(FOUR[None]), r"shape \(1, 4, 4\)"),
        (lambda: octocell.pairs(CENTERS, RADII[:3]), r"radii have the shape \(3,\): .* \(4,\)"),
        (lambda: octocell.pairs(CENTERS, FOUR), r"radii have the shape \(4, 4\)"),
        (lambda: octocell.pairs(FOUR, cast="up"), r"cast='up': must be None or \"nearest\""),
        (lambda: octocell.pairs(FOUR, device="tpu"), r"device='tpu': must be"),
        (lambda: octocell.why_unavailable("tpu"), r"device='tpu': must be"),
        (lambda: octocell.pairs(FOUR, threads=-1), r"threads = -1: must be 1 to 1024"),
        (lambda: octocell.pairs(FOUR, threads=4000), r"threads = 4000: must be 1 to 1024"),
        (lambda: octocell.pairs(FOUR, flags=octocell.flags()), r"1 flags for 4 spheres"),
        (lambda: octocell.chunks(FOUR, pairs=0), r"pairs=0: must be 1 or more"),
        (lambda: octocell.flags(group=0x8000), r"group: must be integers of 0 to 0x7fff"),
        (lambda: octocell.flags(mask=-1), r"mask: must be integers"),
        (lambda: octocell.verify(FOUR, None, [0], [1, 2]), r"shapes \(1,\) and \(2,\)"),
        (lambda: octocell.verify(FOUR, None, [[0, 1, 2]]), r"shape \(1, 3\): must be \(P, 2\)"),
        (lambda: octocell.verify(FOUR, None, [[0, 1], [2, -1]]), r"entry 1 is \(2, -1\)"),
        (lambda: octocell.verify(FOUR, None, [[0, 2**32]]), r"entry 0 is \(0, 4294967296\)"),
        (lambda: octocell.pairs(FOUR).to_matrix(-1), r"k=-1: must be 0 or more"),
    ],
)
def test_wrong_arguments_are_named(call: Callable[[], Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: octocell.pairs(FOUR, index_dtype="int16"), "index_dtype=int16: must be int32"),
        (lambda: octocell.pairs(FOUR, index_dtype="float32"), "index_dtype=float32"),
        (
            lambda: octocell.pairs(FOUR, flags=[1, 1, 1, 1]),
            r"flags are int64 \(4,\): must be uint32",
        ),
        (lambda: octocell.pairs(FOUR.astype(complex)), "centers are complex128: must be numbers"),
        (lambda: octocell.pairs(np.array([["a"] * 4])), "centers are <U1: must be numbers"),
        (lambda: octocell.pairs(FOUR.astype(np.longdouble), cast="nearest"), "at most 8 bytes"),
        (lambda: octocell.verify(FOUR, None, [[0.5, 1]]), "pairs are float64: must be integers"),
    ],
)
def test_wrong_types_are_named(call: Callable[[], Any], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        call()


def test_too_many_spheres_are_refused_before_they_are_read() -> None:
    many = np.zeros(
        (octocell._native.max_spheres + 1, 4), np.float32
    )  # pages that are never touched
    with pytest.raises(octocell.LimitError, match="268435457 spheres"):
        octocell.count(many)


def test_a_layout_that_does_not_fit_is_refused() -> None:
    with pytest.raises(MemoryError, match=r"the matrix: .* GiB are needed"):
        octocell.pairs(FOUR).to_matrix(10**12)


def test_a_device_that_is_not_there_is_refused() -> None:
    reason = octocell.why_unavailable("cuda")
    if reason is None:
        pytest.skip("a GPU can be used here")
    with pytest.raises(octocell.Unavailable, match=re.escape(reason)):
        octocell.pairs(FOUR, device="cuda")
    assert octocell.why_unavailable("cpu") is None


def test_objects_can_be_used_after_an_error() -> None:
    finder = octocell.Finder()
    broken = FOUR.copy()
    broken[1, 0] = np.nan
    assert finder.find(FOUR).count == 3
    with pytest.raises(octocell.InvalidSphere):
        finder.find(broken)
    assert finder.find(FOUR).count == 3


def test_arrays_on_a_gpu_are_refused_with_the_way_out() -> None:
    class OnGpu:
        shape = (4, 4)

        def __dlpack_device__(self) -> tuple[int, int]:
            return 2, 0

        def __dlpack__(self, **_: Any) -> Any:
            raise AssertionError("must not be read")

    class OfNumba:
        __cuda_array_interface__: dict[str, Any] = {}  # noqa: RUF012

    for array in (OnGpu(), OfNumba()):
        with pytest.raises(NotImplementedError, match=r"centers lie on a GPU.*\.cpu\(\)"):
            octocell.pairs(array)
        with pytest.raises(NotImplementedError, match=r"radii lie on a GPU"):
            octocell.pairs(CENTERS, array)
