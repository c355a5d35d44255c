# SPDX-License-Identifier: MIT
"""`octocell try --stage`: one stage of a hand-in, judged on arrays."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from program import ROOT, Octocell, Refused
from stage_hand_ins import CPP, PYTHON
from trying import Try

STAGES = ("cell_ids", "sort", "cell_index", "pair_tests")


@pytest.fixture(name="attempt")
def _attempt(octocell: Octocell, tmp_path: Path) -> Try:
    return Try(octocell, tmp_path)


@pytest.fixture(scope="module", name="library")
def _library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All four stages in one, compiled once."""
    folder = tmp_path_factory.mktemp("stages")
    (folder / "a.cpp").write_text(CPP, encoding="utf-8")
    command = ["c++", "-std=c++20", "-O1", "-shared", "-fPIC", "-I", ROOT / "include/octocell"]
    subprocess.run([*command, folder / "a.cpp", "-o", folder / "a.so"], check=True)
    return folder / "a.so"


@pytest.mark.parametrize("stage", [s for s in STAGES if s != "sort"])
def test_a_right_stage_is_exact(octocell: Octocell, library: Path, stage: str) -> None:
    result = octocell.ok("try", library, "--stage", stage, "--budget", "0.01")
    assert f"a.so: exact: stage {stage} on " in result.stdout
    assert "dense:n=1000,seed=2" in result.stdout


def test_red_zones_are_before_and_behind(octocell: Octocell, library: Path) -> None:
    result = octocell.run("try", library, "--stage", "sort", "--budget", "0.01")
    assert result.rc == 2
    assert (
        "fails on keys:n=257,bits=8,seed=1: it wrote before the beginning of ids" in result.stdout
    )


@pytest.mark.parametrize("stage", STAGES)
def test_python_is_judged_too(attempt: Try, stage: str) -> None:
    answer = attempt(PYTHON, "--stage", stage, name="mine.py")
    assert (answer["verdict"], answer["function"]) == ("exact", stage)
    assert answer["scenes"][-1]["scene"].startswith("fcc")


SORT = '    order = np.argsort(ids, kind="stable")\n    return ids[order], objects[order]'
ID = "x + grid.cells[0] * (y + grid.cells[1] * z)"
APPEND = "(homes if at_home else phantoms)"
AT_HOME_AGAIN = "if at_home: phantoms.append((id, s | marks | 1 << 31))\n" + " " * 20
TWO = "if end - begin >= 2"
KINDS = "end - begin - phantoms, phantoms"
COUNTS = "counts = ((o[k] | o[k + 1 :]) >> 28 & 7) == 7"
BLOCKS = """    order = np.concatenate([b + np.argsort(ids[b:b+256], kind="stable")
                            for b in range(0, max(len(ids), 1), 256)])
    return ids[order], objects[order]"""
TWO_PASSES = """    low = np.argsort(ids & 15, kind="stable")
    order = low[np.lexsort((-np.arange(len(ids)), ids[low] >> 4))]
    return ids[order], objects[order]"""


