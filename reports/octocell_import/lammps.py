# SPDX-License-Identifier: MIT
"""LAMMPS' two text formats: data files, in sections, and dumps, frame by frame in ITEMs.

https://docs.lammps.org/read_data.html, https://docs.lammps.org/dump.html
"""

import re
from collections.abc import Iterator

import numpy as np

from octocell_import import InputError, quote
from octocell_import.decimals import Column, NotAFloat, to_float32, to_float64
from octocell_import.elements import symbol, symbol_of_mass
from octocell_import.frame import Frame, kinds_of
from octocell_import.text import File, as_column, is_whole, whole_numbers

Columns = dict[str, Column]
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
    "electron": "id type q spin eradius x y z",
}
# Styles that may be guessed, with bonds and without; those of other columns only forbid a guess.
_GUESSES = {True: {STYLES["molecular"], STYLES["full"]}, False: {STYLES["atomic"]}}
_WHOLE = {"id", "mol", "spin", "nx", "ny", "nz"}
_ADVICE = f"give --atom-style: {', '.join(STYLES)}, or the columns' names: 'id type x y z radius'"
_INTEGER = re.compile(rb"[-+]?\d+")
_KNOWN = ("x", "y", "z", "radius", "diameter", "type", "element", "line")
_SECTION = re.compile(r"[A-Za-z][A-Za-z/_ ]*")
_ITEMS = {"TIMESTEP": 1, "TIME": 1, "UNITS": 1, "NUMBER OF ATOMS": 1, "BOX BOUNDS": 3}  # lines
_PLACES = (["x", "y", "z"], ["xu", "yu", "zu"], ["xs", "ys", "zs"], ["xsu", "ysu", "zsu"])
# Units whose length is known; the others keep their own (https://docs.lammps.org/units.html).
_UNITS = {"": "angstrom", "real": "angstrom", "metal": "angstrom", "nano": "nm"}


def read_data(file: File, atom_style: str = "") -> Iterator[Frame]:
    title = file.line("the title").decode("utf-8", "replace")
    counts: dict[str, int] = {}  # of the header
    types: dict[str, dict[str, str]] = {"Masses": {}, "Atom Type Labels": {}, "comment": {}}
    section, how = "", ""
    atoms: Columns = {name: np.empty(0, "S1") for name in ("x", "y", "z", "type")}
    for line in file:
        text, _, comment = (part.strip() for part in line.decode("utf-8", "replace").partition("#"))
        words = text.split()
        if _SECTION.fullmatch(text):
            section = text
            if section == "Atoms":
                if how or "atoms" not in counts:
                    file.refuse("a second section Atoms" if how else "no line 'N atoms' before it")
                file.line()  # LAMMPS passes over it, whatever it holds
                labels = {label.encode() for label in types["Atom Type Labels"].values()}
                atoms, how = _atoms(file, counts, labels, atom_style, comment)
        elif not section and " ".join(words[1:]) in ("atoms", "atom types", "bonds"):
            counts[" ".join(words[1:])] = file.count(words[0].encode(), "number")
        elif section in types and len(words) == 2:
            types[section][words[0]] = words[1]
            types["comment"][words[0]] = comment * (section == "Masses")
        elif section == "Atoms" and words:
            file.refuse(f"more atoms than the header's {counts['atoms']}: {quote(text)}")
    if not how and counts.get("atoms") != 0:
        raise InputError("no section Atoms")

    def element(kind: str) -> str | None:
        """By a name that is written out, or else by mass."""
        labels = types["Atom Type Labels"]
        number = next((number for number, label in labels.items() if label == kind), kind)
        for name in (labels.get(number, ""), *types["comment"].get(number, "").split()[:1]):
            if symbol(name):
                return symbol(name)
        mass = types["Masses"].get(number) or types["Masses"].get(kind, "")
        return symbol_of_mass(float(to_float32([mass], strict=False)[0]))

    unit = re.search(r"units = (\w+)", title)
    frame = _frame(file, atoms, unit[1] if unit else "", how)
    frame.columns["kind"], frame.kinds = kinds_of(element, frame.columns.pop("type"))
    frame.elements_from = "the types' labels, comments or masses"
    yield frame


