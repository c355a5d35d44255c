# SPDX-License-Identifier: MIT
"""Compares static spheres, groups and masks on the command line with a definition written here."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from exact import Pairs, checksum, exact_pairs
from hard_scenes import SCENES
from program import Octocell, Refused, load

Words = NDArray[np.uint32]  # static: bit 15; group: below it; mask: above it


def random_words(n: int, seed: int) -> Words:
    random = np.random.default_rng(seed)
    word = random.integers(0, 2**32, (2, n), np.uint32)
    return word[0] & word[1]


def allowed(words: Words, pairs: Pairs) -> Pairs:
    """Not both static, and each in a group of the other's mask."""
    a, b = (words[pairs[:, k]] for k in (0, 1))
    both_static = a & b & 0x8000 != 0
    a_seeks_b = b & 0x7FFF & a >> 16 != 0
    b_seeks_a = a & 0x7FFF & b >> 16 != 0
    return pairs[~both_static & a_seeks_b & b_seeks_a]


@pytest.mark.parametrize("name", SCENES)
def test_find_gives_the_pairs_that_may_collide(
    octocell: Octocell, tmp_path: Path, name: str
) -> None:
    scene = SCENES[name]
    words = random_words(len(scene), seed=len(name))
    np.save(tmp_path / "scene.npy", scene)
    np.save(tmp_path / "flags.npy", words)
    truth = allowed(words, exact_pairs(scene))
    for method in ("half_shell", "home_phantom", "brute_force"):
        answer = octocell.find(
            tmp_path / "scene.npy",
            "--flags",
            tmp_path / "flags.npy",
            "--method",
            method,
            "-o",
            tmp_path / "pairs.npy",
        )
        assert (answer["pairs"], answer["checksum"]) == (len(truth), checksum(truth)), method
        assert answer["static"] == int(np.count_nonzero(words & 0x8000))
        np.testing.assert_array_equal(np.load(tmp_path / "pairs.npy"), truth)


def test_a_bool_array_tells_which_spheres_are_static(octocell: Octocell, tmp_path: Path) -> None:
    static = np.random.default_rng(1).random(150) < 0.7
    np.save(tmp_path / "scene.npy", SCENES["gas"])
    np.save(tmp_path / "static.npy", static)
    pairs = exact_pairs(SCENES["gas"])
    truth = pairs[~(static[pairs[:, 0]] & static[pairs[:, 1]])]
    assert 0 < len(truth) < len(pairs)
    answer = octocell.find(tmp_path / "scene.npy", "--flags", tmp_path / "static.npy")
    assert (answer["pairs"], answer["checksum"]) == (len(truth), checksum(truth))


def test_columns_of_a_csv_say_the_same_as_a_side_file(octocell: Octocell, tmp_path: Path) -> None:
    spec = "dense:n=400,static=0.5,groups=3"
    octocell.ok("generate", spec, "-o", tmp_path / "a.csv")
    octocell.ok(
        "generate", spec, "-o", tmp_path / "a.npy", "--flags-output", tmp_path / "flags.npy"
    )
    words = np.load(tmp_path / "flags.npy")
    assert words.dtype == np.uint32 and words.shape == (400,)
    table = np.genfromtxt(tmp_path / "a.csv", delimiter=",", names=True)
    packed = table["group"] + 2**15 * table["static"] + 2**16 * table["mask"]
    np.testing.assert_array_equal(words, packed)
    truth = allowed(words, exact_pairs(np.load(tmp_path / "a.npy")))
    assert len(truth) > 0
    side = octocell.find(tmp_path / "a.npy", "--flags", tmp_path / "flags.npy")
    for answer in (octocell.find(spec), octocell.find(tmp_path / "a.csv"), side):
        assert (answer["pairs"], answer["checksum"]) == (len(truth), checksum(truth))


def test_check_holds_every_implementation_against_the_flags(
    octocell: Octocell, tmp_path: Path
) -> None:
    text = octocell.ok("check", "dense:n=1500,static=0.8,groups=4").stdout
    assert ", 0 wrong," in text and "(1500 spheres, 0 pairs)" not in text
    np.save(tmp_path / "static.npy", np.ones(300, bool))
    text = octocell.ok("check", "gas:n=300", "--flags", tmp_path / "static.npy").stdout
    assert "(300 spheres, 0 pairs)" in text and ", 0 wrong," in text


@pytest.mark.parametrize("motion", ["brownian", "free_fall", "gravity"])
def test_frames_with_static_spheres_are_exact(
    octocell: Octocell, tmp_path: Path, motion: str
) -> None:
    args = ("--motion", motion, "--frames", 6, "--rounds", 1, "--no-memory")
    octocell.ok("bench", "gas:n=500,static=0.6,groups=3", *args, "-o", tmp_path / "x.json")
    document = load(tmp_path / "x.json")
    rows = [row for row in document["rows"] if row["backend"] not in octocell.unavailable()]
    assert rows and {row["status"] for row in rows} == {"ok"}
    assert "static=0.6,groups=3" in document["groups"][0]["spec"]


