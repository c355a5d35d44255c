# SPDX-License-Identifier: MIT
import numpy as np

PHANTOM, LOWEST = 1 << 31, (1 << 28, 1 << 29, 1 << 30)


def cells_of(v, grid, axis):
    cells = np.floor((v.astype(np.float64) - grid.corner[axis]) / grid.side)
    return np.clip(cells, 0, grid.cells[axis] - 1).astype(np.int64)


def cell_ids(spheres, grid):
    home = [cells_of(spheres[:, a], grid, a) for a in range(3)]
    ids = home[0] + grid.cells[0] * (home[1] + grid.cells[1] * home[2])
    objects = np.arange(len(spheres))
    # Your part: behind the homes, the other cells that each sphere's box meets, and the four
    # control bits of all entries.
    return ids, objects
