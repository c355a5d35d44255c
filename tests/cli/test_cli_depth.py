# SPDX-License-Identifier: MIT
"""Compares `octocell find --depth` and `--depth-check` with rational arithmetic."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from exact import Depths, depth_is_within, exact_pairs
from hard_scenes import SCENES
from program import Octocell, Refused


def depths_of(octocell: Octocell, scene: object, folder: Path, *args: object) -> Depths:
    """What `find --depth` writes, after a look at its form."""
    octocell.ok("find", scene, "--depth", folder / "depths.npy", *args)
    depths: Depths = np.load(folder / "depths.npy")
    assert (depths.dtype, depths.ndim) == (np.float32, 1)
    return depths


@pytest.mark.parametrize("name", SCENES)
def test_depths_are_the_nearest_floats(octocell: Octocell, name: str, tmp_path: Path) -> None:
    path, spheres = tmp_path / "scene.npy", SCENES[name]
    np.save(path, spheres)
    depths = depths_of(octocell, path, tmp_path, "-o", tmp_path / "pairs.npy")
    pairs = np.load(tmp_path / "pairs.npy")
    assert pairs.tolist() == exact_pairs(spheres).tolist()
    assert len(depths) == len(pairs)
    for (i, j), depth in zip(pairs.tolist(), depths.tolist(), strict=True):
        assert depth_is_within(spheres[i], spheres[j], depth, Fraction("0.5000025"))


def test_depths_alone_and_of_other_backends_are_the_same(
    octocell: Octocell, tmp_path: Path
) -> None:
    depths = depths_of(octocell, "poly:n=2000", tmp_path).tobytes()
    assert [path.name for path in tmp_path.iterdir()] == ["depths.npy"]
    for how in (("--method", "brute_force"), ("--backend", "bullet_dbvt"), ("--threads", "3")):
        assert depths_of(octocell, "poly:n=2000", tmp_path, *how).tobytes() == depths


def test_depth_check_tells_the_error(octocell: Octocell, tmp_path: Path) -> None:
    assert "depth_error_ulp" not in octocell.find("gas:n=500")
    errors = octocell.find("dense:n=2000", "--depth-check")["depth_error_ulp"]
    assert list(errors) == ["median", "p99", "max", "not_nearest"]
    assert 0.2 < errors["median"] < 0.3 < 0.45 < errors["p99"] < errors["max"] <= 0.5000025
    assert errors["not_nearest"] <= 1
    ties = octocell.find("lattice:n=1000", "--depth-check")["depth_error_ulp"]
    assert ties == {"median": 0, "p99": 0, "max": 0, "not_nearest": 0}
    alone = octocell.find("gas:n=1", "--depth-check")["depth_error_ulp"]
    assert alone["max"] == 0
    text = octocell.ok("find", "dense:n=2000", "--depth-check").stdout
    assert re.search(
        r"^depth error 0\.\d+ ULP median, 0\.\d+ p99, 0\.\d+ max; ", text, re.MULTILINE
    )


DEPTH_REFUSALS = {
    "count": (["--count", "--depth", "d.npy"], ["--count", "no depths"]),
    "count_check": (["--count", "--depth-check"], ["--count", "no depths"]),
    "no_name": (["--depth", ""], ["--depth", "the file name is empty"]),
    "wrong_ending": (["--depth", "d.csv"], ["d.csv", ".npy"]),
    "same_file": (["--depth", "d.npy", "-o", "./d.npy"], ["d.npy", "a file each"]),
    "no_folder": (["--depth", "absent/d.npy", "-o", "p.npy"], ["absent/d.npy"]),
    "no_folder_for_pairs": (["--depth", "d.npy", "-o", "absent/p.npy"], ["absent/p.npy"]),
}


@pytest.mark.parametrize("name", DEPTH_REFUSALS)
def test_depths_that_cannot_be_written(refused: Refused, name: str) -> None:
    arguments, words = DEPTH_REFUSALS[name]
    line = refused("find", "gas:n=200", *arguments)
    assert all(word in line for word in words), line
