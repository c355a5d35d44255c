# SPDX-License-Identifier: MIT
"""The labs: each starter fails with the text that its statement shows, each solution passes."""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

import pytest
from program import ROOT, Octocell, Result

LABS = ROOT / "course/labs"
NAMES = sorted(path.name for path in LABS.glob("[1-9]_*"))
STAGES = {
    "2_cell_ids": "cell_ids",
    "3_sort": "sort",
    "4_cell_index": "cell_index",
    "5_pair_tests": "pair_tests",
}
HAS_GPU = Path("/dev/nvidiactl").exists()
needs_gpu = pytest.mark.skipif(not HAS_GPU, reason="there is no GPU here")
SUFFIXES = ["cpp", "py", pytest.param("cu", marks=needs_gpu)]
# The places of pairs in a list that threads fill, and of those that Python lists otherwise.
ROW = re.compile(r", in row \d+$", re.MULTILINE)


def try_file(octocell: Octocell, folder: Path, file: str, lab: str) -> Result:
    stage = ("--stage", STAGES[lab]) if lab in STAGES else ()
    own_python = ("--python", sys.executable, "--budget", "0.01")
    return octocell.run("try", file, *stage, *own_python, cwd=folder, timeout=120)


def shown_by(lab: str) -> str:
    """What the statement shows of the starter's trial, from the wrong scene on."""
    text = (LABS / lab / "README.md").read_text(encoding="utf-8")
    found = re.search(r"^\$ octocell try .*\n\.\.\.\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    assert found, f"{lab}/README.md shows no trial"
    return found[1]


def printed_from_wrong_scene(result: Result) -> str:
    lines = result.stdout.splitlines(keepends=True)
    wrong = [k for k, line in enumerate(lines) if line.endswith("WRONG\n")]
    assert len(wrong) == 1, result.stdout + result.stderr
    return "".join(lines[wrong[0] :])


@pytest.fixture(scope="module")
def solved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The labs of a student who has done those before the sixth."""
    folder = tmp_path_factory.mktemp("solved")
    shutil.copytree(LABS, folder / "course/labs")
    for lab in STAGES:
        for suffix in ("cpp", "cu", "py"):
            solution = LABS / f"solutions/{lab}.{suffix}"
            shutil.copy(solution, folder / f"course/labs/{lab}/starter.{suffix}")
    return folder


def test_there_are_seven_labs_with_all_files() -> None:
    assert [name[0] for name in NAMES] == list("1234567")
    for name in NAMES:
        for suffix in ("cpp", "cu", "py"):
            starter = (LABS / name / f"starter.{suffix}").read_text(encoding="utf-8")
            assert "Your part" in starter
            assert (LABS / f"solutions/{name}.{suffix}").is_file()
        for statement in ("README.md", "README.zh-CN.md"):
            assert "<details>" in (LABS / name / statement).read_text(encoding="utf-8")


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("lab", NAMES)
def test_the_starter_fails_as_its_statement_shows(
    octocell: Octocell, solved: Path, lab: str, suffix: str
) -> None:
    folder = solved if lab == "6_the_whole" else ROOT
    result = try_file(octocell, folder, f"course/labs/{lab}/starter.{suffix}", lab)
    assert result.rc == 1, result.stdout + result.stderr
    printed = printed_from_wrong_scene(result).replace(f"starter.{suffix}", "starter.cpp")
    expected = shown_by(lab)
    if suffix != "cpp":
        printed, expected = ROW.sub("", printed), ROW.sub("", expected)
    if (lab, suffix) == ("7_faster", "cu"):  # fused operations round otherwise
        assert "cause        float32 test" in printed
    else:
        assert printed == expected


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("lab", NAMES)
def test_the_solution_is_exact(octocell: Octocell, lab: str, suffix: str) -> None:
    result = try_file(octocell, ROOT, f"course/labs/solutions/{lab}.{suffix}", lab)
    assert result.rc == 0, result.stdout + result.stderr
    assert ": exact" in result.stdout.splitlines()[-1]
