# SPDX-License-Identifier: MIT
import numpy as np


def overlap(sphere, others):
    """Your part: which of the others does the sphere overlap? Spheres that touch do, too.

    A row is x, y, z, r in float32. Returns an array of True and False."""
    return np.zeros(len(others), bool)


def find_pairs(spheres):
    found = [np.empty((0, 2), np.int64)]
    for i in range(len(spheres) - 1):
        j = i + 1 + np.flatnonzero(overlap(spheres[i], spheres[i + 1 :]))
        found.append(np.column_stack([np.full_like(j, i), j]))
    return np.concatenate(found)
