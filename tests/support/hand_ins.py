# SPDX-License-Identifier: MIT
"""Lists of pairs as programs with one flaw each make them, for `octocell judge`."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from hard_scenes import Spheres
from numpy.typing import NDArray

Pairs = NDArray[np.int64]  # (m, 2)
Mask = NDArray[np.bool_]


def balls(n: int = 900, side: float = 16.0, seed: int = 3) -> Spheres:
    """A box around the origin with about 2 n pairs, radii 0.5 to 1."""
    random = np.random.default_rng(seed)
    places = (random.random((n, 3)) - 0.5) * side
    return np.column_stack([places, random.uniform(0.5, 1, n)]).astype(np.float32)


def homes(spheres: Spheres, side: float, origin: Any = 0.0) -> NDArray[np.int64]:
    """Each sphere's home cell, in float32 as a program has it."""
    places = (spheres[:, :3] - np.float32(origin)) / np.float32(side)
    return np.floor(places).astype(np.int64)


def steps(spheres: Spheres, pairs: Pairs, side: float, origin: Any = 0.0) -> NDArray[np.int64]:
    """From the home of i to that of j."""
    cells = homes(spheres, side, origin)
    return cells[pairs[:, 1]] - cells[pairs[:, 0]]


def have_negative(spheres: Spheres, pairs: Pairs) -> Mask:
    negative = (spheres[:, :3] < 0).any(axis=1)
    return negative[pairs].any(axis=1)


def depths(spheres: Spheres, pairs: Pairs) -> NDArray[np.float64]:
    a, b = (spheres[pairs[:, k]].astype(np.float64) for k in (0, 1))
    return a[:, 3] + b[:, 3] - np.linalg.norm(a[:, :3] - b[:, :3], axis=1)


def first_partners(pairs: Pairs, most: int) -> Mask:
    """The first `most` pairs of each lower id; `pairs` are sorted."""
    begin = np.searchsorted(pairs[:, 0], pairs[:, 0])
    return np.arange(len(pairs)) - begin < most


def all_pairs(spheres: Spheres) -> Pairs:
    i, j = np.triu_indices(len(spheres), 1)
    return np.column_stack([i, j]).astype(np.int64)


def phantom_cells(sphere: NDArray[np.float32], home: tuple[int, ...], side: float) -> set[Any]:
    """The neighbours of the home that the ball meets."""
    found = set()
    for step in product((-1, 0, 1), repeat=3):
        cell = np.add(home, step)
        low = cell * side
        gap = np.maximum(np.maximum(low - sphere[:3], sphere[:3] - (low + side)), 0)
        if (gap**2).sum() <= sphere[3] ** 2:
            found.add(tuple(int(c) for c in cell))
    return found - {home}


def found_with_cells_cast_to_int(spheres: Spheres, pairs: Pairs) -> Mask:
    """Cells of 2 r_max by a cast to int; any two spheres that one cell lists are tested."""
    side = float(2 * spheres[:, 3].max())
    cells = np.trunc(spheres[:, :3] / np.float32(side)).astype(int)
    homes = [tuple(int(c) for c in cell) for cell in cells]
    listed = [{h} | phantom_cells(s, h, side) for s, h in zip(spheres, homes, strict=True)]
    return np.array([bool(listed[i] & listed[j]) for i, j in pairs])
