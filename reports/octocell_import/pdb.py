# SPDX-License-Identifier: MIT
"""PDB in its fixed columns, and PQR in words between blanks; a frame ends at ENDMDL or END.

https://www.wwpdb.org/documentation/file-format-content/format33/v3.3.html
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from octocell_import.decimals import NotAFloat, to_float32
from octocell_import.elements import element_of, element_of_pdb, symbol
from octocell_import.errors import InputError, quote
from octocell_import.frame import Frame
from octocell_import.text import TextFile

_PQR_WORDS = (10, 11)  # without and with a chain; the last five are x y z charge radius


@dataclass
class _Atoms:
    """The atoms of a frame as they come."""

    columns: tuple[list[str], ...] = field(default_factory=lambda: ([], [], []))
    labels: list[str] = field(default_factory=list)
    elements: list[str | None] = field(default_factory=list)
    radii: list[str] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)
    guessed: int = 0  # elements that come from names
    alternates: int = 0

    def frame(self) -> Frame:
        source = "columns 77 and 78"
        if self.guessed:
            all_guessed = self.guessed == len(self.labels)
            source = "atom and residue names" if all_guessed else f"{source}, and names"
        remarks = []
        if self.alternates:
            remarks.append(f"alternate  locations are kept: {self.alternates} atoms have them")
        x, y, z = self.columns
        radii = self.radii or None
        return Frame(
            xyz=(x, y, z),
            unit="angstrom",
            labels=self.labels,
            elements=self.elements,
            radii=radii,
            lines=self.lines,
            elements_from=source,
            remarks=remarks,
        )


def read_pdb(path: Path) -> Iterator[Frame]:
    with TextFile(path) as file:
        yield from _frames(file, pqr=False)


def read_pqr(path: Path) -> Iterator[Frame]:
    with TextFile(path) as file:
        yield from _frames(file, pqr=True)


def _frames(file: TextFile, pqr: bool) -> Iterator[Frame]:
    add = _add_pqr if pqr else _add_pdb
    atoms = _Atoms()
    found = False
    while (line := file.next()) is not None:
        if line.startswith(("ATOM", "HETATM")):
            add(file, line, atoms)
        elif line.startswith("END") and atoms.lines:
            yield atoms.frame()
            atoms, found = _Atoms(), True
    if atoms.lines:
        yield atoms.frame()
    elif not found:
        raise InputError(f"{file.path}: no ATOM and no HETATM record")


def _add_pdb(file: TextFile, line: str, atoms: _Atoms) -> None:
    if len(line.rstrip()) < 54:
        file.refuse(f"too short for x, y and z in columns 31 to 54: {quote(line)}")
    for k, column in enumerate(atoms.columns):
        column.append(line[30 + 8 * k : 38 + 8 * k])
    name, written = line[12:16], line[76:78].strip()
    atoms.labels.append(name.strip())
    atoms.elements.append(symbol(written) if written else element_of_pdb(name, line[17:20].strip()))
    atoms.guessed += not written
    atoms.alternates += line[16] != " "
    atoms.lines.append(file.number)


def _add_pqr(file: TextFile, line: str, atoms: _Atoms) -> None:
    words = line.split()
    if len(words) not in _PQR_WORDS:
        file.refuse(f"{len(words)} fields, expected 10 or, with a chain, 11: {quote(line)}")
    x, y, z, charge, radius = words[-5:]
    for column, word in zip(atoms.columns, (x, y, z), strict=True):
        column.append(word)
    try:
        to_float32([charge])  # not used, but a wrong one means that the fields are others
    except NotAFloat as error:
        file.refuse(f"charge {error}")
    atoms.labels.append(words[2])
    atoms.elements.append(element_of(words[2], words[3]))
    atoms.radii.append(radius)
    atoms.guessed += 1
    atoms.lines.append(file.number)
