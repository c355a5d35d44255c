# SPDX-License-Identifier: MIT
"""`octocell trace`: the arrays of real runs are those that the stages must make of their input."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hard_scenes import Spheres
from program import ROOT, RULES, Octocell

SCENES = sorted((ROOT / "course/scenes").glob("*.csv"))
WAYS = (
    *(("--rule", rule) for rule in RULES),
    ("--method", "half_shell"),
    ("--method", "brute_force"),
)
PHANTOM = 1 << 31
ID_MASK = (1 << 28) - 1

Trace = dict[str, Any]


@pytest.fixture(scope="module")
def schema() -> Any:
    jsonschema = pytest.importorskip("jsonschema", reason="scripts/setup_browser.sh installs it")
    text = (ROOT / "docs/trace.schema.json").read_text(encoding="utf-8")
    return jsonschema.Draft202012Validator(json.loads(text))


@pytest.fixture(scope="module")
def backends(octocell: Octocell) -> list[str]:
    """Those that can run here."""
    missing = octocell.unavailable()
    return [backend for backend in octocell.listed("backends") if backend not in missing]


def trace(octocell: Octocell, folder: Path, scene: object, *options: str) -> Trace:
    octocell.ok("trace", scene, "-o", folder / "trace.json", *options)
    found: Trace = json.loads((folder / "trace.json").read_text(encoding="utf-8"))
    return found


def traces(octocell: Octocell, folder: Path, backend: str, scene: object) -> Iterator[Trace]:
    for way in WAYS:
        asked = ("trace", scene, "--backend", backend, *way, "-o", folder / "trace.json")
        done = octocell.run(*asked)
        if done.rc == 2 and "chapter32 does not hold" in done.stderr:
            continue
        assert done.rc == 0, done.stderr
        yield json.loads((folder / "trace.json").read_text(encoding="utf-8"))


def entries(arrays: Trace) -> list[tuple[int, int, bool]]:
    """Cell, sphere, phantom or not."""
    pairs = zip(arrays["cell_ids"], arrays["objects"], strict=True)
    return [(cell, word & ID_MASK, word >= PHANTOM) for cell, word in pairs]


def check_sort(stages: Trace) -> None:
    before = stages["cell_ids"]
    for number in stages["sort"]["passes"] or []:
        digits = [
            cell >> number["shift"] & (1 << number["bits"]) - 1 for cell in before["cell_ids"]
        ]
        assert number["counts"] == np.bincount(digits, minlength=1 << number["bits"]).tolist()
        assert number["offsets"] == [
            sum(number["counts"][:d]) for d in range(len(number["counts"]))
        ]
        order = np.argsort(digits, kind="stable").tolist()
        assert [number["destinations"][k] for k in order] == list(range(len(order)))
        for name in ("cell_ids", "objects"):
            assert number[name] == [before[name][k] for k in order]
        before = number
    if stages["sort"]["passes"] is not None:
        assert stages["sort"]["cell_ids"] == before["cell_ids"]
        assert stages["sort"]["objects"] == before["objects"]
    assert Counter(entries(stages["sort"])) == Counter(entries(stages["cell_ids"]))
    assert stages["sort"]["cell_ids"] == sorted(stages["sort"]["cell_ids"])


def cells_of(stages: Trace) -> dict[int, list[tuple[int, bool]]]:
    cells: dict[int, list[tuple[int, bool]]] = {}
    for cell, sphere, phantom in entries(stages["sort"]):
        cells.setdefault(cell, []).append((sphere, phantom))
    return cells


def check_cells(stages: Trace, rule: str) -> None:
    cells = cells_of(stages)
    for members in cells.values():
        assert [phantom for _, phantom in members] == sorted(phantom for _, phantom in members)
    listed = stages["cell_index"]["cells"]
    if listed is None:
        return
    seen = set()
    for entry in listed:
        members = cells[entry["cell"]]
        begin, homes = entry["begin"], entry["homes"]
        assert stages["sort"]["cell_ids"].index(entry["cell"]) == begin
        assert homes == sum(not phantom for _, phantom in members)
        assert homes + entry["phantoms"] == len(members)
        seen.add(entry["cell"])
    for cell, members in cells.items():
        homes = sum(not phantom for _, phantom in members)
        has_work = len(members) > 1 and (rule == "lowest_cell" or homes > 0)
        assert (cell in seen) == has_work, (cell, members)


def check_considered(found: Trace) -> None:
    rule = found["plan"]["rule"]
    stages = found["stages"]
    considered = stages["pair_tests"]["considered"]
    rows = Counter((c["cell"], c["i"], c["j"]) for c in considered)
    if rule is None:
        n = len(found["spheres"])
        assert rows == Counter((0, i, j) for i in range(n) for j in range(i + 1, n))
    else:
        wanted: Counter[tuple[int, int, int]] = Counter()
        for cell, members in cells_of(stages).items():
            for k, (i, i_phantom) in enumerate(members):
                if i_phantom and rule != "lowest_cell":
                    continue
                wanted.update((cell, i, j) for j, _ in members[k + 1 :])
        assert rows == wanted
    overlapping = sorted(sorted((c["i"], c["j"])) for c in considered if c["verdict"] == "overlap")
    assert overlapping == found["pairs"]


def check(found: Trace) -> None:
    stages = found["stages"]
    for path, reason in found["missing"].items():
        assert reason
        value: Any = found
        for name in path.split("."):
            value = value[name]
        assert value is None, path
    method = found["plan"]["method"]
    if method != "brute_force":
        check_sort(stages)
        homes = [entry for entry in entries(stages["cell_ids"]) if not entry[2]]
        assert [sphere for _, sphere, _ in homes] == list(range(len(found["spheres"])))
    if method == "home_phantom":
        check_cells(stages, found["plan"]["rule"])
    if method == "half_shell":
        assert stages["pair_tests"]["considered"] is None
    else:
        check_considered(found)
    certain = stages["pair_tests"]["certain"]
    assert sorted(certain + stages["resolve"]["overlap"]) == found["pairs"]


@pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)
def test_every_array_follows_from_the_one_before(
    octocell: Octocell, schema: Any, backends: list[str], scene: Path, tmp_path: Path
) -> None:
    for backend in backends:
        for found in traces(octocell, tmp_path, backend, scene):
            schema.validate(found)
            assert found["backend"] == backend
            check(found)


def random_scenes(count: int) -> Iterator[Spheres]:
    """Small, with ties: places and radii are often multiples of a quarter."""
    random = np.random.default_rng(20)
    for _ in range(count):
        n, size = random.integers(1, 33), random.uniform(1, 12)
        places = random.uniform(-size / 2, size, (n, 3)) * random.choice([1, 1, 0], (1, 3))
        radii = random.uniform(0.1, 1, n) ** random.choice([0, 1, 4])
        radii[0] = 1  # without any radius, each backend chooses its own cells
        scene = np.column_stack([places, radii])
        if random.random() < 0.5:
            scene = np.round(scene * 4) / 4
        yield scene.astype(np.float32)


def test_backends_make_the_same_cells_and_pairs(
    octocell: Octocell, backends: list[str], tmp_path: Path
) -> None:
    """Orders may differ: threads list phantoms in any order. Cells, homes and pairs may not."""
    for number, scene in enumerate(random_scenes(1000)):
        np.save(tmp_path / "scene.npy", scene)
        scene_file = tmp_path / "scene.npy"
        answers = [trace(octocell, tmp_path, scene_file, "--backend", b) for b in backends]
        first = answers[0]
        for found in answers:
            check(found)
            for stage in ("cell_ids", "sort"):
                ours, theirs = entries(first["stages"][stage]), entries(found["stages"][stage])
                assert Counter(ours) == Counter(theirs), (number, found["backend"])
            assert found["pairs"] == first["pairs"]


def test_the_verdict_of_an_uncertain_pair_is_the_last_stage_s(
    octocell: Octocell, tmp_path: Path
) -> None:
    found = trace(
        octocell, tmp_path, ROOT / "course/scenes/touching.csv", "--no-skip", "uncertain_pairs"
    )
    exact = [c for c in found["stages"]["pair_tests"]["considered"] if c["reason"] == "exact"]
    assert exact and len(exact) == len(found["stages"]["pair_tests"]["uncertain"])
    for candidate in exact:
        is_pair = sorted((candidate["i"], candidate["j"])) in found["pairs"]
        assert candidate["verdict"] == ("overlap" if is_pair else "apart")


def test_flags_are_a_reason(octocell: Octocell, tmp_path: Path) -> None:
    np.save(
        tmp_path / "scene.npy", np.array([[0, 0, 0, 1], [1, 0, 0, 1], [2, 0, 0, 1]], np.float32)
    )
    np.save(tmp_path / "flags.npy", np.array([True, True, False]))
    for backend in ("impl_cpu", "impl_thrust"):
        found = trace(
            octocell,
            tmp_path,
            tmp_path / "scene.npy",
            "--flags",
            str(tmp_path / "flags.npy"),
            "--backend",
            backend,
        )
        reasons = {
            (c["i"], c["j"]): c["reason"] for c in found["stages"]["pair_tests"]["considered"]
        }
        assert reasons[0, 1] == "flags" and [0, 1] not in found["pairs"]


def test_the_text_shows_every_stage(octocell: Octocell) -> None:
    text = octocell.ok("trace", ROOT / "course/scenes/eight.csv").stdout
    for head in (
        "1 bounds",
        "2 cell_ids",
        "3 sort",
        "4 cell_index",
        "5 pair_tests",
        "6 resolve",
        "pairs",
    ):
        assert f"\n{head}" in text
    assert max(map(len, text.splitlines()[1:])) <= 100


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("gas:n=10001",), "10001 spheres; a trace shows at most 10000"),
        (("gas:n=2000", "--method", "brute_force"), "a trace shows at most 1000000 of each"),
        (("gas:n=40", "--html", "{folder}/page.html"), "40 spheres; a page shows at most 32"),
        (("gas:n=0", "--html", "{folder}/page.html"), "without spheres"),
        (("gas:n=8", "gas:n=9"), "several scenes fit only into a page"),
        (("gas:n=8", "--backend", "fcl_dynamic_aabb_tree"), "is a library"),
        (("gas:n=8", "-o", ""), "the file name is empty"),
        (("gas:n=8", "-o", "{folder}/none/trace.json"), "cannot write"),
        (("gas:n=8", "--method", "half_shell", "--rule", "lowest_cell"), "has no rules"),
    ],
    ids=str,
)
def test_what_cannot_be_traced_is_refused(
    octocell: Octocell, arguments: tuple[str, ...], message: str, tmp_path: Path
) -> None:
    asked = [argument.format(folder=tmp_path) for argument in arguments]
    done = octocell.run("trace", *asked)
    assert done.rc == 2 and message in done.stderr, done
    assert done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_scene_is_not_overwritten(octocell: Octocell, tmp_path: Path) -> None:
    np.save(tmp_path / "scene.npy", np.ones((3, 4), np.float32))
    before = (tmp_path / "scene.npy").read_bytes()
    done = octocell.run("trace", tmp_path / "scene.npy", "-o", tmp_path / "scene.npy")
    assert done.rc == 2 and (tmp_path / "scene.npy").read_bytes() == before
