# SPDX-License-Identifier: MIT
"""The commands that documents show: ```console blocks with their output, ```sh blocks without."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from program import ROOT, Octocell

FENCE = re.compile(r"^```(sh|console)\n(.*?)^```$", re.M | re.S)
# What differs from run to run: names of temporary folders, and times.
VARIES = re.compile(r"octocell-try-\w+|\d+(\.\d+)? ms")


@dataclass(frozen=True)
class Shown:
    """A command of a document; `output` is None where the document shows none."""

    path: Path
    command: str
    output: str | None = None

    def __str__(self) -> str:
        return f"{self.path.relative_to(ROOT)}: {self.command}"


def shown_in(path: Path) -> Iterator[Shown]:
    for kind, text in FENCE.findall(path.read_text(encoding="utf-8")):
        if kind == "console":
            for part in re.split(r"^\$ ", text, flags=re.M)[1:]:
                command, _, output = part.partition("\n")
                yield Shown(path, command.strip(), output)
        else:
            for line in text.replace("\\\n", " ").splitlines():
                if command := re.sub(r"(^|\s+)#.*$", "", line).strip():
                    yield Shown(path, command)


def agrees(expected: str, printed: str) -> bool:
    """Whether lines are those expected; a line of three full stops stands for any lines."""
    pattern = ""
    for line in VARIES.sub("VARIES", expected).rstrip("\n").splitlines():
        pattern += r"(?:.*\n)*?" if line == "..." else re.escape(line) + r"[ ]*\n"
    text = VARIES.sub("VARIES", printed)
    return re.fullmatch(pattern, text if text.endswith("\n") else text + "\n") is not None


@dataclass
class Sandbox:
    """A folder that looks like the repository with a build in it; commands may write there."""

    folder: Path
    octocell: Octocell

    def prepare(self) -> None:
        for path in ROOT.iterdir():
            if path.name.startswith("build") or path.name in {"course", ".git", ".cache", "dist"}:
                continue
            (self.folder / path.name).symlink_to(path)
        shutil.copytree(ROOT / "course", self.folder / "course")  # commands compile there
        (self.folder / "build").mkdir()
        (self.folder / "build/octocell").symlink_to(self.octocell.path)

    def run(self, command: str, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
        """Output and errors, with paths as they are told from the repository."""
        done = subprocess.run(
            ["bash", "-c", f'PATH="{self.folder}/build:$PATH"\n{command}'],
            cwd=folder or self.folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=120,
            check=False,
        )
        done.stdout = done.stdout.replace(f"{self.folder}/", "").replace(f"{ROOT}/", "")
        return done

    def pairs_in_blocks(self, scene: str, size: int) -> str:
        """The true pairs that do not cross a border of blocks of that many spheres, as text."""
        self.octocell.ok("find", scene, "-o", self.folder / "all.npy")
        pairs = np.load(self.folder / "all.npy")
        inside = pairs[pairs[:, 0] // size == pairs[:, 1] // size]
        return "".join(f"{i},{j}\n" for i, j in inside)
