# SPDX-License-Identifier: MIT
"""`octocell find --box --periodic --cutoff --shifts` against rational numbers."""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from program import Octocell

SKEWED = [[4, 0, 0], [1, 5, 0], [-1.5, 2, 6]]


def written(rows: list[list[float]]) -> str:
    return ",".join(str(number) for row in rows for number in row)


def pairs_by_definition(
    spheres: np.ndarray, box: list[list[float]], axes: str = "xyz", cutoff: str = "0"
) -> list[tuple[int, ...]]:
    """All (i, j, S), with the shifts that such small boxes can need."""
    exact = [[Fraction(float(number)) for number in sphere] for sphere in spheres]
    vectors = [[Fraction(float(np.float32(number))) for number in row] for row in box]
    steps = [range(-4, 5) if axis in axes else range(1) for axis in "xyz"]
    found = []
    for shift in product(*steps):
        moved = [sum(s * vectors[a][k] for a, s in enumerate(shift)) for k in range(3)]
        for i, p in enumerate(exact):
            for j, q in enumerate(exact[i:], i):
                if i == j and shift <= (0, 0, 0):
                    continue
                distance2 = sum((p[k] - q[k] + moved[k]) ** 2 for k in range(3))
                if distance2 <= (p[3] + q[3] + Fraction(cutoff)) ** 2:
                    found.append((i, j, *shift))
    return sorted(found)


@pytest.fixture(name="spheres")
def _spheres() -> np.ndarray:
    random = np.random.default_rng(7)
    places = random.uniform(0, 1, (12, 3)) @ np.array(SKEWED)
    return np.column_stack((places, random.uniform(0.5, 1.5, 12))).astype(np.float32)


@pytest.mark.parametrize("axes", ["xyz", "x", "yz"])
@pytest.mark.parametrize("cutoff", ["0", "0.5"])
def test_pairs_and_shifts_are_those_of_the_definition(
    octocell: Octocell, tmp_path: Path, spheres: np.ndarray, axes: str, cutoff: str
) -> None:
    scene, pairs, shifts = (tmp_path / name for name in ("s.npy", "pairs.npy", "shifts.npy"))
    np.save(scene, spheres)
    expected = pairs_by_definition(spheres, SKEWED, axes, cutoff)
    answer = octocell.find(
        scene, "--box", written(SKEWED), "--periodic", axes, "--cutoff", cutoff,
        "-o", pairs, "--shifts", shifts,
    )  # fmt: skip
    assert answer["pairs"] == len(expected) > 5
    assert (answer["box"], answer["periodic"]) == (SKEWED, axes)
    assert np.load(shifts).dtype == np.int32
    found = np.column_stack((np.load(pairs).astype(np.int64), np.load(shifts)))
    assert [tuple(row) for row in found.tolist()] == expected
    counted = octocell.find(
        scene, "--box", written(SKEWED), "--periodic", axes, "--cutoff", cutoff, "--count"
    )
    assert counted["pairs"] == len(expected)


@pytest.mark.parametrize("backend", ["impl_cpu", "impl_thrust", "fcl_dynamic_aabb_tree"])
def test_every_backend_finds_the_same(octocell: Octocell, backend: str) -> None:
    # A lattice in its own cell: each sphere touches six others, across all borders.
    found = octocell.find("lattice:n=8000", "--box", "20", "--backend", backend)
    assert not found["compared_directly"]
    assert found["pairs"] == octocell.find("lattice:n=8000", "--box", "20")["pairs"]


def test_a_cutoff_needs_no_box(octocell: Octocell) -> None:
    wider = octocell.find("chain:n=200", "--cutoff", "1.5")["pairs"]
    assert wider > octocell.find("chain:n=200")["pairs"]


def test_the_text_names_the_box_as_it_was_rounded(octocell: Octocell) -> None:
    text = octocell.ok("find", "gas:n=100", "--box", "10.1,20,30", "--periodic", "xz").stdout
    assert "box         (10.1, 0, 0)  (0, 20, 0)  (0, 0, 30), repeats along xz" in text


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["--box", "0"], "box: its periodic vectors are zero, or lie in one plane"),
        (["--box", "1,2,3,2,4,6,0,0,1"], "box: its periodic vectors are zero, or lie in one plane"),
        (["--box", "inf"], "box: vector a is (inf, 0, 0); its numbers must be finite"),
        (["--box", "1,x,2"], "--box 1,x,2: 'x' is not a float32"),
        (["--box", "1,2"], "--box 1,2: 2 numbers; must be 1 (a cube), 3 (a cuboid) or 9"),
        (["--box", ""], "is not a float32"),
        (["--box", "9", "--periodic", "xq"], "--periodic xq: must name vectors of the box"),
        (["--box", "9", "--periodic", "xx"], "--periodic xx: must name vectors of the box"),
        (["--box", "9", "--periodic", ""], "--periodic: names no vector of the box"),
        (["--periodic", "x"], "--periodic: there is no --box"),
        (["--shifts", "s.npy"], "--shifts: there is no --box"),
        (["--box", "9", "--shifts", "s.npy", "--count"], "nothing to write to --shifts"),
        (["--box", "9", "--shifts", "s.csv"], "the name must end in .npy"),
        (["--box", "9", "-o", "s.npy", "--shifts", "s.npy"], "s.npy"),
        (["--box", "9", "--depth", "d.npy"], "--box and --cutoff: not with --depth"),
        (["--box", "9", "--predicate", "f32"], "can be wrong"),
        (["--cutoff", "-1"], "cutoff -1: must be 0, or from"),
        (["--cutoff", "inf"], "cutoff inf: must be 0, or from"),
        (["--box", "1e-9"], "boxes apart along vector a; this implementation's limit is"),
    ],
)
def test_what_cannot_be_done_is_one_line(
    octocell: Octocell, arguments: list[str], line: str, tmp_path: Path
) -> None:
    result = octocell.run("find", "gas:n=50", *arguments, cwd=tmp_path)
    assert result.rc == 2
    assert line in result.stderr
    assert len(result.stderr.splitlines()) == 1
    assert not list(tmp_path.iterdir())
