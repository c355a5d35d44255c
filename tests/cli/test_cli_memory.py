# SPDX-License-Identifier: MIT
"""In a container with little memory, scenes that do not fit are refused, and others run."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from control_groups import ControlGroup
from program import Octocell, Refused

MEBIBYTE = 1 << 20


def group_of(mebibytes: int) -> Iterator[ControlGroup]:
    limit = str(mebibytes * MEBIBYTE)
    # Swap would let the program live, slowly.
    swap = {"memory.swappiness": "0", "memory.swap.max": "0"}
    limits = {"memory.limit_in_bytes": limit, "memory.max": limit}
    yield from ControlGroup.make("memory", {**limits, **swap})


@pytest.fixture
def small() -> Iterator[ControlGroup]:
    yield from group_of(64)


@pytest.fixture
def medium() -> Iterator[ControlGroup]:
    yield from group_of(420)


@pytest.mark.parametrize("output", [["-o", "p.npy"], ["-o", "p.npy", "--depth", "d.npy"]])
def test_pairs_need_room_once(
    octocell: Octocell, medium: ControlGroup, tmp_path: Path, output: list[str]
) -> None:
    octocell.ok("find", "identical:n=9000", *output, cwd=tmp_path, preexec_fn=medium.enter)
    assert len(np.load(tmp_path / "p.npy", mmap_mode="r")) == 9000 * 8999 // 2


@pytest.mark.parametrize(
    "arguments",
    [
        ["identical:n=12000"],  # pairs
        ["identical:n=12000", "--backend", "impl_thrust"],
        ["identical:n=12000", "--backend", "bullet_dbvt"],
        ["gas:n=100000", "--cell-side", "0.08"],  # cell ids
        ["gas:n=100000", "--cell-side", "0.08", "--count"],
        ["gas:n=100000", "--cell-side", "0.08", "--backend", "impl_thrust"],
        ["gas:n=20000000", "--count"],  # ids and copies of the spheres
        ["gas:n=6e7", "--count"],  # the spheres
        ["gas:n=20000000", "--count", "--round-input"],
        ["gas:n=1000000", "--backend", "fcl_dynamic_aabb_tree_morton"],  # objects of a library
    ],
)
def test_what_does_not_fit_is_refused(
    refused: Refused, medium: ControlGroup, arguments: list[str]
) -> None:
    line = refused("find", *arguments, preexec_fn=medium.enter)
    assert "GiB are available" in line


def test_counting_is_named(refused: Refused, medium: ControlGroup) -> None:
    line = refused("find", "identical:n=12000", "-o", "p.npy", preexec_fn=medium.enter)
    assert "72000000 pairs" in line or "71994000 pairs" in line
    assert "counting needs no memory for pairs" in line


def test_the_exact_pairs_are_refused(refused: Refused, medium: ControlGroup) -> None:
    line = refused("check", "identical:n=12000", preexec_fn=medium.enter)
    assert "the exact pairs" in line


def test_frames_are_refused(refused: Refused, medium: ControlGroup) -> None:
    line = refused(
        *["bench", "gas:n=1000000", "--motion", "slow", "--frames", "100", "-o", "b.json"],
        preexec_fn=medium.enter,
    )
    assert "100 frames" in line


def test_a_long_table_is_refused(refused: Refused, small: ControlGroup, tmp_path: Path) -> None:
    (tmp_path / "long.csv").write_bytes(b"0,0,0,0\n" * 3_000_000)
    line = refused("find", "long.csv", "--count", preexec_fn=small.enter)
    assert "long.csv" in line and "GiB are available" in line


@pytest.mark.parametrize("name", ["holes.csv", "holes.pqr"])
def test_a_file_of_holes_is_refused(
    refused: Refused, small: ControlGroup, tmp_path: Path, name: str
) -> None:
    with (tmp_path / name).open("wb") as file:
        file.truncate(300_000_000)
    line = refused("find", name, preexec_fn=small.enter)
    assert f"{name}:1: a line of more than" in line


def test_a_large_array_is_refused(refused: Refused, small: ControlGroup, tmp_path: Path) -> None:
    np.lib.format.open_memmap(tmp_path / "a.npy", "w+", np.float32, (20_000_000, 4)).flush()
    line = refused("find", "a.npy", preexec_fn=small.enter)
    assert "a.npy" in line and "GiB are available" in line


def test_a_table_is_written_without_a_copy(
    octocell: Octocell, small: ControlGroup, tmp_path: Path
) -> None:
    octocell.ok("generate", "gas:n=1500000", "-o", tmp_path / "a.csv", preexec_fn=small.enter)
