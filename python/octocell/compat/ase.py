# SPDX-License-Identifier: MIT
"""ase.neighborlist.neighbor_list: the neighbors of atoms, by quantities."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._float64 import Limits, both_ways, distances, pairs_within, points_of


def neighbor_list(
    quantities: str,
    a: Any,
    cutoff: float | Mapping[tuple[Any, Any], float] | ArrayLike,
    self_interaction: bool = False,
    max_nbins: float = 1e6,
) -> Any:
    """Returns the neighbors of all atoms: those that are less than a cutoff away.

    ``quantities`` names what is returned: i and j, ids in both orders, sorted by (i, j); d, the
    distance; D, the vector from i to j; S, the shift, which is zero without a periodic cell.
    ``cutoff`` is a number, a dict by pairs of elements, or a radius for each atom. Periodic cells
    are not supported. ``max_nbins`` is ignored: memory does not depend on the size of the cell.

    >>> import ase
    >>> from octocell.compat.ase import neighbor_list
    >>> i, j, d = neighbor_list("ijd", ase.Atoms("H3", [[0, 0, 0], [1, 0, 0], [3, 0, 0]]), 1.5)
    >>> i.tolist(), j.tolist(), d.tolist()
    ([0, 1], [1, 0], [1.0, 1.0])
    """
    unknown = set(quantities) - set("ijdDS")
    if unknown or not quantities:
        raise ValueError(f"quantities={quantities!r}: must be of the letters i, j, d, D, S")
    if np.any(a.pbc):
        raise NotImplementedError("periodic cells are not supported")
    points = points_of(a.positions, "positions")
    most, limits = _limits(a, cutoff)
    pairs = pairs_within(points, most, limits=limits, strict=True)
    i, j = both_ways(pairs, len(points))
    if self_interaction:
        own: NDArray[np.int64] = np.arange(len(points) if most > 0 else 0, dtype=np.int64)
        if limits is not None:  # elements without a cutoff are no neighbors of themselves either
            own = own[limits(np.column_stack([own, own]).astype(np.int32)) > 0]
        i, j = _sorted(np.concatenate([i, own]), np.concatenate([j, own]))
    vectors, lengths = distances(points, i, j)
    shifts = np.zeros((len(i), 3), np.int64)
    values: dict[str, NDArray[Any]] = {"i": i, "j": j, "d": lengths, "D": vectors, "S": shifts}
    chosen = tuple(values[quantity] for quantity in quantities)
    return chosen if len(chosen) > 1 else chosen[0]


def _limits(atoms: Any, cutoff: Any) -> tuple[float, Limits | None]:
    """Returns the largest cutoff, and the function that gives each pair its own."""
    if isinstance(cutoff, Mapping):
        return _limits_by_element(atoms, cutoff)
    if np.isscalar(cutoff):
        return float(cutoff), None  # type: ignore[arg-type]
    radii = np.asarray(cutoff, np.float64)
    if radii.shape != (len(atoms),):
        raise ValueError(f"cutoff has the shape {radii.shape}: must be ({len(atoms)},)")
    return 2 * float(radii.max(initial=0)), lambda ids: radii[ids[:, 0]] + radii[ids[:, 1]]


def _limits_by_element(
    atoms: Any, cutoff: Mapping[tuple[Any, Any], float]
) -> tuple[float, Limits | None]:
    from ase.data import atomic_numbers

    numbers = np.asarray(atoms.numbers)
    table = np.full((numbers.max(initial=0) + 1,) * 2, -1.0)  # no limit: no pair
    for elements, limit in cutoff.items():
        first, second = (atomic_numbers[e] if isinstance(e, str) else int(e) for e in elements)
        if max(first, second) < len(table):
            table[first, second] = table[second, first] = limit

    def limits(ids: NDArray[np.int32]) -> NDArray[np.float64]:
        chosen: NDArray[np.float64] = table[numbers[ids[:, 0]], numbers[ids[:, 1]]]
        return chosen

    return max([0.0, *map(float, cutoff.values())]), limits


def _sorted(
    i: NDArray[np.int64], j: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    order = np.lexsort((j, i))
    return i[order], j[order]
