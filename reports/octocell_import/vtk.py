# SPDX-License-Identifier: MIT
"""Legacy VTK, text or binary: points, and radius or diameter if the file has them of each point.

https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html
"""

from collections.abc import Iterator

import numpy as np

from octocell_import import InputError, quote
from octocell_import.decimals import Column
from octocell_import.frame import Frame, points
from octocell_import.text import File, as_column, as_columns

_TYPES = {"unsigned_char": "u1", "char": "i1", "unsigned_short": "u2", "short": "i2", "int": "i4"}
_TYPES |= {"unsigned_int": "u4", "unsigned_long": "u8", "long": "i8", "vtktypeint64": "i8"}
_TYPES |= {"vtkidtype": "i4", "float": "f4", "double": "f8"}
_DATASETS = ("POLYDATA", "UNSTRUCTURED_GRID", "STRUCTURED_GRID")  # those with points
_CELLS = ("VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS", "CELLS")
_PER_POINT = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9, "GLOBAL_IDS": 1, "PEDIGREE_IDS": 1}


def read(file: File) -> Iterator[Frame]:
    version = file.line().lower().partition(b"# vtk datafile version ")[2].strip()
    if not version:
        raise InputError("no legacy VTK: it does not start with # vtk DataFile Version")
    file.line("the title")
    form = file.filled().strip().upper()
    if form not in (b"ASCII", b"BINARY"):
        file.refuse(f"neither ASCII nor BINARY: {quote(form)}")

    def numbers(count: str, kind: str, each: str | int = 1) -> Column:
        total = file.count(count.encode(), "count") * file.count(str(each).encode(), "count")
        if kind.lower() not in _TYPES:
            file.refuse(f"{quote(kind)} is no type of numbers that is known here")
        if form == b"BINARY":
            real = np.dtype(f">{_TYPES[kind.lower()]}")
            return np.frombuffer(file.take(total * real.itemsize, f"{total} numbers"), real)
        words: list[bytes] = []
        while len(words) < total:
            words += file.split(file.line(f"{total} numbers"))
        if len(words) > total:
            file.refuse(f"{len(words)} numbers, where {total} were expected")
        return as_column(words)

    xyz: Column | None = None
    sizes, rows, of_points, arrays = ("0", "0"), "0", False, 0  # arrays of a FIELD that follow
    columns: dict[str, Column] = {}
    while words := [word.decode("ascii", "replace") for word in file.filled().split()]:
        found: dict[str, Column] = {}
        match [words[0].upper(), *words[1:]]:
            case [_, many, count, kind] if arrays > 0:
                arrays, found = arrays - 1, {words[0]: numbers(count, kind, many)}
            case ["DATASET", kind] if kind.upper() in _DATASETS:
                pass
            case ["DIMENSIONS", _, _, _]:
                pass
            case ["FIELD", _, count]:
                arrays = file.count(count.encode(), "number of arrays")
            case ["METADATA"]:
                while file.line().strip():
                    pass
            case ["POINTS", count, kind]:
                xyz = numbers(count, kind, 3).reshape(-1, 3)
            case [key, count, size] if key in _CELLS:
                sizes = count, size
                numbers("0" if version >= b"5" else size, "int")
            case ["OFFSETS" | "CONNECTIVITY" as key, kind]:
                numbers(sizes[key == "CONNECTIVITY"], kind)
            case ["CELL_TYPES", count]:
                numbers(count, "int")
            case ["POINT_DATA" | "CELL_DATA" as key, rows]:
                of_points = key == "POINT_DATA"
            case ["SCALARS", name, kind, *many] if len(many) < 2:
                if not file.line("LOOKUP_TABLE").upper().startswith(b"LOOKUP_TABLE"):
                    file.refuse("LOOKUP_TABLE was expected")
                found = {name: numbers(rows, kind, *many)}
            case [key, _, kind] if key in _PER_POINT:
                numbers(rows, kind, _PER_POINT[key])
            case ["COLOR_SCALARS", _, many]:
                numbers(rows, "unsigned_char", many)
            case ["LOOKUP_TABLE", _, count]:
                numbers(count, "unsigned_char", 4)
            case _:
                file.refuse(f"{quote(' '.join(words))} is nothing that is known here")
        columns |= found if of_points else {}
    if xyz is None or arrays:
        raise InputError(
            f"ends after line {file.number}, before {'an array' if arrays else 'POINTS'}"
        )
    yield points(as_columns(xyz, "xyz") | columns)
