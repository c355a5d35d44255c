# SPDX-License-Identifier: MIT
"""The command line. Exit code 0: well; 1: looked at and found wanting; 2: could not look."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from octocell_report import __version__
from octocell_report.console import Parser, run, say
from octocell_report.fields import naming
from octocell_report.load import Result, load

if TYPE_CHECKING:
    from octocell_report.error import Study


def main(arguments: Sequence[str] | None = None) -> int:
    return run("octocell-report", lambda: _command(arguments))


def _command(arguments: Sequence[str] | None) -> int:
    options = _parser().parse_args(arguments)
    code: int = options.command(options)
    return code


def _parser() -> Parser:
    parser = Parser(
        prog="octocell-report", description="Checks, plots and pages from octocell bench's JSON."
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    build = commands.add_parser("build", help="write plots, tables and a page")
    build.add_argument("result", type=Path, metavar="RESULT.json")
    build.add_argument("-o", "--output", type=Path, default=Path("reports/out"), metavar="FOLDER")
    build.add_argument(
        "--ablation",
        type=Path,
        metavar="ABLATION.json",
        help="result of the preset ablation (default: FOLDER/ablation.json, if it is there)",
    )
    build.add_argument(
        "--error",
        type=Path,
        nargs="+",
        default=[],
        metavar="ERROR.json",
        help="results with several predicates (default: FOLDER/error*.json, if there are any)",
    )
    build.set_defaults(command=_build)

    check = commands.add_parser(
        "check", help="exit 1 if a row is wrong that is no negative control"
    )
    check.add_argument("result", type=Path, metavar="RESULT.json")
    check.set_defaults(command=_check)

    compare = commands.add_parser("compare", help="which rows became faster or slower")
    compare.add_argument("old", type=Path, metavar="OLD.json")
    compare.add_argument("new", type=Path, metavar="NEW.json")
    compare.add_argument(
        "--threshold",
        type=_share,
        default=0.05,
        metavar="SHARE",
        help="changes up to this share are none (default 0.05)",
    )
    compare.add_argument("--fail-on-slower", action="store_true", help="exit 1 if a row is slower")
    compare.set_defaults(command=_compare)

    readme = commands.add_parser("readme", help="write the text between octocell markers")
    readme.add_argument("pages", type=Path, nargs="+", metavar="FILE.md")
    readme.add_argument("--check", action="store_true", help="write nothing; exit 1 if one differs")
    readme.set_defaults(command=_readme)

    sort = commands.add_parser("sort", help="plots and a table from octocell bench-sort's JSON")
    sort.add_argument("result", type=Path, metavar="SORT.json")
    sort.add_argument("-o", "--output", type=Path, default=Path("reports/out"), metavar="FOLDER")
    sort.set_defaults(command=_sort)

    ablation = commands.add_parser("ablation", help="plots and tables from the preset ablation")
    ablation.add_argument("result", type=Path, metavar="ABLATION.json")
    ablation.add_argument(
        "-o", "--output", type=Path, default=Path("reports/out"), metavar="FOLDER"
    )
    ablation.set_defaults(command=_ablation)

    error = commands.add_parser("error", help="plots and tables of run time against error")
    error.add_argument("results", type=Path, nargs="+", metavar="ERROR.json")
    error.add_argument("-o", "--output", type=Path, default=Path("reports/out"), metavar="FOLDER")
    error.set_defaults(command=_error)
    return parser


def _share(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 <= value < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number, 0 or more")
    return value


def _build(options: argparse.Namespace) -> int:
    from octocell_report import page  # Matplotlib is slow to load; only plots need it

    result = load(options.result)
    ablation_path, error_paths = _ablation_path(options), _error_paths(options)
    ablation = _loaded_ablation(ablation_path) if ablation_path else None
    names = page.build(
        result,
        options.output,
        ablation or (result if result.variants else None),
        _loaded_error(error_paths) if error_paths else _own_error(result),
        inputs=[options.result, *([ablation_path] if ablation_path else []), *error_paths],
    )
    say(f"{options.output / 'index.html'}: written, with {len(names) - 1} plots and tables beside")
    return 0


def _ablation_path(options: argparse.Namespace) -> Path | None:
    """The one that was named, or else lies in the folder; None without."""
    path: Path = options.ablation or options.output / "ablation.json"
    return path if options.ablation or path.is_file() else None


def _error_paths(options: argparse.Namespace) -> list[Path]:
    """Those that were named, or else lie in the folder."""
    return options.error or sorted(options.output.glob("error*.json"))


def _own_error(result: Result) -> Study | None:
    """The result, if it is one."""
    from octocell_report.error import Study

    study = Study([result])
    return study if study.compares else None


def _loaded_error(paths: list[Path]) -> Study:
    from octocell_report.error import Study, require

    study = Study(load(path) for path in paths)
    with naming(", ".join(map(str, paths))):
        require(study)
    return study


def _loaded_ablation(path: Path) -> Result:
    from octocell_report.ablation import require

    result = load(path)
    with naming(path):
        require(result)
    return result


def _check(options: argparse.Namespace) -> int:
    from octocell_report.check import complaint, judge, summary

    verdict = judge(load(options.result))
    for row in [*verdict.wrong, *verdict.wrong_variants]:
        say(complaint(row))
    say(summary(verdict))
    return 0 if verdict.passes else 1


def _compare(options: argparse.Namespace) -> int:
    from octocell_report.compare import report

    lines, slower = report(load(options.old), load(options.new), options.threshold)
    say(*lines)
    return 1 if slower and options.fail_on_slower else 0


def _readme(options: argparse.Namespace) -> int:
    from octocell_report.readme import rewrite

    every = []
    for path in options.pages:
        differing = rewrite(path, check_only=options.check)
        verb = "differs" if options.check else "rewritten"
        say(f"{path}: {verb}: {', '.join(differing)}" if differing else f"{path}: up to date")
        every += differing
    return 1 if every and options.check else 0


def _sort(options: argparse.Namespace) -> int:
    from octocell_report import sort, sort_figures  # as for _build

    names = sort_figures.build(sort.load(options.result), options.output, [options.result])
    say(f"{options.output}: written: {', '.join(names)}")
    return 0


def _ablation(options: argparse.Namespace) -> int:
    from octocell_report import ablation_files, check  # as for _build

    result = _loaded_ablation(options.result)
    names = ablation_files.build(result, options.output, [options.result])
    verdict = check.judge(result)
    for row in [*verdict.wrong, *verdict.wrong_variants]:
        say(check.complaint(row))
    say(f"{options.output}: written: {', '.join(names)}")
    return 0


def _error(options: argparse.Namespace) -> int:
    from octocell_report import error_files, findings_error  # as for _build

    study = _loaded_error(options.results)
    names = error_files.build(study, options.output, options.results)
    for line in findings_error.sentences(study, "error_map"):
        say(line)
    say(f"{options.output}: written: {', '.join(names)}")
    return 0
