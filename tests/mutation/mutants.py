#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Would the tests notice a fault? Runs them on a build in which one fault after another is switched
on (faults.toml), each until a test fails. First runs all tests without a fault: they must pass,
and their times decide in which order they are tried. Exit code 1 if a fault survives."""

from __future__ import annotations

import argparse
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "reports"))

from plant import PlantedFault  # noqa: E402
from plant import faults as planted_faults  # noqa: E402
from runner import Check, Runner  # noqa: E402

from octocell_report.console import Parser, run  # noqa: E402
from octocell_report.files import check_outputs, write_json  # noqa: E402

Item = TypeVar("Item")
Result = TypeVar("Result")

DEVICE = "impl_cuda_custom"  # its faults need a GPU
LEAST_LIMIT, LIMIT_FACTOR = 30.0, 10.0  # seconds, and times what a check takes without a fault
EXIT_SURVIVED, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 1, 2, 130

# What is tried first for the faults of a file or folder; then all the rest, the quickest first.
LIKELY = {
    "core/overlap.hpp": ("test_overlap test_properties_margins test_properties_overlap"),
    "core/grid.hpp": "test_grid test_properties_grid",
    "core/flags.hpp": "test_flags",
    "core/same_bits.hpp": "test_coherence",
    "core/tiles.hpp": "test_tiles",
    "core/chapter32.hpp": "test_cell_ids stress_impl_cpu",
    "core/plan_facts.hpp": "test_bounds",
    "core/planner": "test_planner test_grid test_properties_grid",
    "core/planner/tiles.cpp": "test_tiles",
    "core/planner/scene_stats.cpp": "test_bounds test_half_shell",
    "harness/files": "test_scene_files",
    "impl_cpu/coherence": "test_coherence test_coherence_movers",
    "impl_cpu/backend.cpp": "test_coherence test_flags",
    "impl_cpu/half_shell": "test_half_shell test_coherence_movers",
    "impl_cpu/pair_list.hpp": "stress_many_pairs",
    "impl_cpu/radix_sort.cpp": "test_sort",
    "impl_cpu/stage2_cell_ids.cpp": "test_cell_ids",
    "impl_cpu/stage4_cell_index.cpp": "test_cell_index",
    "impl_cpu/stage5_pair_tests.cpp": "test_pair_tests",
    "impl_cpu/stage6_resolve.cpp": "test_resolve",
    "impl_cpu": "test_buffers test_resolve stress_impl_cpu",
    "impl_thrust": "test_thrust test_thrust_half_shell stress_impl_thrust",
    "impl_cuda_custom": "test_radix_sort test_cuda_half_shell test_cuda_custom",
}


@dataclass(frozen=True)
class Fault:
    name: str
    what: str
    file: str
    line: int | None  # none: the sources are not here (a bundle on another machine)

    @property
    def needs_device(self) -> bool:
        return self.name.startswith("cuda_")

    @property
    def likely(self) -> list[str]:
        fitting = [start for start in LIKELY if self.file.startswith(start)]
        return LIKELY[max(fitting, key=len)].split() if fitting else []


@dataclass
class Verdict:
    fault: Fault
    status: str  # killed, survived, not_run
    check: str | None = None
    why: str | None = None
    seconds: float = 0.0

    def text(self) -> str:
        if self.status == "killed":
            return f"killed by {self.check}: {self.why} ({self.seconds:.1f} s)"
        if self.status == "survived":
            return f"SURVIVED all checks ({self.seconds:.0f} s)"
        return f"not run: {self.why}"

    def to_json(self) -> dict[str, Any]:
        return {
            "name": self.fault.name,
            "what": self.fault.what,
            "file": self.fault.file,
            "line": self.fault.line,
            "status": self.status,
            "killed_by": self.check,
            "reason": self.why,
            "seconds": round(self.seconds, 2),
        }


def line_of(fault: PlantedFault) -> int | None:
    path = ROOT / fault.file
    if not path.is_file():
        return None
    text = path.read_text(encoding="utf-8")
    return text.count("\n", 0, fault.place_in(text)[0]) + 1


def faults_in(program: Path) -> list[Fault]:
    environment = {**os.environ, "OCTOCELL_FAULT": "list"}
    done = subprocess.run([program], env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"mutants: {program} has no faults: it is not of the preset `faults`")
    known = set(line.split("\t")[0] for line in done.stdout.splitlines())
    return [
        Fault(fault.name, fault.what, fault.file, line_of(fault))
        for fault in planted_faults()
        if fault.name in known
    ]


def has_device(program: Path) -> bool:
    listed = subprocess.run([program, "list"], capture_output=True, text=True, check=True).stdout
    return not re.search(rf"^  {DEVICE} .* not here: ", listed, re.MULTILINE)


def checks_in(folder: Path, device: bool) -> list[Check]:
    """Every test program, what fuzzers found, and slices of the stress catalogue."""
    program = str(folder / "octocell")
    backends = ["impl_cpu", "impl_thrust", *([DEVICE] if device else [])]
    checks = [
        Check(path.name, (str(path),))
        for path in sorted((folder / "tests").glob("test_*"))
        if path.is_file() and os.access(path, os.X_OK)
    ]
    for what in ("scenes", "files"):
        fuzz = folder / "tests" / f"fuzz_{what}"
        corpus = ROOT / "tests/fuzz/corpus" / what
        if fuzz.is_file() and corpus.is_dir():
            checks.append(Check(f"fuzz_{what}_corpus", (str(fuzz), str(corpus))))
    stress = (program, "stress", "-o", "RESULT")
    for backend in backends:
        flags = ("--size", "slice", "--backend", backend)
        checks.append(Check(f"stress_{backend}", (*stress, *flags)))
    # The only count beyond 2^31, which the slice has no time for.
    many = ("--size", "quick", "--backend", "impl_cpu", "--entry", "F33")
    checks.append(Check("stress_many_pairs", (*stress, *many)))
    return checks


def try_all(fault: Fault, checks: list[Check], cost: dict[str, float], runner: Runner) -> Verdict:
    likely = fault.likely
    rank = {name: k for k, name in enumerate(likely)}
    seconds = 0.0
    for check in sorted(checks, key=lambda c: (rank.get(c.name, len(rank)), cost[c.name])):
        outcome = runner.run(check, fault.name)
        seconds += outcome.seconds
        if not outcome.passed:
            return Verdict(fault, "killed", check.name, outcome.why, seconds)
    return Verdict(fault, "survived", seconds=seconds)


def side_by_side(
    work: Callable[[Item], Result], items: list[Item], runner: Runner, jobs: int
) -> Iterator[tuple[Item, Result]]:
    """Each as it is done. Ctrl-C ends what runs."""
    with ThreadPoolExecutor(jobs) as pool:
        item_of = {pool.submit(work, item): item for item in items}
        try:
            for future in as_completed(item_of):
                yield item_of[future], future.result()
        except BaseException:
            for future in item_of:
                future.cancel()
            runner.stop()
            raise


def sound_times(checks: list[Check], runner: Runner, jobs: int) -> dict[str, float]:
    """Seconds by check, without a fault. All must pass, else a failure would prove nothing."""
    times: dict[str, float] = {}
    for check, outcome in side_by_side(lambda c: runner.run(c, ""), checks, runner, jobs):
        times[check.name] = outcome.seconds
        count = f"[{len(times)}/{len(checks)}]"
        print(f"{count} no fault: {check.name} ({outcome.seconds:.1f} s)", flush=True)
        if not outcome.passed:
            runner.stop()
            sys.exit(f"mutants: without a fault {check.name} fails: {outcome.why}")
    return {check.name: times[check.name] for check in checks}


def context_of(program: Path) -> dict[str, Any]:
    """Machine, compiler and commit, in the words of every other result."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "stress.json"
        flags = ["--size", "slice", "--backend", "impl_cpu", "--entry", "A6"]
        command = [str(program), "stress", *flags, "-o", str(path)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        context: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))["context"]
    del context["size"]
    return context


