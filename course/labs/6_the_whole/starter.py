# SPDX-License-Identifier: MIT
import runpy
from pathlib import Path
from types import SimpleNamespace

import numpy as np


def function(name, lab):
    return runpy.run_path(str(Path(__file__).parent.parent / lab / "starter.py"))[name]


cell_ids = function("cell_ids", "2_cell_ids")
sort = function("sort", "3_sort")
cell_index = function("cell_index", "4_cell_index")
pair_tests = function("pair_tests", "5_pair_tests")


def choose_grid(spheres):
    """Your part, 1: a better side. It must leave at most 1000 cells on an axis, so that ids fit
    into 32 bits."""
    low, high = (f(spheres[:, :3].astype(np.float64), axis=0) for f in (np.min, np.max))
    side = max(0.5 * spheres[:, 3].max(), (high - low).max() / 1000) or 1.0
    cells = 1 + ((high - low) / side).astype(np.int64)
    return SimpleNamespace(corner=tuple(low), side=float(side), cells=tuple(map(int, cells)))


def find_pairs(spheres):
    if len(spheres) == 0:
        return []
    grid = choose_grid(spheres)
    key_bits = (int(np.prod(grid.cells)) - 1).bit_length()
    ids, objects = cell_ids(spheres, grid)
    # Your part, 2: why is there room for eight entries a sphere? Here, phantoms are dropped.
    if len(ids) > 8 * len(spheres):
        ids, objects = ids[: len(spheres)], objects[: len(spheres)]
    ids, objects = sort(ids, objects, key_bits)
    cells = cell_index(ids, objects)
    return pair_tests(spheres, ids, objects, cells)
