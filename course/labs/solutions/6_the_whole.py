# SPDX-License-Identifier: MIT
import runpy
from pathlib import Path
from types import SimpleNamespace

import numpy as np


def function(name, file):
    return runpy.run_path(str(Path(__file__).parent / file))[name]


cell_ids = function("cell_ids", "2_cell_ids.py")
sort = function("sort", "3_sort.py")
cell_index = function("cell_index", "4_cell_index.py")
pair_tests = function("pair_tests", "5_pair_tests.py")


def choose_grid(spheres):
    """Cells as wide as the largest sphere, but at most 1000 on an axis: ids fit into 32 bits."""
    low, high = (f(spheres[:, :3].astype(np.float64), axis=0) for f in (np.min, np.max))
    side = max(2.0 * spheres[:, 3].max(), (high - low).max() / 1000) or 1.0
    cells = 1 + ((high - low) / side).astype(np.int64)
    return SimpleNamespace(corner=tuple(low), side=float(side), cells=tuple(map(int, cells)))


def find_pairs(spheres):
    if len(spheres) == 0:
        return []
    grid = choose_grid(spheres)
    key_bits = (int(np.prod(grid.cells)) - 1).bit_length()
    ids, objects = cell_ids(spheres, grid)
    ids, objects = sort(ids, objects, key_bits)
    cells = cell_index(ids, objects)
    return pair_tests(spheres, ids, objects, cells)