@dataclass
class Document:
    """What is written: docs/how_to/mutants.md."""

    context: dict[str, Any]
    cost: dict[str, float] = field(default_factory=dict)
    verdicts: list[Verdict] = field(default_factory=list)

    def with_status(self, status: str) -> int:
        return sum(verdict.status == status for verdict in self.verdicts)

    @property
    def tried(self) -> int:
        return len(self.verdicts) - self.with_status("not_run")

    def summary(self) -> str:
        not_run = self.with_status("not_run")
        apart = f", {not_run} not run: no device" if not_run else ""
        return f"{self.with_status('killed')}/{self.tried} killed{apart}"

    def write(self, path: Path) -> None:
        document = {
            "schema": 2,
            "kind": "mutants",
            "context": self.context,
            "killed": self.with_status("killed"),
            "tried": self.tried,
            "not_run": self.with_status("not_run"),
            "checks": [{"name": name, "seconds": round(s, 2)} for name, s in self.cost.items()],
            "faults": [verdict.to_json() for verdict in self.verdicts],
        }
        write_json(path, document)


def parse_arguments() -> argparse.Namespace:
    parser = Parser(description=__doc__)
    parser.add_argument(
        "--build", type=Path, default=ROOT / "build-faults", help="folder of octocell and tests/"
    )
    parser.add_argument("--only", default=".*", help="faults whose whole name matches")
    parser.add_argument("--checks", default=".*", help="checks whose whole name matches")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="faults at a time")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "reports/out/mutants.json")
    arguments = parser.parse_args()
    for name in ("only", "checks"):
        pattern = getattr(arguments, name)
        try:
            setattr(arguments, name, re.compile(pattern))
        except re.error as error:
            parser.error(f"--{name} {pattern}: {error}")
    if arguments.jobs < 1:
        parser.error(f"--jobs {arguments.jobs}: at least 1")
    if not os.access(arguments.build / "octocell", os.X_OK):
        parser.error(f"no program {arguments.build / 'octocell'}: make mutants builds it")
    return arguments


