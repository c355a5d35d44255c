# SPDX-License-Identifier: MIT
"""The definition, spelt out: which spheres overlap over the reals. Shares nothing with the C++."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

Pairs = NDArray[np.uint32]  # (m, 2), i < j, sorted


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
