# SPDX-License-Identifier: MIT
"""octocell's own reader: its options are handed on, and what it says is passed on."""

import os
import shutil
import subprocess
import tempfile
from argparse import Namespace
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import numpy as np

from octocell_import import InputError
from octocell_import.frame import Frame

_ROOT = Path(__file__).resolve().parents[2]


def frames_by_octocell(path: Path, name: str, options: Namespace) -> Iterator[Frame]:
    builds = sorted(_ROOT.glob("build*/octocell"), key=lambda path: -path.stat().st_mtime)
    found = [os.environ.get("OCTOCELL_BIN"), *map(str, builds), shutil.which("octocell")]
    program = next(filter(None, found), None)
    if program is None:
        raise InputError(f"{path}: octocell reads such files, but is not built here")
    command = [program, "generate", str(path), "--format", name]
    command += ["--drop-invalid"] * options.drop_invalid
    if name != "pqr":  # its radii may be overridden here
        command += [f"--radius={radius}" for radius in options.radius if "=" not in radius]
    for frame in count() if name == "pqr" else [0]:
        with tempfile.TemporaryDirectory() as folder:
            output = ["-o", f"{folder}/scene.npy", *["--frame", str(frame)] * (name == "pqr")]
            done = subprocess.run([*command, *output], stdout=subprocess.DEVNULL, stderr=-1)
            said = done.stderr.decode("utf-8", "replace").splitlines()
            if done.returncode and frame and "no frame" in said[-1]:
                return
            if done.returncode:
                raise InputError(said[-1].removeprefix("octocell: "))
            columns = zip(("x", "y", "z", "radius"), np.load(f"{folder}/scene.npy").T, strict=True)
        said = [f"octocell   {line.removeprefix('octocell: ')}" for line in said]
        yield Frame(dict(columns), "angstrom" if name == "pqr" else None, said=said)
