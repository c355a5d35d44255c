# SPDX-License-Identifier: MIT
"""XYZ: count, comment, one atom a line (symbol or atomic number, x, y, z, and what is not read).

Extended XYZ says in its comment what the columns are: Properties=species:S:1:pos:R:3:radius:R:1
https://github.com/libAtoms/extxyz
"""

import re
from collections.abc import Iterator

import gemmi
import numpy as np

from octocell_import import quote
from octocell_import.decimals import Column
from octocell_import.elements import symbol
from octocell_import.frame import Frame, Kind, kinds_of
from octocell_import.text import File, is_whole

_PAIR = re.compile(r"""([\w-]+)\s*=\s*("(?:[^"\\]|\\.)*"|'[^']*'|\{[^}]*\}|\[[^]]*\]|\S+)""")
_PLAIN = {"label": "0", "x": "1", "y": "2", "z": "3", "fifth": "4"}
_SAID = {"label": "species 0", "x": "pos 0", "y": "pos 1", "z": "pos 2", "radius": "radius 0"}
_MOST_COLUMNS = 10_000


def read(file: File) -> Iterator[Frame]:
    line = file.line("the number of atoms")
    while line:
        count = file.count(line, "number of atoms")
        comment = file.line("the comment").decode("utf-8", "replace")
        yield _frame(file, count, comment)
        line = b"" if comment.startswith("gdb ") else file.filled()  # QM9 adds three lines


def _frame(file: File, count: int, comment: str) -> Frame:
    names, said = _names(file, comment), ["unit       not in the file, taken as Angstrom"]
    at = _SAID if names else _PLAIN
    if "species 0" not in names and "z 0" in names:
        at = _SAID | {"label": "z 0"}
    words, lines = file.words(count, names, least=4)
    more = len(words) - len(_PLAIN) + 1
    if not names and more > 0:
        hint = " (--radii file takes it as radius)" if more == 1 else ""
        said.append(f"columns    after z are not used: {more} of them{hint}")
    if more != 1:
        at = {name: word for name, word in at.items() if name != "fifth"}
    columns = {name: words[word] for name, word in at.items() if word in words}
    columns |= {name: _decimal(c) for name, c in columns.items() if name != "label"}
    has_types = comment.startswith("Atoms. Timestep")  # LAMMPS writes no elements by default
    source = "the species" if not has_types else "nothing: LAMMPS wrote types"
    kinds: list[Kind] = []
    if "label" in columns:
        element = symbol if has_types else _element
        columns["kind"], kinds = kinds_of(element, columns.pop("label"))
    return Frame(columns | {"line": lines}, "angstrom", kinds, source, said)


def _names(file: File, comment: str) -> list[str]:
    """What extended XYZ says: a name for each column, such as "pos 0"."""
    said = next((value for key, value in _PAIR.findall(comment) if key.lower() == "properties"), "")
    words = said.strip("\"'").lower().split(":")
    if words == [""]:
        return []
    sizes = [int(word) if is_whole(word.encode()) else _MOST_COLUMNS for word in words[2::3]]
    if len(words) % 3 or sum(sizes) >= _MOST_COLUMNS:
        file.refuse(f"Properties is no list of name:type:columns: {quote(said)}")
    pairs = zip(words[::3], sizes, strict=True)
    names = [f"{name} {k}" for name, size in pairs for k in range(size)]
    if "pos 2" not in names or {"pos 3", "radius 1", "species 1"} & set(names):
        file.refuse(f"Properties wants pos:R:3, and one column for others: {quote(said)}")
    return names


def _decimal(words: Column) -> Column:
    """Exponents as Fortran and Mathematica write them become e."""
    if words.dtype.kind == "S" and np.isin(words.view(np.uint8), list(b"Dd^")).any():
        for old in (b"*^", b"D", b"d"):
            words = np.char.replace(words, old, b"e")
    return words


def _element(word: str) -> str | None:
    is_number = is_whole(word.encode()) and 0 < int(word) < 119
    return gemmi.Element(int(word)).name if is_number else symbol(word)
