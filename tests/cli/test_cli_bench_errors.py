# SPDX-License-Identifier: MIT
"""`octocell bench`: how rounding the input changes pairs, and the preset for run time and error."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from program import Octocell, Refused, load

TINY = ("--rounds", 2, "--benchmark_min_time=0.001")


def test_rounding_is_reported_apart_from_the_rows(octocell: Octocell, tmp_path: Path) -> None:
    path, scene = tmp_path / "x.json", tmp_path / "float64.npy"
    np.save(scene, np.array([[0, 0, 0, 0.5], [1 + 1e-9, 0, 0, 0.5], [9, 0, 0, 0.5]]))
    small = (*TINY, "--no-memory", "--benchmark_filter=impl_cpu/method:planned.*run:warm")
    far = "shifted:n=2000,offset=1e7"
    octocell.ok("bench", scene, far, "gas:n=50", "-o", path, *small, "--round-input")
    file, shifted, gas = load(path)["groups"]
    assert file["input_rounding"] == {"lost": 0, "gained": 1}
    assert shifted["input_rounding"]["lost"] > 0 < shifted["input_rounding"]["gained"]
    assert gas["input_rounding"] == {"lost": 0, "gained": 0}
    assert {(row["missed"], row["false"]) for row in load(path)["rows"]} == {(0, 0)}
    octocell.ok("bench", far, "-o", path, *small)
    assert [group["input_rounding"] for group in load(path)["groups"]] == [None]


def test_float64_files_need_the_word(refused: Refused, tmp_path: Path) -> None:
    np.save(tmp_path / "float64.npy", np.zeros((2, 4)))
    assert "--round-input" in refused("bench", "float64.npy", "-o", "x.json")


def test_memory_is_measured_of_rounded_files_too(octocell: Octocell, tmp_path: Path) -> None:
    np.save(tmp_path / "float64.npy", np.zeros((2, 4)))
    path = tmp_path / "x.json"
    args = (*TINY, "--round-input", "--benchmark_filter=impl_cpu/method:planned.*run:warm")
    octocell.ok("bench", tmp_path / "float64.npy", "-o", path, *args)
    assert all(row["peak_bytes"] is not None for row in load(path)["rows"])


def error_rows(octocell: Octocell, folder: Path) -> list[str]:
    args = ("--preset", "error", "--benchmark_list_tests")
    return octocell.ok("bench", *args, cwd=folder).stdout.splitlines()


def test_the_error_preset_has_our_plans_and_libraries(octocell: Octocell, tmp_path: Path) -> None:
    names = error_rows(octocell, tmp_path)
    assert all(name.endswith("/threads:1/run:warm") for name in names)
    backends = {re.findall("backend:(\\w+)", name)[0] for name in names}
    assert set(octocell.listed("backends")) <= backends
    assert octocell.faulty() <= backends
    assert {"bullet_dbvt", "fcl_dynamic_aabb_tree_morton"} <= backends
    assert not any("/rule:" in name or "brute_force" in name for name in names)
    for scene in ("gas", "lattice", "lattice(spacing=0.1)", "shifted(offset=1e7)", "giant"):
        assert any(f"/scene:{scene}/n:100000/" in name for name in names), scene


def test_the_error_preset_tells_class_and_rounding(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    scenes = "scene:(gas|chain|shifted.offset=1e7.)/"
    which = f"impl_cpu/method:planned/(predicate:(f32|q16_exact)/)?{scenes}"
    octocell.ok(
        "bench",
        "--preset",
        "error",
        "-o",
        path,
        *TINY,
        "--no-memory",
        f"--benchmark_filter={which}",
    )
    document = load(path)
    classes = [(group["scene"], group["n"], group["scene_class"]) for group in document["groups"]]
    assert classes == [
        ("gas", 100_000, "random"),
        ("chain", 10_000, "structured"),
        ("shifted(offset=1e7)", 10_000, "extreme"),
        ("shifted(offset=1e7)", 100_000, "extreme"),
        ("gas", 1_000_000, "random"),
    ]
    rounding = [group["input_rounding"] for group in document["groups"]]
    assert rounding.pop() is None  # the large ones are there for their time
    assert rounding[1] == {"lost": 0, "gained": 0}
    assert all(far["lost"] > 0 < far["gained"] for far in rounding[2:])
    for row in document["rows"]:
        assert row["status"] == "ok" or row["negative_control"], row["name"]
    assert {row["predicate"] for row in document["rows"]} >= {"exact", "f32", "q16_exact"}


def test_libraries_take_fewer_rounds_of_the_error_preset(
    octocell: Octocell, tmp_path: Path
) -> None:
    path = tmp_path / "x.json"
    args = ("--benchmark_min_time=0.001", "--no-memory", "--rounds", 7)
    which = "--benchmark_filter=(impl_cpu/method:planned|bullet_dbvt)/scene:gas/"
    octocell.ok("bench", "--preset", "error", "-o", path, *args, which)
    rounds = {row["backend"]: len(row["total_ms"]) for row in load(path)["rows"]}
    assert rounds == {"impl_cpu": 7, "bullet_dbvt": 5}
