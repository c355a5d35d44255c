# SPDX-License-Identifier: MIT
import numpy as np

PHANTOM = 1 << 31


def cell_index(ids, objects):
    if len(ids) == 0:
        return np.empty((0, 3), np.int64)
    # Your part: a row for each cell with at least two entries: where it begins, how many of its
    # entries are homes, and how many are phantoms.
    begins = np.arange(len(ids))
    return np.column_stack([begins, np.ones_like(begins), np.zeros_like(begins)])
