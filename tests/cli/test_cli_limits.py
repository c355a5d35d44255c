# SPDX-License-Identifier: MIT
"""Threads that cannot be made, files that may not grow, signals: one line, and no file is left."""

from __future__ import annotations

import json
import os
import resource
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from control_groups import ControlGroup
from program import Octocell, Refused

SCENE = "gas:n=1000"


@pytest.fixture
def few_processes() -> Iterator[ControlGroup]:
    """A group in which a program gets its first thread and two more."""
    yield from ControlGroup.make("pids", {"pids.max": "3"})


@pytest.fixture
def one_process() -> Iterator[ControlGroup]:
    yield from ControlGroup.make("pids", {"pids.max": "1"})


def small_address_space() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (200_000 << 10, 200_000 << 10))


@pytest.mark.parametrize("backend", ["impl_cpu", "impl_thrust"])
def test_no_room_for_threads_does_not_hang(octocell: Octocell, backend: str) -> None:
    result = octocell.run(
        "find", SCENE, "--threads", 64, "--backend", backend, preexec_fn=small_address_space
    )
    assert result.rc in (0, 2), result
    assert len(result.stderr.splitlines()) == 1, result.stderr


@pytest.mark.parametrize("backend", ["impl_cpu", "impl_thrust"])
@pytest.mark.parametrize("command", ["find", "check"])
def test_fewer_threads_are_an_answer(
    octocell: Octocell, few_processes: ControlGroup, backend: str, command: str
) -> None:
    result = octocell.run(
        command, SCENE, "--threads", 64, "--backend", backend, preexec_fn=few_processes.enter
    )
    assert result.rc == 0, result
    assert result.stderr == "octocell: 64 threads were requested, but the system gave 3\n"


def test_threads_are_those_that_worked(octocell: Octocell, few_processes: ControlGroup) -> None:
    result = octocell.ok("find", SCENE, "--json", "--threads", 64, preexec_fn=few_processes.enter)
    assert json.loads(result.stdout)["threads"] == 3


@pytest.mark.parametrize("backend", ["impl_cpu", "impl_thrust"])
def test_no_other_thread_is_an_answer(
    octocell: Octocell, one_process: ControlGroup, backend: str
) -> None:
    result = octocell.run(
        "find", SCENE, "--threads", 8, "--backend", backend, preexec_fn=one_process.enter
    )
    assert result.rc == 0 and result.stderr.count("\n") == 1, result


def test_near_tangent_do_without_threads(octocell: Octocell, one_process: ControlGroup) -> None:
    octocell.ok("near-tangent", "--pairs", 100, "--threads", 8, preexec_fn=one_process.enter)


def test_a_row_without_its_threads_is_skipped(
    octocell: Octocell, one_process: ControlGroup, tmp_path: Path
) -> None:
    if (os.cpu_count() or 1) < 2:
        pytest.skip("the bench has rows with several threads on several cores only")
    result = octocell.ok(
        *["bench", SCENE, "--backend", "impl_cpu", "--rounds", 1, "--no-memory"],
        *["--benchmark_filter=method:planned/.*run:warm", "-o", tmp_path / "b.json"],
        preexec_fn=one_process.enter,
    )
    text = (tmp_path / "b.json").read_text(encoding="utf-8")
    assert "the system gave 1 of" in text, result


def shrink_disk() -> None:
    resource.setrlimit(resource.RLIMIT_FSIZE, (256, 256))


@pytest.mark.parametrize("command", [("find", "gas:n=300"), ("generate", "gas:n=300")])
def test_a_limit_on_file_sizes_is_an_error(
    refused: Refused, tmp_path: Path, command: tuple[str, str]
) -> None:
    (tmp_path / "a.npy").write_bytes(b"what was there")
    # SIGXFSZ as a shell has it, not ignored as Python has it.
    line = refused(*command, "-o", "a.npy", preexec_fn=shrink_disk, restore_signals=True)
    assert "cannot write a.npy: File too large" in line


def test_a_limit_on_file_sizes_holds_for_standard_output(refused: Refused, tmp_path: Path) -> None:
    out = tmp_path.parent / f"{tmp_path.name}.out"
    with out.open("w", encoding="utf-8") as stdout:
        line = refused("list", stdout=stdout, preexec_fn=shrink_disk, restore_signals=True)
    assert "standard output" in line


def _temporaries(folder: Path) -> list[Path]:
    return list(folder.glob(".octocell-*.tmp"))


DEADLY = ["HUP", "INT", "QUIT", "PIPE", "ALRM", "TERM", "USR1", "USR2", "XCPU", "VTALRM", "PROF"]


@pytest.mark.parametrize("name", [*DEADLY, "RTMIN"])
def test_no_signal_leaves_a_temporary(octocell: Octocell, tmp_path: Path, name: str) -> None:
    number = getattr(signal, f"SIG{name}")
    for _ in range(20):
        with subprocess.Popen(
            [octocell.path, "generate", "gas:n=200000", "-o", tmp_path / "a.csv"],
            stdout=subprocess.DEVNULL,
            # nohup, and shells with &, hand on signals that are ignored.
            preexec_fn=lambda: signal.signal(number, signal.SIG_DFL),
        ) as running:
            while running.poll() is None and not _temporaries(tmp_path):
                time.sleep(0.0002)
            running.send_signal(number)
            running.wait(timeout=60)
        assert not _temporaries(tmp_path)
        if running.returncode == -number:  # it came in time
            return
    pytest.fail(f"SIG{name} never came while the file was written")


def test_signals_that_are_ignored_stay_so(octocell: Octocell, tmp_path: Path) -> None:
    def ignore() -> None:
        signal.signal(signal.SIGHUP, signal.SIG_IGN)

    with subprocess.Popen(
        [octocell.path, "generate", "gas:n=200000", "-o", tmp_path / "a.csv"],
        stdout=subprocess.DEVNULL,
        preexec_fn=ignore,
    ) as running:
        while running.poll() is None:
            running.send_signal(signal.SIGHUP)
            time.sleep(0.001)
    assert running.returncode == 0 and (tmp_path / "a.csv").is_file()


def test_a_library_that_exits_does_not_choose_the_code(octocell: Octocell) -> None:
    """OpenMP reads this at the start; a size that cannot be had ends the first parallel loop."""
    environment = {**os.environ, "OMP_STACKSIZE": "4096G"}
    result = octocell.run(
        "find", SCENE, "--backend", "impl_thrust", "--threads", 2, env=environment
    )
    assert result.rc in (0, 2), result
