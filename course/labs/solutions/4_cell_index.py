# SPDX-License-Identifier: MIT
import numpy as np

PHANTOM = 1 << 31


def cell_index(ids, objects):
    if len(ids) == 0:
        return np.empty((0, 3), np.int64)
    begins = np.concatenate([[0], 1 + np.flatnonzero(ids[1:] != ids[:-1])])
    sizes = np.diff(np.append(begins, len(ids)))
    phantoms = np.add.reduceat((objects & PHANTOM != 0).astype(np.int64), begins)
    cells = np.column_stack([begins, sizes - phantoms, phantoms])
    return cells[sizes >= 2]
