# SPDX-License-Identifier: MIT
"""torch_cluster.radius_graph: edges between all points within a distance."""

from __future__ import annotations

from typing import Any

import numpy as np

from .._foreign import to_numpy
from ._float64 import both_ways, pairs_within, points_of


def radius_graph(
    x: Any,
    r: float,
    batch: Any = None,
    loop: bool = False,
    max_num_neighbors: int = 32,
    flow: str = "source_to_target",
    num_workers: int = 1,
    batch_size: int | None = None,
) -> Any:
    """Returns edges (2, E), int64, between all points that are at most ``r`` apart.

    ``x`` is a tensor (N, 1) to (N, 3) on the CPU, and ``batch`` an integer for each point: only
    points of one batch are joined. Edges are sorted by target, or by source with
    ``flow="target_to_source"``.

    **Nothing is left out.** The original keeps at most ``max_num_neighbors`` neighbors of a point,
    32 by default, and says nothing about those that it drops. Here the argument is accepted and has
    no effect; neither have ``num_workers`` and ``batch_size``.
    """
    import torch

    if flow not in ("source_to_target", "target_to_source"):
        raise ValueError(f'flow={flow!r}: must be "source_to_target" or "target_to_source"')
    table = x.detach()
    points = points_of(table[:, None] if table.ndim == 1 else table, "x", (1, 2, 3))
    groups = None
    if batch is not None:
        groups = to_numpy(batch, "batch")
        if groups.shape != (len(points),):
            raise ValueError(f"batch has the shape {groups.shape}: must be ({len(points)},)")
    pairs = pairs_within(points, float(r), batch=groups, threads=max(num_workers, 0))
    first, second = both_ways(pairs, len(points))
    if loop:
        own = np.arange(len(points))
        first, second = np.concatenate([first, own]), np.concatenate([second, own])
        order = np.lexsort((second, first))
        first, second = first[order], second[order]
    rows = (second, first) if flow == "source_to_target" else (first, second)
    return torch.from_numpy(np.stack(rows))