def _atoms(
    file: File, counts: dict[str, int], labels: set[bytes], given: str, said: str
) -> tuple[Columns, str]:
    """The section's columns by name, and how the names were found."""
    first, style = file.number + 1, given or said.rpartition(": ")[2]  # Atoms # full: id mol ...
    names, how = STYLES.get(style, "").split(), f"atom style {style}"
    if " " in style and {"x", "y", "z", "type"} <= set(style.split()):
        names, how = style.split(), "as given"
    elif not names and (given or len(style.split()) == 1 or style.startswith("hybrid")):
        file.refuse(f"atom style {quote(style)} is not known; {_ADVICE}", first - 2)
    more = 3 * bool(names)  # image flags
    columns, lines = file.words(counts["atoms"], names, least=5, more=more, comment=b"#")
    if not names:  # Atoms # some remark: LAMMPS takes that for a style, but people write it
        words, has_bonds = list(columns.values()), bool(counts.get("bonds"))
        styles = {s for s in STYLES.values() if "mol" in s or not has_bonds}
        types = counts.get("atom types", 0)
        fitting = {s for s in styles if _fits(s.split(), words, types, labels)}
        if len(fitting) != 1 or not fitting <= _GUESSES[has_bonds]:
            file.refuse(f"{len(words)} columns and no atom style in the file; {_ADVICE}", first)
        names = fitting.pop().split()
        columns = dict(zip(names, words, strict=False))
        how = "no other style that is known here fits"
    return columns | {"line": lines}, f"columns    {' '.join(names)} ({how})"


def _fits(names: list[str], words: list[Column], types: int, labels: set[bytes]) -> bool:
    """Tells whether columns can be of a style, perhaps with three image flags behind."""
    if len(words) not in (len(names), len(names) + 3):
        return False
    columns = dict(zip([*names, "nx", "ny", "nz"], words, strict=False))
    kinds = set(columns["type"].tolist())
    known = {word for word in kinds if is_whole(word) and 1 <= int(word) <= types} | labels
    whole = (word for name in columns.keys() & _WHOLE for word in columns[name].tolist())
    return kinds <= known and all(map(_INTEGER.fullmatch, whole))


def read_dump(file: File) -> Iterator[Frame]:
    said: dict[str, list[bytes]] = {}  # of each ITEM the lines that follow
    found = False
    while line := file.filled():
        if not line.startswith(b"ITEM: "):
            file.refuse(f"'ITEM: ' expected: {quote(line)}")
        item = line[6:].decode("utf-8", "replace").strip()
        name = next((name for name in sorted(_ITEMS, reverse=True) if item.startswith(name)), "")
        if item.split()[:1] == ["ATOMS"]:
            yield _dumped(file, said, item.split()[1:])
            said = {"UNITS": said["UNITS"]} if "UNITS" in said else {}  # stands once in a file
            found = True
        elif name:
            need = f"the lines of ITEM: {name}"
            said[name] = [file.line(need).strip() for _ in range(_ITEMS[name])]
            if name == "NUMBER OF ATOMS":
                file.count(said[name][0], "number of atoms")
        else:
            file.refuse(f"an ITEM that is not known: {quote(line)}")
    if not found or set(said) - {"UNITS"}:
        raise InputError(f"ends after line {file.number}, before ITEM: ATOMS")


