# SPDX-License-Identifier: MIT
"""NPY files that are there whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from octocell_import.decimals import Floats
from octocell_import.errors import InputError


def write_npy(path: Path, scene: Floats) -> None:
    """Little-endian float32, (N, 4). Throws InputError."""
    target = path.resolve()
    part = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        with part.open("wb") as stream:
            np.save(stream, np.ascontiguousarray(scene, "<f4"))
        os.replace(part, target)
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from error
    finally:
        part.unlink(missing_ok=True)
