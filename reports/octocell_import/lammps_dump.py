# SPDX-License-Identifier: MIT
"""LAMMPS text dump: ITEM sections, the last of a frame being ITEM: ATOMS with named columns.

https://docs.lammps.org/dump.html
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from octocell_import.decimals import NotAFloat, to_float64
from octocell_import.elements import symbol
from octocell_import.errors import InputError, quote
from octocell_import.frame import Column, Frame
from octocell_import.lammps import ASSUMED_UNIT, UNITS, Table
from octocell_import.text import TextFile

_LINES = {"TIMESTEP": 1, "TIME": 1, "UNITS": 1, "NUMBER OF ATOMS": 1, "BOX BOUNDS": 3}


@dataclass
class _Header:
    """What precedes the atoms: each section's lines."""

    lines: dict[str, list[str]] = field(default_factory=dict)
    box_titles: str = ""


def read_lammps_dump(path: Path) -> Iterator[Frame]:
    with TextFile(path) as file:
        units: str | None = None  # written once, before the first frame
        found = False
        while (header := _header(file)) is not None:
            said, columns = header
            if "NUMBER OF ATOMS" not in said.lines:
                file.refuse("ITEM: ATOMS without an ITEM: NUMBER OF ATOMS before it")
            units = said.lines.get("UNITS", [units])[0]
            yield _atoms(file, said, columns, units)
            found = True
        if not found:
            raise InputError(f"{file.path}: no ITEM: ATOMS")


def _header(file: TextFile) -> tuple[_Header, list[str]] | None:
    """The sections up to ITEM: ATOMS, and its columns' names; None at the end of the file."""
    header = _Header()
    while (line := file.next_filled()) is not None:
        if not line.startswith("ITEM: "):
            file.refuse(f"'ITEM: ' expected: {quote(line)}")
        item = line.removeprefix("ITEM: ").strip()
        if item.startswith("ATOMS"):
            return header, item.split()[1:]
        name = next((name for name in sorted(_LINES, reverse=True) if item.startswith(name)), None)
        if name is None:
            file.refuse(f"an ITEM that is not known: {quote(line)}")
        if name == "BOX BOUNDS":
            header.box_titles = item.removeprefix(name)
        header.lines[name] = [file.need(f"the lines of ITEM: {name}") for _ in range(_LINES[name])]
        if name == "NUMBER OF ATOMS":
            file.whole(header.lines[name][0], "number of atoms")
    if header.lines:
        raise InputError(f"{file.path}: ends after line {file.number}, before ITEM: ATOMS")
    return None


def _atoms(file: TextFile, header: _Header, columns: list[str], units: str | None) -> Frame:
    table = Table(file, columns)
    titles = file.number
    count = int(header.lines["NUMBER OF ATOMS"][0])
    if count == 0:
        file.refuse("no atoms")
    for atom in range(count):
        words = file.need(f"atom {atom + 1} of {count}").split()
        if len(words) != len(columns):
            file.refuse(f"atom {atom + 1} of {count}: {len(words)} words, expected {len(columns)}")
        table.add(words, file.number)
    order = table.sort_by_id()
    xyz, how = _coordinates(table, header, titles)
    remarks = [order, how, ASSUMED_UNIT if units is None else f"units      {units.strip()}"]
    kinds = next((name for name in ("element", "type") if name in table.at), None)
    labels = table.column(kinds) if kinds else []
    return Frame(
        xyz=xyz,
        unit="angstrom" if units is None else UNITS.get(units.strip()),
        labels=labels,
        elements=[symbol(label) if kinds == "element" else None for label in labels],
        radii=table.radii(),
        lines=table.lines,
        elements_from="the column element",
        remarks=remarks,
    )


def _coordinates(
    table: Table, header: _Header, titles: int
) -> tuple[tuple[Column, Column, Column], str]:
    for names in (("x", "y", "z"), ("xu", "yu", "zu")):
        if all(name in table.at for name in names):
            x, y, z = (table.column(name) for name in names)
            return (x, y, z), f"columns    {' '.join(names)}"
    for names in (("xs", "ys", "zs"), ("xsu", "ysu", "zsu")):
        if all(name in table.at for name in names):
            return _from_scaled(table, header, names, titles), (
                f"columns    {' '.join(names)}, scaled to the box in float64"
            )
    table.file.refuse("ITEM: ATOMS has neither x y z nor xu yu zu nor xs ys zs", titles)


def _from_scaled(
    table: Table, header: _Header, names: tuple[str, str, str], titles: int
) -> tuple[Column, Column, Column]:
    bounds = [line.split() for line in header.lines.get("BOX BOUNDS", [])]
    if "xy" in header.box_titles or "abc" in header.box_titles:
        table.file.refuse("scaled coordinates in a tilted box: dump x y z instead", titles)
    found = []
    for name, bound in zip(names, bounds, strict=False):
        try:
            low, high = (float(word) for word in bound)
        except ValueError:
            table.file.refuse(f"box bounds are not two numbers: {quote(' '.join(bound))}", titles)
        try:
            scaled = to_float64(table.column(name))
        except NotAFloat as error:
            table.file.refuse(f"{name} {error}", table.lines[error.index])
        with np.errstate(all="ignore"):  # what is not finite is refused with its line
            found.append(np.asarray(low + scaled * (high - low)))
    if len(found) != 3:
        table.file.refuse("scaled coordinates without ITEM: BOX BOUNDS", titles)
    return found[0], found[1], found[2]
