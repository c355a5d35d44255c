# SPDX-License-Identifier: MIT
"""PLY, text or binary: the vertices' x, y, z, and radius or diameter if they have one.

http://gamma.cs.unc.edu/POWERPLANT/papers/ply.pdf
"""

import struct
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from octocell_import import InputError, quote
from octocell_import.decimals import Column
from octocell_import.frame import Frame, points
from octocell_import.text import File, as_column

_TEXT = "text"
_ORDERS = {"ascii": _TEXT, "binary_little_endian": "<", "binary_big_endian": ">"}
_TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I"}
_TYPES |= {"float": "f", "double": "d", "float32": "f", "float64": "d", "int8": "b"}
_TYPES |= {"uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I"}
_Property = tuple[str, str, str]  # name, type, and of a list the type of its length
_Elements = dict[str, tuple[int, list[_Property]]]  # name: how many, and of what


def read(file: File) -> Iterator[Frame]:
    if file.line().strip() != b"ply":
        raise InputError("no sound PLY: it does not start with ply")
    order, elements = _header(file)
    if "vertex" not in elements:
        raise InputError("no vertices")
    columns = {name: _rows(file, quote(name), *elements[name], order) for name in elements}
    if file.filled():
        file.refuse("more follows than the header says")
    yield points(*columns["vertex"])


def _header(file: File) -> tuple[str, _Elements]:
    order, elements, name = "", _Elements(), ""
    while (line := file.line("end_header")).strip() != b"end_header":
        match [word.decode("ascii", "replace") for word in line.split()]:
            case _ if line[:1] == b"\r":
                file.refuse("no sound PLY: lines end in LF and CR")
            case ["format", form, "1.0"] if form in _ORDERS:
                order = _ORDERS[form]
            case ["element", name, count] if name not in elements:
                elements[name] = file.count(count.encode(), "number of rows"), []
            case ["property", kind, own] if name and kind in _TYPES:
                elements[name][1].append((own, _TYPES[kind], ""))
            case ["property", "list", length, kind, own] if name and {length, kind} <= set(_TYPES):
                elements[name][1].append((own, _TYPES[kind], _TYPES[length]))
            case words if words[:1] not in (["comment"], ["obj_info"], []):
                file.refuse(f"no sound PLY: {quote(line)}")
        names = [own for own, _, _ in elements[name][1]] if name else []
        if len(set(names)) < len(names):
            file.refuse(f"no sound PLY: two properties are called {quote(names[-1])}")
    if not order:
        file.refuse("no sound PLY: no format")
    for name, (rows, properties) in elements.items():
        if rows and not properties:
            file.refuse(f"no sound PLY: element {quote(name)} has no properties")
    return order, elements


def _rows(
    file: File, name: str, count: int, properties: list[_Property], order: str
) -> tuple[dict[str, Column], Column | None]:
    """The columns of an element's rows, and their lines."""
    names = [own for own, _, length in properties if not length]
    if order == _TEXT and len(names) == len(properties) > 0:
        return file.words(count, names)
    if len(names) == len(properties) > 0:
        kind = np.dtype([(own, order + code) for own, code, _ in properties])
        rows = np.frombuffer(file.take(count * kind.itemsize, f"element {name}"), kind)
        return {own: rows[own] for own in names}, None
    values: dict[str, list[Any]] = {own: [] for own in names}
    row: list[bytes] = []  # words that are left, the last one first

    def cells(code: str, many: int = 1) -> Sequence[Any]:
        if order == _TEXT:
            return [row.pop() for _ in range(many)]
        kind = f"{order}{many}{code}"
        return struct.unpack(kind, file.take(struct.calcsize(kind), f"element {name}"))

    for k in range(count):
        if order == _TEXT:
            line = file.line(f"row {k + 1} of {count} of element {name}")
            row += reversed(file.split(line))
        try:
            for own, code, length in properties:
                found = cells(code, int(cells(length)[0]) if length else 1)
                if not length:
                    values[own].append(found[0])
        except (IndexError, ValueError, struct.error):
            file.refuse(f"row {k + 1} of {count} of element {name} has too few numbers")
        if row:
            file.refuse(f"row {k + 1} of {count} of element {name} has too many numbers")
    columns = {own: as_column(v) if order == _TEXT else np.array(v) for own, v in values.items()}
    return columns, None
