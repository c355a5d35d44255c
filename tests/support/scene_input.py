# SPDX-License-Identifier: MIT
"""What the program reads: a file's bytes in, its spheres out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt

from program import Octocell

Spheres = npt.NDArray[np.float32]


def read(octocell: Octocell, file: Path, *args: object) -> tuple[Spheres, str]:
    """The spheres of a file, as `generate` writes them, and what it says on stderr."""
    out = file.with_name("read.npy")
    said = octocell.ok("generate", file.name, *args, "-o", out.name, cwd=file.parent).stderr
    spheres: Spheres = np.load(out)
    out.unlink()
    return spheres, said


def npy_bytes(array: npt.NDArray[np.generic], folder: Path) -> bytes:
    path = folder / "bytes.npy"
    np.save(path, array)
    content = path.read_bytes()
    path.unlink()
    return content
