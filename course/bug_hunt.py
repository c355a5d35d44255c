#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The bug hunt: a build with one mistake in it that you do not know (course/bug_hunt.md).

course/bug_hunt.py start [CASE]        chooses a case, at random or by its number
course/bug_hunt.py octocell ARGS...    runs the octocell that has the mistake
course/bug_hunt.py answer FILE:LINE    checks where you think it is
course/bug_hunt.py give-up             says what it is
"""

from __future__ import annotations

import argparse
import hashlib
import os
import random
import sys
from pathlib import Path

import tomllib

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests/mutation"))

from plant import PlantedFault, faults  # noqa: E402

CASES = ROOT / "course/bug_hunt.toml"
NEAR = 6  # lines: an answer so near is right


def build() -> Path:
    return Path(os.environ.get("OCTOCELL_HUNT_BUILD", ROOT / "build-hunt"))


def cases() -> list[PlantedFault]:
    """In an order that says nothing about them; the first is case 1."""
    table = tomllib.loads(CASES.read_text(encoding="utf-8"))
    chosen = [fault for fault in faults() if fault.name in table]
    return sorted(chosen, key=lambda fault: hashlib.sha256(fault.name.encode()).digest())


def line_of(fault: PlantedFault) -> int:
    text = (ROOT / fault.file).read_text(encoding="utf-8")
    begin, _ = fault.place_in(text)
    return text.count("\n", 0, begin) + 1


def start(wanted: int | None) -> str:
    there = len(cases())
    number = random.randint(1, there) if wanted is None else wanted
    if not 1 <= number <= there:
        sys.exit(f"bug hunt: there are cases 1 to {there}, not {number}")
    (build() / "case").write_text(f"{number}\n", encoding="utf-8")
    table = tomllib.loads(CASES.read_text(encoding="utf-8"))
    case = table[cases()[number - 1].name]
    return (
        f"case {number}: one mistake is somewhere in core/ or impl_cpu/.\n"
        "It shows here:\n"
        f"  course/bug_hunt.py octocell find {case['scene']} {case['options']} -o pairs.npy\n"
        f"  build/octocell judge {case['scene']} pairs.npy"
    )


def hidden() -> PlantedFault:
    path = build() / "case"
    if not path.exists():
        sys.exit("bug hunt: no case is open; course/bug_hunt.py start")
    return cases()[int(path.read_text(encoding="utf-8")) - 1]


def run(arguments: list[str]) -> None:
    program = build() / "octocell"
    if not program.exists():
        sys.exit(f"bug hunt: {program} is missing; make bug-hunt builds it")
    os.environ["OCTOCELL_FAULT"] = hidden().name
    os.execv(program, [str(program), *arguments])


def answer(place: str) -> tuple[bool, str]:
    """Whether FILE or FILE:LINE is where the mistake is, and what to say to that."""
    fault = hidden()
    file, _, line = place.partition(":")
    if not (ROOT / file).is_file():
        sys.exit(f"bug hunt: no file {file} here; name it from the top of the repository")
    if line and not line.isdecimal():
        sys.exit(f"bug hunt: {line!r} is not the number of a line")
    if file != fault.file:
        stage = "the right folder" if Path(file).parent == Path(fault.file).parent else "elsewhere"
        return (
            False,
            f"not in {file}; it is in {stage}" if stage != "elsewhere" else f"not in {file}",
        )
    if not line:
        return False, f"yes, it is in {file}; in which line?"
    if abs(int(line) - line_of(fault)) > NEAR:
        return False, f"the right file, but not near line {line}"
    return True, f"found: {told(fault)}"


def told(fault: PlantedFault) -> str:
    return f"{fault.what} ({fault.file}:{line_of(fault)}, {fault.name})"


def main() -> int:
    if sys.argv[1:2] == ["octocell"]:
        run(sys.argv[2:])
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    commands.add_parser("start").add_argument("case", type=int, nargs="?")
    commands.add_parser("answer").add_argument("place", metavar="FILE:LINE")
    commands.add_parser("give-up")
    commands.add_parser("octocell")
    options = parser.parse_args()
    if options.command == "answer":
        right, words = answer(options.place)
        print(words)
        return 0 if right else 1
    print(start(options.case) if options.command == "start" else told(hidden()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
