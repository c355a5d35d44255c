# SPDX-License-Identifier: MIT
"""--drop-invalid leaves out what is no sphere, and says how many and which first."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hard_scenes import SCENES
from program import Octocell, Refused
from scene_input import read

GAS = np.ascontiguousarray(SCENES["gas"], dtype=np.float32)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_of_an_array(octocell: Octocell, tmp_path: Path, kind: type) -> None:
    spheres = GAS.astype(kind)
    spheres[7, 1] = np.nan
    spheres[9, 3] = -1
    spheres[-1, 2] = np.inf
    np.save(tmp_path / "a.npy", spheres)
    options = ["--drop-invalid"] + (["--round-input"] if kind is np.float64 else [])
    kept, said = read(octocell, tmp_path / "a.npy", *options)
    np.testing.assert_array_equal(kept, np.delete(GAS, [7, 9, len(GAS) - 1], axis=0))
    assert f"3 of {len(GAS)} spheres are left out, the first is sphere 7: y is nan" in said


def test_of_numbers_beyond_float32(octocell: Octocell, tmp_path: Path) -> None:
    spheres = GAS[:3].astype(np.float64)
    spheres[1, 0] = 1e39
    np.save(tmp_path / "a.npy", spheres)
    kept, said = read(octocell, tmp_path / "a.npy", "--drop-invalid", "--round-input")
    np.testing.assert_array_equal(kept, GAS[[0, 2]])
    assert "sphere 1: x is 1e+39" in said


def test_of_a_table(octocell: Octocell, tmp_path: Path) -> None:
    rows = ["0,0,0,1,0", "nan,0,0,1,0", "0,,0,1,1", "1e39,0,0,1,0", "0,0,0,-1,0", "1,0,0,1,1"]
    text = "x,y,z,r,static\n" + "\n".join(rows) + "\n"
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    out = tmp_path / "b.csv"
    said = octocell.ok("generate", "a.csv", "--drop-invalid", "-o", out, cwd=tmp_path).stderr
    lines = out.read_text(encoding="utf-8").splitlines()
    assert [line.split(",")[:5] for line in lines[1:]] == [list("00010"), list("10011")]
    assert "4 of 6 spheres are left out, the first is sphere 1: x is nan" in said


def test_of_a_pqr_file(octocell: Octocell, tmp_path: Path) -> None:
    line = "ATOM 1 N GLY A 1 0 0 0 0 {}\n"
    text = "".join(line.format(radius) for radius in ("1", "-1", "1e40", "2"))
    (tmp_path / "a.pqr").write_text(text, encoding="utf-8")
    kept, said = read(octocell, tmp_path / "a.pqr", "--drop-invalid")
    assert kept[:, 3].tolist() == [1, 2] and "2 of 4 spheres are left out" in said


def test_flags_of_a_side_file_go_with_their_spheres(octocell: Octocell, tmp_path: Path) -> None:
    spheres = np.array([[0, 0, 0, 1], [np.nan, 0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 1]], np.float32)
    np.save(tmp_path / "a.npy", spheres)
    np.save(tmp_path / "f.npy", np.array([True, False, True, False]))
    answer = octocell.find(tmp_path / "a.npy", "--drop-invalid", "--flags", tmp_path / "f.npy")
    assert (answer["n"], answer["static"], answer["pairs"]) == (3, 2, 2)
    assert answer["scene"].endswith(f"--drop-invalid --flags {tmp_path}/f.npy")


def test_nothing_is_said_where_nothing_is_left_out(octocell: Octocell, tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", GAS)
    kept, said = read(octocell, tmp_path / "a.npy", "--drop-invalid")
    np.testing.assert_array_equal(kept, GAS)
    assert said == ""


def test_what_is_no_number_stays_refused(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("0,0,0,1\n0,zero,0,1\n", encoding="utf-8")
    assert "a.csv:2: 'zero' is not a number" in refused("find", "a.csv", "--drop-invalid")


def test_of_the_memory_of_bench(octocell: Octocell, tmp_path: Path) -> None:
    """The child process that measures memory reads the file with the same options."""
    (tmp_path / "a.txt").write_text("0 0 0\nnan 0 0\n1 0 0\n", encoding="utf-8")
    arguments = ["--radius", "1", "--drop-invalid", "--row", "impl_cpu planned"]
    found = octocell.ok("measure-memory", tmp_path / "a.txt", *arguments).stdout
    assert '"output_bytes":8' in found
