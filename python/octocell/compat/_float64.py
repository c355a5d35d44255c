# SPDX-License-Identifier: MIT
"""All pairs of float64 points within a distance."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _native
from .._foreign import to_numpy
from .._input import options_of

# Limits of the pairs (P, 2), if they differ from pair to pair.
Limits = Callable[[NDArray[np.int32]], NDArray[np.float64]]


def points_of(given: Any, name: str, columns: tuple[int, ...] = (3,)) -> NDArray[np.float64]:
    """Returns points as (N, 3) float64; axes that are missing are zero."""
    array = to_numpy(given, name)
    if array.ndim != 2 or array.shape[1] not in columns or array.dtype.kind not in "iufb":
        wanted = " or ".join(f"(N, {width})" for width in columns)
        raise ValueError(f"{name}: {array.dtype} of shape {array.shape}, must be numbers {wanted}")
    points = np.zeros((len(array), 3))
    points[:, : array.shape[1]] = array
    return points


def pairs_within(
    points: NDArray[np.float64],
    most: float,
    *,
    limits: Limits | None = None,
    strict: bool = False,
    batch: NDArray[Any] | None = None,
    threads: int = 0,
) -> NDArray[np.int32]:
    """Returns all pairs i < j, sorted, at most `most` apart; if `strict`, less than it.

    With `limits`, each pair has a limit of its own, which is at most `most`. With `batch`, both
    points must have the same number there.
    """
    if not most >= 0:
        raise ValueError(f"a distance of {most}: must be 0 or more")
    if not np.isfinite(most):
        raise ValueError(f"a distance of {most}: must be finite")
    spheres = np.column_stack([points, np.full(len(points), 0.5 * most)])
    _, wide = _native.rounded(spheres)
    options = options_of(len(wide), threads, True, "cpu", None)
    found = _native.find(wide, options)
    ids = found.view(np.int32)
    if batch is not None:
        found = np.ascontiguousarray(found[batch[ids[:, 0]] == batch[ids[:, 1]]])
    given = np.array([most]) if limits is None else limits(found.view(np.int32))
    chosen = _native.near(points, found, given, strict)
    kept: NDArray[np.int32] = (found if chosen.all() else found[chosen]).view(np.int32)
    return kept


def both_ways(pairs: NDArray[np.int32], count: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Returns every pair as (i, j) and as (j, i), sorted."""
    indptr, indices = _native.csr(pairs.view(np.uint32), count, True)
    first = np.repeat(np.arange(count, dtype=np.int64), np.diff(indptr))
    return first, indices.astype(np.int64)


def distances(
    points: NDArray[np.float64], i: NDArray[Any], j: NDArray[Any]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Returns the vectors from i to j, and their lengths, in float64 arithmetic."""
    vectors = points[j] - points[i]
    return vectors, np.sqrt((vectors * vectors).sum(axis=1))
