# SPDX-License-Identifier: MIT
"""`octocell try --bench`: times, and hand-ins that cheat for them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from cheats import CHEATS
from hand_in_sources import PYTHON
from program import ROOT, Octocell, Refused

Bench = Callable[..., dict[str, Any]]


@pytest.fixture(scope="module", name="library")
def _library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All cheats in one; the environment chooses."""
    folder = tmp_path_factory.mktemp("cheats")
    (folder / "a.cpp").write_text(CHEATS, encoding="utf-8")
    command = ["c++", "-std=c++20", "-O2", "-shared", "-fPIC", "-I", ROOT / "include/octocell"]
    subprocess.run([*command, folder / "a.cpp", "-o", folder / "a.so"], check=True)
    return folder / "a.so"


@pytest.fixture(name="bench")
def _bench(octocell: Octocell, library: Path) -> Bench:
    def run(cheat: str = "", budget: str = "0.01", file: Path = library) -> dict[str, Any]:
        options = ("--bench", "--json", "--budget", budget, "--python", sys.executable)
        result = octocell.run(
            "try", file, *options, env={**os.environ, "CHEAT": cheat}, timeout=120
        )
        answer: dict[str, Any] = json.loads(result.stdout)
        assert result.rc == {"exact": 0, "wrong": 1}.get(answer["verdict"], 2)
        return answer

    return run


def test_an_honest_one_is_timed_beside_ours(bench: Bench) -> None:
    answer = bench(budget="0.6")
    assert answer["verdict"] == "exact"
    first, *_, last = answer["bench"]
    assert (first["scene"], first["n"], last["n"]) == ("gas", 1000, 100000)
    rows = {row["name"]: row for row in first["rows"]}
    assert {"mine", "impl_cpu brute_force", "impl_cpu half_shell"} <= rows.keys()
    for row in rows.values():
        assert len(row["ms"]) >= 3 and 0 < row["low"] <= row["median"] <= row["high"]
    slow = {row["name"]: row["ended"] for row in last["rows"]}
    assert slow["mine"] == "too slow for the budget"  # it stays in the table


def test_python_is_timed_too(bench: Bench, tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text(PYTHON, encoding="utf-8")
    answer = bench(file=tmp_path / "a.py")
    assert answer["verdict"] == "exact"
    assert answer["bench"][0]["rows"][0]["median"] > 0.1


@pytest.mark.parametrize("cheat", ["last answer", "later thread", "later process"])
def test_pairs_that_are_not_found_in_time_are_wrong(bench: Bench, cheat: str) -> None:
    answer = bench(cheat)
    assert answer["verdict"] == "wrong" and answer["at"].startswith("gas:n=1000,seed=1001")


def test_only_small_scenes(bench: Bench) -> None:
    answer = bench("small only", budget="6")
    assert answer["verdict"] == "wrong" and answer["at"].startswith("gas:n=10000")


@pytest.mark.parametrize(
    ("cheat", "reason"),
    [
        ("clobber", "crashed: it crashed with SIGSEGV"),
        ("behind", "fails: it wrote around pairs"),
        ("before", "fails: it wrote around pairs"),
        ("huge count", "fails: it counts 18446744073709551615 pairs"),
    ],
)
def test_what_it_may_not_do_is_named(bench: Bench, cheat: str, reason: str) -> None:
    answer = bench(cheat)
    assert f"{answer['kind']}: {answer['reason']}".startswith(reason), answer


def test_its_clock_is_not_asked(bench: Bench) -> None:
    mine = bench("clock")["bench"][0]["rows"][0]
    assert (mine["name"], mine["low"] >= 30) == ("mine", True)


def test_it_goes_with_neither_a_stage_nor_a_sanitizer(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "a.py").touch()
    for other in (("--stage", "sort"), ("--sanitize",)):
        assert "not with --sanitize or --stage" in refused("try", "a.py", "--bench", *other)
