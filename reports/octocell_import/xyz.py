# SPDX-License-Identifier: MIT
"""XYZ: count, comment, one atom a line (symbol x y z, and r if there is just one number more).

Extended XYZ says in its comment what the columns are: Properties=species:S:1:pos:R:3:radius:R:1
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from octocell_import.elements import symbol
from octocell_import.errors import quote
from octocell_import.frame import Frame
from octocell_import.text import TextFile

_SIZE = re.compile(r"[0-9]{1,9}")
_SIZES = {"species": 1, "pos": 3, "radius": 1}  # columns of what is used
_PLAIN = {"species": 0, "pos": 1}


def read_xyz(path: Path) -> Iterator[Frame]:
    with TextFile(path) as file:
        line: str | None = file.need("the number of atoms")
        while line is not None:
            count = file.whole(line, "number of atoms")
            if count == 0:
                file.refuse("no atoms")
            yield _atoms(file, count, file.need("the comment"))
            line = file.next_filled()


def _columns(file: TextFile, comment: str) -> tuple[dict[str, int], int] | None:
    """What extended XYZ says: each property's first column, and the number of columns."""
    found = re.search(r"\bProperties=\"?([^\s\"]+)", comment)
    if found is None:
        return None
    words = found[1].split(":")
    if len(words) % 3 or not all(_SIZE.fullmatch(word) for word in words[2::3]):
        file.refuse(f"Properties is no list of name:type:columns: {quote(found[1])}")
    first: dict[str, int] = {}
    total = 0
    for name, size in zip(words[0::3], words[2::3], strict=True):
        if int(size) != _SIZES.get(name, int(size)):
            file.refuse(f"Properties gives {name} {size} columns, not {_SIZES[name]}")
        first[name] = total
        total += int(size)
    if "species" not in first or "pos" not in first:
        file.refuse(f"Properties lacks species or pos: {quote(found[1])}")
    return first, total


def _atoms(file: TextFile, count: int, comment: str) -> Frame:
    said = _columns(file, comment)
    first = file.number + 1
    rows: list[list[str]] = []
    for atom in range(count):
        words = file.need(f"atom {atom + 1} of {count}").split()
        expected = said[1] if said else len(rows[0]) if rows else max(len(words), 4)
        if len(words) != expected:
            file.refuse(f"atom {atom + 1} of {count}: {len(words)} words, expected {expected}")
        rows.append(words)
    at = said[0] if said else _PLAIN | ({"radius": 4} if len(rows[0]) == 5 else {})
    remarks = ["unit       not in the file, taken as Angstrom"]
    if not said and len(rows[0]) > 5:
        remarks.append(f"columns    after z are not used: {len(rows[0]) - 4} of them")
    columns = list(map(list, zip(*rows, strict=True)))
    x, y, z = columns[at["pos"] : at["pos"] + 3]
    labels = columns[at["species"]]
    return Frame(
        xyz=(x, y, z),
        unit="angstrom",
        labels=labels,
        elements=[symbol(label) for label in labels],
        radii=columns[at["radius"]] if "radius" in at else None,
        lines=range(first, first + count),
        elements_from="the species",
        remarks=remarks,
    )
