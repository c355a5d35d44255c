# SPDX-License-Identifier: MIT
"""`octocell judge`: what is wrong with a list, and what the wrong pairs have in common."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hand_ins import (
    Pairs,
    all_pairs,
    balls,
    depths,
    first_partners,
    found_with_cells_cast_to_int,
    have_negative,
    homes,
    steps,
)
from hard_scenes import Spheres, spheres
from judging import Judge
from program import ROOT, Octocell, Refused

SCENES = ROOT / "course/scenes"


@pytest.fixture
def judge(octocell: Octocell, tmp_path: Path) -> Judge:
    return Judge(octocell, tmp_path)


# What is counted, and how lists may be written.


def test_an_exact_list_is_exact_in_any_order_and_type(judge: Judge) -> None:
    scene = judge.save(balls(120, 6))
    truth = judge.truth(scene)
    random = np.random.default_rng(1)
    mixed = random.permutation(truth)
    mixed[::2] = mixed[::2, ::-1]
    for dtype in ("i2", "u1", "u4", "i8", "u8", ">i4", ">u2"):
        assert judge(scene, mixed.astype(dtype))["verdict"] == "exact", dtype
    assert judge(scene, np.asfortranarray(mixed))["verdict"] == "exact"


@pytest.mark.parametrize("separator", [",", " ", "\t", "; "])
def test_text_is_read_with_any_separator(
    judge: Judge, tmp_path: Path, octocell: Octocell, separator: str
) -> None:
    scene = judge.save(balls(120, 6))
    rows = [f"{i}{separator}{j}" for i, j in judge.truth(scene)]
    text = "\n".join(["# by hand", f"i{separator}j", *rows, ""])
    (tmp_path / "list.txt").write_text(text, encoding="utf-8")
    octocell.ok("judge", scene, tmp_path / "list.txt")
    with (tmp_path / "list.txt").open(encoding="utf-8") as file:
        done = subprocess.run([octocell.path, "judge", scene, "-"], stdin=file, check=False)
    assert done.returncode == 0


def test_what_savetxt_writes_is_read(judge: Judge, tmp_path: Path, octocell: Octocell) -> None:
    scene = judge.save(balls(120, 6))
    np.savetxt(tmp_path / "list.txt", judge.truth(scene))
    octocell.ok("judge", scene, tmp_path / "list.txt")


def test_an_empty_file_holds_no_pairs(judge: Judge, tmp_path: Path, octocell: Octocell) -> None:
    (tmp_path / "list.txt").touch()
    octocell.ok("judge", judge.save(spheres([0, 9], 0, 0, 1)), tmp_path / "list.txt")
    assert octocell.run("judge", judge.save(balls(50, 4)), tmp_path / "list.txt").rc == 1


def test_wrong_rows_are_counted_by_kind_and_the_first_are_named(judge: Judge) -> None:
    scene = judge.save(spheres([0, 1, 2, 10, 20], 0, 0, 0.5))  # pairs 0 1 and 1 2
    answer = judge(scene, [[3, 0], [2, 1], [1, 2], [2, 2], [0, 5], [-1, 0], [4, 0]])
    counts = [answer[key] for key in ("missed", "false", "duplicates", "out_of_range")]
    assert counts == [1, 2, 1, 3]
    first = {f["kind"]: (f["i"], f["j"], f["row"]) for f in answer["first"]}
    assert first == {
        "missed": (0, 1, None),
        "false": (0, 3, 0),
        "duplicates": (1, 2, 2),
        "out_of_range": (2, 2, 3),
    }


def test_the_first_missed_pair_is_explained_as_why_does(judge: Judge, octocell: Octocell) -> None:
    path = SCENES / "smaller_home.csv"
    (first,) = judge(path, np.empty((0, 2), int))["first"]
    why = json.loads(octocell.ok("why", path, 0, 1, "--json").stdout)
    assert first["why"] == why
    assert first["flaw"]["name"] == "smaller home only"
    assert "this pair is LOST" in octocell.ok(*first["command"].split()[1:]).stdout


def test_a_small_scene_has_too_few_pairs_for_a_cause(octocell: Octocell, tmp_path: Path) -> None:
    (tmp_path / "list.csv").write_text("0,1\n", encoding="utf-8")
    result = octocell.run("judge", SCENES / "eight.csv", tmp_path / "list.csv")
    assert result.rc == 1 and "too few pairs to tell" in result.stdout
    assert "wrong        missed" in result.stdout


# The causes of lost pairs.


def test_a_random_loss_has_no_cause(judge: Judge) -> None:
    scene = judge.save(balls())
    truth = judge.truth(scene)
    assert len(truth) > 1200
    for seed, share in enumerate((0.001, 0.01, 0.1, 0.3, 0.6, 0.9) * 4):
        random = np.random.default_rng(seed)
        kept = random.random(len(truth)) >= share
        assert judge.cause(scene, random.permutation(truth[kept])) is None, (seed, share)


def test_random_rows_have_no_cause(judge: Judge) -> None:
    scene = judge.save(balls())
    truth = judge.truth(scene)
    for seed in range(6):
        false = np.random.default_rng(seed).integers(0, 900, (40, 2))
        false = false[false[:, 0] != false[:, 1]]
        assert judge.cause(scene, np.concatenate([truth, false])) is None, seed
        twice = np.random.default_rng(seed).choice(truth, 30)
        assert judge.cause(scene, np.concatenate([truth, np.sort(twice)])) is None, seed


def lost_by(name: str, scene: Spheres, truth: Pairs) -> Any:
    """Which of the pairs a program with that flaw loses."""
    side = 2 * scene[:, 3].max()
    lowest = scene[:, :3].min(axis=0)
    d = steps(scene, truth, side, lowest)
    flaws = {
        "negative coordinates": lambda: have_negative(scene, truth),
        "both sides of zero": lambda: (scene[truth, 1] < 0).sum(axis=1) == 1,
        "one direction": lambda: (d == [1, -1, 0]).all(1) | (d == [-1, 1, 0]).all(1),
        "one axis": lambda: steps(scene, truth, side)[:, 2] != 0,
        "edges and corners": lambda: (d != 0).sum(axis=1) >= 2,
        "other cells": lambda: (d != 0).any(axis=1),
        "block borders": lambda: np.diff(truth // 256, axis=1).ravel() != 0,
        "last block": lambda: truth[:, 1] >= 768,
        "last sphere": lambda: truth[:, 1] == len(scene) - 1,
        "next id": lambda: truth[:, 1] == truth[:, 0] + 1,
        "clipped": lambda: np.arange(len(truth)) >= 1024,
        "clipped per sphere": lambda: ~first_partners(truth, 4),
        "truncated cells": lambda: ~found_with_cells_cast_to_int(scene, truth),
        "large spheres": lambda: scene[truth, 3].max(axis=1) > 0.95,
    }
    return flaws[name]()


@pytest.mark.parametrize(
    "name",
    [
        "negative coordinates",
        "both sides of zero",
        "one direction",
        "one axis",
        "edges and corners",
        "other cells",
        "block borders",
        "last block",
        "last sphere",
        "next id",
        "clipped",
        "clipped per sphere",
        "truncated cells",
        "large spheres",
    ],
)
def test_what_lost_pairs_have_in_common(judge: Judge, name: str) -> None:
    scene = balls()
    if name == "last sphere":
        scene[-1] = (0, 0, 0, 1.5)
    truth = judge.truth(judge.save(scene))
    lost = lost_by(name, scene, truth)
    assert 2 <= lost.sum() < len(truth)
    answer = judge(judge.save(scene), truth[~lost])
    assert answer["cause"] is not None and answer["cause"]["name"] == name, answer["cause"]
    assert answer["missed"] == answer["cause"]["wrong"] == lost.sum()


def test_borders_of_blocks_of_sorted_entries(judge: Judge) -> None:
    scene = balls()
    truth = judge.truth(judge.save(scene))
    x, y, z = homes(scene, 2 * scene[:, 3].max(), scene[:, :3].min(axis=0)).T
    place = np.empty(len(scene), int)
    place[np.lexsort((x, y, z))] = np.arange(len(scene))
    kept = place[truth[:, 0]] // 128 == place[truth[:, 1]] // 128
    cause = judge(judge.save(scene), truth[kept])["cause"]
    assert cause["name"] == "block borders"
    assert "128 entries, sorted by cell, x the fastest" in cause["text"]


def test_exact_touching(judge: Judge) -> None:
    lattice = np.stack(np.meshgrid(*[np.arange(6.0)] * 3), axis=-1).reshape(-1, 3)
    scene = np.column_stack([lattice, np.where(np.arange(216) % 7 == 0, 0.625, 0.5)])
    scene = scene.astype(np.float32)
    truth = judge.truth(judge.save(scene))
    touching = depths(scene, truth) == 0
    assert 10 < touching.sum() < len(truth) - 10
    assert judge.cause(judge.save(scene), truth[~touching]) == "touching"


@pytest.fixture(scope="module")
def many(octocell: Octocell, tmp_path_factory: pytest.TempPathFactory) -> Pairs:
    """The pairs of 70000 spheres, more than 16 bits count."""
    path = tmp_path_factory.mktemp("many") / "truth.npy"
    octocell.ok("find", "gas:n=70000", "-o", path)
    pairs: Pairs = np.load(path).astype(np.int64)
    return pairs


def test_ids_that_do_not_fit_in_16_bits(judge: Judge, many: Pairs) -> None:
    scene = "gas:n=70000"
    assert judge.cause(scene, many[many[:, 1] < 65536]) == "ids of 2^16 and more"
    assert judge.cause(scene, many.astype(np.uint16)) == "ids cut to 16 bits"
    assert judge.cause(scene, many.astype(np.int16)) == "ids cut to 16 bits"
    number = many[:, 0] * 70000 + many[:, 1]
    assert judge.cause(scene, many[number < 2**31]) == "pair number of 31 bits"


def couples(n: int, size: float) -> Spheres:
    """Pairs that are far from each other, in a box of that many cells of 2 r_max an axis."""
    random = np.random.default_rng(8)
    places = random.random((n, 3)) * 2 * size
    places = np.concatenate([places, places + random.normal(size=(n, 3)) * 0.3])
    return np.column_stack([places, np.ones(2 * n)]).astype(np.float32)


@pytest.mark.parametrize(("bits", "size"), [(16, 64), (31, 2000)])
def test_cell_ids_that_overflow(judge: Judge, bits: int, size: float) -> None:
    scene = couples(500, size)
    truth = judge.truth(judge.save(scene))
    cells = homes(scene, 2, scene[:, :3].min(axis=0))
    nx, ny, _ = cells.max(axis=0) + 1
    ids = cells[:, 0] + nx * (cells[:, 1] + ny * cells[:, 2])
    kept = (ids[truth] < 2**bits).all(axis=1)
    assert 100 < kept.sum() < len(truth) - 100
    assert judge.cause(judge.save(scene), truth[kept]) == f"cell ids of {bits} bits"


# Flaws of the list, false pairs, repeated pairs.


def test_flaws_of_the_list_as_a_whole(judge: Judge) -> None:
    scene = judge.save(balls())
    truth = judge.truth(scene)
    assert judge.cause(scene, truth + 1) == "ids from 1"
    assert judge.cause(scene, np.concatenate([truth, truth[:, ::-1]])) == "both orders"
    assert judge.cause(scene, np.concatenate([truth, truth, truth])) == "everything repeated"
    for filler in (0, -1, 2**32 - 1):
        rows = np.concatenate([truth, np.full((50, 2), filler)])
        assert judge.cause(scene, rows) == "unused rows", filler
    itself = np.repeat(np.arange(900), 2).reshape(-1, 2)
    assert judge.cause(scene, np.concatenate([truth, itself])) == "itself"
    order = np.argsort(np.argsort(balls()[:, 0], kind="stable"))
    assert judge.cause(scene, order[truth]) == "places instead of ids"
    random = np.random.default_rng(4)
    assert judge.cause(scene, random.permutation(truth)[:1024]) == "clipped"


def near_pairs(scene: Spheres, pairs: Pairs, name: str) -> Any:
    """Which pairs a test with that flaw takes for pairs."""
    a, b = (scene[pairs[:, k]].astype(float) for k in (0, 1))
    distance, radii = abs(a - b)[:, :3], (a + b)[:, 3]
    return {
        "boxes only": lambda: (distance <= radii[:, None]).all(axis=1),
        "axis ignored": lambda: np.linalg.norm(distance[:, :2], axis=1) <= radii,
        "largest radius": lambda: np.linalg.norm(distance, axis=1) <= 2 * scene[:, 3].max(),
    }[name]()


@pytest.mark.parametrize("name", ["boxes only", "axis ignored", "largest radius"])
def test_what_false_pairs_have_in_common(judge: Judge, name: str) -> None:
    scene = balls(400, 12)
    candidates = all_pairs(scene)
    found = candidates[near_pairs(scene, candidates, name)]
    answer = judge(judge.save(scene), found)
    assert answer["missed"] == 0 and answer["false"] > 30
    assert answer["cause"]["name"] == name


def test_pairs_that_flags_forbid(octocell: Octocell, judge: Judge, tmp_path: Path) -> None:
    scene = judge.save(balls())
    np.save(tmp_path / "static.npy", np.arange(900) % 3 > 0)
    np.save(tmp_path / "list.npy", judge.truth(scene))
    result = octocell.run(
        "judge", scene, tmp_path / "list.npy", "--flags", tmp_path / "static.npy", "--json"
    )
    assert result.rc == 1
    assert json.loads(result.stdout)["cause"]["name"] == "flags ignored"


def test_pairs_that_are_met_in_several_cells(judge: Judge) -> None:
    scene = balls()
    truth = judge.truth(judge.save(scene))
    side = 2 * scene[:, 3].max()
    moved = [scene.copy() for _ in range(2)]
    for copy, sign in zip(moved, (-1, 1), strict=True):
        copy[:, :3] += sign * copy[:, 3:]
    low = np.max([homes(moved[0], side)[truth[:, k]] for k in (0, 1)], axis=0)
    high = np.min([homes(moved[1], side)[truth[:, k]] for k in (0, 1)], axis=0)
    times = (high - low + 1).prod(axis=1)
    assert judge.cause(judge.save(scene), np.repeat(truth, times, axis=0)) == "several cells"


# What cannot be judged.


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("0,1\n1,x\n", "list.txt:2: 'x' is not a whole number: '1,x'"),
        ("0,1\n1,0.5\n", "list.txt:2: '0.5' is not a whole number"),
        ("0 1\n\n1 2 3\n", "list.txt:3: 3 fields, expected the two numbers of a pair: '1 2 3'"),
        ("0\n", "list.txt:1: 1 field, expected"),
        ("0,1\ni,j\n", "list.txt:2: 'i' is not a whole number"),
    ],
)
def test_bad_text_is_refused_with_its_line(
    refused: Refused, tmp_path: Path, text: str, reason: str
) -> None:
    (tmp_path / "list.txt").write_text(text, encoding="utf-8")
    assert reason in refused("judge", "gas:n=9", "list.txt")


@pytest.mark.parametrize(
    ("array", "reason"),
    [
        (np.zeros((3, 2)), "numbers of type '<f8', expected integers"),
        (
            np.zeros((2, 3), int),
            "shape (2, 3), expected (m, 2): one pair a row; save the transposed",
        ),
        (np.zeros(4, int), "shape (4,), expected (m, 2)"),
        (np.zeros((3, 2), bool), "numbers of type '|b1', expected integers"),
    ],
)
def test_bad_arrays_are_refused(refused: Refused, tmp_path: Path, array: Any, reason: str) -> None:
    np.save(tmp_path / "list.npy", array)
    assert reason in refused("judge", "gas:n=9", "list.npy")


def test_bad_calls_are_refused(refused: Refused) -> None:
    assert "No such file" in refused("judge", "gas:n=9", "none.npy")
    assert "cannot both be standard input" in refused("judge", "-", "-")
