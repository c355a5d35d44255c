# SPDX-License-Identifier: MIT
"""NPY files that are there whole or not at all."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from numpy.lib import format as npy

from octocell_import.decimals import Floats
from octocell_report.files import write_whole


def write_npy(path: Path, scene: Floats) -> None:
    """Little-endian float32, (N, 4). Throws ReportError."""
    plain, header = np.ascontiguousarray(scene, "<f4"), io.BytesIO()
    about = npy.header_data_from_array_1_0(plain)  # type: ignore[no-untyped-call]
    npy.write_array_header_1_0(header, about)  # type: ignore[no-untyped-call]
    write_whole(path, header.getvalue(), plain.data)
