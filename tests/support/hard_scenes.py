# SPDX-License-Identifier: MIT
"""Small scenes, each hard in its own way; (n, 4) float32: x, y, z, r."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Spheres = NDArray[np.float32]
FLOAT_MAX = float(np.finfo(np.float32).max)
SMALLEST = 2.0**-149


def spheres(*columns: ArrayLike) -> Spheres:
    """Columns x, y, z, r; numbers are repeated."""
    return np.stack(np.broadcast_arrays(*columns), axis=-1).reshape(-1, 4).astype(np.float32)


def _lattice(side: int, spacing: float, r: float, origin: float = 0.0) -> Spheres:
    steps = origin + spacing * np.arange(side)
    x, y, z = np.meshgrid(steps, steps, steps)
    return spheres(x, y, z, r)


def _gas(n: int, side: float, r: ArrayLike, seed: int = 1) -> Spheres:
    places = (np.random.default_rng(seed).random((n, 3)) - 0.5) * side
    return spheres(places[:, 0], places[:, 1], places[:, 2], r)


def _an_ulp_apart() -> Spheres:
    """Couples far from each other, whose gap is one float below, at, or above contact."""
    random = np.random.default_rng(2)
    rows = []
    for k in range(60):
        r, s = random.uniform(0.25, 1.25, 2).astype(np.float32)
        touching = r + s
        gap = np.nextafter(touching, [np.float32(0), touching, np.float32(9)][k % 3])
        couple = np.zeros((2, 4), np.float32)
        couple[1, k % 3] = gap  # exact: the other one sits at 0 on this axis
        couple[:, (k + 1) % 3] = 8 * k
        couple[:, 3] = r, s
        rows.append(couple)
    return np.concatenate(rows)


def _nine_decades() -> Spheres:
    random = np.random.default_rng(3)
    r = 10.0 ** random.uniform(-6, 3, 150)
    scene = _gas(150, 1.0, r, seed=4)
    scene[:, :3] *= np.exp(random.uniform(-6, 8, (150, 1))).astype(np.float32)
    return scene


def _dust_with_couples() -> Spheres:
    dust = _gas(80, 4.0, 0.0, seed=5)
    dust[40:60] = dust[:20]  # points overlap where they coincide
    return dust


def _near_the_end_of_float() -> Spheres:
    m = FLOAT_MAX
    corner = [[m, m, m, m], [-m, -m, -m, m], [m, -m, m, 0], [0, 0, 0, m], [0, 0, 0, SMALLEST]]
    random = np.random.default_rng(6)
    rest = random.uniform(-m, m, (60, 4)) * [1, 1, 1, 0.3]
    rest[:, 3] = abs(rest[:, 3])
    return np.array([*corner, *rest], np.float32)


def _denormals() -> Spheres:
    steps = np.random.default_rng(7).integers(-12, 12, (90, 4))
    steps[:, 3] = abs(steps[:, 3])
    return (steps * SMALLEST).astype(np.float32)


def _one_giant() -> Spheres:
    scene = _gas(120, 9.0, 0.1, seed=8)
    scene[57] = [0, 0, 0, 3]
    return scene


SCENES: dict[str, Spheres] = {
    "gas": _gas(150, 6.0, 0.5),
    "radii_differ": _gas(150, 9.0, np.random.default_rng(9).random(150), seed=10),
    "tangent_lattice": _lattice(5, 1.0, 0.5),
    "lattice_off_by_roundings": _lattice(5, 0.1, 0.05),
    "an_ulp_apart": _an_ulp_apart(),
    "nine_decades_of_radius": _nine_decades(),
    "all_radii_zero": _dust_with_couples(),
    "identical": spheres(np.full(40, 0.1), 0.2, -0.3, 0.5),
    "empty": np.empty((0, 4), np.float32),
    "single": spheres(1, 2, 3, 4),
    "single_point": spheres(0, 0, 0, 0),
    "far_from_the_origin": _lattice(5, 2.0, 1.0, origin=2.0**24),
    "coarser_than_its_spheres": _lattice(4, 8.0, 4.0, origin=1e8),
    "denormals": _denormals(),
    "near_the_end_of_float": _near_the_end_of_float(),
    "one_giant": _one_giant(),
    "flat": _gas(150, 8.0, 0.3, seed=11) * np.array([1, 1, 0, 1], np.float32),
}
