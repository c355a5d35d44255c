#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs libFuzzer on each target, one after another, and records how much it tried.

A target that fails ends the campaign with exit code 1; its finding is in the folder `found`.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import time
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/support"), str(ROOT / "reports")]

from octocell_report.console import Parser, run  # noqa: E402
from octocell_report.files import check_outputs, write_json  # noqa: E402
from provenance import context  # noqa: E402


TARGETS = ("scenes", "files")
# The last numbers that libFuzzer prints, and what it prints now and then before: "#4096 pulse ..."
_TOTAL = re.compile(r"^stat::number_of_executed_units:\s*(\d+)|^Done (\d+) runs in ")
_SO_FAR = re.compile(r"^#(\d+)\s")
_ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1",
}


@dataclass(frozen=True)
class Tried:
    name: str
    runs: int
    seconds: float
    crashes: int  # libFuzzer ends at the first


def runs_of(lines: Iterable[str]) -> int:
    """How many inputs were run, by the output of libFuzzer; 0 if it says nothing."""
    found = 0
    for line in lines:
        if match := _TOTAL.search(line) or _SO_FAR.search(line):
            found = max(found, *(int(group) for group in match.groups() if group))
    return found


def program(build: Path, name: str) -> Path:
    return build / "tests" / f"fuzz_{name}"


def fuzz(name: str, build: Path, seconds: int) -> Tried:
    """Shows what the fuzzer says while it says it."""
    corpus, found = build / "corpus" / name, build / "found"
    corpus.mkdir(parents=True, exist_ok=True)
    found.mkdir(parents=True, exist_ok=True)
    command = [str(program(build, name)), "-max_len=600", "-print_final_stats=1"]
    command += [f"-max_total_time={seconds}", f"-artifact_prefix={found}/{name}-"]
    command += [str(corpus), str(ROOT / "tests/fuzz/corpus" / name)]
    begin, lines = time.monotonic(), []
    with subprocess.Popen(
        command,
        env=os.environ | _ENVIRONMENT,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    ) as process:
        assert process.stdout
        for line in process.stdout:
            print(line, end="", flush=True)
            if line.startswith(("#", "stat::", "Done ")):
                lines.append(line)
    passed = time.monotonic() - begin
    return Tried(f"fuzz_{name}", runs_of(lines), round(passed, 1), int(process.returncode != 0))


def main() -> int:
    parser = Parser(description=__doc__)
    parser.add_argument("--build", type=Path, default=ROOT / "build-fuzz", help="of preset fuzz")
    parser.add_argument("--seconds", type=int, default=300, help="for each target")
    parser.add_argument("-o", "--output", type=Path, required=True, help="JSON to write")
    arguments = parser.parse_args()
    check_outputs([arguments.output], (program(arguments.build, name) for name in TARGETS))

    document = {"schema": 2, "kind": "fuzz", "context": context(), "targets": []}
    failed = False
    for name in TARGETS:
        tried = fuzz(name, arguments.build, arguments.seconds)
        document["targets"].append(asdict(tried))
        failed = tried.crashes > 0
        if failed:
            break
    write_json(arguments.output, document)
    total = sum(target["runs"] for target in document["targets"])
    print(f"{total} inputs, {'a failure' if failed else 'no failure'}; {arguments.output}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(run("campaign", main))
