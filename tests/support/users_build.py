# SPDX-License-Identifier: MIT
"""The build without the parts for developers, as the Makefile makes it: OCTOCELL_DEVELOPER=OFF."""

from __future__ import annotations

import os
import subprocess
from functools import cache
from pathlib import Path

from program import ROOT

# What such a build may not look for.
PACKAGES = ("GTest", "benchmark", "fcl", "Bullet", "PkgConfig", "TBB")


def checked(*command: object, **options: object) -> str:
    """Runs a command that must succeed; returns what it printed."""
    done = subprocess.run(  # type: ignore[call-overload]
        [str(word) for word in command], capture_output=True, text=True, check=False, **options
    )
    assert done.returncode == 0, f"{command}\n{done.stdout[-3000:]}{done.stderr[-3000:]}"
    return str(done.stdout)


@cache
def users_build() -> Path:
    """Its folder. Built once: ccache has nearly all of it from the tests' build."""
    folder = ROOT / "build-users"
    options = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in PACKAGES]
    options += ["-DOCTOCELL_DEVELOPER=OFF", "-DCMAKE_BUILD_TYPE=Release"]
    options += [f"-DOCTOCELL_CUDA={os.environ.get('OCTOCELL_CUDA', 'AUTO')}"]
    options += [f"-DOCTOCELL_WERROR={'ON' if os.environ.get('CI') else 'OFF'}"]
    checked("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", *options)
    checked("cmake", "--build", folder, "-j", os.cpu_count())
    return folder
