# SPDX-License-Identifier: MIT
"""`--plugin`: a shared library as a row of find, check and stress."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from hand_in_sources import BRUTE_FORCE
from program import ROOT, Octocell, Refused


def library(folder: Path, name: str, text: str = BRUTE_FORCE) -> Path:
    source, target = folder / f"{name}.cpp", folder / f"{name}.so"
    source.write_text(text, encoding="utf-8")
    command = ["c++", "-shared", "-fPIC", "-O2", "-I", ROOT / "include/octocell", source]
    subprocess.run([*command, "-o", target], check=True)
    return target


@pytest.fixture(scope="module")
def plugin(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return library(tmp_path_factory.mktemp("plugin"), "libmine")


@pytest.fixture(scope="module")
def wrong(tmp_path_factory: pytest.TempPathFactory) -> Path:
    text = BRUTE_FORCE.replace("uint32_t j = i + 1", "uint32_t j = i + 2")
    return library(tmp_path_factory.mktemp("plugin"), "wrong", text)


def test_find_takes_the_plugin_unless_a_backend_is_named(
    octocell: Octocell, plugin: Path, tmp_path: Path
) -> None:
    ours = octocell.find("poly:n=3000")
    answer = octocell.find("poly:n=3000", "--plugin", plugin, "-o", tmp_path / "pairs.npy")
    assert answer["backend"] == "plugin_mine"
    assert answer["checksum"] == ours["checksum"]
    assert len(np.load(tmp_path / "pairs.npy")) == ours["pairs"]
    named = octocell.find("poly:n=3000", "--plugin", plugin, "--backend", "impl_cpu")
    assert named["backend"] == "impl_cpu"


def test_counting_and_growing_give_the_same(octocell: Octocell, plugin: Path) -> None:
    # Many more pairs than the room to begin with.
    for options in ((), ("--count",)):
        answer = octocell.find("identical:n=3000", "--plugin", plugin, *options)
        assert answer["pairs"] == 3000 * 2999 // 2, options


def test_flags_leave_pairs_out(octocell: Octocell, plugin: Path) -> None:
    scene = "dense:n=2000,static=0.5,groups=3"
    ours = octocell.find(scene)
    assert octocell.find(scene, "--plugin", plugin)["checksum"] == ours["checksum"]
    assert ours["pairs"] < octocell.find("dense:n=2000")["pairs"]


def test_check_has_a_row_for_each_plugin(octocell: Octocell, plugin: Path, wrong: Path) -> None:
    both = ("--plugin", plugin, "--plugin", wrong)
    result = octocell.run("check", "gas:n=2000", "chain:n=100", *both, timeout=120)
    assert result.rc == 1, result.stderr
    assert len(re.findall(r"^  plugin_mine +exact$", result.stdout, re.M)) == 2
    assert re.search(r"^  plugin_wrong +missed 99 ", result.stdout, re.M)
    octocell.ok("check", "gas:n=2000", *both, "--backend", "plugin_mine")


def test_stress_judges_a_plugin(
    octocell: Octocell, plugin: Path, wrong: Path, tmp_path: Path
) -> None:
    for path, status in ((plugin, "exact"), (wrong, "wrong")):
        out = tmp_path / f"{status}.json"
        options = ("--plugin", path, "--backend", f"plugin_{path.stem.removeprefix('lib')}")
        octocell.ok("stress", "--size", "slice", "--entry", "A1|B1", *options, "-o", out)
        rows = json.loads(out.read_text(encoding="utf-8"))["rows"]
        assert {row["status"] for row in rows} == {status}


def test_a_pair_of_no_spheres_is_refused(octocell: Octocell, tmp_path: Path) -> None:
    text = BRUTE_FORCE.replace("pairs[k] = {i, j}", "pairs[k] = {i, j + n}")
    result = octocell.run("check", "gas:n=100", "--plugin", library(tmp_path, "far", text))
    assert result.rc == 2 and "the plug-in gives the pair 0, 1" in result.stderr


@pytest.mark.parametrize("command", [("find", "gas:n=9"), ("check",), ("stress",)])
def test_what_is_no_plugin_is_refused(
    refused: Refused, tmp_path: Path, command: tuple[str, ...]
) -> None:
    (tmp_path / "a.so").write_text("no library", encoding="utf-8")
    assert refused(*command, "--plugin", "a.so").startswith("octocell: --plugin a.so: ")
    assert "none.so" in refused(*command, "--plugin", "none.so")
    empty = library(tmp_path, "empty", "int other;")
    assert "it has no function find_pairs" in refused(*command, "--plugin", empty)


def test_a_name_is_taken_once(refused: Refused, plugin: Path) -> None:
    twice = refused("check", "--plugin", plugin, "--plugin", plugin)
    assert "there is a row of this name, plugin_mine" in twice
