# SPDX-License-Identifier: MIT
"""The library and the command line without the parts for developers: OCTOCELL_DEVELOPER=OFF."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from program import Octocell
from users_build import users_build

# What such a build may not link.
LIBRARIES = ("fcl", "Bullet", "gmp", "gtest", "benchmark", "tbb", "hwy")


@pytest.fixture(scope="module")
def users_octocell() -> Octocell:
    return Octocell(users_build() / "octocell")


def test_it_links_nothing_of_the_developers(users_octocell: Octocell) -> None:
    linked = subprocess.run(
        ["ldd", users_octocell.path], capture_output=True, text=True, check=True
    )
    for library in LIBRARIES:
        assert f"lib{library}" not in linked.stdout, linked.stdout


def test_it_finds_the_same_pairs(users_octocell: Octocell, octocell: Octocell) -> None:
    for scene in ("gas:n=5000", "lattice:n=1000", "poly:n=3000,ratio=100"):
        ours, theirs = (
            json.loads(program.ok("find", scene, "--json").stdout)
            for program in (octocell, users_octocell)
        )
        assert (ours["pairs"], ours["checksum"]) == (theirs["pairs"], theirs["checksum"])


def test_it_plans_and_writes_scenes(users_octocell: Octocell, tmp_path: Path) -> None:
    assert "half_shell" in users_octocell.ok("explain", "gas:n=100000").stdout
    users_octocell.ok("generate", "gas:n=10", "-o", tmp_path / "ten.npy")
    assert "impl_cpu" in users_octocell.ok("list").stdout
    assert "fcl" not in users_octocell.ok("list").stdout


@pytest.mark.parametrize(
    "arguments",
    [
        ("check", "gas:n=10"),
        ("bench", "--preset", "quick"),
        ("bench-sort",),
        ("stress", "--size", "slice"),
        ("near-tangent", "--pairs", "5"),
        ("find", "gas:n=10", "--round-input"),
        ("find", "gas:n=10", "--depth-check"),
    ],
)
def test_what_is_missing_says_so(users_octocell: Octocell, arguments: tuple[str, ...]) -> None:
    result = users_octocell.run(*arguments)
    assert result.rc == 2
    assert "OCTOCELL_DEVELOPER=OFF" in result.stderr
    assert len(result.stderr.splitlines()) == 1
