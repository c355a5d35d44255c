# SPDX-License-Identifier: MIT
"""GROMACS .trr: frames in XDR (big-endian); coordinates in nm, and names in another file.

A frame is a header (magic number, version, the sizes of ten blocks, atoms, step, time), then the
blocks in this order; GROMACS: src/gromacs/fileio/trrio.cpp.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import numpy as np

from octocell_import.errors import InputError
from octocell_import.frame import Frame
from octocell_import.text import DAMAGED, open_bytes, unreadable

_MAGIC = 1993
_VERSION = b"GMX_trn_file"
_START = struct.Struct(">iiI")  # magic number, length of the version with its zero, and without
_SIZES = struct.Struct(">13i")  # bytes of the ten blocks, number of atoms, step, unused
_X, _AFTER_X = 7, slice(8, 10)  # blocks: ir e box vir pres top sym x v f


@dataclass(frozen=True)
class _Header:
    sizes: tuple[int, ...]  # [10] bytes
    count: int
    step: int
    real: str  # '>f4' or '>f8'
    time: float  # [ps]


class _Stream:
    """Bytes with their position, so that errors can say where."""

    def __init__(self, path: Path, stream: IO[bytes]) -> None:
        self.path, self._stream, self.position = path, stream, 0

    def take(self, size: int, what: str) -> bytes:
        """Exactly size bytes; none at all at the end of the file if what is the next frame."""
        try:
            found = self._stream.read(size)
        except DAMAGED as error:
            raise unreadable(self.path, error) from error
        if len(found) != size and (found or what != "the next frame"):
            raise self.fault(f"the file ends within {what}")
        self.position += len(found)
        return found

    def fault(self, why: str) -> InputError:
        return InputError(f"{self.path}: byte {self.position}: {why}")


def read_trr(path: Path) -> Iterator[Frame]:
    found = False
    with open_bytes(path) as opened:
        stream = _Stream(path, opened)
        while (header := _header(stream)) is not None:
            size, before = header.sizes[_X], sum(header.sizes[:_X])
            stream.take(before, "the box")
            numbers = np.frombuffer(stream.take(size, "the coordinates"), header.real)
            stream.take(sum(header.sizes[_AFTER_X]), "the velocities and forces")
            if size == 0:  # a frame of velocities or forces alone
                continue
            found = True
            x, y, z = numbers.astype(header.real.replace(">", "=")).reshape(header.count, 3).T
            remark = f"time       {header.time:g} ps, step {header.step}"
            yield Frame((x, y, z), "nm", [], [], remarks=[remark])
    if not found:
        raise InputError(f"{path}: no frame with coordinates")


def _header(stream: _Stream) -> _Header | None:
    start = stream.take(_START.size, "the next frame")
    if not start:
        return None
    magic, _, length = _START.unpack(start)
    if magic != _MAGIC or length != len(_VERSION) or stream.take(length, "a header") != _VERSION:
        raise stream.fault("no TRR frame starts here")
    *sizes, count, step, _ = _SIZES.unpack(stream.take(_SIZES.size, "a header"))
    width = _width(sizes, count)
    if width is None:
        raise stream.fault(f"a header whose sizes do not fit {count} atoms")
    time, _ = struct.unpack(f">2{'f' if width == 4 else 'd'}", stream.take(2 * width, "a header"))
    return _Header(tuple(sizes), count, step, f">f{width}", time)


def _width(sizes: list[int], count: int) -> int | None:
    """Bytes of a real number, which nothing but the sizes tells; None if they contradict."""
    if count <= 0 or min(sizes) < 0:
        return None
    expected = {7: 3 * count, 8: 3 * count, 9: 3 * count, 2: 9, 3: 9, 4: 9}
    widths = {sizes[k] / numbers for k, numbers in expected.items() if sizes[k]}
    fits = len(widths) == 1 and widths <= {4.0, 8.0}
    return int(widths.pop()) if fits else None