def test_bench_takes_a_side_file(octocell: Octocell, tmp_path: Path) -> None:
    np.save(tmp_path / "static.npy", np.arange(300) % 2 == 0)
    args = ("--flags", tmp_path / "static.npy", "--backend", "impl_cpu", "--rounds", 1)
    octocell.ok("bench", "dense:n=300", *args, "-o", tmp_path / "x.json")
    document = load(tmp_path / "x.json")
    group = document["groups"][0]
    expected = octocell.find("dense:n=300", "--flags", tmp_path / "static.npy")
    assert group["truth"]["pairs"] == expected["pairs"] > 0
    assert group["truth"]["pairs"] < octocell.find("dense:n=300")["pairs"]
    assert any(row["peak_bytes"] for row in document["rows"])


def test_explain_says_that_nothing_is_searched(octocell: Octocell) -> None:
    assert "SKIPS search" in octocell.ok("find", "gas:n=300,static=1", "--explain").stderr
    assert "search: none" not in octocell.ok("find", "gas:n=300,static=0.9", "--explain").stderr


BAD_FLAGS: dict[str, tuple[NDArray[Any], list[str]]] = {
    "too_short": (np.zeros(8, np.uint32), ["flags of 8 spheres", "has 9"]),
    "too_long": (np.zeros(10, bool), ["flags of 10 spheres", "has 9"]),
    "table": (np.zeros((9, 1), np.uint32), ["(9, 1)", "(n,)"]),
    "floats": (np.zeros(9, np.float32), ["'<f4'", "uint32"]),
    "signed": (np.zeros(9, np.int64), ["'<i8'", "uint32"]),
    "not_a_bool": (np.array([0, 1, 1, 0, 7, 0, 0, 0, 0], np.uint8), ["sphere 4", "static is 7"]),
}


@pytest.mark.parametrize("command", ["find", "check", "generate", "bench"])
@pytest.mark.parametrize("name", BAD_FLAGS)
def test_bad_side_files_are_refused(
    refused: Refused, tmp_path: Path, command: str, name: str
) -> None:
    flags, words = BAD_FLAGS[name]
    np.save(tmp_path / "bad.npy", flags)
    output = [] if command == "check" else ["-o", "x.json" if command == "bench" else "x.npy"]
    line = refused(command, "gas:n=9", "--flags", "bad.npy", *output)
    assert all(word in line for word in ["bad.npy", *words]), line


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["find", "gas:n=9", "--flags", "missing.npy"], ["missing.npy", "No such file"]),
        (["find", "gas:n=9", "--flags", ""], ["--flags"]),
        (["find", "gas:n=9,static=2"], ["static=2", "out of range"]),
        (["find", "gas:n=9,groups=16"], ["groups=16", "out of range"]),
        (["find", "gas:n=9,groups=1", "--flags", "ok.npy"], ["ok.npy", "flags of its own"]),
        (["check", "--flags", "ok.npy"], ["--flags", "one scene"]),
        (["check", "gas:n=9", "gas:n=9", "--flags", "ok.npy"], ["--flags", "one scene"]),
        (["bench", "--flags", "ok.npy", "-o", "x.json"], ["--flags", "one scene"]),
        (["generate", "gas:n=9,static=0.5", "-o", "x.npy"], ["x.npy", "--flags-output"]),
        (
            ["generate", "gas:n=9,static=0.5", "-o", "x.npy", "--flags-output", "x.npy"],
            ["x.npy", "a file each"],
        ),
        (
            ["generate", "gas:n=9,static=0.5", "-o", "x.npy", "--flags-output", "no/f.npy"],
            ["no/f.npy", "No such file"],
        ),
        (
            ["generate", "gas:n=9,static=0.5", "-o", "no/x.npy", "--flags-output", "f.npy"],
            ["no/x.npy", "No such file"],
        ),
        (["find", "bad.csv"], ["bad.csv:3", "group is '40000'", "32767"]),
    ],
)
def test_bad_flags_are_refused(
    refused: Refused, tmp_path: Path, arguments: list[str], words: list[str]
) -> None:
    np.save(tmp_path / "ok.npy", np.zeros(9, bool))
    (tmp_path / "bad.csv").write_text("x,y,z,r,group\n1,2,3,4,1\n1,2,3,4,40000\n", encoding="utf-8")
    line = refused(*arguments)
    assert all(word in line for word in words), line
