# SPDX-License-Identifier: MIT
"""Files that octocell reads itself are read by it here, too: each format has one reader."""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from octocell_import import InputError
from octocell_import.frame import Frame

_ROOT = Path(__file__).resolve().parents[2]


def frames_by_octocell(path: Path) -> Iterator[Frame]:
    builds = sorted(map(str, _ROOT.glob("build*/octocell")))
    found = [os.environ.get("OCTOCELL_BIN"), *builds, shutil.which("octocell")]
    program = next(filter(None, found), None)
    if program is None:
        raise InputError(f"{path}: octocell reads such files, but is not built here")
    with tempfile.TemporaryDirectory() as folder:
        scene = f"{folder}/scene.npy"
        command = [program, "generate", str(path), "-o", scene]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace")
        if done.returncode:
            raise InputError(done.stderr.strip().removeprefix("octocell: "))
        columns = dict(zip(("x", "y", "z", "radius"), np.load(scene).T, strict=True))
    yield Frame(columns, "angstrom" if ".pqr" in path.suffixes else None)
