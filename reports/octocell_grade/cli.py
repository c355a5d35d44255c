# SPDX-License-Identifier: MIT
"""The command line. Exit code 0: all were graded, well or badly; 2: not, and why."""

from __future__ import annotations

import csv
import io
import json
import shutil
import sys
from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from octocell_grade import __version__
from octocell_grade.grade import Settings, grade, times_of
from octocell_grade.hand_ins import HandIn, hand_ins_of
from octocell_grade.leaderboard import leaderboard
from octocell_grade.rubric import read_rubric
from octocell_report.console import Parser, run, say
from octocell_report.fields import ReportError
from octocell_report.files import check_outputs, write_whole

Json = dict[str, Any]


def main(arguments: Sequence[str] | None = None) -> int:
    return run("octocell-grade", lambda: _command(_parser().parse_args(arguments)))


def _parser() -> Parser:
    about = "Grades each hand-in of a folder with `octocell try`. What is graded already stays."
    parser = Parser(prog="octocell-grade", description=about)
    add = parser.add_argument
    add("--version", action="version", version=f"%(prog)s {__version__}")
    add(
        "folder", type=Path, metavar="DIR", help="files, folders and archives, one for each hand-in"
    )
    add("-o", "--output", type=Path, default=Path("grades.csv"), metavar="GRADES.csv")
    add("--rubric", type=Path, metavar="RUBRIC.toml", help="default: docs/how_to/grade.md")
    add("--seed", type=_whole, default=1, help="of the scenes; one that the class does not know")
    add("--budget", type=float, default=20, help="of each hand-in, as of octocell try; default 20")
    add("--timeout", type=float, default=10, help="seconds for one scene; default 10")
    add("--octocell", type=Path, metavar="PROGRAM", help="default: the one on the PATH")
    add("--python", default=sys.executable, help="of hand-ins in Python; default: this one")
    return parser


def _whole(text: str) -> int:
    if not text.isdecimal():
        raise ValueError
    return int(text)


def _command(options: Namespace) -> int:
    settings = Settings(
        octocell=_octocell(options.octocell),
        python=options.python,
        seed=options.seed,
        budget=options.budget,
        timeout=options.timeout,
        rubric=read_rubric(options.rubric),
    )
    found = hand_ins_of(options.folder)
    details = options.output.with_suffix("")
    page = options.output.with_suffix(".html")
    check_outputs([options.output, page], [hand_in.path for hand_in in found])
    details.mkdir(exist_ok=True)
    grades = []
    for hand_in in found:
        known = details / f"{hand_in.name}.json"
        grades.append(_known_or_graded(hand_in, known, settings))
        # After each one: an interruption loses nothing.
        write_whole(options.output, _table(grades, settings).encode())
        write_whole(page, leaderboard(grades, settings).encode())
    say(f"{options.output}: {len(grades)} hand-ins; {page}")
    return 0


def _known_or_graded(hand_in: HandIn, known: Path, settings: Settings) -> Json:
    key = settings.key(hand_in)
    if known.is_file():
        try:
            before: Json = json.loads(known.read_text(encoding="utf-8"))
            if before["key"] == key:
                say(f"{hand_in.name}: graded before")
                return before
        except (ValueError, KeyError, TypeError):
            pass  # not a grade of ours: it is graded again
    found = {"key": key, **grade(hand_in, settings)}
    write_whole(known, json.dumps(found, indent=1).encode())
    say(f"{hand_in.name}: {found['verdict']}, {found['total']:g} of {settings.rubric.most:g}")
    return found


def _octocell(asked: Path | None) -> Path:
    found = asked or shutil.which("octocell")
    if found is None or not Path(found).is_file():
        raise ReportError(f"{found or 'octocell'}: no such program; name it by --octocell")
    return Path(found)


def _table(grades: list[Json], settings: Settings) -> str:
    text = io.StringIO()
    parts = list(grades[0]["points"])
    writer = csv.writer(text, lineterminator="\n")
    why = ["kind", "reason", "at", "cause"]
    times = ["ms", "reference_ms"]
    writer.writerow(["name", "language", "verdict", "total", *parts, *times, *why])
    for found in grades:
        trial = found["trial"]
        cause = trial.get("cause") or {}
        writer.writerow(
            [
                _no_formula(found["name"]),
                found["language"],
                found["verdict"],
                found["total"],
                *found["points"].values(),
                *("" if t is None else f"{t:.4g}" for t in times_of(trial, settings.rubric.speed)),
                *(_no_formula(str(trial.get(name) or "")) for name in ("kind", "reason", "at")),
                cause.get("name", ""),
            ]
        )
    return text.getvalue()


def _no_formula(text: str) -> str:
    """A table program would compute what begins with one of these."""
    line = " ".join(text.split())
    return f"'{line}" if line.startswith(("=", "+", "-", "@")) else line
