# SPDX-License-Identifier: MIT
"""What LAMMPS' two text formats share: named columns of words, in any order of atoms."""

from __future__ import annotations

from itertools import pairwise

from octocell_import.decimals import NotAFloat, to_float32
from octocell_import.frame import Column
from octocell_import.text import TextFile

# Units whose length is known; the others keep their own (https://docs.lammps.org/units.html).
UNITS = {"real": "angstrom", "metal": "angstrom", "nano": "nm"}
ASSUMED_UNIT = "unit       not in the file, taken as Angstrom (units real or metal)"


class Table:
    """Rows of words under named columns."""

    def __init__(self, file: TextFile, names: list[str]) -> None:
        self.file = file
        self.at = {name: k for k, name in enumerate(names)}
        self.rows: list[list[str]] = []
        self.lines: list[int] = []

    def add(self, words: list[str], line: int) -> None:
        self.rows.append(words)
        self.lines.append(line)

    def column(self, name: str) -> list[str]:
        k = self.at[name]
        return [row[k] for row in self.rows]

    def sort_by_id(self) -> str:
        """LAMMPS writes atoms in any order; by id, atom i is the same in every frame."""
        if "id" not in self.at:
            return "order      as in the file: it has no ids"
        k = self.at["id"]
        for row, line in zip(self.rows, self.lines, strict=True):
            self.file.number = line
            self.file.whole(row[k], "atom id")
        order = sorted(range(len(self.rows)), key=lambda i: int(self.rows[i][k]))
        for i, j in pairwise(order):
            if int(self.rows[i][k]) == int(self.rows[j][k]):
                self.file.refuse(f"id {self.rows[j][k]} is line {self.lines[i]}'s", self.lines[j])
        self.rows = [self.rows[i] for i in order]
        self.lines = [self.lines[i] for i in order]
        return "order      by atom id"

    def radii(self) -> Column | None:
        """A diameter is halved after rounding: halving is exact."""
        if "radius" in self.at:
            return self.column("radius")
        if "diameter" not in self.at:
            return None
        try:
            return to_float32(self.column("diameter")) / 2
        except NotAFloat as error:
            self.file.refuse(f"diameter {error}", self.lines[error.index])
