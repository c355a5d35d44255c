# SPDX-License-Identifier: MIT
"""GROMACS .trr: frames in XDR (big-endian); coordinates in nm, and names in another file.

A frame is a header (magic number, version, the sizes of ten blocks, atoms, step, time), then the
blocks in this order; GROMACS: src/gromacs/fileio/trrio.cpp.
"""

import struct
from collections.abc import Iterator

import numpy as np

from octocell_import import InputError
from octocell_import.frame import Frame
from octocell_import.text import File

_START, _VERSION = struct.pack(">iii", 1993, 13, 12), b"GMX_trn_file"
_BOXES = dict.fromkeys((2, 3, 4), 9)  # real numbers in the blocks of box, virial and pressure
_X, _V, _F = 7, 8, 9  # blocks of three real numbers an atom


def read(file: File) -> Iterator[Frame]:
    found = False
    while not file.ended():
        start = file.take(len(_START), "the next frame")
        if start != _START or file.take(len(_VERSION), "a header") != _VERSION:
            raise InputError(f"byte {file.position}: no TRR frame starts here")
        *sizes, count, step, _ = struct.unpack(">13i", file.take(52, "a header"))
        numbers = _BOXES | dict.fromkeys((_X, _V, _F), 3 * count)
        widths = {sizes[k] / max(n, 1) for k, n in numbers.items() if sizes[k]}  # of a number
        if count < 0 or min(sizes) < 0 or widths not in ({4}, {8}):
            raise InputError(f"byte {file.position}: a header whose sizes do not fit {count} atoms")
        real = f">f{int(widths.pop())}"
        time = np.frombuffer(file.take(2 * int(real[2]), "a header"), real)[0]
        file.take(sum(sizes[:_X]), "the box")
        xyz = np.frombuffer(file.take(sizes[_X], "the coordinates"), real).reshape(-1, 3)
        file.take(sizes[_V] + sizes[_F], "the velocities and forces")
        if sizes[_X]:  # else a frame of velocities or forces alone
            found = True
            columns = dict(zip("xyz", xyz.astype(real.replace(">", "=")).T, strict=True))
            yield Frame(columns, "nm", said=[f"time       {time:g} ps, step {step}"])
    if not found:
        raise InputError("no frame with coordinates")
