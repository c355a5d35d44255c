# SPDX-License-Identifier: MIT
"""Every command in every document is run, and prints what the document shows; what takes long or
needs what is not here stands in a list with its reason, and is checked to exist."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from commands import Sandbox, Shown, agrees, shown_in
from hand_in_sources import BRUTE_FORCE
from program import ROOT, Octocell
from test_layout import files

ALL = [shown for path in sorted(files(suffixes={".md"})) for shown in shown_in(path)]

# Commands that are not run, as patterns of the whole command, and why.
LONG = "takes minutes or hours"
EXAMPLE = "speaks of a file or a name that the reader has, not we"
HERE = "is how this test was started, or builds everything"
NODE = "needs a machine with a GPU"
NOT_RUN = {
    r"make [\w-]+( [A-Z_]+=\S+)*": LONG,
    r"\.ci/run": LONG,
    r"ctest .*|.*-m pytest .*": HERE,
    r"(OCTOCELL_DEVELOPER=OFF )?scripts/setup\.sh|pip install \.": "installs something",
    r"ssh .*|scp .*|.*--preset gpu.*|.*--device gpu.*|.*impl_cuda_custom": NODE,
    r".*octocell bench .*|.*octocell bench-sort .*|octocell-report sort .*": LONG,
    r"\./build/octocell stress .*|octocell stress .*": LONG,
    r".*build/tests/test_\w+": LONG,
    r"build/tests/fuzz_scenes FOLDER": LONG,
    r".*build-faults/octocell.*|.*mutants\.py .*": "needs the build with planted faults",
    r"course/bug_hunt\.py .*|diff sound\.txt faulty\.txt": "needs a case of the bug hunt",
    r".*fetch_real_scenes\.py|.*data/real/.*": "needs files that `make real` downloads",
    r".*(impl_sycl|fcl_other|lattice:n=30000|spiral).*": EXAMPLE,
    r".*octocell-import .*": EXAMPLE,
    r".*(protein\.npy|packing\.txt|atoms\.pqr\.gz|grains\.csv).*": EXAMPLE,
    r".*(libmine|my_program|pairs\.txt).*": EXAMPLE,
    r"octocell try mine\.cpp.*": EXAMPLE,
    r"octocell try course/labs/.*": "test_labs.py does, in all languages",
    r".*octocell doctor": "says what this machine has",
    r".*(libcgal-dev|examples/plugins|build-cgal|build-cub).*": "test_cli_example_plugins.py does",
    r"cd reports|python -m octocell_grade .*": EXAMPLE,
}
NON_ZERO = {"judge": 1, "try": 1, "bad.csv": 2, "diff": 1}


def reason_not_to_run(command: str) -> str | None:
    return next((why for what, why in NOT_RUN.items() if re.fullmatch(what, command)), None)


RUN = [shown for shown in ALL if not reason_not_to_run(shown.command)]
LEFT_OUT = [shown for shown in ALL if reason_not_to_run(shown.command)]


@pytest.fixture(scope="module")
def sandbox(octocell: Octocell, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Sandbox]:
    made = Sandbox(tmp_path_factory.mktemp("documents"), octocell)
    made.prepare()
    mine = made.pairs_in_blocks("shifted:n=2000,offset=0,phi=0.3", 256)
    (made.folder / "mine.csv").write_text(mine, encoding="utf-8")
    in_blocks = "if (i / 256 == j / 256 && overlap(s[i], s[j]))"
    blocks = BRUTE_FORCE.replace("if (overlap(s[i], s[j]))", in_blocks)
    (made.folder / "blocks.cpp").write_text(blocks, encoding="utf-8")
    yield made


def exit_code(command: str) -> int:
    return next((code for word, code in NON_ZERO.items() if word in command), 0)


def groups() -> dict[str, list[Shown]]:
    """The commands of each document, those equal to one of an earlier document left out."""
    seen, found = set[tuple[str, str | None]](), dict[str, list[Shown]]()
    for shown in RUN:
        if (shown.command, shown.output) in seen:
            continue
        seen.add((shown.command, shown.output))
        found.setdefault(str(shown.path.relative_to(ROOT)), []).append(shown)
    return found


@pytest.mark.parametrize("document", groups())
def test_commands_print_what_the_document_shows(document: str, sandbox: Sandbox) -> None:
    folder = sandbox.folder
    for shown in groups()[document]:
        if there := re.fullmatch(r"cd (\S+)", shown.command):
            folder = folder / there[1]
            continue
        done = sandbox.run(shown.command, folder)
        assert done.returncode == exit_code(shown.command), (
            f"{shown}: exit {done.returncode}:\n{done.stdout}"
        )
        if shown.output:
            assert agrees(shown.output, done.stdout), f"{shown} prints:\n{done.stdout}"


def test_output_is_compared_line_by_line() -> None:
    printed = "a 1\nb 2\ntook 3.5 ms\nd\n"
    assert agrees(printed, printed) and agrees("a 1\n...\nd\n", printed)
    assert agrees("...\ntook 9 ms\nd\n", printed) and agrees("...\n", printed)
    assert not agrees("a 1\n", printed) and not agrees("a 1\n...\nc\n...\n", printed)
    assert not agrees("b 2\n...\n", printed)


@cache
def targets() -> set[str]:
    text = (ROOT / "Makefile").read_text(encoding="utf-8")
    return set(re.findall(r"^([a-z-]+):", text, re.M))


@pytest.mark.parametrize("shown", LEFT_OUT, ids=str)
def test_what_is_not_run_exists(shown: Shown, octocell: Octocell) -> None:
    for target in re.findall(r"(?:^|&& )make ([\w-]+)", shown.command):
        assert target in targets()
    for script in re.findall(r"(?:^|\s)((?:\.ci|scripts|tests|course)/[\w./]+)", shown.command):
        assert (ROOT / script).exists(), script
    for name, options in re.findall(r"octocell ([a-z-]+)([^|;&]*)", shown.command):
        text = octocell.ok(name, "--help").stdout
        text += "--benchmark_filter --benchmark_list_tests"  # Google Benchmark's own
        for option in re.findall(r"(?<!\S)--[\w-]+", options):
            assert option in text, f"octocell {name} has no option {option}"


def test_every_reason_is_needed() -> None:
    for pattern in NOT_RUN:
        assert any(re.fullmatch(pattern, shown.command) for shown in ALL), pattern


def test_commands_are_found() -> None:
    documents = {str(shown.path.relative_to(ROOT)) for shown in RUN}
    assert {"README.md", "docs/command_line.md", "course/lesson.md"} <= documents
    assert len(RUN) > 30
    assert [shown.command for shown in shown_in(Path(ROOT / "docs/README.md"))]
