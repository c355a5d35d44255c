# SPDX-License-Identifier: MIT
"""PLY, text or binary: the vertices' x, y, z, and radius or diameter if they have one."""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from plyfile import PlyData, PlyParseError  # type: ignore[import-untyped]

from octocell_import.errors import InputError
from octocell_import.frame import Frame
from octocell_import.text import DAMAGED, open_bytes, unreadable

# What plyfile and NumPy say of headers that cannot be meant: counts below zero or beyond memory.
_NO_PLY = (PlyParseError, ValueError, ArithmeticError, LookupError, TypeError, MemoryError)


def read_ply(path: Path) -> Iterator[Frame]:
    try:
        with open_bytes(path) as stream:
            content = io.BytesIO(stream.read())  # of a file itself plyfile may leave a handle open
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of rows that are not there, which are refused below
            data = PlyData.read(content, mmap=False)
    except _NO_PLY as error:
        raise InputError(f"{path}: no sound PLY: {' '.join(str(error).split())}") from error
    except DAMAGED as error:
        raise unreadable(path, error) from error
    vertices = next((element for element in data.elements if element.name == "vertex"), None)
    if vertices is None or vertices.count == 0:
        raise InputError(f"{path}: no vertices")
    columns = {p.name: vertices[p.name] for p in vertices.properties if hasattr(p, "val_dtype")}
    for name in ("x", "y", "z"):
        if name not in columns or columns[name].dtype == object:
            raise InputError(f"{path}: the vertices have no number {name}")
    radii, remark = _radii(columns)
    x, y, z = (_numbers(columns[name]) for name in ("x", "y", "z"))
    yield Frame((x, y, z), None, [], [], radii, remarks=[remark] if remark else [])


def _radii(columns: dict[str, NDArray[Any]]) -> tuple[NDArray[Any] | None, str]:
    if "radius" in columns:
        return _numbers(columns["radius"]), "radii      from the property radius"
    if "diameter" in columns:
        return _numbers(columns["diameter"]) / 2, "radii      from half the property diameter"
    return None, ""


def _numbers(column: NDArray[Any]) -> NDArray[Any]:
    """float32 as it is; anything else as float64, which holds every number a PLY may hold."""
    return column if column.dtype == np.float32 else column.astype(np.float64)
