# SPDX-License-Identifier: MIT
"""scipy.spatial.cKDTree.query_pairs: every pair of points within a distance."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._float64 import pairs_within, points_of


def query_pairs(
    tree: Any, r: float, p: float = 2.0, eps: float = 0, output_type: str = "set"
) -> set[tuple[int, int]] | NDArray[np.intp]:
    """Finds all pairs of points that are at most ``r`` apart, as ``tree.query_pairs(r)`` does.

    ``tree`` is a tree of SciPy or its points, (N, 1) to (N, 3). ``output_type`` is "set", of tuples
    (i, j), or "ndarray", (P, 2) of intp; i < j; the array is sorted. Only ``p=2`` is supported, and
    no periodic box. Answers are exact, which any ``eps`` allows.

    >>> from octocell.compat.scipy import query_pairs
    >>> sorted(query_pairs([[0.0, 0.0], [0.3, 0.4], [9.0, 9.0]], 0.5))
    [(0, 1)]
    """
    if p != 2:
        raise NotImplementedError(f"p={p}: only the Euclidean distance, p=2, is supported")
    if getattr(tree, "boxsize", None) is not None:
        raise NotImplementedError("trees with a periodic box are not supported")
    if output_type not in ("set", "ndarray"):
        raise ValueError(f'output_type={output_type!r}: must be "set" or "ndarray"')
    if eps < 0:
        raise ValueError(f"eps={eps}: must be 0 or more")
    points = points_of(
        getattr(tree, "data", tree) if hasattr(tree, "query_pairs") else tree, "points", (1, 2, 3)
    )
    pairs = pairs_within(points, float(r))
    if output_type == "ndarray":
        return pairs.astype(np.intp)
    return set(map(tuple, pairs.tolist()))
