# SPDX-License-Identifier: MIT
"""The command line. Exit code 0: well; 1: looked at and found wanting; 2: could not look.

A function is a command, and its docstring the help. Modules that draw are imported where they are
used: Matplotlib is slow to load.
"""

import argparse
import math
from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from octocell_report import __version__, ablation, check, compare, error, readme
from octocell_report.console import Parser, run, say
from octocell_report.load import load


def main(arguments: Sequence[str] | None = None) -> int:
    return run("octocell-report", lambda: _main(arguments))


def _main(arguments: Sequence[str] | None) -> int:
    about = "Checks, plots and pages from octocell bench's JSON."
    parser = Parser(prog="octocell-report", description=about)
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for work, options in _COMMANDS.items():
        command = commands.add_parser(work.__name__.strip("_"), help=work.__doc__)
        command.set_defaults(work=work)
        for option in options:
            command.add_argument(*option.split(), **_OPTIONS[option])
    given = parser.parse_args(arguments)
    code: int = given.work(given)
    return code


def _build(given: Namespace) -> int:
    """write plots, tables and a page"""
    from octocell_report import page

    result, lying = load(given.result), given.output / "ablation.json"
    ablated = given.ablation or (lying if lying.is_file() else None)
    errors = given.error or sorted(given.output.glob("error*.json"))
    own = result if len(result.variants_frame) else None, error.Study([result])
    names = page.build(
        result,
        given.output,
        ablation.load(ablated) if ablated else own[0],
        error.load(errors) if errors else own[1] if own[1].compares else None,
        inputs=[given.result, *([ablated] if ablated else []), *errors],
    )
    say(f"{given.output / 'index.html'}: written, with {len(names) - 1} plots and tables beside")
    return 0


def _check(given: Namespace) -> int:
    """exit 1 if a row is wrong that is no negative control"""
    result = load(given.result)
    verdict = check.judge(result)
    say(*verdict.complaints, check.summary(result))
    return 0 if verdict.passes else 1


def _compare(given: Namespace) -> int:
    """which rows became faster or slower"""
    lines, slower = compare.report(load(given.old), load(given.new), given.threshold)
    say(*lines)
    return 1 if slower and given.fail_on_slower else 0


def _readme(given: Namespace) -> int:
    """write the text between octocell markers"""
    every = []
    for path in given.pages:
        differing = readme.rewrite(path, check_only=given.check)
        verb = "differs" if given.check else "rewritten"
        say(f"{path}: {verb}: {', '.join(differing)}" if differing else f"{path}: up to date")
        every += differing
    return 1 if every and given.check else 0


def _sort(given: Namespace) -> int:
    """plots and a table from octocell bench-sort's JSON"""
    from octocell_report import sort, sort_figures

    return _written(
        given, sort_figures.build(sort.load(given.result), given.output, [given.result])
    )


def _ablation(given: Namespace) -> int:
    """plots and tables from the preset ablation"""
    from octocell_report import study_files

    result = ablation.load(given.result)
    names = study_files.of_ablation(result).build(given.output, [given.result])
    say(*check.judge(result).complaints)
    return _written(given, names)


def _error(given: Namespace) -> int:
    """plots and tables of run time against error"""
    from octocell_report import captions, study_files

    study = error.load(given.results)
    names = study_files.of_error(study).build(given.output, given.results)
    say(captions.claims(study).en)
    return _written(given, names)


def _written(given: Namespace, names: list[str]) -> int:
    say(f"{given.output}: written: {', '.join(names)}")
    return 0


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
_CHANGES = "changes up to this share are none (default 0.05)"
_OPTIONS: dict[str, dict[str, Any]] = {
    "result": _file("RESULT.json"),
    "results": _file("ERROR.json", nargs="+"),
    "old": _file("OLD.json"),
    "new": _file("NEW.json"),
    "pages": _file("FILE.md", nargs="+"),
    "-o --output": _file("FOLDER", default=Path("reports/out")),
    "--ablation": _file("ABLATION.json", help=_ABLATION),
    "--error": _file("ERROR.json", nargs="+", help=_ERROR),
    "--threshold": {"type": _share, "default": 0.05, "metavar": "SHARE", "help": _CHANGES},
    "--fail-on-slower": {"action": "store_true", "help": "exit 1 if a row is slower"},
    "--check": {"action": "store_true", "help": "write nothing; exit 1 if one differs"},
}
_COMMANDS = {
    _build: ("result", "-o --output", "--ablation", "--error"),
    _check: ("result",),
    _compare: ("old", "new", "--threshold", "--fail-on-slower"),
    _readme: ("pages", "--check"),
    _sort: ("result", "-o --output"),
    _ablation: ("result", "-o --output"),
    _error: ("results", "-o --output"),
}
