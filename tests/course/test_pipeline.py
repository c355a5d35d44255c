# SPDX-License-Identifier: MIT
"""course/pipeline: the text as a program, and eight steps from it to the exact answer."""

from __future__ import annotations

import difflib
import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from exact import exact_pairs
from hard_scenes import SCENES as HARD_SCENES
from hard_scenes import Spheres
from pipeline_steps import PIPELINE, STEPS, build, pairs_of, printed
from program import ROOT, Octocell

SCENES = ROOT / "course/scenes"
# By scene: what each step loses (-) or gives twice (+); a full stop where it is exact.
LOSSES = {
    "eight": "-2 -2 -2 . . . . .",
    "negative": "-1 . . . . . . .",
    "same_id": "+1 +1 . . . . . .",
    "ninth_cell": "-1 -1 -1 . . . . .",
    "both_phantoms": "-1 -1 -1 -1 . . . .",
    "smaller_home": "-1 -1 -1 -1 -1 . . .",
    "far_away": "-1 -1 -1 -1 -1 -1 . .",
    "touching": "-1 -1 -1 -1 -1 -1 -1 .",
}
NOT_A_SPHERE = "not four finite numbers x,y,z,r, r >= 0"
MOST_CHANGED = 125  # lines of a step that differ from the one before, removed and added


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("pipeline")
    with ThreadPoolExecutor(2) as pool:
        return list(pool.map(lambda source: build(source, folder), STEPS))


def write(spheres: Spheres, path: Path) -> Path:
    rows = [",".join(np.format_float_positional(v, unique=True) for v in s) for s in spheres]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def read(path: Path) -> Spheres:
    return np.loadtxt(path, np.float32, comments=("#", "x"), delimiter=",", ndmin=2)


def difference(found: list[tuple[int, int]], spheres: Spheres) -> str:
    """As LOSSES says it. A pair that does not overlap is never found: that would be '?'."""
    truth = {(int(i), int(j)) for i, j in exact_pairs(spheres)}
    if not set(found) <= truth:
        return "?"
    missed, twice = len(truth - set(found)), len(found) - len(set(found))
    return f"-{missed}" if missed else f"+{twice}" if twice else "."


@pytest.mark.parametrize("scene", LOSSES)
def test_each_step_loses_what_its_heading_says(programs: list[Path], scene: str) -> None:
    path = SCENES / f"{scene}.csv"
    spheres = read(path)
    found = [difference(pairs_of(printed(program, path)), spheres) for program in programs]
    assert " ".join(found) == LOSSES[scene]


