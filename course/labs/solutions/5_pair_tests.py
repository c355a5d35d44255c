# SPDX-License-Identifier: MIT
import numpy as np

LOWEST, SPHERE = 7 << 28, (1 << 28) - 1


def overlap(a, b):
    d = a - b
    reach = a[:, 3] + b[:, 3]
    return d[:, 0] ** 2 + d[:, 1] ** 2 + d[:, 2] ** 2 <= reach**2


def pair_tests(spheres, ids, objects, cells):
    s = spheres.astype(np.float64)
    found = [np.empty((0, 2), np.int64)]
    for begin, homes, phantoms in cells.astype(np.int64):
        here = objects[begin : begin + homes + phantoms]
        for k in range(len(here) - 1):
            # Of the cells that two spheres share, one is the lowest on each axis.
            others = here[k + 1 :]
            others = others[(others | here[k]) & LOWEST == LOWEST] & SPHERE
            i = np.full(len(others), here[k] & SPHERE)
            kept = overlap(s[i], s[others])
            found.append(np.column_stack([i[kept], others[kept]]))
    return np.concatenate(found)
