# SPDX-License-Identifier: MIT
"""GROMACS .gro: title, count, one atom a line in fixed columns, box; nm; frames follow each other.

https://manual.gromacs.org/current/reference-manual/file-formats.html#gro
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from octocell_import.elements import element_of
from octocell_import.errors import quote
from octocell_import.frame import Frame
from octocell_import.text import TextFile

# Wide numbers of the box may touch each other; then five decimals tell them apart.
_NUMBER = r"[-+]?\d+(\.\d*)?"
_BOX = re.compile(
    rf"\s*({_NUMBER}(\s+{_NUMBER}){{2}}((\s+{_NUMBER}){{6}})?|(\s*-?\d+\.\d{{5}}){{3}})\s*"
)
_COORDINATES = 20  # after residue number, residue, name and atom number, five columns each


def read_gro(path: Path) -> Iterator[Frame]:
    with TextFile(path) as file:
        title: str | None = file.need("the title")
        while title is not None:
            count = file.whole(file.need("the number of atoms"), "number of atoms")
            if count == 0:
                file.refuse("no atoms")
            frame = _atoms(file, count)
            _check_box(file, count)
            yield frame
            title = file.next_filled()


def _atoms(file: TextFile, count: int) -> Frame:
    columns: tuple[list[str], ...] = ([], [], [])
    labels: list[str] = []
    elements: list[str | None] = []
    first = file.number + 1
    width = 0
    for atom in range(count):
        line = file.need(f"atom {atom + 1} of {count}")
        width = width or _width(file, line)
        if len(line) < _COORDINATES + 3 * width:
            file.refuse(f"atom {atom + 1} of {count}: too short for x, y and z: {quote(line)}")
        for k, column in enumerate(columns):
            start = _COORDINATES + k * width
            column.append(line[start : start + width])
        labels.append(line[10:15].strip())
        elements.append(element_of(labels[-1], line[5:10].strip()))
    return Frame(
        xyz=(columns[0], columns[1], columns[2]),
        unit="nm",
        labels=labels,
        elements=elements,
        lines=range(first, first + count),
        elements_from="atom and residue names",
    )


def _width(file: TextFile, line: str) -> int:
    """Columns per coordinate: the decimal points of the first atom are so far apart."""
    first = line.find(".", _COORDINATES)
    second = line.find(".", first + 1)
    third = line.find(".", second + 1)
    if first < 0 or second < 0 or third - second != second - first:
        file.refuse(f"no x, y and z in columns of one width from column 21 on: {quote(line)}")
    return second - first


def _check_box(file: TextFile, count: int) -> None:
    """The line after the atoms is the box: otherwise the count was wrong."""
    line = file.need(f"the box that follows {count} atoms")
    if _BOX.fullmatch(line) is None:
        file.refuse(f"after {count} atoms the box (3 or 9 numbers) was expected: {quote(line)}")