@pytest.mark.parametrize(
    ("stage", "old", "new", "cause"),
    [
        ("sort", "np.argsort(ids, kind", "np.argsort(ids.view(np.int32), kind", "signed keys"),
        ("sort", SORT, SORT.replace("ids,", "-ids.astype(int),"), "descending"),
        ("sort", SORT, "    return ids, objects", "nothing sorted"),
        (
            "sort",
            'np.argsort(ids, kind="stable")',
            "np.lexsort((-np.arange(len(ids)), ids))",
            "not stable",
        ),
        ("sort", SORT, SORT[:-7], "objects not carried along"),
        ("sort", SORT, SORT + " & SPHERE", "control bits lost"),
        ("sort", SORT, SORT + "[::-1]", "objects of other ids"),
        (
            "sort",
            "    return ids[order], objects[order]",
            "    ids, objects = ids[order], objects[order]\n"
            "    if len(ids) > 2: ids[1] = ids[0]\n    return ids, objects",
            "ids lost",
        ),
        (
            "sort",
            "    return ids[order], objects[order]",
            "    m = len(ids) // 256 * 256\n    if m == 0: return ids[order], objects[order]\n"
            "    order = np.argsort(ids[:m], kind='stable')\n    rest = [0] * (len(ids) - m)\n"
            "    return np.append(ids[order], rest), np.append(objects[order], rest)",
            "last block missing",
        ),
        ("sort", "np.argsort(ids,", "np.argsort(ids & 255,", "high bits missing"),
        ("sort", SORT, BLOCKS, "blocks not merged"),
        ("sort", SORT, TWO_PASSES, "a pass not stable"),
        ("cell_ids", " - grid.corner)", ")", "corner ignored"),
        ("cell_ids", "np.floor((", "np.floor(0.5 + (", "rounded"),
        ("cell_ids", ID, "z + grid.cells[2] * (y + grid.cells[1] * x)", "axes exchanged"),
        ("cell_ids", "(homes + phantoms,", "(homes,", "no phantoms"),
        ("cell_ids", "== low[s][a])", "== high[s][a])", "highest for lowest"),
        ("cell_ids", "entries[:, 1]\n", "entries[:, 1] & SPHERE\n", "control bits lost"),
        ("cell_ids", "(not at_home) << 31", "0", "phantom bit lost"),
        ("cell_ids", APPEND, AT_HOME_AGAIN + APPEND, "home listed again"),
        ("cell_index", TWO, "if end > begin", "cells of one entry"),
        ("cell_index", "[*begins[1:], len(ids)]", "begins[1:]", "last cell missing"),
        ("cell_index", KINDS, "phantoms, end - begin - phantoms", "homes and phantoms exchanged"),
        ("cell_index", TWO, TWO + " and phantoms < end - begin", "no homes no cell"),
        ("cell_index", TWO, TWO + " and begin // 256 == (end - 1) // 256", "block borders"),
        ("pair_tests", COUNTS, "counts = j >= 0", "several cells"),
    ],
)
def test_the_cause_of_a_wrong_stage_is_named(
    attempt: Try, stage: str, old: str, new: str, cause: str
) -> None:
    assert PYTHON.count(old) == 1
    answer = attempt(PYTHON.replace(old, new), "--stage", stage, name="mine.py")
    assert answer["verdict"] == "wrong"
    assert answer["cause"] and answer["cause"]["name"] == cause, answer
    assert len(answer["first"]) == 1 or stage == "pair_tests"


def test_the_first_wrong_entry_is_shown(attempt: Try) -> None:
    text = PYTHON.replace(SORT, SORT + " & SPHERE")
    result = attempt.run(text, "--stage", "sort", name="mine.py")
    assert result.rc == 1
    lines = result.stdout.splitlines()
    assert re.match(r"first wrong  objects \d+: expected \d+P .*, got \d+H ", lines[-4])
    assert lines[-3].startswith("cause        control bits lost: bits 28 to 31 of all objects")
    assert lines[-1].endswith("look at it first") and "mine.py: wrong: stage sort on" in lines[-1]


def test_a_stage_must_be_there(attempt: Try) -> None:
    ending = attempt.ending("x = 1", "--stage", "sort", name="mine.py")
    assert ending == "fails: it defines no function sort(ids, objects, key_bits)"
    changes = "def sort(ids, objects, key_bits):\n    ids.sort()\n    return ids, objects"
    assert (
        attempt.ending(changes, "--stage", "sort", name="mine.py") == "fails: it changed its input"
    )
    assert "no ids, objects" in attempt.ending(
        "def sort(ids, objects, key_bits): return ids", "--stage", "sort", name="mine.py"
    )


def test_an_unknown_stage_is_refused(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "a.py").touch()
    for name in ("resolve", "find_pairs", "x"):
        assert "expected cell_ids, sort, cell_index or pair_tests" in refused(
            "try", "a.py", "--stage", name
        )
