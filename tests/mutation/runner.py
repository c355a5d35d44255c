# SPDX-License-Identifier: MIT
"""Runs a check with or without a fault, with limits on time and memory; the caller can end it."""

from __future__ import annotations

import contextlib
import os
import re
import resource
import signal
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

FIRST_LIMIT = 600.0  # seconds, where it is not known what a check takes


@dataclass(frozen=True)
class Check:
    """A program that passes, or does not."""

    name: str
    command: tuple[str, ...]


@dataclass(frozen=True)
class Outcome:
    passed: bool
    seconds: float
    why: str = ""  # the test that failed, or how the program ended


@dataclass
class Runner:
    """Runs programs with a fault or none, and ends them all when it is told to stop."""

    limits: dict[str, float] = field(default_factory=dict)  # seconds, by check
    stopped: bool = False
    running: set[subprocess.Popen[str]] = field(default_factory=set)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def run(self, check: Check, fault: str) -> Outcome:
        environment = {
            **os.environ,
            "OCTOCELL_FAULT": fault,
            "OMP_WAIT_POLICY": "passive",
            "GTEST_FAIL_FAST": "1",
            "GTEST_BRIEF": "1",
            # As tests/properties/parameters.cpp has it; to know that a case fails is enough.
            "RC_PARAMS": "seed=1 max_success=50000 max_discard_ratio=100 noshrink=1",
        }
        limit = self.limits.get(check.name, FIRST_LIMIT)
        begin = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "result.json"
            process = self.start(
                [part.replace("RESULT", str(out)) for part in check.command], environment
            )
            try:
                output, _ = process.communicate(timeout=limit)
            except subprocess.TimeoutExpired:
                end(process)
                process.communicate()  # closes what it wrote to
                return Outcome(False, time.monotonic() - begin, f"no answer within {limit:.0f} s")
            except KeyboardInterrupt:
                end(process)
                raise
            finally:
                with self.lock:
                    self.running.discard(process)
        seconds = time.monotonic() - begin
        if process.returncode == 0:
            return Outcome(True, seconds)
        return Outcome(False, seconds, why_failed(process.returncode, output))

    def start(self, command: list[str], environment: dict[str, str]) -> subprocess.Popen[str]:
        with self.lock:
            if self.stopped:
                raise KeyboardInterrupt
            process = subprocess.Popen(
                command,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                errors="replace",
                start_new_session=True,  # so that its children end with it
            )
            self.running.add(process)
        limit_memory(process)
        return process

    def stop(self) -> None:
        with self.lock:
            self.stopped = True
            for process in self.running:
                end(process)


def limit_memory(process: subprocess.Popen[str]) -> None:
    """A fault may ask for any amount: no more than the machine has, and no core files."""
    most = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    with contextlib.suppress(ProcessLookupError):  # it may have ended
        resource.prlimit(process.pid, resource.RLIMIT_AS, (most, most))
        resource.prlimit(process.pid, resource.RLIMIT_CORE, (0, 0))


def end(process: subprocess.Popen[str]) -> None:
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def why_failed(code: int, output: str) -> str:
    """The first test that failed, in the words of Google Test or of `octocell stress`."""
    if found := re.search(r"\[  FAILED  \] ([\w/.]+)", output):
        return found[1]
    entry = ""
    for line in output.splitlines():
        if found := re.match(r"([A-Z]\d+) ", line):
            entry = found[1]
        if "FAILED, " in line:
            return f"entry {entry}, {line.partition('FAILED, ')[2]}"
    if code < 0:
        return signal.Signals(-code).name
    last = output.strip().splitlines()[-1:]
    return f"exit {code}" + (f": {last[0][:100]}" if last else "")
