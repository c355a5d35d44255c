# SPDX-License-Identifier: MIT
"""`octocell try`: limits, sanitizers, and what follows after the scenes of every kind."""

from __future__ import annotations

import contextlib
import os
import re
from pathlib import Path

import numpy as np
import pytest
from hand_in_sources import PYTHON, at_1000, changed
from program import Octocell
from trying import Try


@pytest.fixture(name="attempt")
def _attempt(octocell: Octocell, tmp_path: Path) -> Try:
    return Try(octocell, tmp_path)


def alive(mark: str) -> list[Path]:
    """Processes that have the mark in their environment."""
    found = []
    for environ in Path("/proc").glob("[0-9]*/environ"):
        with contextlib.suppress(OSError):
            found += [environ] * (mark.encode() in environ.read_bytes().split(b"\0"))
    return found


@pytest.fixture(name="mark")
def _mark(monkeypatch: pytest.MonkeyPatch) -> str:
    """A mark in the environment of all that a test starts."""
    monkeypatch.setenv("HAND_IN_OF", str(os.getpid()))
    return f"HAND_IN_OF={os.getpid()}"


def test_too_many_processes_are_ended(attempt: Try, mark: str) -> None:
    """All of them, also those that left its group."""
    grow = "for (int k = 0; k < 300; ++k) if (!fork()) { setsid(); for (;;) pause(); } sleep(60);"
    ending = attempt.ending("#include <unistd.h>\n" + at_1000(grow), "--timeout", "60")
    assert re.fullmatch(r"too many processes: it has \d+ processes, more than 64", ending)
    assert alive(mark) == []


def test_processes_that_it_leaves_behind_are_ended(attempt: Try, mark: str) -> None:
    leave = "if (!fork()) { setsid(); if (!fork()) sleep(600); _exit(0); } sleep(1); abort();"
    text = "#include <cstdlib>\n#include <unistd.h>\n" + at_1000(leave)
    assert attempt.ending(text) == "crashed: it crashed with SIGABRT"
    assert alive(mark) == []


def test_it_runs_as_another_user_than_root(attempt: Try) -> None:
    if os.geteuid() != 0:
        pytest.skip("not root")
    text = "#include <cstdlib>\n#include <unistd.h>\n" + at_1000("if (geteuid() == 0) abort();")
    assert attempt(text)["verdict"] == "exact"


def test_the_stress_catalogue_follows(attempt: Try, tmp_path: Path) -> None:
    huge_missing = changed("return x * x", "return r < 1e9 && x * x")
    answer = attempt(huge_missing, "--budget", "8")
    assert answer["verdict"] == "wrong" and answer["class"] == "stress", answer["at"]
    saved = tmp_path / "scene.npy"
    text = changed("uint32_t j = i + 1", "uint32_t j = i + 2")
    assert attempt(text, "--save", str(saved))["class"] == "small"
    assert np.load(saved).shape == (2, 4)


@pytest.mark.parametrize(
    ("statement", "found"),
    [
        ("static int* a = new int[4]; a[n % 7] = 1;", "AddressSanitizer: heap-buffer"),
        ("volatile int m = 2147483647; m = m + 1;", "runtime error: signed integer overflow"),
    ],
)
def test_sanitizers_find_what_the_answer_does_not_show(
    attempt: Try, statement: str, found: str
) -> None:
    text = at_1000(statement)
    ending = attempt.ending(text, "--sanitize")
    assert ending.startswith("sanitizer: ") and found in ending


def test_no_sanitizer_for_python(attempt: Try) -> None:
    ending = attempt.ending(PYTHON, "--sanitize", name="mine.py")
    assert ending == "no sanitizer: --sanitize is for .cpp and .cu, not for .py"
