# SPDX-License-Identifier: MIT
"""`octocell why`: an account of one pair, which must agree with what the backends find."""

from __future__ import annotations

import json
from collections import Counter
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hard_scenes import Spheres, spheres
from program import ROOT, Octocell, Refused

SCENES = ROOT / "course/scenes"
WAYS = (
    ("--rule", "lowest_cell"),
    ("--rule", "chapter32"),
    ("--rule", "as_written"),
    ("--method", "half_shell"),
    ("--method", "brute_force"),
    ("--method", "tiles"),  # nothing runs, so an account needs no GPU
)
TOUCHING = spheres([0, 1], 0, 0, 0.5)


def why(octocell: Octocell, scene: object, i: int, j: int, *options: str) -> dict[str, Any]:
    answer: dict[str, Any] = json.loads(octocell.ok("why", scene, i, j, "--json", *options).stdout)
    return answer


def saved(scene: Spheres, folder: Path) -> Path:
    np.save(folder / "scene.npy", scene)
    return folder / "scene.npy"


@pytest.mark.parametrize(
    ("scene", "pair", "flaw"),
    [
        ("smaller_home", (0, 1), "smaller home only"),
        ("both_phantoms", (0, 1), "both phantoms"),
        ("ninth_cell", (2, 3), "eight slots"),
        ("negative", (0, 1), "unsigned cells"),
        ("same_id", (1, 2), "shared ids"),
    ],
)
def test_each_flaw_of_the_text_has_its_name(
    octocell: Octocell, scene: str, pair: tuple[int, int], flaw: str
) -> None:
    path = SCENES / f"{scene}.csv"
    answer = why(octocell, path, *pair, "--rule", "as_written")
    assert answer["flaw"]["name"] == flaw
    assert answer["times_found"] == (2 if flaw == "shared ids" else 0)
    text = octocell.ok("why", path, *pair, "--rule", "as_written").stdout
    assert f"\nflaw         {flaw}: " in text
    right = why(octocell, path, *pair)
    assert (right["rule"], right["times_found"], right["flaw"]) == ("lowest_cell", 1, None)


def some_pairs(scene: Spheres, count: int) -> list[tuple[int, int]]:
    """Those nearest to touching, so that about half of them overlap."""
    i, j = np.triu_indices(len(scene), 1)
    distance = np.linalg.norm(scene[i, :3].astype(float) - scene[j, :3], axis=1)
    nearest = np.argsort(abs(distance - scene[i, 3] - scene[j, 3]))[:count]
    return [(int(i[k]), int(j[k])) for k in nearest]


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way[1])
def test_accounts_agree_with_what_is_found(
    octocell: Octocell, tmp_path: Path, way: tuple[str, str]
) -> None:
    random = np.random.default_rng(5)
    met: Counter[int] = Counter()
    for number in range(6):
        n, size = 24, random.uniform(3, 9)
        radii = 10 ** random.uniform(-1 if number % 2 else -0.2, 0, n)
        scene = np.column_stack([random.uniform(-size / 4, size, (n, 3)), radii])
        path = saved(scene.astype(np.float32), tmp_path)
        finder = ("--method", "planned") if "tiles" in way else way
        octocell.ok("find", path, *finder, "-o", tmp_path / "pairs.npy")
        found = Counter(map(tuple, np.load(tmp_path / "pairs.npy").tolist()))
        for pair in some_pairs(np.load(path), 14):
            answer = why(octocell, path, *pair, *way)
            assert answer["times_found"] == found[pair], (number, pair)
            met[answer["times_found"]] += 1
    assert met[0] > 10 and met[1] > 10


def test_numbers_are_given_with_all_their_digits(octocell: Octocell, tmp_path: Path) -> None:
    scene = np.array(
        [
            [0.1, 0.2, 0.3, 0.4],
            [1.1, -2.7, 3.3, 1e-3],
            [2.0**-149, 0, 0, 2.0**-149],
            [3e38, -3e38, 3e38, 1e38],
        ],
        np.float32,
    )
    path = saved(scene, tmp_path)
    for i, j in ((0, 1), (0, 2), (1, 3), (2, 3)):
        p, q = ([Fraction(float(v)) for v in scene[k]] for k in (i, j))
        overlap = why(octocell, path, i, j, "--method", "brute_force")["overlap"]
        distance2 = sum((a - b) ** 2 for a, b in zip(p[:3], q[:3], strict=True))
        assert Fraction(overlap["distance2"]) == distance2
        assert Fraction(overlap["radius_sum2"]) == (p[3] + q[3]) ** 2
        assert overlap["answer"] == (distance2 <= (p[3] + q[3]) ** 2)


TINY = 2.0**-40


@pytest.mark.parametrize(
    ("scene", "decided_by"),
    [
        (spheres([0, 1.5], 0, 0, 1), "plain float32, exact on this lattice"),
        (spheres([0, 1.1], 0, 0, 1), "float32 with an error bound"),
        (spheres([0, 1 - 2.0**-23], 0, 0, 0.5), "float64 with an error bound"),
        (spheres([0, 1 + 2.0**-20], 0, 0, [0.5, 0.5 + 2.0**-20]), "float64, without any rounding"),
        (spheres([1, -TINY], 0, 0, [1, TINY]), "integers"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_the_level_that_decides_is_named(
    octocell: Octocell, tmp_path: Path, scene: Spheres, decided_by: str
) -> None:
    answer = why(octocell, saved(scene, tmp_path), 0, 1, "--method", "brute_force")
    assert answer["overlap"]["decided_by"] == decided_by


def test_flags_can_forbid_a_pair(octocell: Octocell, tmp_path: Path) -> None:
    path = saved(TOUCHING, tmp_path)
    np.save(tmp_path / "static.npy", np.array([True, True]))
    text = octocell.ok("why", path, 0, 1, "--flags", tmp_path / "static.npy").stdout
    assert text.endswith("found        no, and rightly: by their flags they do not collide\n")


def test_a_large_sphere_shows_some_cells_and_counts_all(octocell: Octocell, tmp_path: Path) -> None:
    scene = np.concatenate(
        [spheres(np.arange(200) % 20, np.arange(200) // 20, 0, 0.1), spheres(9, 5, 0, 8)]
    )
    answer = why(octocell, saved(scene, tmp_path), 0, 200, "--cell-side", "0.5")
    large = answer["spheres"][1]
    assert len(large["cells"]) == 32 < large["cell_count"]
    assert large["cells"][0]["home"] and not large["cells"][1]["home"]


def test_check_names_the_first_wrong_pair_and_the_command(octocell: Octocell) -> None:
    path = SCENES / "eight.csv"
    text = octocell.ok("check", path, "--backend", "impl_cpu").stdout
    line = next(line for line in text.splitlines() if "first missed" in line)
    command = line.split("; octocell ")[1].split()
    assert command[0] == "why" and command[-2:] == ["--rule", "as_written"]
    assert "this pair is LOST" in octocell.ok(*command).stdout


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (("0", "2"), "no sphere 2: the scene has 2 spheres, numbered from 0"),
        (("1", "1"), "1 twice: a pair is two spheres"),
        (("0", "1", "--rule", "best"), "unknown rule 'best'"),
        (("0", "1", "--method", "half_shell", "--rule", "chapter32"), "has no rules"),
        (("0", "-1"), ""),
        (("0",), ""),
    ],
)
def test_bad_questions_are_refused(
    refused: Refused, tmp_path: Path, options: tuple[str, ...], reason: str
) -> None:
    saved(TOUCHING, tmp_path)
    assert reason in refused("why", "scene.npy", *options)
