# SPDX-License-Identifier: MIT
"""Builds and runs the steps of course/pipeline."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

from program import ROOT

PIPELINE = ROOT / "course/pipeline"
STEPS = sorted(PIPELINE.glob("[1-8]_*.cpp"))


def command_of(source: Path) -> list[str]:
    """The command that stands at the top of the file."""
    found = re.search(r"^//   ((?:g\+\+|nvcc) .*)$", source.read_text(encoding="utf-8"), re.M)
    assert found, f"{source}: says no command"
    return found[1].split()


def build(source: Path, folder: Path) -> Path:
    command = command_of(source)
    program = folder / command[-1]
    done = subprocess.run(
        [*command[:-1], program], cwd=PIPELINE, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    return program


def printed(program: Path, scene: Path) -> str:
    done = subprocess.run([program, scene], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def pairs_of(text: str) -> list[tuple[int, int]]:
    body = text[re.search(r"^\d+ pairs$", text, re.M).end() :]  # type: ignore[union-attr]
    return [(int(i), int(j)) for i, j in re.findall(r"^  (\d+) (\d+)$", body, re.M)]