def _dumped(file: File, said: dict[str, list[bytes]], names: list[str]) -> Frame:
    title, xyz = file.number, next((place for place in _PLACES if set(place) <= set(names)), None)
    if xyz is None:
        file.refuse("ITEM: ATOMS has neither x y z nor xu yu zu nor xs ys zs")
    if "NUMBER OF ATOMS" not in said:
        file.refuse("ITEM: ATOMS without an ITEM: NUMBER OF ATOMS before it")
    own = [name if names.index(name) == k else f"{name} {k}" for k, name in enumerate(names)]
    columns, lines = file.words(int(said["NUMBER OF ATOMS"][0]), own)
    for name, used in zip(names, own, strict=True):  # LIGGGHTS writes the type twice
        if (columns[name] != columns[used]).any():
            file.refuse(f"two columns are called {quote(name)}, and differ", title)
    about = f"columns    {' '.join(xyz)}"
    places = [columns[name] for name in xyz]
    if "s" in xyz[0]:
        places = _unscaled(file, said.get("BOX BOUNDS"), places, lines, title)
        about += ", scaled to the box in float64"
    columns |= dict(zip("xyz", places, strict=True)) | {"line": lines}
    unit = said.get("UNITS", [b""])[0].decode("ascii", "replace")
    frame = _frame(file, columns, unit, about)
    for name, element in (("type", lambda kind: None), ("element", symbol)):  # the last one counts
        if name in frame.columns:
            frame.columns["kind"], frame.kinds = kinds_of(element, frame.columns.pop(name))
            frame.elements_from = f"the column {name}"
    return frame


def _unscaled(
    file: File, box: list[bytes] | None, words: list[Column], lines: Column, title: int
) -> list[Column]:
    """Coordinates that were scaled to the box, whose edges may be tilted."""
    if box is None:
        file.refuse("scaled coordinates without ITEM: BOX BOUNDS", title)
    try:
        scaled = [to_float64(column) for column in words]
    except NotAFloat as error:
        file.refuse(str(error), lines[error.index])
    try:
        rows = np.array([to_float64(as_column(line.split())) for line in box])
    except (InputError, ValueError):  # the lines may also differ in length
        rows = np.empty(0)
    if rows.shape not in ((3, 2), (3, 3), (3, 4)):
        file.refuse(f"box bounds are not numbers: {quote(b' / '.join(box))}", title)
    if rows.shape == (3, 4):  # the edges, one a line, each with a coordinate of the origin
        edges, origin = rows[:, :3], rows[:, 3]
    else:  # the bounds enclose the tilts, too
        xy, xz, yz = rows[:, 2] if rows.shape == (3, 3) else (0.0, 0.0, 0.0)
        tilts = ((0.0, xy, xz, xy + xz), (0.0, yz), (0.0,))
        ends = rows[:, :2] - [(min(tilt), max(tilt)) for tilt in tilts]
        edges = np.diag(ends[:, 1] - ends[:, 0])
        edges[[1, 2, 2], [0, 0, 1]] = xy, xz, yz
        origin = ends[:, 0]
    with np.errstate(all="ignore"):  # what is not finite is refused with its line
        moved = [sum(scaled[i] * edges[i, k] for i in range(3)) for k in range(3)]
        return [origin[k] + moved[k] for k in range(3)]


def _frame(file: File, columns: Columns, unit: str, about: str) -> Frame:
    """The atoms by id: LAMMPS writes them in any order, but atom i should be one in all frames."""
    order = "place in the file: it has no ids"
    if "id" in columns:
        ids, lines, order = whole_numbers(columns["id"]), columns["line"], "atom id"
        if (ids < 0).any():
            first = int((ids < 0).argmax())
            file.refuse(f"{quote(columns['id'][first])} is no atom id", lines[first])
        sort = np.argsort(ids, kind="stable")
        twice = np.flatnonzero(np.diff(ids[sort]) == 0)
        if len(twice):
            first, second = sort[twice[0]], sort[twice[0] + 1]
            file.refuse(f"id {ids[first]} is line {lines[first]}'s", lines[second])
        columns = {name: column[sort] for name, column in columns.items()}
    units = f"units      {unit}" if unit else "unit       not in the file, taken as Angstrom"
    known = {name: column for name, column in columns.items() if name in _KNOWN}
    return Frame(known, _UNITS.get(unit), said=[f"order      by {order}", about, units])
