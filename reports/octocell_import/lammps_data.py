# SPDX-License-Identifier: MIT
"""LAMMPS data file: header, then sections; of these Atoms, Masses and Atom Type Labels are read.

https://docs.lammps.org/read_data.html
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from octocell_import.elements import symbol, symbol_of_mass
from octocell_import.errors import InputError, quote
from octocell_import.frame import Frame
from octocell_import.lammps import ASSUMED_UNIT, UNITS, Table
from octocell_import.text import TextFile

STYLES = {
    "atomic": "id type x y z",
    "charge": "id type q x y z",
    "bond": "id mol type x y z",
    "angle": "id mol type x y z",
    "molecular": "id mol type x y z",
    "full": "id mol type q x y z",
    "sphere": "id type diameter density x y z",
    "bpm/sphere": "id mol type diameter density x y z",
    "dipole": "id type q x y z mux muy muz",
}
_FLAGS = ["nx", "ny", "nz"]  # image flags, which may follow


@dataclass
class _Content:
    """What was read so far; types are known by their number, or by their label."""

    title: str
    counts: dict[str, int] = field(default_factory=dict)  # of the header
    masses: dict[str, str] = field(default_factory=dict)
    comments: dict[str, str] = field(default_factory=dict)  # the first word after # in Masses
    type_labels: dict[str, str] = field(default_factory=dict)
    atoms: Table | None = None
    remarks: list[str] = field(default_factory=list)

    def element(self, kind: str) -> str | None:
        """By a name that is written out, or else by mass."""
        number = next((n for n, label in self.type_labels.items() if label == kind), kind)
        for name in (self.type_labels.get(number), self.comments.get(number)):
            if name and symbol(name):
                return symbol(name)
        mass = self.masses.get(number, self.masses.get(kind, ""))
        try:
            return symbol_of_mass(float(mass))
        except ValueError:
            return None


def read_lammps_data(path: Path, atom_style: str | None = None) -> Iterator[Frame]:
    with TextFile(path) as file:
        content = _Content(title=file.need("the title"))
        section = ""
        while (line := file.next_filled()) is not None:
            text, _, comment = (part.strip() for part in line.partition("#"))
            if text and text[0].isalpha():
                section = text
                if section == "Atoms":
                    _read_atoms(file, content, atom_style, comment)
            elif text:
                _take(file, section, text, comment, content)
        if content.atoms is None:
            raise InputError(f"{path}: no section Atoms")
        yield _frame(content, content.atoms)


def _take(file: TextFile, section: str, text: str, comment: str, content: _Content) -> None:
    """One line of the header or of a section; most are of no use here."""
    words = text.split()
    if section == "" and " ".join(words[1:]) in ("atoms", "atom types", "bonds"):
        content.counts[" ".join(words[1:])] = file.whole(words[0], "number")
    elif section == "Masses" and len(words) == 2:
        content.masses[words[0]] = words[1]
        content.comments[words[0]] = comment.split()[0] if comment else ""
    elif section == "Atom Type Labels" and len(words) == 2:
        content.type_labels[words[0]] = words[1]
    elif section == "Atoms":
        file.refuse(f"more atoms than the header's {content.counts['atoms']}: {quote(text)}")


def _read_atoms(file: TextFile, content: _Content, given: str | None, said: str) -> None:
    if content.atoms is not None:
        file.refuse("a second section Atoms")
    count = content.counts.get("atoms", 0)
    if count == 0:
        file.refuse("no atoms: the header has no line 'N atoms'")
    line = file.next_filled()
    table: Table | None = None
    for atom in range(count):
        words = (line or "").partition("#")[0].split()
        if line is None or not words:
            file.refuse(f"section Atoms ends after {atom} of {count} atoms")
        if table is None:
            names, how = _columns(file, content, given, said, len(words))
            table = Table(file, names)
            content.remarks = [how]
        if len(words) not in (len(names), len(names) + len(_FLAGS)):
            file.refuse(f"atom {atom + 1} of {count}: {len(words)} words, expected {len(names)}")
        table.add(words, file.number)
        line = file.next() if atom + 1 < count else None
    assert table is not None
    content.remarks.append(table.sort_by_id())
    content.atoms = table


def _columns(
    file: TextFile, content: _Content, given: str | None, said: str, words: int
) -> tuple[list[str], str]:
    """The columns' names, and how they were found: given, said by the file, or from their count."""
    style = given or said
    if " " in style.strip() and {"x", "y", "z", "type"} <= set(style.split()):
        return style.split(), f"columns    {style}, as given"
    if style in STYLES:
        return STYLES[style].split(), f"columns    {STYLES[style]} (atom style {style})"
    known = f"{', '.join(STYLES)}, or the columns' names, such as 'id type x y z radius'"
    # Atoms # some remark: LAMMPS takes that for a style, but people write it.
    if style and (given or len(style.split()) == 1 or style.startswith("hybrid")):
        file.refuse(f"atom style {quote(style)} is not known; give --atom-style: {known}")
    # Without a style only some numbers of columns tell which one it is.
    bonds = content.counts.get("bonds", 0) > 0
    guesses = {5: "atomic", 8: "atomic"} | ({6: "molecular", 7: "full"} if bonds else {})
    guesses |= {9: "molecular", 10: "full"} if bonds else {}
    if words not in guesses:
        file.refuse(f"{words} columns and no atom style in the file; give --atom-style: {known}")
    guess = guesses[words]
    how = f"columns    {STYLES[guess]} (atom style {guess}, taken from their count)"
    return STYLES[guess].split(), how


def _frame(content: _Content, table: Table) -> Frame:
    said = re.search(r"units = (\w+)", content.title)
    labels = table.column("type")
    elements = {kind: content.element(kind) for kind in set(labels)}
    remarks = [*content.remarks, f"units      {said[1]}" if said else ASSUMED_UNIT]
    return Frame(
        xyz=(table.column("x"), table.column("y"), table.column("z")),
        unit=UNITS.get(said[1]) if said else "angstrom",
        labels=labels,
        elements=[elements[kind] for kind in labels],
        radii=table.radii(),
        lines=table.lines,
        elements_from="the types' labels, comments or masses",
        remarks=remarks,
    )
