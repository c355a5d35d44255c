# SPDX-License-Identifier: MIT
"""The committed results: small, readable, and all of a machine from one commit of this history."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from octocell_report.files import read_json

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "reports" / "results"
IN_PROGRESS = RESULTS / "IN_PROGRESS"
MACHINES = sorted(path for path in RESULTS.iterdir() if path.is_dir())
MOST_BYTES = 4_000_000


def commits(machine: Path) -> dict[str, str]:
    """By file: the commit that its context names."""
    return {
        path.name: read_json(path, lambda document: str(document["context"]["commit"]))
        for path in sorted(machine.glob("*.json*"))
    }


def faults(of: dict[str, str], is_known: bool) -> list[str]:
    """What speaks against a set of results, by the commit of each file."""
    found = [] if len(set(of.values())) <= 1 else [f"several commits: {of}"]
    return found if is_known else [*found, "a commit that is not in this history"]


def is_in_history(commit: str) -> bool:
    command = ["git", "merge-base", "--is-ancestor", commit, "HEAD"]
    return subprocess.run(command, cwd=ROOT, capture_output=True, check=False).returncode == 0


def has_history() -> bool:
    command = ["git", "rev-parse", "--is-shallow-repository"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    return done.returncode == 0 and done.stdout.strip() == "false"


def test_they_are_small() -> None:
    assert sum(path.stat().st_size for path in RESULTS.rglob("*")) <= MOST_BYTES


@pytest.mark.parametrize("machine", MACHINES, ids=lambda path: path.name)
def test_those_of_a_machine_are_of_one_commit(machine: Path) -> None:
    if IN_PROGRESS.exists():
        assert len(IN_PROGRESS.read_text(encoding="utf-8").split()) > 5, "it names the reason"
        return
    if not has_history():
        pytest.skip("no git history here")
    of = commits(machine)
    assert not faults(of, all(map(is_in_history, of.values())))


def test_a_mixture_and_a_lost_commit_are_noticed() -> None:
    assert faults({"a.json": "1", "b.json": "1"}, is_known=True) == []
    assert len(faults({"a.json": "1", "b.json": "2"}, is_known=True)) == 1
    assert len(faults({"a.json": "1", "b.json": "1"}, is_known=False)) == 1
    assert not is_in_history("0" * 40)