def try_faults(
    faults: list[Fault], checks: list[Check], document: Document, jobs: int
) -> Iterator[Verdict]:
    """Fills in the document's checks, then yields what became of each fault, in any order."""
    runner = Runner()
    document.cost = sound_times(checks, runner, jobs)
    runner.limits = {name: LEAST_LIMIT + LIMIT_FACTOR * s for name, s in document.cost.items()}
    tried = side_by_side(
        lambda fault: try_all(fault, checks, document.cost, runner), faults, runner, jobs
    )
    for count, (fault, verdict) in enumerate(tried, 1):
        print(f"[{count}/{len(faults)}] {fault.name}: {verdict.text()}", flush=True)
        yield verdict


def main() -> int:
    arguments = parse_arguments()
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # as Ctrl-C: nothing is left running
    program = arguments.build.resolve() / "octocell"
    check_outputs([arguments.output], [program])
    faults = [fault for fault in faults_in(program) if arguments.only.fullmatch(fault.name)]
    if not faults:
        print(f"mutants: --only {arguments.only.pattern}: no such fault", file=sys.stderr)
        return EXIT_BAD_INPUT
    device = has_device(program)
    checks = [
        check
        for check in checks_in(program.parent, device)
        if arguments.checks.fullmatch(check.name)
    ]
    if not checks:
        print(f"mutants: --checks {arguments.checks.pattern}: no such check", file=sys.stderr)
        return EXIT_BAD_INPUT
    here = [fault for fault in faults if device or not fault.needs_device]
    document = Document({**context_of(program), "jobs": arguments.jobs, "finished": False})
    try:
        for verdict in try_faults(here, checks, document, arguments.jobs):
            document.verdicts.append(verdict)
        document.context["finished"] = True
    except KeyboardInterrupt:
        print("mutants: interrupted", file=sys.stderr)
    for fault in faults:
        if fault not in here:
            document.verdicts.append(Verdict(fault, "not_run", why="no device"))
    document.verdicts.sort(key=lambda verdict: faults.index(verdict.fault))
    document.write(arguments.output)
    print(f"{document.summary()}; {arguments.output}")
    if not document.context["finished"]:
        return EXIT_INTERRUPTED
    return EXIT_SURVIVED if document.with_status("survived") else 0


if __name__ == "__main__":
    sys.exit(run("mutants", main))
