# SPDX-License-Identifier: MIT
"""Runs the program under test and the scripts, and reads their output."""

from __future__ import annotations

import importlib.util
import json
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
RULES = ("lowest_cell", "chapter32", "as_written")

Json = dict[str, Any]


@dataclass(frozen=True)
class Result:
    rc: int
    stdout: str
    stderr: str


@dataclass(frozen=True)
class Octocell:
    path: Path

    def run(self, *args: object, timeout: float = 60.0, **options: Any) -> Result:
        """Options go to subprocess.run; stdout may be redirected, and is then empty here."""
        options.setdefault("stdout", subprocess.PIPE)
        done = subprocess.run(
            [self.path, *map(str, args)],
            stdin=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            timeout=timeout,
            check=False,
            **options,
        )
        return Result(done.returncode, done.stdout or "", done.stderr)

    def ok(self, *args: object, **options: Any) -> Result:
        result = self.run(*args, **options)
        assert result.rc == 0, f"{args}: exit {result.rc}: {result.stderr}"
        return result

    def find(self, scene: object, *args: object) -> Json:
        """What `find --json` prints."""
        answer: Json = json.loads(self.ok("find", scene, "--json", *args).stdout)
        return answer

    def listed(self, section: str) -> list[str]:
        """Names in a section of `octocell list`: backends, baselines or scenes."""
        text = self.ok("list").stdout
        found = re.search(rf"^{section}\b.*\n((?:[ ].*\n)*)", text, re.MULTILINE)
        assert found, f"`octocell list` has no section {section}:\n{text}"
        return re.findall(r"^  (\w+) ", found[1], re.MULTILINE)

    def unavailable(self) -> dict[str, str]:
        """Backends that cannot run here, and why not."""
        text = self.ok("list").stdout
        return dict(re.findall(r"^  (\w+) .* not here: (.+)$", text, re.MULTILINE))

    def faulty(self) -> set[str]:
        """Baselines that may lose pairs, by a fault that `octocell list` names."""
        text = self.ok("list").stdout
        return set(re.findall(r"^  (\w+) .*\n      known issue: ", text, re.MULTILINE))

    def implementations(self) -> list[tuple[str, ...]]:
        """The flags of `find` for each row of `check`, whether it can run here or not."""
        rows: list[tuple[str, ...]] = []
        for backend in self.listed("backends"):
            rows.append(("--backend", backend, "--method", "planned"))
            rows += [("--backend", backend, "--rule", rule) for rule in RULES]
            methods = ["half_shell", "brute_force"]
            if backend == "impl_cuda_custom":
                methods.append("tiles")
            rows += [("--backend", backend, "--method", m) for m in methods]
        return rows + [("--backend", name) for name in self.listed("baselines")]


# Runs the program in a folder of the test's, checks that it refuses as it should, returns its line.
Refused = Callable[..., str]


def load(path: Path) -> Json:
    document: Json = json.loads(path.read_text(encoding="utf-8"))
    return document


def module_of(script: Path) -> ModuleType:
    """A script that lies in no folder for imports."""
    spec = importlib.util.spec_from_file_location(script.stem, script)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[script.stem] = module  # its dataclass looks itself up
    spec.loader.exec_module(module)
    return module
