# SPDX-License-Identifier: MIT
import numpy as np

PHANTOM, LOWEST = 1 << 31, (1 << 28, 1 << 29, 1 << 30)


def cells_of(v, grid, axis):
    cells = np.floor((v.astype(np.float64) - grid.corner[axis]) / grid.side)
    return np.clip(cells, 0, grid.cells[axis] - 1).astype(np.int64)


def cell_ids(spheres, grid):
    r = spheres[:, 3]
    axes = range(3)
    home = [cells_of(spheres[:, a], grid, a) for a in axes]
    low = [cells_of(spheres[:, a] - r, grid, a) for a in axes]
    high = [cells_of(spheres[:, a] + r, grid, a) for a in axes]

    # One row for each cell of each box: the sphere, and the number of the cell in its box.
    spans = [high[a] - low[a] + 1 for a in axes]
    boxes = spans[0] * spans[1] * spans[2]
    sphere = np.repeat(np.arange(len(spheres)), boxes)
    number = np.arange(boxes.sum()) - np.repeat(np.cumsum(boxes) - boxes, boxes)
    offset = [
        number % spans[0][sphere],
        number // spans[0][sphere] % spans[1][sphere],
        number // (spans[0] * spans[1])[sphere],
    ]
    cell = [low[a][sphere] + offset[a] for a in axes]
    is_home = np.logical_and.reduce([cell[a] == home[a][sphere] for a in axes])

    ids = cell[0] + grid.cells[0] * (cell[1] + grid.cells[1] * cell[2])
    objects = sphere + sum(np.where(offset[a] == 0, LOWEST[a], 0) for a in axes)
    objects[~is_home] += PHANTOM
    order = np.concatenate([np.flatnonzero(is_home), np.flatnonzero(~is_home)])
    return ids[order], objects[order]
