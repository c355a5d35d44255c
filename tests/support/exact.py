# SPDX-License-Identifier: MIT
"""The definition in Python: which spheres overlap over the reals. Shares no code with the C++."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

Pairs = NDArray[np.uint32]  # (m, 2), i < j, sorted
Depths = NDArray[np.float32]  # (m,), as the pairs


def exact_pairs(spheres: NDArray[np.float32] | NDArray[np.float64]) -> Pairs:
    """All (i, j) with |p - q|^2 <= (r_i + r_j)^2, without any rounding."""
    # One unit for all numbers makes them integers, which Python multiplies faster than Fractions.
    rows = [[Fraction(float(value)) for value in row] for row in spheres]
    unit = max((f.denominator for row in rows for f in row), default=1)
    whole = [[f.numerator * (unit // f.denominator) for f in row] for row in rows]
    found = [
        (i, j)
        for (i, a), (j, b) in combinations(enumerate(whole), 2)
        if sum((p - q) ** 2 for p, q in zip(a[:3], b[:3], strict=True)) <= (a[3] + b[3]) ** 2
    ]
    return np.array(found, np.uint32).reshape(-1, 2)


def depth_is_within(
    a: NDArray[np.float32], b: NDArray[np.float32], depth: float, ulps: Fraction
) -> bool:
    """Is r_a + r_b - |p - q| so near to `depth`, in units of float32's last place there?"""
    p, q = ([Fraction(float(value)) for value in row] for row in (a, b))
    reach, distance2 = p[3] + q[3], sum((s - t) ** 2 for s, t in zip(p[:3], q[:3], strict=True))
    if np.isinf(depth):  # what is no nearer to the largest float than to 2^128
        most = Fraction(2**128 - 2**103)
        return depth > 0 and reach >= most and (reach - most) ** 2 >= distance2
    unit = Fraction(2) ** max(int(np.frexp(depth)[1]) - 24, -149)
    # reach - |p - q| <= high if and only if |p - q| >= reach - high; squares decide, without roots.
    low, high = Fraction(depth) - ulps * unit, Fraction(depth) + ulps * unit
    return (reach - high <= 0 or (reach - high) ** 2 <= distance2) and (
        reach - low >= 0 and (reach - low) ** 2 >= distance2
    )


def checksum(pairs: Pairs) -> str:
    """The sum of splitmix64-mixed pairs, as `find` prints it."""
    mask = 2**64 - 1
    total = 0
    for i, j in pairs.tolist():
        z = ((i << 32 | j) + 0x9E3779B97F4A7C15) & mask
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9 & mask
        z = (z ^ z >> 27) * 0x94D049BB133111EB & mask
        total += z ^ z >> 31
    return f"{total & mask:#018x}"
