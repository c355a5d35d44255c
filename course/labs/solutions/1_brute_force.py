# SPDX-License-Identifier: MIT
import numpy as np


def find_pairs(spheres):
    s = spheres.astype(np.float64)
    found = [np.empty((0, 2), np.int64)]
    for i in range(len(s) - 1):
        away = s[i + 1 :] - s[i]
        reach = s[i + 1 :, 3] + s[i, 3]
        j = i + 1 + np.flatnonzero((away[:, :3] ** 2).sum(axis=1) <= reach**2)
        found.append(np.column_stack([np.full_like(j, i), j]))
    return np.concatenate(found)
