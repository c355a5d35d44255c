#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One checksum for every compiler: builds digests.cpp with generators, planner, impl_cpu and
reference with every compiler and set of flags, runs all, and compares their output.
Also: everything that would void the proofs (-ffast-math) must be refused at compile time."""

from __future__ import annotations

import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/support"), str(ROOT / "reports")]

from octocell_report import console  # noqa: E402
from octocell_report.files import check_outputs, write_json  # noqa: E402
from provenance import context  # noqa: E402

# impl_cpu as the build compiles it; nothing else of the build's flags: no -fno-tree-slp-vectorize.
ALWAYS = ["-std=c++20", "-ffp-contract=off", f"-I{ROOT}", "-DBOOST_ASIO_DISABLE_FENCED_BLOCK"]
LIBRARIES = ["-lfmt", "-lgmpxx", "-lgmp", "-pthread"]
LEVELS = ["-O0", "-O1", "-O2", "-O3"]
TARGETS = [[], ["-mfma"], ["-march=native"]]
REFUSED = ["-ffast-math", "-ffinite-math-only", "-Ofast"]


@dataclass(frozen=True)
class Configuration:
    compiler: str
    flags: tuple[str, ...]

    @property
    def name(self) -> str:
        return " ".join([self.compiler, *self.flags])

    @property
    def folder(self) -> str:
        return self.name.replace(" ", "_").replace("=", "-")


def compilers() -> list[str]:
    return [name for name in ("g++", "clang++") if shutil.which(name)]


def all_configurations() -> list[Configuration]:
    return [
        Configuration(compiler, (level, *target))
        for compiler in compilers()
        for level in LEVELS
        for target in TARGETS
    ]


def two_configurations() -> list[Configuration]:
    """As far from each other as this machine's compilers allow."""
    return [
        Configuration("g++", ("-O0",)),
        Configuration(compilers()[-1], ("-O3", "-march=native")),
    ]


def sources() -> list[Path]:
    folders = ["core", "harness/scenes", "harness/verify/reference", "impl_cpu"]
    found = [path for folder in folders for path in sorted((ROOT / folder).rglob("*.cpp"))]
    found = [path for path in found if not path.stem.endswith("missing")]  # of builds for users
    driver = [ROOT / "harness/engine" / f"{name}.cpp" for name in ("find_completely", "memory_guard")]
    return [*found, *driver, ROOT / "tests/hazards/digests.cpp"]


def run(command: list[str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True, check=False)


def compile_one(configuration: Configuration, source: Path, folder: Path) -> Path:
    target = folder / (source.relative_to(ROOT).as_posix().replace("/", "_") + ".o")
    cache = ["ccache"] if shutil.which("ccache") else []
    command = [*cache, configuration.compiler, *ALWAYS, *configuration.flags]
    done = run([*command, "-c", str(source), "-o", str(target)])
    if done.returncode != 0:
        sys.exit(f"compilers: {configuration.name}: {source}:\n{done.stderr[-2000:]}")
    return target


def digests(configuration: Configuration, jobs: int, out: Path) -> list[str]:
    """What the program says when it is built so."""
    folder = out / configuration.folder
    folder.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(jobs) as pool:
        objects = pool.map(lambda s: compile_one(configuration, s, folder), sources())
        names = [str(path) for path in objects]
    program = str(folder / "digests")
    linked = run([configuration.compiler, *names, *LIBRARIES, "-o", program])
    if linked.returncode != 0:
        sys.exit(f"compilers: {configuration.name}: {linked.stderr[-2000:]}")
    done = run([program])
    if done.returncode != 0:
        sys.exit(f"compilers: {configuration.name}: exit {done.returncode}: {done.stderr}")
    return done.stdout.splitlines()


def wrong_answers(lines: list[str]) -> list[str]:
    """Answers of correct rules that are not exact; as_written is wrong everywhere alike."""
    exact: dict[str, str] = {}
    wrong = []
    for line in lines:
        scene, _, said = line.partition(" | ")
        what, _, value = said.partition(" ")
        if what == "exact":
            exact[scene] = value
        elif what == "spheres" or "as_written" in said or said.endswith(" refused"):
            continue
        elif not said.endswith(" " + exact[scene]):
            wrong.append(line)
    return wrong


def flags_that_compile() -> list[str]:
    """Of the flags that must be refused, those that are not."""
    source = '#include "core/sphere.hpp"'
    accepted = []
    for compiler in compilers():
        for flag in REFUSED:
            command = [compiler, *ALWAYS, flag, "-fsyntax-only", "-x", "c++", "-"]
            done = subprocess.run(
                command, input=source, text=True, capture_output=True, check=False
            )
            if done.returncode == 0 or "would void the proofs" not in done.stderr:
                accepted.append(f"{compiler} {flag}")
    return accepted


def version(compiler: str) -> str:
    return run([compiler, "--version"]).stdout.partition("\n")[0]


def main() -> int:
    parser = console.Parser(description=__doc__)
    parser.add_argument("--slice", action="store_true", help="two configurations instead of all")
    parser.add_argument("--jobs", type=int, default=2, help="compilers at a time")
    parser.add_argument("--build", type=Path, default=ROOT / "build/hazards", help="for objects")
    parser.add_argument("-o", "--output", type=Path, help="JSON to write")
    arguments = parser.parse_args()
    check_outputs([arguments.output] if arguments.output else [])

    failures = [f"{what} is accepted" for what in flags_that_compile()]
    configurations = two_configurations() if arguments.slice else all_configurations()
    first: list[str] = []
    for configuration in configurations:
        begin = time.monotonic()
        lines = digests(configuration, arguments.jobs, arguments.build)
        first = first or lines
        differing = [line for line in lines if line not in set(first)]
        failures += [f"{configuration.name}: {line}" for line in differing[:5]]
        failures += [f"{configuration.name}: wrong: {line}" for line in wrong_answers(lines)[:5]]
        verdict = "differs" if differing or len(lines) != len(first) else "same"
        seconds = f"{time.monotonic() - begin:.0f} s"
        print(f"{configuration.name:<32} {len(lines)} checksums, {verdict} ({seconds})", flush=True)
    for failure in failures:
        print(f"FAILED: {failure}")
    print(
        f"{len(configurations)} configurations, {len(first)} checksums each, "
        f"{len(failures)} failures"
    )
    if arguments.output:
        result = {
            "schema": 2,
            "kind": "compilers",
            "context": context(),
            "compilers": {name: version(name) for name in compilers()},
            "configurations": [configuration.name for configuration in configurations],
            "checksums": len(first),
            "refused": [f"{compiler} {flag}" for compiler in compilers() for flag in REFUSED],
            "failures": failures,
        }
        write_json(arguments.output, result)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(console.run("compilers", main))
