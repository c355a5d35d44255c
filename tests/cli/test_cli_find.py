# SPDX-License-Identifier: MIT
"""Compares `octocell find` and `generate` with the definition."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from program import ROOT, Octocell
from exact import Pairs, checksum, exact_pairs
from hard_scenes import SCENES, Spheres

BACKEND_STAGES = ["bounds", "cell_ids", "sort", "cell_index", "pair_tests", "resolve"]
KEYS = (
    "scene n static backend method planned rule predicate threads pairs checksum candidates "
    "uncertain_pairs runs plan_ms total_ms stage_ms"
).split()

# One line each of x y z r; the same spheres in every format.
FOUR = np.array([[0, 0, 0, 0.5], [0.75, 0, 0, 0.5], [5, -1, 2, 1.5], [5, -1, 4.5, 1]], np.float32)


@pytest.fixture(params=SCENES)
def hard_scene(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Path, Spheres]:
    path = tmp_path / f"{request.param}.npy"
    np.save(path, SCENES[request.param])
    return path, SCENES[request.param]


def pairs_of(octocell: Octocell, scene: object, folder: Path, *args: object) -> Pairs:
    """What `find -o` writes, after a look at its form."""
    path = folder / "pairs.npy"
    octocell.ok("find", scene, "-o", path, *args)
    pairs: Pairs = np.load(path)
    assert pairs.dtype == np.uint32
    assert pairs.ndim == 2 and pairs.shape[1] == 2
    assert pairs.flags.c_contiguous
    assert (pairs[:, 0] < pairs[:, 1]).all()
    assert pairs.tolist() == sorted(pairs.tolist())
    return pairs


def test_pairs_are_those_of_the_definition(
    octocell: Octocell, hard_scene: tuple[Path, Spheres], tmp_path: Path
) -> None:
    path, spheres = hard_scene
    truth = exact_pairs(spheres)
    assert pairs_of(octocell, path, tmp_path).tolist() == truth.tolist()
    for counting in ((), ("--count",)):
        answer = octocell.find(path, *counting)
        assert (answer["n"], answer["pairs"]) == (len(spheres), len(truth))
        assert answer["checksum"] == checksum(truth)


def test_the_hard_scenes_have_pairs_and_gaps() -> None:
    for name, spheres in SCENES.items():
        if len(spheres) < 2:
            continue
        count, possible = len(exact_pairs(spheres)), len(spheres) * (len(spheres) - 1) // 2
        assert 0 < count <= possible
        assert count < possible or name == "identical"


def test_every_implementation_agrees_or_says_why_not(
    octocell: Octocell, hard_scene: tuple[Path, Spheres]
) -> None:
    path, spheres = hard_scene
    truth = exact_pairs(spheres)
    faulty, unavailable = octocell.faulty(), octocell.unavailable()
    for how in octocell.implementations():
        if "as_written" in how:
            continue
        result = octocell.run("find", path, *how)
        if how[1] in unavailable:
            assert (result.rc, result.stdout) == (2, "")
            assert f"{how[1]} cannot run here: {unavailable[how[1]]}" in result.stderr
            continue
        if how[1] in faulty and result.rc == 0:
            assert "            may lose pairs: " in result.stdout
            found = re.search(r"^pairs +(\d+)$", result.stdout, re.MULTILINE)
            assert found and int(found[1]) <= len(truth), how
            continue
        if result.rc == 2 and "chapter32" in how:
            assert result.stdout == ""
            assert result.stderr.count("\n") == 1
            assert "rule chapter32 does not hold for this scene" in result.stderr
            continue
        assert result.rc == 0, (how, result.stderr)
        answer = f"pairs       {len(truth)}\nchecksum    {checksum(truth)}\n"
        assert answer in result.stdout, how


def test_as_written_loses_the_same_pairs_every_time(
    octocell: Octocell, hard_scene: tuple[Path, Spheres], tmp_path: Path
) -> None:
    path, spheres = hard_scene
    rule = ("--rule", "as_written")
    found = pairs_of(octocell, path, tmp_path, *rule, "--threads", 1).tolist()
    truth = exact_pairs(spheres).tolist()
    assert all(pair in truth for pair in found)  # some twice, where ids collide
    for threads in (1, 2, 3, 7):
        again = pairs_of(octocell, path, tmp_path, *rule, "--threads", threads).tolist()
        assert again == found, threads


def test_as_written_is_a_negative_control_because_it_loses_pairs(octocell: Octocell) -> None:
    whole = octocell.find("gas:n=5000")
    negative_control = octocell.find("gas:n=5000", "--rule", "as_written")
    assert 0 < negative_control["pairs"] < whole["pairs"]
    assert "negative control" in octocell.ok("find", "gas:n=5000", "--rule", "as_written").stdout


@pytest.mark.parametrize("scene", ["gas:n=20000", "poly:n=20000", "lattice:n=20000,shuffle=1"])
@pytest.mark.parametrize("rule", ["lowest_cell", "chapter32"])
def test_the_number_of_threads_changes_nothing(
    octocell: Octocell, scene: str, rule: str, tmp_path: Path
) -> None:
    answers, files = set(), set()
    for threads in (1, 2, 3, 7):
        path = tmp_path / f"{threads}.npy"
        answer = octocell.find(scene, "--rule", rule, "--threads", threads, "-o", path)
        assert answer["threads"] == threads
        files.add(path.read_bytes())
        answers.add(tuple(answer[key] for key in ("pairs", "checksum", "candidates", "uncertain_pairs")))
    assert len(answers) == 1
    assert len(files) == 1


@pytest.mark.parametrize("side", [0.1, 0.3, 1.0, 7.5, 1e9])
def test_any_cell_side_gives_the_same_answer(octocell: Octocell, side: float) -> None:
    scene = "poly:n=2000"
    assert octocell.find(scene, "--cell-side", side)["checksum"] == octocell.find(scene)["checksum"]


@pytest.mark.parametrize("name", ["gas", "dense", "poly", "cluster", "lattice", "shifted", "giant"])
def test_generated_scenes_hold_what_the_definition_says(
    octocell: Octocell, name: str, tmp_path: Path
) -> None:
    path = tmp_path / "scene.npy"
    octocell.ok("generate", f"{name}:n=300", "-o", path)
    spheres = np.load(path)
    assert (spheres.shape, spheres.dtype) == ((300, 4), np.float32)
    assert octocell.find(f"{name}:n=300")["checksum"] == checksum(exact_pairs(spheres))


def test_generate_round_trip(octocell: Octocell, tmp_path: Path) -> None:
    first, again, copy = (tmp_path / name for name in ("a.npy", "b.npy", "c.npy"))
    octocell.ok("generate", "poly:n=400,seed=7", "-o", first)
    octocell.ok("generate", octocell.find("poly:n=400,seed=7")["scene"], "-o", again)
    said = octocell.ok("generate", first, "-o", copy).stdout
    assert "400 spheres" in said and str(copy) in said
    assert first.read_bytes() == again.read_bytes() == copy.read_bytes()
    assert octocell.find(first)["checksum"] == octocell.find("poly:n=400,seed=7")["checksum"]
    assert octocell.find("poly:n=400,seed=8")["checksum"] != octocell.find(first)["checksum"]


def test_json_has_every_key(octocell: Octocell) -> None:
    answer = octocell.find("gas:n=500")
    assert list(answer) == KEYS
    assert (answer["backend"], answer["method"], answer["rule"]) == (
        "impl_cpu",
        "half_shell",
        None,
    )
    assert answer["planned"]
    assert list(answer["stage_ms"]) == BACKEND_STAGES
    assert sum(answer["stage_ms"].values()) <= answer["total_ms"] + 1e-6
    assert min(answer["stage_ms"].values()) >= 0
    assert answer["runs"] >= 1 and answer["candidates"] >= answer["pairs"]


def test_json_of_brute_force_and_of_baselines(octocell: Octocell) -> None:
    brute = octocell.find("gas:n=500", "--method", "brute_force")
    assert (brute["method"], brute["rule"]) == ("brute_force", None)
    assert brute["candidates"] == 500 * 499 // 2
    assert list(brute["stage_ms"]) == ["bounds", "pair_tests", "resolve"]
    for name in octocell.listed("baselines"):
        answer = octocell.find("gas:n=500", "--backend", name)
        assert (answer["backend"], answer["method"], answer["rule"]) == (name, None, None)
        assert answer["threads"] == 1
        assert list(answer["stage_ms"]) == ["build", "query"]


def test_explain_says_more_on_stderr_only(octocell: Octocell) -> None:
    result = octocell.ok("find", "gas:n=500", "--explain", "--json")
    assert result.stderr.count("\n") > 1
    assert result.stdout.startswith("{")
    assert octocell.ok("find", "gas:n=500", "--json").stderr == ""


CSV_FORMS = {
    "plain": "0,0,0,0.5\n0.75,0,0,0.5\n5,-1,2,1.5\n5,-1,4.5,1\n",
    "header": "x,y,z,r\n0,0,0,0.5\n0.75,0,0,0.5\n5,-1,2,1.5\n5,-1,4.5,1\n",
    "other_order": "r,z,y,x\n0.5,0,0,0\n.5,0,0,.75\n1.5,2,-1,5\n1,4.5,-1,5\n",
    "windows": "\ufeffx,y,z,r\r\n0,0,0,0.5\r\n0.75,0,0,0.5\r\n5,-1,2,1.5\r\n5,-1,4.5,1\r\n",
    "comments": "# four\n\n0, 0, 0, 5e-1 # one\n+0.75,0,0,0.5\n\n5,-1,2,1.5\n5,-1,45e-1,1",
}


@pytest.mark.parametrize("form", CSV_FORMS)
def test_csv_gives_the_same_answer_as_npy(octocell: Octocell, form: str, tmp_path: Path) -> None:
    path = tmp_path / "four.csv"
    path.write_text(CSV_FORMS[form], encoding="utf-8", newline="")
    np.save(tmp_path / "four.npy", FOUR)
    assert pairs_of(octocell, path, tmp_path).tolist() == [[0, 1], [2, 3]]
    assert pairs_of(octocell, tmp_path / "four.npy", tmp_path).tolist() == [[0, 1], [2, 3]]


@pytest.mark.parametrize("scene", ["radii_differ", "denormals", "near_the_end_of_float"])
def test_what_numpy_writes_as_text_is_read_to_the_last_bit(
    octocell: Octocell, scene: str, tmp_path: Path
) -> None:
    path, back = tmp_path / "scene.csv", tmp_path / "back.npy"
    np.savetxt(path, SCENES[scene], fmt="%.9g", delimiter=",", header="x,y,z,r")
    octocell.ok("generate", path, "-o", back)
    assert np.load(back).tobytes() == SCENES[scene].tobytes()


def test_csv_with_only_a_header_is_an_empty_scene(octocell: Octocell, tmp_path: Path) -> None:
    (tmp_path / "none.csv").write_text("x,y,z,r\n", encoding="utf-8")
    assert octocell.find(tmp_path / "none.csv")["n"] == 0


def test_pqr_atoms_are_spheres_and_other_records_are_not(
    octocell: Octocell, tmp_path: Path
) -> None:
    path = tmp_path / "four.pqr"
    path.write_text(
        "REMARK   1 made by hand\n"
        "ATOM      1  N   GLY A   1       0.000   0.000   0.000 -0.3000 0.5000\n"
        "ATOM      2  CA  GLY     1       0.750   0.000   0.000  0.1000 0.5000\n"
        "TER\n"
        "HETATM    3  O   HOH A   2       5.000  -1.000   2.000 -0.8340 1.5000\n"
        "HETATM    4  H1  HOH A   2       5.000  -1.000   4.500  0.4170 1.0000\n"
        "END\n",
        encoding="utf-8",
    )
    octocell.ok("generate", path, "-o", tmp_path / "four.npy")
    assert np.load(tmp_path / "four.npy").tolist() == FOUR.tolist()
    assert pairs_of(octocell, path, tmp_path).tolist() == [[0, 1], [2, 3]]


def test_the_molecule_if_it_was_fetched(octocell: Octocell) -> None:
    molecule = ROOT / "data" / "1A2C.pqr"
    if not molecule.exists():
        pytest.skip(f"{molecule} was not fetched")
    brute = octocell.find(molecule, "--method", "brute_force")
    assert octocell.find(molecule)["checksum"] == brute["checksum"]
    assert brute["n"] == 5313


@pytest.fixture
def float64_scene(tmp_path: Path) -> Path:
    """One pair that rounding makes, one that it breaks, one that it leaves."""
    r = 0.5 + 0.49 * 2**-24  # rounds to 0.5
    scene = np.array(
        [
            [1 + 1e-9, 0, 0, 0.5],  # rounds to 1: touches the next
            [0, 0, 0, 0.5],
            [1, 10, 0, r],
            [-(2.0**-25), 10, 0, r],  # exact in float32: 1 + 2^-25 from the last
            [0, 20, 0, 1],
            [0, 21, 0, 1],
        ]
    )
    assert exact_pairs(scene).tolist() == [[2, 3], [4, 5]]
    assert exact_pairs(scene.astype(np.float32)).tolist() == [[0, 1], [4, 5]]
    np.save(tmp_path / "float64.npy", scene)
    return tmp_path / "float64.npy"


def test_round_input_says_what_rounding_changed(
    octocell: Octocell, float64_scene: Path, tmp_path: Path
) -> None:
    answer = octocell.find(float64_scene, "--round-input")
    assert answer["rounding"] == {"lost": 1, "gained": 1}
    assert answer["pairs"] == 2
    text = octocell.ok("find", float64_scene, "--round-input").stdout
    assert "lost 1 pairs and gained 1" in text
    pairs = pairs_of(octocell, float64_scene, tmp_path, "--round-input")
    assert pairs.tolist() == [[0, 1], [4, 5]]


def test_round_input_of_a_generator_tells_what_it_rounded(octocell: Octocell) -> None:
    far = octocell.find("shifted:n=2000,offset=1e7", "--round-input")
    assert far["rounding"]["lost"] > 0 < far["rounding"]["gained"]
    plain = octocell.find("shifted:n=2000,offset=1e7")
    assert "rounding" not in plain and plain["checksum"] == far["checksum"]
    assert octocell.find("chain:n=200", "--round-input")["rounding"] == {"lost": 0, "gained": 0}


def test_round_input_leaves_float32_alone(octocell: Octocell, tmp_path: Path) -> None:
    np.save(tmp_path / "four.npy", FOUR)
    assert "rounding" not in octocell.find(tmp_path / "four.npy", "--round-input")


def test_a_predicate_can_be_asked_for(octocell: Octocell) -> None:
    exact = octocell.find("gas:n=3000")
    boxes = octocell.find("gas:n=3000", "--predicate", "aabb_only")
    assert (exact["predicate"], boxes["predicate"]) == ("exact", "aabb_only")
    assert boxes["pairs"] > exact["pairs"]
    assert octocell.find("gas:n=3000", "--predicate", "q16_exact")["checksum"] == exact["checksum"]
    assert "can be wrong" in octocell.ok("find", "gas:n=9", "--predicate", "f32").stdout


@pytest.mark.parametrize(
    ("backend", "predicate", "words"),
    [
        ("impl_cpu", "f128", ("f128", "q16_exact")),
        ("impl_thrust", "q16_cell", ("impl_thrust", "f32_sqrt")),
        ("bullet_dbvt", "f32", ("bullet_dbvt", "predicate")),
    ],
)
def test_a_predicate_that_is_not_there_is_refused(
    octocell: Octocell, backend: str, predicate: str, words: tuple[str, str]
) -> None:
    result = octocell.run("find", "gas:n=9", "--backend", backend, "--predicate", predicate)
    assert result.rc == 2
    assert all(word in result.stderr for word in words), result.stderr