def test_every_scene_and_every_step_is_in_the_table() -> None:
    text = (PIPELINE / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| \[(\w+)\.csv\]\S* \| (.*) \|$", text, re.M)
    assert {scene: cells.replace("−", "-").split(" | ") for scene, cells in rows} == {
        scene: row.replace(".", "exact").split() for scene, row in LOSSES.items()
    }
    assert sorted(LOSSES) == sorted(path.stem for path in SCENES.glob("*.csv"))
    assert len(STEPS) == 8 and all(len(row.split()) == 8 for row in LOSSES.values())


def random_scenes(count: int) -> Iterator[Spheres]:
    """Up to 32 spheres in a box, on both sides of zero."""
    random = np.random.default_rng(11)
    for _ in range(count):
        n, size = random.integers(2, 33), random.uniform(2, 12)
        places = random.uniform(-size / 4, size, (n, 3))
        places[:, 2] *= random.choice([0.0, 0.3, 1.0])
        yield np.column_stack([places, random.uniform(0.2, 1, n)]).astype(np.float32)


def test_the_first_step_is_the_rule_as_written(
    programs: list[Path], octocell: Octocell, tmp_path: Path
) -> None:
    wrong = 0
    for spheres in random_scenes(100):
        path = write(spheres, tmp_path / "scene.csv")
        octocell.ok("find", path, "--rule", "as_written", "-o", tmp_path / "pairs.npy")
        found = pairs_of(printed(programs[0], path))
        assert found == [tuple(pair) for pair in np.load(tmp_path / "pairs.npy").tolist()]
        wrong += difference(found, spheres) != "."
    assert wrong > 30  # the text loses pairs in many scenes


def test_chapter_32_and_what_follows_are_exact_on_scenes_near_the_origin(
    programs: list[Path], tmp_path: Path
) -> None:
    for spheres in random_scenes(100):
        path = write(spheres, tmp_path / "scene.csv")
        found = [difference(pairs_of(printed(program, path)), spheres) for program in programs[5:]]
        assert found == [".", ".", "."]


def test_the_last_step_is_exact_on_hard_scenes(programs: list[Path], tmp_path: Path) -> None:
    refused = []
    for name, spheres in HARD_SCENES.items():
        if len(spheres) == 0:
            continue  # refused, as a file without spheres
        path = write(spheres, tmp_path / "scene.csv")
        done = subprocess.run([programs[7], path], capture_output=True, text=True, check=False)
        if done.returncode == 2:
            assert re.fullmatch(r"too many cells.*|.*more than 1e9 cells.*", done.stderr.strip())
            refused.append(name)
        else:
            assert difference(pairs_of(done.stdout), spheres) == ".", name
    assert len(refused) < len(HARD_SCENES) / 2, refused


def entries_of(text: str, title: str) -> list[list[str]]:
    """The entries under each heading of that name: 'cell 3: sphere 0 home'."""
    blocks = re.findall(rf"^{title}\n((?:  \[.*\n)*)", text, re.M)
    return [re.findall(r"cell .*", block) for block in blocks]


def test_passes_move_entries_and_the_last_leaves_them_sorted(programs: list[Path]) -> None:
    text = printed(programs[0], SCENES / "eight.csv")
    (unsorted,), passes = entries_of(text, "cells of each sphere"), entries_of(text, " sorted")
    assert len(passes) == 4
    for done, entries in enumerate(passes, 1):
        assert Counter(entries) == Counter(unsorted)
        key = [int(entry.split()[1][:-1]) % 256**done for entry in entries]
        assert key == sorted(key)
    # Stable: entries of one cell stand in the order of spheres, phantoms before homes or not.
    assert passes[3] == sorted(unsorted, key=lambda entry: int(entry.split()[1][:-1]))
    assert "here a phantom stands before a home" in text


def test_the_index_counts_homes_and_phantoms(programs: list[Path]) -> None:
    text = printed(programs[0], SCENES / "eight.csv")
    entries, cells = entries_of(text, " sorted")[3], {}
    for cell, begin, homes, phantoms in re.findall(
        r"cell (\d+): begins at (\d+), H = (\d+), P = (\d+)", text
    ):
        run = entries[int(begin) : int(begin) + int(homes) + int(phantoms)]
        cells[cell] = run
        assert {entry.split(":")[0] for entry in run} == {f"cell {cell}"}
        assert sum(entry.endswith("home") for entry in run) == int(homes)
    assert sum(map(len, cells.values())) == len(entries)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("1,2,3,1\n1,2,x,1\n", f":2: {NOT_A_SPHERE}"),
        ("1,2,3\n", f":1: {NOT_A_SPHERE}"),
        ("1,2,3,4,5\n", f":1: {NOT_A_SPHERE}"),
        ("1,2,3,-1\n", f":1: {NOT_A_SPHERE}"),
        ("1,nan,3,1\n", f":1: {NOT_A_SPHERE}"),
        ("", ": no spheres here"),
    ],
)
def test_bad_files_are_refused(
    programs: list[Path], tmp_path: Path, text: str, reason: str
) -> None:
    path = tmp_path / "bad.csv"
    path.write_text(text, encoding="utf-8")
    for program in programs:
        done = subprocess.run([program, path], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stdout, done.stderr) == (2, "", f"{path}{reason}\n")


def test_the_files_are_short_and_each_step_is_a_small_change() -> None:
    for source in PIPELINE.glob("1_as_written.*"):
        assert len(source.read_text(encoding="utf-8").splitlines()) <= 250, source
    for before, after in pairwise(STEPS):
        text = after.read_text(encoding="utf-8")
        assert re.search(r"\n// wins back  .*(\n//   .*)*\n// why  .*(\n//   .*)*\n// cost  ", text)
        assert f"//   diff {before.name} {after.name}\n" in text
        lines = [path.read_text(encoding="utf-8").splitlines() for path in (before, after)]
        changed = [line for line in difflib.ndiff(*lines) if line[0] in "+-"]
        assert len(changed) <= MOST_CHANGED, (after.name, len(changed))


@pytest.mark.skipif(not shutil.which("nvcc"), reason="no nvcc here")
def test_the_cuda_file_makes_the_same_arrays(programs: list[Path], tmp_path: Path) -> None:
    program = build(PIPELINE / "1_as_written.cu", tmp_path)
    done = subprocess.run([program, SCENES / "eight.csv"], capture_output=True, text=True)
    if done.returncode == 2 and "CUDA" in done.stderr:
        pytest.skip(f"built, not run: {done.stderr.strip()}")
    for scene in LOSSES:
        host, device = (printed(p, SCENES / f"{scene}.csv") for p in (programs[0], program))
        for title in ("cells of each sphere", " sorted"):
            assert entries_of(device, title) == entries_of(host, title)
        assert pairs_of(device) == pairs_of(host)
