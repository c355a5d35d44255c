# SPDX-License-Identifier: MIT
"""Sweep and prune without a loop over spheres: sort by where spheres begin on x; a sphere meets
those that begin before it ends."""

import numpy as np

MOST_CANDIDATES = 4_000_000  # at a time


def overlap(a, b):
    d = a.astype(np.float64) - b
    reach = a[:, 3].astype(np.float64) + b[:, 3]
    return (d[:, :3] ** 2).sum(axis=1) <= reach**2


def find_pairs(spheres):
    begins = spheres[:, 0] - spheres[:, 3]
    order = np.argsort(begins)
    s = spheres[order]
    ends = np.searchsorted(begins[order], s[:, 0] + s[:, 3], side="right")
    counts = ends - np.arange(len(s)) - 1
    found = [np.empty((0, 2), np.int64)]
    first, before = 0, np.concatenate([[0], np.cumsum(counts)])
    while first < len(s):
        last = max(first + 1, np.searchsorted(before, before[first] + MOST_CANDIDATES) - 1)
        own = counts[first:last]
        i = np.repeat(np.arange(first, last), own)
        j = i + 1 + np.arange(own.sum()) - np.repeat(np.cumsum(own) - own, own)
        kept = overlap(s[i], s[j])
        found.append(order[np.column_stack([i[kept], j[kept]])])
        first = last
    return np.concatenate(found)
