#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Counts the reports of sanitizers in the logs of ctest and of compute-sanitizer.

sanitizers.py -o sanitizers.json "TSan=build-tsan/ctest.log" "memcheck=sanitize_memcheck.log"
Exit code 1 if there is a report, 2 if a log does not say how many tests ran.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/support"), str(ROOT / "reports")]

from octocell_report.console import Parser, run  # noqa: E402
from octocell_report.fields import ReportError  # noqa: E402
from octocell_report.files import check_outputs, write_json  # noqa: E402
from provenance import context  # noqa: E402


_REPORT = re.compile(r"ERROR: \w+Sanitizer\b|WARNING: ThreadSanitizer\b|: runtime error: ")
_TESTS = re.compile(r"tests passed, (\d+) tests? failed out of (\d+)")
_SUMMARY = re.compile(r"={5,} (?:ERROR|RACECHECK) SUMMARY: (\d+) (?:error|hazard)")


class Unreadable(ReportError):
    """A log that does not tell how it ended."""


def counted(log: str) -> tuple[int, int]:
    """(tests, reports). A test of ctest that fails is a report, too: under a sanitizer none may."""
    summaries = [int(match[1]) for match in _SUMMARY.finditer(log)]
    if summaries:
        return len(summaries), sum(summaries)
    ends = _TESTS.search(log)
    if ends is None:
        raise Unreadable("says neither how many tests ran nor has it a summary")
    return int(ends[2]), max(len(_REPORT.findall(log)), int(ends[1]))


def tool_of(argument: str) -> dict[str, Any]:
    """One NAME=LOG."""
    name, equals, path = argument.rpartition("=")
    if not equals or not name:
        raise Unreadable(f"'{argument}' is not NAME=LOG")
    try:
        tests, reports = counted(Path(path).read_text(encoding="utf-8", errors="replace"))
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from error
    except Unreadable as error:
        raise Unreadable(f"{path}: {error}") from error
    return {"name": name, "tests": tests, "reports": reports}


def main() -> int:
    parser = Parser(description=__doc__)
    parser.add_argument("logs", nargs="+", metavar="NAME=LOG")
    parser.add_argument("-o", "--output", type=Path, required=True, help="JSON to write")
    arguments = parser.parse_args()
    logs = (Path(argument.rpartition("=")[2]) for argument in arguments.logs)
    check_outputs([arguments.output], logs)
    tools = [tool_of(argument) for argument in arguments.logs]
    document = {"schema": 2, "kind": "sanitizers", "context": context(), "tools": tools}
    write_json(arguments.output, document)
    for tool in tools:
        print(f"{tool['name']}: {tool['tests']} tests, {tool['reports']} reports")
    return 1 if any(tool["reports"] for tool in tools) else 0


if __name__ == "__main__":
    sys.exit(run("sanitizers", main))
