# SPDX-License-Identifier: MIT
"""Two compilers, with and without optimisation, agree; `make compilers` tries them all."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

from program import ROOT, module_of

SCRIPT = ROOT / "tests/hazards/compilers.py"


@pytest.fixture(scope="module")
def compilers() -> ModuleType:
    return module_of(SCRIPT)


def test_two_configurations_give_the_same_checksums(tmp_path: Path) -> None:
    command = [sys.executable, str(SCRIPT), "--slice", "-o", str(tmp_path / "compilers.json")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count(", same (") == 2
    assert done.stdout.endswith(" 0 failures\n")


def test_fast_math_is_refused(compilers: ModuleType) -> None:
    assert compilers.flags_that_compile() == []


def test_an_answer_that_is_not_exact_is_noticed(compilers: ModuleType) -> None:
    lines = [
        "a | spheres 2 0x1",
        "a | exact 1 0x5",
        "a | home_phantom lowest_cell 1 0x5",
        "a | home_phantom chapter32 refused",
        "a | home_phantom as_written 0 0x0",
    ]
    assert compilers.wrong_answers(lines) == []
    lines.append("a | brute_force lowest_cell 1 0x6")
    assert compilers.wrong_answers(lines) == lines[-1:]


def test_the_flags_differ_between_configurations(compilers: ModuleType) -> None:
    names = [configuration.folder for configuration in compilers.all_configurations()]
    assert len(names) == len(set(names)) == 12 * len(compilers.compilers())
    assert len(set(compilers.two_configurations())) == 2
