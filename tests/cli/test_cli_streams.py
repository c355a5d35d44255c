# SPDX-License-Identifier: MIT
"""Packed files and standard input: the same spheres as from the plain file, or refused."""

from __future__ import annotations

import gzip
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from hard_scenes import SCENES
from program import Octocell, Refused
from scene_input import npy_bytes, read

GAS = np.ascontiguousarray(SCENES["gas"], dtype=np.float32)
PQR = b"ATOM 1 N ALA A 1 0 0 0 0.1 1.8\nATOM 2 C ALA A 1 1 0 0 0.1 1.9\n"


def contents(folder: Path) -> dict[str, bytes]:
    lines = "".join(",".join(map(repr, map(float, sphere))) + "\n" for sphere in GAS)
    return {
        ".npy": npy_bytes(GAS, folder),
        ".csv": b"x,y,z,r\n" + lines.encode(),
        ".txt": lines.replace(",", " ").encode(),
        ".pqr": PQR,
    }


@pytest.mark.parametrize("suffix", [".npy", ".csv", ".txt", ".pqr"])
def test_all_ways_give_the_same_spheres(octocell: Octocell, tmp_path: Path, suffix: str) -> None:
    content = contents(tmp_path)[suffix]
    plain = tmp_path / f"a{suffix}"
    plain.write_bytes(content)
    expected, _ = read(octocell, plain)
    assert len(expected) in (2, len(GAS))
    packed = tmp_path / f"A{suffix}.GZ"
    packed.write_bytes(gzip.compress(content))
    np.testing.assert_array_equal(read(octocell, packed)[0], expected)
    for given in (content, gzip.compress(content)):
        spheres = from_standard_input(octocell, given, suffix, tmp_path)
        np.testing.assert_array_equal(spheres, expected)


def from_standard_input(
    octocell: Octocell, content: bytes, suffix: str, folder: Path
) -> np.ndarray:
    options = ["--format", "pqr"] if suffix == ".pqr" else []
    out = folder / "read.npy"
    command = [octocell.path, "generate", "-", *options, "-o", out]
    subprocess.run(command, input=content, check=True, capture_output=True, timeout=60)
    return np.load(out)


def test_packed_parts_in_a_row_are_one_file(octocell: Octocell, tmp_path: Path) -> None:
    parts = [b"x,y,z,r\n0,0,0,1\n1,0,", b"0,1\n", b"", b"2,0,0,1\n"]
    packed = b"".join(map(gzip.compress, parts)) + bytes(512)  # as tapes pad it
    (tmp_path / "a.csv.gz").write_bytes(packed)
    assert len(read(octocell, tmp_path / "a.csv.gz")[0]) == 3


def damaged(content: bytes) -> dict[str, tuple[bytes, str]]:
    packed = gzip.compress(content)
    flipped = bytearray(packed)
    flipped[-6] ^= 1  # of the checksum
    return {
        "cut": (packed[:-9], "ends in the middle of its gzip data"),
        "cut_checksum": (packed[:-1], "ends in the middle of its gzip data"),
        "cut_header": (packed[:5], "ends in the middle of its gzip data"),
        "checksum": (bytes(flipped), "gzip data are damaged"),
        "other_bytes": (packed + b"1,2,3,4\n", "other bytes follow"),
        "no_method": (b"\x1f\x8b\x00" + packed[3:], "gzip data are damaged"),
        "nothing": (gzip.compress(b""), "is empty"),
    }


@pytest.mark.parametrize("name", damaged(b""))
@pytest.mark.parametrize("suffix", [".npy", ".csv"])
def test_damaged_packed_files(refused: Refused, tmp_path: Path, suffix: str, name: str) -> None:
    content, words = damaged(contents(tmp_path)[suffix])[name]
    (tmp_path / f"bad{suffix}.gz").write_bytes(content)
    line = refused("find", f"bad{suffix}.gz")
    assert f"bad{suffix}.gz: " in line and words in line


def test_a_packed_array_has_the_size_that_it_says(refused: Refused, tmp_path: Path) -> None:
    content = contents(tmp_path)[".npy"]
    for name, wrong, words in (
        ("short", content[:-1], "truncated: shape (300, 4) needs"),
        ("long", content + b"\0", "too long: shape (300, 4) needs"),
        ("header", content[:30], "truncated: the NPY header"),
    ):
        (tmp_path / f"{name}.npy.gz").write_bytes(gzip.compress(wrong))
        assert words.replace("300", str(len(GAS))) in refused("find", f"{name}.npy.gz")


def test_a_packed_array_that_lies_costs_no_memory(refused: Refused, tmp_path: Path) -> None:
    header = npy_bytes(np.empty((0, 4), np.float32), tmp_path)
    lie = header.replace(b"(0, 4), }" + b" " * 8, b"(268435456, 4), }")
    assert lie != header and len(lie) == len(header)
    (tmp_path / "lie.npy.gz").write_bytes(gzip.compress(lie))
    assert "truncated" in refused("find", "lie.npy.gz", preexec_fn=_at_most_one_gigabyte)


def _at_most_one_gigabyte() -> None:
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))


def test_line_numbers_count_in_packed_files_and_pipes(refused: Refused, tmp_path: Path) -> None:
    text = b"x,y,z,r\n0,0,0,1\n0,0,0,-1\n"
    (tmp_path / "bad.csv.gz").write_bytes(gzip.compress(text))
    assert "bad.csv.gz:3: r is -1" in refused("find", "bad.csv.gz")


def test_bad_standard_input(octocell: Octocell) -> None:
    for content, words in (
        (b"0,0,0,1\n0,0,0,-1\n", "standard input:2: r is -1"),
        (b"", "standard input: is empty"),
        (PQR, "standard input:1: "),
    ):
        done = subprocess.run(
            [octocell.path, "find", "-"],
            input=content,
            capture_output=True,
            timeout=60,
            check=False,
        )
        assert done.returncode == 2 and words.encode() in done.stderr
        assert done.stderr.count(b"\n") == 1


@pytest.mark.parametrize("command", ["find", "explain", "check"])
def test_commands_read_standard_input(octocell: Octocell, command: str) -> None:
    done = subprocess.run(
        [octocell.path, command, "-"],
        input=b"0,0,0,1\n1,0,0,1\n",
        capture_output=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0 and done.stderr == b""


def test_bench_wants_a_file(refused: Refused) -> None:
    assert "several times" in refused("bench", "-")


def test_standard_input_is_not_overwritten(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "a.npy"
    path.write_bytes(content := npy_bytes(GAS, tmp_path))
    with path.open("rb") as stream:
        done = subprocess.run(
            [octocell.path, "generate", "-", "-o", path],
            stdin=stream,
            capture_output=True,
            timeout=60,
            check=False,
        )
    assert done.returncode == 2 and b"would be lost" in done.stderr
    assert path.read_bytes() == content


def test_a_terminal_is_no_input(octocell: Octocell) -> None:
    leader, follower = os.openpty()
    try:
        done = subprocess.run(
            [octocell.path, "find", "-"],
            stdin=follower,
            capture_output=True,
            timeout=60,
            check=False,
        )
    finally:
        os.close(leader)
        os.close(follower)
    assert done.returncode == 2 and b"is a terminal" in done.stderr


def test_other_packings_are_named(refused: Refused, tmp_path: Path) -> None:
    for name in ("a.csv.bz2", "a.npy.xz"):
        (tmp_path / name).write_bytes(b"BZh9")
        assert "unpack it first" in refused("find", name)
