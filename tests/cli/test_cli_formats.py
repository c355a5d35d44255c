# SPDX-License-Identifier: MIT
"""Which files octocell reads, and what it says of those that only octocell-import reads."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from octocell_import.formats import FORMATS

from hard_scenes import SCENES
from program import ROOT, Octocell, Refused
from scene_input import read

GAS = np.ascontiguousarray(SCENES["gas"], dtype=np.float32)
OURS = {".npy", ".csv", ".tsv", ".txt", ".dat", ".xyzr", ".spheres", ".pqr"}
IMPORTERS = sorted({suffix for known in FORMATS.values() for suffix in known} - OURS)


@pytest.mark.parametrize("suffix", [s + p for s in IMPORTERS for p in ("", ".gz", ".bz2", ".xz")])
def test_the_importers_formats_are_named_with_its_command(
    refused: Refused, tmp_path: Path, suffix: str
) -> None:
    (tmp_path / f"a{suffix.upper()}").write_bytes(b"any")
    line = refused("find", f"a{suffix.upper()}")
    assert f"octocell-import a{suffix.upper()} -o a.npy" in line


def test_no_other_suffix_is_named() -> None:
    """The other direction: what C++ lists as the importer's is what the importer knows."""
    text = (ROOT / "harness/files/format.cpp").read_text(encoding="utf-8")
    listed = re.search(r"kImporters\[\] = \{(.*?)\};", text, re.DOTALL)
    assert listed and set(re.findall(r'"(\.\w+)"', listed[1])) == set(IMPORTERS)


def test_the_files_that_are_read_are_listed(octocell: Octocell) -> None:
    listed = octocell.ok("list").stdout
    assert all(f"{suffix}," in listed for suffix in OURS)


def test_an_unknown_suffix(refused: Refused, tmp_path: Path) -> None:
    for name in ("./scene.foo", "./scene", "./scene.gz"):
        (tmp_path / name).write_bytes(b"1,2,3,4\n")
        line = refused("find", name)
        assert "--format" in line and ".npy, .csv" in line
    assert "unknown format 'xls'; known: npy, table, pqr" in refused(
        "find", "scene.foo", "--format", "xls"
    )


def test_options_that_say_nothing_of_a_format(refused: Refused, tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", GAS)
    for option in (["--columns", "x,y,z,r"], ["--decimal-comma"], ["--frame", "1"]):
        assert f"{option[0]} does not go with format npy" in refused("find", "a.npy", *option)
    for option in (["--radius", "1"], ["--drop-invalid"], ["--format", "npy"]):
        assert f"{option[0]} cannot be used" in refused("find", "gas:n=9", *option)
    for radius in ("-1", "nan", "inf", "1e39", "one", ""):
        assert "--radius" in refused("find", "a.npy", "--radius", radius)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_an_array_without_radii(octocell: Octocell, tmp_path: Path, kind: type) -> None:
    np.save(tmp_path / "a.npy", GAS[:, :3].astype(kind))
    options = ["--radius", "0.1"] + (["--round-input"] if kind is np.float64 else [])
    spheres, _ = read(octocell, tmp_path / "a.npy", *options)
    np.testing.assert_array_equal(spheres[:, :3], GAS[:, :3])
    assert (spheres[:, 3] == np.float32(0.1)).all()
    assert octocell.find(tmp_path / "a.npy", *options)["scene"].endswith("a.npy --radius 0.1")


def test_radii_once_and_only_once(refused: Refused, tmp_path: Path) -> None:
    np.save(tmp_path / "points.npy", GAS[:, :3])
    np.save(tmp_path / "spheres.npy", GAS)
    assert "has no radii; --radius R" in refused("find", "points.npy")
    assert "has radii; --radius is for" in refused("find", "spheres.npy", "--radius", "1")


def test_every_command_takes_the_options(octocell: Octocell, tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("0 0 0\n1 0 0\n", encoding="utf-8")
    scene = (tmp_path / "a.txt", "--radius", "1")
    for command in ("find", "explain", "check"):
        octocell.ok(command, *scene)
    listed = octocell.ok("bench", *scene, "--benchmark_list_tests").stdout
    assert "a" in listed and "2" in listed
