# SPDX-License-Identifier: MIT
"""Files may have any name that the system allows; messages about them stay on one line."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from hard_scenes import SCENES
from program import Octocell

NAMES = {
    b"latin1_\xe9.npy": r"latin1_\xe9.npy",
    b"cut_\xe2\x82.npy": r"cut_\xe2\x82.npy",
    b"surrogate_\xed\xa0\x80.npy": r"surrogate_\xed\xa0\x80.npy",
    b"overlong_\xc0\xaf.npy": r"overlong_\xc0\xaf.npy",
    b"two\nlines.npy": r"two\x0alines.npy",
    b"colour_\x1b[31m.npy": r"colour_\x1b[31m.npy",
    "c1_\x9b31m.npy".encode(): r"c1_\xc2\x9b31m.npy",
    "turned_\u202etxt.npy".encode(): r"turned_\xe2\x80\xaetxt.npy",
    "真实场景.npy".encode(): "真实场景.npy",
    "émoji_\U0001f600.npy".encode(): "émoji_\U0001f600.npy",
}


def run(octocell: Octocell, folder: Path, *args: str | bytes) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [octocell.path, *args], cwd=folder, capture_output=True, timeout=60, check=False
    )


@pytest.fixture(params=list(NAMES), ids=lambda name: ascii(name))
def name(request: pytest.FixtureRequest, tmp_path: Path) -> bytes:
    chosen: bytes = request.param
    with open(os.path.join(os.fsencode(tmp_path), chosen), "wb") as file:
        np.save(file, SCENES["gas"])
    return chosen


def test_find_shows_it(octocell: Octocell, tmp_path: Path, name: bytes) -> None:
    done = run(octocell, tmp_path, "find", name, "-o", "p.npy")
    assert done.returncode == 0 and done.stderr == b""
    assert done.stdout.decode().splitlines()[0].startswith(f"scene       {NAMES[name]} (")


def test_find_writes_json(octocell: Octocell, tmp_path: Path, name: bytes) -> None:
    done = run(octocell, tmp_path, "find", name, "--json", "-o", "p.npy")
    assert done.returncode == 0 and done.stderr == b""
    assert json.loads(done.stdout)["scene"] == NAMES[name]


def test_generate_and_check_show_it(octocell: Octocell, tmp_path: Path, name: bytes) -> None:
    done = run(octocell, tmp_path, "generate", "gas:n=9", "-o", b"new_" + name)
    assert done.returncode == 0
    assert done.stdout.decode() == f"new_{NAMES[name]}: 9 spheres from gas:n=9,seed=1,phi=0.1\n"
    done = run(octocell, tmp_path, "check", name, "--backend", "impl_cpu")
    assert done.returncode == 0
    assert done.stdout.decode().splitlines()[0].startswith(f"{NAMES[name]} (")


def test_bench_keeps_its_group(octocell: Octocell, tmp_path: Path, name: bytes) -> None:
    arguments = ["--backend", "impl_cpu", "--rounds", "1", "--no-memory"]
    filter_ = "--benchmark_filter=method:planned/.*threads:1/run:warm"
    done = run(octocell, tmp_path, "bench", name, *arguments, filter_, "-o", b"b_" + name)
    assert done.returncode == 0, done.stderr
    with open(os.path.join(os.fsencode(tmp_path), b"b_" + name), encoding="utf-8") as file:
        document = json.load(file)
    assert [group["spec"] for group in document["groups"]] == [NAMES[name]]
    assert len(document["rows"]) == 1
    assert done.stderr.decode().splitlines()[-1] == f"b_{NAMES[name]}"


def test_frames_in_such_a_folder(octocell: Octocell, tmp_path: Path) -> None:
    folder = os.path.join(os.fsencode(tmp_path), b"fr\xe9mes\n")
    os.mkdir(folder)
    for k in range(2):
        with open(os.path.join(folder, b"%d.npy" % k), "wb") as file:
            np.save(file, SCENES["gas"])
    arguments = ["--backend", "impl_cpu", "--rounds", "1", "-o", "b.json"]
    filter_ = "--benchmark_filter=method:planned/.*threads:1"
    done = run(octocell, tmp_path, "bench", "--trajectory", folder, *arguments, filter_)
    assert done.returncode == 0, done.stderr
    document = json.loads((tmp_path / "b.json").read_text(encoding="utf-8"))
    assert document["groups"][0]["scene"] == r"fr\xe9mes\x0a"


def test_errors_stay_on_one_line(octocell: Octocell, tmp_path: Path) -> None:
    for name, shown in NAMES.items():
        done = run(octocell, tmp_path, "find", b"missing_" + name)
        assert done.returncode == 2
        assert done.stderr.decode() == f"octocell: missing_{shown}: No such file or directory\n"


@pytest.mark.parametrize("name", ["x.pdb", "x.PDB", "x.gro", "x.xyz", "x.data", "x.dump", "x.ply"])
def test_formats_of_the_importer_name_it(octocell: Octocell, tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text("ATOM\n", encoding="utf-8")
    for command in ("find", "check", "explain", "bench"):
        done = run(octocell, tmp_path, command, name)
        assert done.returncode == 2
        assert f"octocell-import {name} -o x.npy" in done.stderr.decode(), done.stderr
