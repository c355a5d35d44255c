# SPDX-License-Identifier: MIT
"""PDB in its fixed columns; MODEL, ENDMDL and END part frames.

https://www.wwpdb.org/documentation/file-format-content/format33/v3.3.html
"""

from array import array
from collections.abc import Callable, Iterator

import numpy as np

from octocell_import import InputError, quote
from octocell_import.decimals import Column
from octocell_import.elements import element_of_pdb, symbol
from octocell_import.frame import NO_ALTLOC, Frame, encode
from octocell_import.text import File, card, fields

_WIDTH = 80
_FIELDS = {"label": (12, 16), "altloc": (16, 17), "residue": (17, 20), "chain": (21, 22)}
_FIELDS |= {"number": (22, 26), "x": (30, 38), "y": (38, 46), "z": (46, 54), "written": (76, 78)}
_FIELDS |= {"sixth": (11, 12), "point": (35, 36)}  # where six digits of a serial end and move x's
_POINTS = slice(34, 51, 8)  # of x, y and z
_NO_ATOMS = (b"REMARK", b"USER", b"SIGATM", b"ANISOU", b"SIGUIJ")  # may have points there, too


def read(file: File) -> Iterator[Frame]:
    cards, lines, model, found = bytearray(), array("q"), "", False
    for line in file:
        if line.startswith((b"ATOM", b"HETATM")):
            cards += card(file, line, 54, _WIDTH)
            lines.append(file.number)
            continue
        record = line[:6].strip()
        if record in (b"MODEL", b"ENDMDL", b"END"):
            if lines or model:
                frame = _frame(file, cards, lines, model)
                cards, lines, found = bytearray(), array("q"), True
                yield frame
            model = (line[6:].strip().decode("ascii", "replace") or "?") * (record == b"MODEL")
        elif line[_POINTS] == b"..." and record not in _NO_ATOMS:
            file.refuse(f"{quote(record)} is no record of an atom, but has x, y and z")
    if lines or model:
        yield _frame(file, cards, lines, model)
    elif not found:
        raise InputError("no ATOM and no HETATM record")


def _frame(file: File, cards: bytearray, lines: "array[int]", model: str) -> Frame:
    columns = fields(cards, _WIDTH, _FIELDS)
    columns["line"] = np.array(lines)
    late = np.char.isdigit(columns.pop("sixth")) & (columns.pop("point") == b".")
    if late.any():
        why = "a serial number of six digits moved x, y and z one column to the right"
        file.refuse(why, lines[int(late.argmax())])
    return molecule(columns, "columns 77 and 78", element_of_pdb, model)


def molecule(
    columns: dict[str, Column], source: str, by_name: Callable[[str, str], str | None], model: str
) -> Frame:
    """Returns atoms whose element is written, or else that of their names; says if they differ."""
    nothing = np.full(len(columns["x"]), b"")
    words = [columns.get(name, nothing) for name in ("label", "residue", "written")]
    columns["kind"], texts = encode(*words)
    counts = np.bincount(columns["kind"], minlength=len(texts))
    kinds, unsaid, differ = [], 0, 0
    for (name, residue, written), count in zip(texts, counts.tolist(), strict=True):
        guess = by_name(name, residue)
        kinds.append((name.strip(), symbol(written) or guess))
        unsaid += count * (symbol(written) is None)
        differ += count * (guess not in (None, kinds[-1][1]))
    said = [f"elements   of {differ} atoms are others by their names"] * bool(differ)
    alternates = (~np.isin(columns["altloc"], NO_ALTLOC)).sum() if "altloc" in columns else 0
    if alternates:
        said.append(f"alternate  locations are kept: {alternates} atoms have them; see --altloc")
    source += ", and names" * bool(unsaid)
    if unsaid == len(columns["x"]):
        source = "atom and residue names"
    return Frame(columns, "angstrom", kinds, source, said, model)
