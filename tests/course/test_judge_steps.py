# SPDX-License-Identifier: MIT
"""`octocell judge` on the steps of course/pipeline: each flaw has its name."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hand_ins import Pairs, balls
from hard_scenes import Spheres, spheres
from judging import Judge
from pipeline_steps import STEPS, build, pairs_of, printed
from program import Octocell


@pytest.fixture
def judge(octocell: Octocell, tmp_path: Path) -> Judge:
    return Judge(octocell, tmp_path)


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("pipeline")
    return [build(step, folder) for step in STEPS]


def across_edges(side: float) -> Spheres:
    """Couples on both sides of an edge of cells, so that neither ball reaches the other's home."""
    random = np.random.default_rng(5)
    corners = np.stack(np.meshgrid(*[np.arange(1, 8)] * 2), axis=-1).reshape(-1, 2) * side
    near = np.column_stack([corners - 0.65, random.uniform(1, 2, len(corners))])
    far = near + np.array([1.35, 1.35, 0])
    return np.column_stack([np.concatenate([near, far]), np.ones(98)]).astype(np.float32)


def course_scene(step: int) -> Spheres:
    """Spheres among which the flaws that the next steps mend show."""
    random = np.random.default_rng(step)
    if step == 4:
        crowd = balls(500, 13, seed=step) + np.float32([-20, -20, 0, 0])
        return np.concatenate([crowd, across_edges(3 * 2**0.5)])
    if step == 6:  # a part of it so far from the origin that float32 has steps of 1
        near = np.column_stack([random.random((500, 3)) * 10, np.ones(500)])
        places = random.permutation(np.stack(np.meshgrid(*[np.arange(9)] * 3)).reshape(3, -1).T)
        far = np.column_stack([places[:400] + [10_000_000, 0, 0], np.full(400, 0.5)])
        return np.concatenate([near, far]).astype(np.float32)
    if step == 7:  # a lattice whose diagonals are the sums of two radii in decimals
        a, b, layer = np.stack(np.meshgrid(*[np.arange(9)] * 3)).reshape(3, -1)
        radii = random.choice([0.38, 0.57], 729)
        return spheres(0.57 * a, 0.76 * b, 10 * layer, radii)
    return balls(500, 13, seed=step)


def found_by(program: Path, scene: Spheres, folder: Path) -> Pairs:
    np.savetxt(folder / "scene.csv", scene, fmt="%.9g", delimiter=",")
    found = pairs_of(printed(program, folder / "scene.csv"))
    return np.array(found, np.int64).reshape(-1, 2)


PARTS = {
    1: {"unsigned cells", "smaller home only", "both phantoms"},
    2: {"eight slots", "smaller home only", "both phantoms"},
    3: {"eight slots", "smaller home only", "both phantoms"},
    4: {"smaller home only", "both phantoms"},
}


@pytest.mark.parametrize("step", [1, 2, 3, 4])
def test_the_text_and_its_first_steps(
    judge: Judge, programs: list[Path], tmp_path: Path, step: int
) -> None:
    scene = course_scene(step)
    cause = judge(judge.save(scene), found_by(programs[step - 1], scene, tmp_path))["cause"]
    assert cause["name"] == "rule of the course text" and cause["right_with"] == 0
    parts = {part["name"] for part in cause["parts"]}
    assert PARTS[step] <= parts <= PARTS[step] | {"eight slots", "several"}, parts
    assert sum(part["count"] for part in cause["parts"]) == cause["wrong"]


@pytest.mark.parametrize(
    ("step", "name"), [(5, "smaller home only"), (6, "no common cell"), (7, "float32 test")]
)
def test_steps_with_one_flaw_have_its_name(
    judge: Judge, programs: list[Path], tmp_path: Path, step: int, name: str
) -> None:
    scene = course_scene(step)
    found = found_by(programs[step - 1], scene, tmp_path)
    assert judge.cause(judge.save(scene), found) == name
    exact = found_by(programs[7], scene, tmp_path)
    assert judge(judge.save(scene), exact)["verdict"] == "exact"


def test_the_last_step_is_exact(judge: Judge, programs: list[Path], tmp_path: Path) -> None:
    scene = balls(500, 13)
    assert judge(judge.save(scene), found_by(programs[7], scene, tmp_path))["missed"] == 0
