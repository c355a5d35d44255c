# SPDX-License-Identifier: MIT
"""GROMACS .gro: title, count, one atom a line in fixed columns, box; nm; frames follow each other.

https://manual.gromacs.org/current/reference-manual/file-formats.html#gro
"""

import re
from collections.abc import Iterator

import numpy as np

from octocell_import import quote
from octocell_import.elements import element_of
from octocell_import.frame import Frame, kinds_of
from octocell_import.text import File, card, fields

# Wide numbers of the box may touch each other; then five decimals tell them apart.
_NUMBER = rb"[-+]?\d+(\.\d*)?"
_BOX = re.compile(rb"\s*(N(\s+N){2}((\s+N){6})?|(\s*-?\d+\.\d{5}){3})\s*".replace(b"N", _NUMBER))
_NAMES = {"number": (0, 5), "residue": (5, 10), "label": (10, 15)}
_X = 20  # where x starts


def read(file: File) -> Iterator[Frame]:
    title = file.line("the title")
    while title:
        counted = file.line("the number of atoms" if title.strip() else "")
        if title.strip() or counted.strip():  # else blank lines follow the last frame
            yield _frame(file, file.count(counted, "number of atoms"))
            counted = file.line()
        title = counted


def _frame(file: File, count: int) -> Frame:
    cards, width, before = bytearray(), 0, file.number
    for atom in range(count):
        line = file.line() or file.line(f"atom {atom + 1} of {count}")
        width = width or _width(file, line)
        cards += card(file, line, _X + 3 * width, _X + 3 * width)
    ends = {name: (_X + k * width, _X + (k + 1) * width) for k, name in enumerate("xyz")}
    columns = fields(cards, _X + 3 * width, _NAMES | ends)
    for name in ends:
        points = np.char.find(columns[name], b".")
        if (points != points[:1]).any():
            first = int((points != points[0]).argmax())
            why = f"{quote(columns[name][first])} is not a number with its point as above"
            file.refuse(f"{name}: {why}", before + 1 + first)
    box = file.line(f"the box that follows {count} atoms")
    if _BOX.fullmatch(box) is None:
        file.refuse(f"after {count} atoms the box (3 or 9 numbers) was expected: {quote(box)}")
    columns["line"] = np.arange(count) + before + 1
    columns["kind"], kinds = kinds_of(element_of, columns["label"], columns["residue"])
    return Frame(columns, "nm", kinds, "atom and residue names")


def _width(file: File, line: bytes) -> int:
    """Columns per coordinate: the decimal points of the first atom are so far apart."""
    first = line.find(b".", _X)
    second = line.find(b".", first + 1)
    if first < 0 or second < 0 or line.find(b".", second + 1) - second != second - first:
        file.refuse(f"no x, y and z in columns of one width from column 21 on: {quote(line)}")
    return second - first
