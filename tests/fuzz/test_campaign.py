# SPDX-License-Identifier: MIT
"""The output of fuzzers and sanitizers is counted correctly."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

from program import ROOT, Json, load, module_of

CAMPAIGN = ROOT / "tests/fuzz/campaign.py"
SANITIZERS = ROOT / "tests/hazards/sanitizers.py"


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    return module_of(CAMPAIGN)


@pytest.fixture(scope="module")
def sanitizers() -> ModuleType:
    return module_of(SANITIZERS)


def test_runs_are_the_last_number_that_libfuzzer_gives(campaign: ModuleType) -> None:
    said = ["#2\tINITED cov: 9\n", "#4096\tpulse  cov: 12\n", "Done 5000 runs in 3 second(s)\n"]
    assert campaign.runs_of(said[:2]) == 4096
    assert campaign.runs_of(said) == 5000
    assert campaign.runs_of([*said, "stat::number_of_executed_units: 5001\n"]) == 5001
    assert campaign.runs_of(["nothing of interest\n"]) == 0


def fuzzer(folder: Path, name: str, runs: int, code: int = 0) -> None:
    path = folder / "tests" / f"fuzz_{name}"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\necho 'stat::number_of_executed_units: {runs}' >&2\nexit {code}\n")
    path.chmod(0o755)


def run(folder: Path) -> tuple[int, Json]:
    out = folder / "new" / "fuzz.json"
    command = [sys.executable, str(CAMPAIGN), "--build", str(folder), "-o", str(out)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    assert "stat::number_of_executed_units" in done.stdout  # shown as it comes
    return done.returncode, load(out)


def test_a_campaign_is_written_down(tmp_path: Path) -> None:
    fuzzer(tmp_path, "scenes", 700)
    fuzzer(tmp_path, "files", 900)
    code, document = run(tmp_path)
    targets = document["targets"]
    assert code == 0 and document["kind"] == "fuzz" and isinstance(targets, list)
    assert [(t["name"], t["runs"], t["crashes"]) for t in targets] == [
        ("fuzz_scenes", 700, 0),
        ("fuzz_files", 900, 0),
    ]


def test_a_failure_ends_the_campaign_and_is_written_down(tmp_path: Path) -> None:
    fuzzer(tmp_path, "scenes", 7, code=77)
    fuzzer(tmp_path, "files", 900)
    code, document = run(tmp_path)
    targets = document["targets"]
    assert code == 1 and isinstance(targets, list)
    assert [(t["name"], t["crashes"]) for t in targets] == [("fuzz_scenes", 1)]


CTEST = "98% tests passed, {failed} tests failed out of 215\n"


@pytest.mark.parametrize(
    ("log", "counts"),
    [
        (CTEST.format(failed=0), (215, 0)),
        (CTEST.format(failed=3), (215, 3)),
        ("==7==ERROR: AddressSanitizer: heap-use-after-free\n" + CTEST.format(failed=1), (215, 1)),
        ("a.cpp:3:1: runtime error: overflow\n" * 2 + CTEST.format(failed=1), (215, 2)),
        ("WARNING: ThreadSanitizer: data race\n" + CTEST.format(failed=0), (215, 1)),
        ("========= ERROR SUMMARY: 0 errors\n", (1, 0)),
        ("========= ERROR SUMMARY: 1 error\n========= ERROR SUMMARY: 4 errors\n", (2, 5)),
        ("========= RACECHECK SUMMARY: 2 hazards displayed (2 errors, 0 warnings)\n", (1, 2)),
    ],
)
def test_reports_are_counted_from_logs(
    sanitizers: ModuleType, log: str, counts: tuple[int, int]
) -> None:
    assert sanitizers.counted(log) == counts


def sanitize(folder: Path, *logs: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(SANITIZERS), *logs, "-o", str(folder / "out.json")]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_logs_become_a_result(tmp_path: Path) -> None:
    (tmp_path / "a.log").write_text(CTEST.format(failed=0), encoding="utf-8")
    (tmp_path / "b.log").write_text("========= ERROR SUMMARY: 2 errors\n", encoding="utf-8")
    done = sanitize(tmp_path, f"ASan + UBSan={tmp_path}/a.log", f"memcheck={tmp_path}/b.log")
    assert done.returncode == 1, done.stderr
    document = load(tmp_path / "out.json")
    assert document["tools"] == [
        {"name": "ASan + UBSan", "tests": 215, "reports": 0},
        {"name": "memcheck", "tests": 1, "reports": 2},
    ]


@pytest.mark.parametrize("argument", ["no name", "TSan={folder}/none.log", "TSan={folder}/cut.log"])
def test_a_log_that_does_not_tell_is_an_error(tmp_path: Path, argument: str) -> None:
    (tmp_path / "cut.log").write_text("Start 1: grid\n", encoding="utf-8")
    done = sanitize(tmp_path, argument.format(folder=tmp_path))
    assert done.returncode == 2 and done.stderr.startswith("sanitizers: ")
    assert done.stderr.count("\n") == 1 and not (tmp_path / "out.json").exists()


@pytest.mark.parametrize("kind", ["hard", "symbolic"])
def test_no_log_is_written_over(tmp_path: Path, kind: str) -> None:
    log, out = tmp_path / "a.log", tmp_path / "out.json"
    log.write_text(CTEST.format(failed=0), encoding="utf-8")
    out.hardlink_to(log) if kind == "hard" else out.symlink_to(log)
    done = sanitize(tmp_path, f"TSan={log}")
    assert done.returncode == 2 and "is the same file as the input" in done.stderr
    assert done.stderr.count("\n") == 1 and log.read_text() == CTEST.format(failed=0)


def test_a_campaign_is_not_begun_where_its_end_could_not_be_written(tmp_path: Path) -> None:
    fuzzer(tmp_path, "scenes", 700)
    fuzzer(tmp_path, "files", 900)
    for out in (tmp_path, tmp_path / "tests" / "fuzz_files"):
        command = [sys.executable, str(CAMPAIGN), "--build", str(tmp_path), "-o", str(out)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 2 and done.stdout == ""
        assert done.stderr.count("\n") == 1 and "cannot be written" in done.stderr
