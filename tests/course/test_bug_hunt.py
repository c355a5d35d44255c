# SPDX-License-Identifier: MIT
"""The bug hunt: each case shows where it says, and answers are checked."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
import tomllib
from plant import PlantedFault, faults
from program import ROOT, Octocell, module_of

HUNT = ROOT / "course/bug_hunt.py"
TABLE = tomllib.loads((ROOT / "course/bug_hunt.toml").read_text(encoding="utf-8"))
FAULTY = next(
    (
        path
        for path in (ROOT / "build-hunt/octocell", ROOT / "build-faults/octocell")
        if path.exists()
    ),
    None,
)
bug_hunt = module_of(HUNT)


def hunt(folder: Path, *words: object) -> tuple[int, str]:
    done = subprocess.run(
        [sys.executable, HUNT, *map(str, words)],
        env={**os.environ, "OCTOCELL_HUNT_BUILD": str(folder)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout


def test_cases_are_faults_of_the_cpu() -> None:
    planted = {fault.name: fault for fault in faults()}
    assert len(TABLE) == 12 and TABLE.keys() <= planted.keys()
    assert all(planted[name].file.startswith(("core/", "impl_cpu/")) for name in TABLE)
    assert [fault.name for fault in bug_hunt.cases()] != [
        fault.name for fault in faults() if fault.name in TABLE
    ]


@pytest.mark.parametrize("number", range(1, len(TABLE) + 1))
def test_answers_are_checked(tmp_path: Path, number: int) -> None:
    code, words = hunt(tmp_path, "start", number)
    fault: PlantedFault = bug_hunt.cases()[number - 1]
    assert code == 0 and f"case {number}" in words and fault.name not in words
    assert fault.what not in words and fault.file not in words
    line = bug_hunt.line_of(fault)
    text = (ROOT / fault.file).read_text(encoding="utf-8").splitlines()[line - 1]
    assert fault.sound.replace("«", "").split()[0][:6] in "".join(text) or "«" in fault.sound
    assert hunt(tmp_path, "answer", "core/sphere.hpp")[0] == 1
    code, words = hunt(tmp_path, "answer", fault.file)
    assert code == 1 and "in which line" in words
    assert hunt(tmp_path, "answer", f"{fault.file}:{line + 7}")[0] == 1
    code, words = hunt(tmp_path, "answer", f"{fault.file}:{line - 5}")
    assert code == 0 and fault.what in words
    assert fault.what in hunt(tmp_path, "give-up")[1]


def test_what_cannot_be_is_one_line(tmp_path: Path) -> None:
    for words, reason in {
        ("answer", "core/grid.hpp:3"): "no case is open",
        ("start", 99): "there are cases 1 to 12, not 99",
        ("octocell", "list"): "is missing; make bug-hunt builds it",
    }.items():
        code, said = hunt(tmp_path, *words)
        assert code != 0 and reason in said and said.count("\n") == 1, said
        if words[0] == "start":
            assert hunt(tmp_path, "start", 1)[0] == 0
    for place, reason in {
        "core/none.hpp:3": "no file",
        "core/grid.hpp:x": "not the number",
    }.items():
        code, said = hunt(tmp_path, "answer", place)
        assert code != 0 and reason in said and said.count("\n") == 1, said


def found(program: Octocell, name: str, folder: Path) -> Path:
    pairs = folder / "pairs.npy"
    case = TABLE[name]
    program.ok("find", case["scene"], *case["options"].split(), "-o", pairs, cwd=ROOT)
    return pairs


@pytest.mark.parametrize("name", TABLE)
def test_the_sound_program_is_right_there(octocell: Octocell, tmp_path: Path, name: str) -> None:
    pairs = found(octocell, name, tmp_path)
    octocell.ok("judge", TABLE[name]["scene"], pairs, cwd=ROOT)


@pytest.mark.skipif(FAULTY is None, reason="no build with planted faults; make bug-hunt makes one")
@pytest.mark.parametrize("name", TABLE)
def test_the_faulty_program_is_wrong_there(
    octocell: Octocell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    assert FAULTY is not None
    with monkeypatch.context() as faulty:
        faulty.setenv("OCTOCELL_FAULT", name)
        pairs = found(Octocell(FAULTY), name, tmp_path)
    judged = octocell.run("judge", TABLE[name]["scene"], pairs, cwd=ROOT)
    assert judged.rc == 1, judged.stdout
