# SPDX-License-Identifier: MIT
"""`octocell doctor` on machines that are made of a PATH of our own."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from program import ROOT, Json, Octocell, Result

SOLUTION = ROOT / "course/labs/solutions/1_brute_force.cpp"
GPU = "Tesla T4, 7.5, 580.65.06, 15360 MiB"


class Machine:
    """A PATH with only what a test puts there."""

    def __init__(self, octocell: Octocell, folder: Path) -> None:
        self.octocell = octocell
        self.bin = folder / "bin"
        self.bin.mkdir()
        (folder / "temporary").mkdir()
        self.environment = {
            "PATH": str(self.bin),
            "CUDA_HOME": str(folder / "no_cuda"),
            "TMPDIR": str(folder / "temporary"),
        }

    def add(self, name: str, script: str) -> None:
        path = self.bin / name
        path.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
        path.chmod(0o755)

    def add_compiler(self) -> None:
        self.add("c++", f'{self.real_compiler()} "$@"')

    @staticmethod
    def real_compiler() -> str:
        return f'PATH="{os.environ["PATH"]}" exec {shutil.which("c++")}'

    def add_python(self, options: str = "") -> None:
        self.add("python3", f'exec {sys.executable} {options} "$@"')

    def add_nvcc(self, release: str) -> None:
        """Gives the solution in C++ for that in CUDA: there need be no GPU."""
        version = f"Cuda compilation tools, release {release}, V{release}.88"
        flags = f"-shared -fPIC -O2 -std=c++20 -I {ROOT}/include/octocell"
        self.add(
            "nvcc",
            f"""[ "$1" = --version ] && echo "{version}" && exit
            for last; do :; done
            {self.real_compiler()} {flags} {SOLUTION} -o "$last\"""",
        )

    def run(self, *arguments: str, before: str = "") -> Result:
        words = [str(self.octocell.path), "doctor", *arguments]
        command = ["/bin/sh", "-c", f'{before} exec "$@"', "sh", *words] if before else words
        done = subprocess.run(
            command, env=self.environment, capture_output=True, text=True, timeout=120, check=False
        )
        return Result(done.returncode, done.stdout, done.stderr)

    def report(self, expected_rc: int, before: str = "") -> Json:
        result = self.run("--json", before=before)
        assert result.rc == expected_rc, result.stdout + result.stderr
        return dict(json.loads(result.stdout))


@pytest.fixture
def machine(octocell: Octocell, tmp_path: Path) -> Machine:
    return Machine(octocell, tmp_path)


def check_of(report: Json, name: str) -> Json:
    found = [check for check in report["checks"] if check["name"] == name]
    assert len(found) == 1, report["checks"]
    return dict(found[0])


def works(report: Json) -> dict[str, bool]:
    return {way["name"]: way["works"] for way in report["ways"]}


def test_a_machine_with_all_but_a_gpu_is_well(machine: Machine) -> None:
    machine.add_compiler()
    machine.add_python()
    report = machine.report(0)
    assert report["well"] is True
    assert works(report) == {"C++": True, "Python": True, "CUDA": False}
    for name in ("compiler", "Python", "NumPy", "memory", "disk"):
        assert check_of(report, name)["here"] is True
        assert check_of(report, name)["mend"] == ""
    assert "none" in check_of(report, "GPU")["found"]
    assert "make cuda-toolkit" in check_of(report, "nvcc")["mend"]

    text = machine.run()
    assert text.rc == 0
    lines = text.stdout.splitlines()
    assert len(lines) <= 24, "more than a screen"
    assert any(
        line.split()[0] == "C++" and line.endswith("works") for line in lines if line.strip()
    )
    assert any(line.startswith("- CUDA") for line in lines)


def test_an_empty_machine_lacks_all(machine: Machine) -> None:
    machine.add("apt-get", "exit 0")
    report = machine.report(1)
    assert report["well"] is False
    assert works(report) == {"C++": False, "Python": False, "CUDA": False}
    assert "apt-get install g++" in check_of(report, "compiler")["mend"]
    assert check_of(report, "Python")["mend"].endswith("apt-get install python3-numpy")


def test_the_package_manager_is_this_machines(machine: Machine) -> None:
    machine.add("dnf", "exit 0")
    assert "dnf install gcc-c++" in check_of(machine.report(1), "compiler")["mend"]
    machine.environment["CONDA_PREFIX"] = "/opt/conda"
    assert "conda install -c conda-forge" in check_of(machine.report(1), "compiler")["mend"]


def test_a_compiler_that_is_too_old_says_so(machine: Machine) -> None:
    machine.add("c++", "echo \"c++: error: unrecognized option '-std=c++20'\" >&2; exit 1")
    machine.add_python()
    report = machine.report(1)
    assert works(report) == {"C++": False, "Python": True, "CUDA": False}
    assert "unrecognized option" in check_of(report, "compiler")["found"]


def test_python_without_numpy(machine: Machine) -> None:
    machine.add_compiler()
    machine.add_python("-S")  # without site-packages
    report = machine.report(1)
    assert works(report) == {"C++": True, "Python": False, "CUDA": False}
    assert check_of(report, "NumPy")["here"] is False
    assert "-m pip install numpy" in check_of(report, "NumPy")["mend"]


@pytest.mark.parametrize(
    ("release", "gpu", "wrong", "words"),
    [
        ("13.0", GPU, "", ""),
        ("13.0", "Tesla T4, 7.5, 535.104.05, 15360 MiB", "driver", "CUDA 13 needs 580 or newer"),
        ("12.4", "Tesla T4, 7.5, 535.104.05, 15360 MiB", "", ""),
        ("12.4", "Tesla T4, 7.5, 470.82.01, 15360 MiB", "driver", "CUDA 12 needs 525 or newer"),
        ("13.0", "Quadro P400, 6.1, 580.65.06, 2048 MiB", "GPU", "too old for this nvcc"),
        ("12.4", "Quadro P400, 6.1, 535.104.05, 2048 MiB", "", ""),
    ],
)
def test_toolkit_driver_and_gpu_must_fit(
    machine: Machine, release: str, gpu: str, wrong: str, words: str
) -> None:
    machine.add_nvcc(release)
    machine.add("nvidia-smi", f'echo "{gpu}"')
    report = machine.report(1)  # there is no compiler for C++ alone
    assert works(report)["CUDA"] is True
    assert f"CUDA {release}" in check_of(report, "nvcc")["found"]
    for name in ("driver", "GPU"):
        check = check_of(report, name)
        assert check["here"] is (name != wrong), check
        if name == wrong:
            assert words in check["found"]
            assert check["mend"]


def test_limits_are_named(machine: Machine) -> None:
    report = machine.report(1, before="ulimit -v 16000000;")
    check = check_of(report, "limits")
    assert check["here"] is False
    assert check["mend"] == "ulimit -v unlimited"


def test_a_folder_for_temporary_files_that_is_not_there(machine: Machine, tmp_path: Path) -> None:
    machine.add_compiler()
    machine.environment["TMPDIR"] = str(tmp_path / "gone")
    report = machine.report(1)
    assert check_of(report, "disk")["here"] is False
    assert check_of(report, "disk")["mend"]
