# SPDX-License-Identifier: MIT
import numpy as np

SPHERE = (1 << 28) - 1


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
            others = here[k + 1 :] & SPHERE
            # Your part: only those whose pair with here[k] counts in this cell.
            i = np.full(len(others), here[k] & SPHERE)
            kept = overlap(s[i], s[others])
            found.append(np.column_stack([i[kept], others[kept]]))
    return np.concatenate(found)
