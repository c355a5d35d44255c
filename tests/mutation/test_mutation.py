# SPDX-License-Identifier: MIT
"""The faults: each can be planted in the sources as they are, and none is in the program."""

from __future__ import annotations

import subprocess
from collections import Counter
from pathlib import Path

import mutants
import plant
import pytest
from program import ROOT, Octocell
from runner import Check, Runner, why_failed

USE = """
#include "core/sphere.hpp"
bool touch(int r) { return r <= 3 && r > 0; }
"""


def fault(sound: str, name: str = "touching_apart", faulty: str = "r < 3") -> plant.PlantedFault:
    return plant.PlantedFault(name, "spheres that touch are apart", "a.hpp", sound, faulty)


@pytest.mark.parametrize("planted", plant.faults(), ids=lambda planted: planted.name)
def test_a_fault_has_its_place_in_the_sources(planted: plant.PlantedFault) -> None:
    text = (ROOT / planted.file).read_text(encoding="utf-8")
    begin, end = planted.place_in(text)
    assert "".join(text[begin:end].split()) != "".join(planted.faulty.split())
    assert planted.what


def test_faults_are_many_and_their_names_are_different() -> None:
    names = [planted.name for planted in plant.faults()]
    assert len(names) >= 25
    assert max(Counter(names).values()) == 1


def test_every_fault_has_checks_of_its_own_that_exist() -> None:
    stems = {
        path.stem for path in (ROOT / "tests").rglob("test_*") if path.suffix in {".cpp", ".cu"}
    }
    stress = {"stress_impl_cpu", "stress_impl_thrust", "stress_many_pairs"}
    for planted in plant.faults():
        likely = mutants.Fault(planted.name, "", planted.file, None).likely
        assert likely, f"{planted.name} in {planted.file}: no check in LIKELY"
        assert set(likely) <= stems | stress, planted.name


@pytest.mark.parametrize("sound", ["r <= 3", "r<=3", "return «r <= 3» &&", "return «r\n<= 3» && r"])
def test_a_fault_is_planted_where_its_text_is(sound: str) -> None:
    text = plant.planted(USE, [fault(sound)])
    assert "return OCTOCELL_FAULT(touching_apart, r < 3, r <= 3) && r > 0;" in text
    assert text.index(plant.MACRO) < text.index("core/sphere.hpp")


@pytest.mark.parametrize("sound", ["r >= 3", "r", "return «r <= 4» &&"])
def test_a_fault_without_a_place_of_its_own_is_refused(sound: str) -> None:
    with pytest.raises(plant.CannotPlant, match=r"touching_apart: .* a.hpp \d times, not once"):
        plant.planted(USE, [fault(sound)])


def test_two_faults_do_not_overlap() -> None:
    two = [fault("r <= 3"), fault("r <= 3 && r > 0", name="other", faulty="true")]
    with pytest.raises(plant.CannotPlant, match="overlaps"):
        plant.planted(USE, two)


def test_a_copy_of_the_sources_has_all_faults_and_compiles(tmp_path: Path) -> None:
    """Planting again changes no file, and removes what is no longer in the sources."""
    plant.plant_all(tmp_path)
    text = (tmp_path / "core/overlap.hpp").read_text(encoding="utf-8")
    assert "OCTOCELL_FAULT(filter_touching_apart, " in text
    done = subprocess.run(
        ["g++", "-std=c++20", "-E", "-P", f"-I{tmp_path}", tmp_path / "core/overlap.hpp"],
        text=True, capture_output=True, check=True,
    )  # fmt: skip
    assert "faults::chosen" in done.stdout

    times = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*") if path.is_file()}
    stale = tmp_path / "core/gone.hpp"
    stale.touch()
    plant.plant_all(tmp_path)
    assert not stale.exists()
    assert times == {path: path.stat().st_mtime_ns for path in times}


def test_the_program_holds_nothing_of_them(octocell: Octocell) -> None:
    """Neither the names, nor the variable that chooses one, nor a symbol of theirs."""
    program = octocell.path.read_bytes()
    assert b"as_written" in program, "names of rules can be found in it, so others could, too"
    names = (planted.name for planted in plant.faults())
    for trace in ("OCTOCELL_FAULT", "6faults6chosen", *names):
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
    fault = mutants.Fault("some_fault", "", "core/grid.hpp", None)
    passes = Check("passes", ("true",))
    notices = Check("notices", ("sh", "-c", '[ "$OCTOCELL_FAULT" != some_fault ]'))
    last = Check("last", ("false",))
    cost = {"passes": 1.0, "notices": 2.0, "last": 3.0}
    runner = Runner()
    assert mutants.try_all(fault, [last, notices, passes], cost, runner).check == "notices"
    assert mutants.try_all(fault, [passes], cost, runner).status == "survived"
    assert runner.run(notices, "").passed
