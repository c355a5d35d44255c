# SPDX-License-Identifier: MIT
"""sklearn.neighbors.radius_neighbors_graph: the neighbors of each point, as a sparse matrix."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _native
from ._float64 import distances, pairs_within, points_of


def radius_neighbors_graph(
    X: Any,
    radius: float,
    *,
    mode: str = "connectivity",
    metric: str = "minkowski",
    p: float = 2,
    metric_params: dict[str, Any] | None = None,
    include_self: bool | str = False,
    n_jobs: int | None = None,
) -> Any:
    """Returns the graph of all points that are at most ``radius`` apart.

    ``X`` is (N, 1) to (N, 3). The result is a ``scipy.sparse.csr_matrix`` (N, N) of float64: ones,
    or distances with ``mode="distance"``. Columns are sorted. Only Euclidean distances are
    supported. Needs SciPy.

    >>> from octocell.compat.sklearn import radius_neighbors_graph
    >>> radius_neighbors_graph([[0.0], [1.0], [3.0]], 1.5).toarray().tolist()
    [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    """
    from scipy.sparse import csr_matrix

    euclidean = metric in ("euclidean", "l2") or (metric == "minkowski" and p == 2)
    if not euclidean or metric_params:
        raise NotImplementedError(
            f"metric={metric!r} p={p}: only Euclidean distances are supported"
        )
    if mode not in ("connectivity", "distance"):
        raise ValueError(f'mode={mode!r}: must be "connectivity" or "distance"')
    if include_self == "auto":
        include_self = mode == "connectivity"
    points = points_of(X, "X", (1, 2, 3))
    count = len(points)
    threads = n_jobs if n_jobs is not None and n_jobs > 0 else int(n_jobs is None)
    pairs = pairs_within(points, float(radius), threads=threads)
    indptr, indices = _native.csr(pairs.view(np.uint32), count, True)
    if mode == "distance":
        rows = np.repeat(np.arange(count), np.diff(indptr))
        data = distances(points, rows, indices)[1]
    else:
        data = np.ones(len(indices))
    graph = csr_matrix((data, indices, indptr), shape=(count, count))
    if include_self:
        own = csr_matrix(
            (np.full(count, float(mode == "connectivity")), np.arange(count), np.arange(count + 1)),
            shape=(count, count),
        )
        graph = _with_own(graph, own)
    return graph


def _with_own(graph: Any, own: Any) -> Any:
    """Adds entries of the diagonal, which may be zero: a sum would drop these."""
    from scipy.sparse import coo_matrix

    parts = [graph.tocoo(), own.tocoo()]
    data, row, col = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("data", "row", "col")
    )
    return coo_matrix((data, (row, col)), shape=graph.shape).tocsr()
