# SPDX-License-Identifier: MIT
"""The plug-ins of examples/plugins: built by their own CMake, judged by `octocell try`."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from program import ROOT, Octocell

EXAMPLES = ROOT / "examples/plugins"


def build(name: str, folder: Path, *options: str) -> Path:
    configure = ["cmake", "-S", EXAMPLES / name, "-B", folder, *options]
    for command in (configure, ["cmake", "--build", folder]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    library = folder / f"lib{name}.so"
    assert library.is_file()
    return library


@pytest.mark.skipif(not Path("/usr/include/CGAL").is_dir(), reason="libcgal-dev is not installed")
def test_cgal_is_exact(octocell: Octocell, tmp_path: Path) -> None:
    library = build("cgal_box_intersection", tmp_path)
    assert "exact on" in octocell.ok("try", library, "--budget", "1").stdout
    # Nearly touching at all sizes, and what float64 cannot decide.
    judged = octocell.ok(
        "stress", "--size", "slice", "--entry", "A.*", "--plugin", library,
        "--backend", "plugin_cgal_box_intersection", timeout=100,
    )  # fmt: skip
    assert "plugin_cgal_box_intersection" in judged.stdout


def nvcc() -> str | None:
    home = os.environ.get("CUDA_HOME", "/usr/local/cuda")
    return os.environ.get("CUDACXX") or shutil.which("nvcc") or shutil.which(f"{home}/bin/nvcc")


@pytest.mark.skipif(nvcc() is None, reason="there is no nvcc here")
def test_cub_only_compiles_and_is_exact_on_a_gpu(octocell: Octocell, tmp_path: Path) -> None:
    library = build(
        "cub_only", tmp_path, "-DCMAKE_CUDA_ARCHITECTURES=90", f"-DCMAKE_CUDA_COMPILER={nvcc()}"
    )
    if not Path("/dev/nvidiactl").exists():
        return  # that it compiles is all that can be seen here
    judged = octocell.run("try", library, "--budget", "2")
    if "no kernel image" in judged.stdout:
        pytest.skip("this GPU is not of sm_90")
    assert "exact on" in judged.stdout
