# SPDX-License-Identifier: MIT
"""The planted faults: each name occurs in the code once; the normal program has none."""

from __future__ import annotations

import re
import subprocess
from collections import Counter

import mutants
import pytest
from program import ROOT, Octocell
from runner import Check, Runner, why_failed

TABLE = ROOT / "tests/mutation/fault_table.hpp"
USE = """
#include "core/faults.hpp"
int answer(int r) { return OCTOCELL_FAULT(filter_touching_apart, r < 3, r <= 3); }
"""


def names() -> list[str]:
    return re.findall(r'^  fault\((\w+), "', TABLE.read_text(encoding="utf-8"), re.MULTILINE)


def planted() -> list[str]:
    texts = (path.read_text(encoding="utf-8") for path in mutants.sources())
    return [name for text in texts for name in mutants.PLANTED.findall(text)]


def preprocessed(*flags: str) -> str:
    command = ["g++", "-std=c++20", "-E", "-P", f"-I{ROOT}", *flags, "-x", "c++", "-"]
    done = subprocess.run(command, input=USE, text=True, capture_output=True, check=True)
    return done.stdout


def test_every_fault_is_planted_once_and_none_is_unknown() -> None:
    assert len(names()) >= 25
    assert Counter(planted()) == Counter(names())
    assert max(Counter(names()).values()) == 1


def test_every_fault_has_checks_of_its_own_that_exist() -> None:
    stems = {
        path.stem for path in (ROOT / "tests").rglob("test_*") if path.suffix in {".cpp", ".cu"}
    }
    stress = {"stress_impl_cpu", "stress_impl_thrust", "stress_many_pairs"}
    for name, (file, line) in mutants.places().items():
        likely = mutants.Fault(name, "", file, line).likely
        assert likely, f"{name} in {file}: no check in LIKELY"
        assert set(likely) <= stems | stress, name


def test_without_faults_only_the_sound_code_is_left() -> None:
    assert " ".join(preprocessed().split()) == "int answer(int r) { return (r <= 3); }"
    with_faults = preprocessed("-DOCTOCELL_FAULTS")
    assert "r < 3" in with_faults
    assert "faults::chosen" in with_faults


def test_the_program_holds_nothing_of_them(octocell: Octocell) -> None:
    """Neither the names, nor the variable that chooses one, nor a symbol of theirs."""
    program = octocell.path.read_bytes()
    assert b"as_written" in program, "names of rules can be found in it, so others could, too"
    for trace in ("OCTOCELL_FAULT", "6faults6chosen", *names()):
        assert trace.encode() not in program, trace


@pytest.mark.parametrize(
    ("code", "output", "why"),
    [
        (1, "x\n[  FAILED  ] Grid.IsMonotone (3 ms)\n[  FAILED  ] Other.One\n", "Grid.IsMonotone"),
        (
            1,
            "A1   lattices\nB9   borders 3 cases\n     impl_cpu     FAILED, wrong: 4: missed 2\n",
            "entry B9, wrong: 4: missed 2",
        ),
        (-11, "no words\n", "SIGSEGV"),
        (2, "first\nthe last line\n", "exit 2: the last line"),
    ],
)
def test_the_first_failure_is_named(code: int, output: str, why: str) -> None:
    assert why_failed(code, output) == why


def test_a_check_that_hangs_is_ended() -> None:
    runner = Runner(limits={"sleep": 0.2})
    outcome = runner.run(Check("sleep", ("sleep", "60")), "")
    assert not outcome.passed
    assert outcome.why == "no answer within 0 s"
    assert not runner.running


def test_a_fault_is_tried_until_a_check_fails() -> None:
    fault = mutants.Fault("some_fault", "", None, None)
    passes = Check("passes", ("true",))
    notices = Check("notices", ("sh", "-c", '[ "$OCTOCELL_FAULT" != some_fault ]'))
    last = Check("last", ("false",))
    cost = {"passes": 1.0, "notices": 2.0, "last": 3.0}
    runner = Runner()
    assert mutants.try_all(fault, [last, notices, passes], cost, runner).check == "notices"
    assert mutants.try_all(fault, [passes], cost, runner).status == "survived"
    assert runner.run(notices, "").passed
