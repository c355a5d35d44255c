# SPDX-License-Identifier: MIT
"""The command line. Exit code 0: well; 1: looked at and found wanting; 2: could not look.

A function here is a command of its name, and its docstring is the command's help. Modules that
draw are imported where they are used: Matplotlib is slow to load.
"""

from __future__ import annotations

import argparse
import math
from argparse import Namespace
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from octocell_report import __version__
from octocell_report.console import Parser, run, say
from octocell_report.fields import naming
from octocell_report.load import Result, load

if TYPE_CHECKING:
    from octocell_report.error import Study

Work = Callable[[Namespace], int]


def main(arguments: Sequence[str] | None = None) -> int:
    return run("octocell-report", lambda: _main(arguments))


def _main(arguments: Sequence[str] | None) -> int:
    about = "Checks, plots and pages from octocell bench's JSON."
    parser = Parser(prog="octocell-report", description=about)
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for work, options in _COMMANDS.items():
        command = commands.add_parser(work.__name__, help=work.__doc__)
        command.set_defaults(work=work)
        for option in options:
            command.add_argument(*option.split(), **_OPTIONS[option])
    given = parser.parse_args(arguments)
    code: int = given.work(given)
    return code


def _share(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 <= value < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number, 0 or more")
    return value


def _file(metavar: str, **more: Any) -> dict[str, Any]:
    return {"type": Path, "metavar": metavar, **more}


_ABLATION = "result of the preset ablation (default: FOLDER/ablation.json, if it is there)"
_ERROR = "results with several predicates (default: FOLDER/error*.json, if there are any)"
_THRESHOLD = "changes up to this share are none (default 0.05)"
_OPTIONS: dict[str, dict[str, Any]] = {
    "result": _file("RESULT.json"),
    "results": _file("ERROR.json", nargs="+"),
    "old": _file("OLD.json"),
    "new": _file("NEW.json"),
    "pages": _file("FILE.md", nargs="+"),
    "-o --output": _file("FOLDER", default=Path("reports/out")),
    "--ablation": _file("ABLATION.json", help=_ABLATION),
    "--error": _file("ERROR.json", nargs="+", help=_ERROR),
    "--threshold": {"type": _share, "default": 0.05, "metavar": "SHARE", "help": _THRESHOLD},
    "--fail-on-slower": {"action": "store_true", "help": "exit 1 if a row is slower"},
    "--check": {"action": "store_true", "help": "write nothing; exit 1 if one differs"},
}
_COMMANDS: dict[Work, tuple[str, ...]] = {}


def _command(*options: str) -> Callable[[Work], Work]:
    def register(work: Work) -> Work:
        _COMMANDS[work] = options
        return work

    return register


@_command("result", "-o --output", "--ablation", "--error")
def build(given: Namespace) -> int:
    """write plots, tables and a page"""
    from octocell_report import page

    result, lying = load(given.result), given.output / "ablation.json"
    ablation = given.ablation or (lying if lying.is_file() else None)
    errors = given.error or sorted(given.output.glob("error*.json"))
    names = page.build(
        result,
        given.output,
        _ablation(ablation) if ablation else result if len(result.variants_frame) else None,
        _study(errors) if errors else _own_study(result),
        inputs=[given.result, *([ablation] if ablation else []), *errors],
    )
    say(f"{given.output / 'index.html'}: written, with {len(names) - 1} plots and tables beside")
    return 0


def _ablation(path: Path) -> Result:
    from octocell_report.ablation import require

    result = load(path)
    with naming(path):
        require(result)
    return result


def _study(paths: list[Path]) -> Study:
    from octocell_report.error import Study, require

    study = Study(map(load, paths))
    with naming(", ".join(map(str, paths))):
        require(study)
    return study


def _own_study(result: Result) -> Study | None:
    """The result, if it is one."""
    from octocell_report.error import Study

    study = Study([result])
    return study if study.compares else None


@_command("result")
def check(given: Namespace) -> int:
    """exit 1 if a row is wrong that is no negative control"""
    from octocell_report.check import complaints, judge, summary

    verdict = judge(load(given.result))
    say(*complaints(verdict), summary(verdict))
    return 0 if verdict.passes else 1


@_command("old", "new", "--threshold", "--fail-on-slower")
def compare(given: Namespace) -> int:
    """which rows became faster or slower"""
    from octocell_report.compare import report

    lines, slower = report(load(given.old), load(given.new), given.threshold)
    say(*lines)
    return 1 if slower and given.fail_on_slower else 0


@_command("pages", "--check")
def readme(given: Namespace) -> int:
    """write the text between octocell markers"""
    from octocell_report.readme import rewrite

    every = []
    for path in given.pages:
        differing = rewrite(path, check_only=given.check)
        verb = "differs" if given.check else "rewritten"
        say(f"{path}: {verb}: {', '.join(differing)}" if differing else f"{path}: up to date")
        every += differing
    return 1 if every and given.check else 0


@_command("result", "-o --output")
def sort(given: Namespace) -> int:
    """plots and a table from octocell bench-sort's JSON"""
    from octocell_report import sort, sort_figures

    names = sort_figures.build(sort.load(given.result), given.output, [given.result])
    say(f"{given.output}: written: {', '.join(names)}")
    return 0


@_command("result", "-o --output")
def ablation(given: Namespace) -> int:
    """plots and tables from the preset ablation"""
    from octocell_report import check, study_files

    result = _ablation(given.result)
    names = study_files.of_ablation(result).build(given.output, [given.result])
    say(*check.complaints(check.judge(result)))
    say(f"{given.output}: written: {', '.join(names)}")
    return 0


@_command("results", "-o --output")
def error(given: Namespace) -> int:
    """plots and tables of run time against error"""
    from octocell_report import captions, study_files

    study = _study(given.results)
    names = study_files.of_error(study).build(given.output, given.results)
    say(captions.claims(study).en)
    say(f"{given.output}: written: {', '.join(names)}")
    return 0
