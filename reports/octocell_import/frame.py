# SPDX-License-Identifier: MIT
"""What every reader gives: the atoms of one frame, still as the file has them."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from octocell_import import InputError, quote
from octocell_import.decimals import Column, Floats, NotAFloat, to_float32

Kind = tuple[str, str | None]  # the atom's name or type, as in the file, and its element
_OF_POINTS = ("x", "y", "z", "radius", "diameter")
_CHUNK = 50_000  # atoms, whose words take a few megabytes
NO_ALTLOC = (b"", b" ", b".", b"?")
EXPONENTS = {"angstrom": 0, "nm": 1}  # what a unit of length is in Angstrom, as a power of ten


@dataclass
class Frame:
    """Columns hold one entry an atom: x, y, z; and, if the file has them, radius or diameter, kind,
    chain, residue, number (the residue's), altloc, line."""

    columns: dict[str, Column]
    unit: str | None = None  # None: one of the file's own
    kinds: list[Kind] = field(default_factory=list)  # what the column kind numbers
    elements_from: str = ""
    said: list[str] = field(default_factory=list)  # what the reader assumed
    model: str = ""  # its number in the file

    def __len__(self) -> int:
        return len(self.columns["x"])

    def place(self, atom: int) -> str:
        """Returns where in the file: people look for lines, else they count atoms from 1."""
        lines = self.columns.get("line")
        return f"atom {atom + 1}" if lines is None else f"line {lines[atom]}"

    def take(self, atoms: Column | slice) -> "Frame":
        """Returns these atoms alone, in this order."""
        return replace(self, columns={name: c[atoms] for name, c in self.columns.items()})

    def numbers(self, name: str, exponent: int, strict: bool) -> Floats:
        """Returns a column times 10^exponent. What is no number throws InputError, or is NaN."""
        try:
            return to_float32(self.columns[name], exponent, strict)
        except NotAFloat as error:
            raise InputError(f"{self.place(error.index)}: {name}: {error}") from error


def points(columns: dict[str, Column], lines: Column | None = None) -> Frame:
    """Returns points of no unit, whose columns may be in capitals or have CloudCompare's prefix."""
    known: dict[str, Column] = {}
    for name, column in columns.items():
        meant = name.lower().removeprefix("scalar_")
        if meant in known:
            raise InputError(f"two columns are called {meant}, one of them {quote(name)}")
        if meant in _OF_POINTS:
            known[meant] = column
    for name in _OF_POINTS[:3]:
        if name not in known:
            raise InputError(f"the vertices have no number {name}")
    for name, column in known.items():
        if len(column) != len(known["x"]):
            raise InputError(f"{len(known['x'])} points, but {len(column)} times {name}")
    return Frame(known if lines is None else known | {"line": lines})


def kinds_of(element: Callable[..., str | None], *columns: Column) -> tuple[Column, list[Kind]]:
    """Returns every atom's kind, as a number, and the kinds; the first column has the labels."""
    codes, texts = encode(*columns)
    return codes, [(words[0].strip(), element(*words)) for words in texts]


def encode(*columns: Column) -> tuple[Column, list[list[str]]]:
    """Returns a number for each combination of words, and the words of each number."""
    codes: dict[tuple[bytes, ...], int] = {}
    parts: list[Column] = [np.empty(0, np.int32)]
    for start in range(0, len(columns[0]), _CHUNK):
        atoms = list(zip(*(c[start : start + _CHUNK].tolist() for c in columns), strict=True))
        for atom in dict.fromkeys(atoms):
            codes.setdefault(atom, len(codes))
        parts.append(np.fromiter(map(codes.__getitem__, atoms), np.int32))
    texts = [[word.decode("utf-8", "replace") for word in words] for words in codes]
    return np.concatenate(parts), texts


def choose(frame: Frame, choices: dict[str, list[str]]) -> Column | slice:
    """Returns the atoms that have, in each column named, one of its values. Throws InputError."""
    if not choices:
        return slice(None)
    keep = np.ones(len(frame), bool)
    for name, values in choices.items():
        if name not in frame.columns:
            raise InputError(f"--{name}: the file has none")
        words = np.char.strip(frame.columns[name].astype("S"))
        fits = np.isin(words, [value.encode() for value in values])
        fits |= (name == "altloc") & np.isin(words, NO_ALTLOC)
        for value in values if name == "residue" else []:
            ends = re.fullmatch(r"(-?\d{1,6})(?:-(-?\d{1,6}))?", value)
            if ends and "number" in frame.columns:
                number = frame.numbers("number", 0, strict=False)
                fits |= (number >= int(ends[1])) & (number <= int(ends[2] or ends[1]))
        keep &= fits
    if len(frame) and not keep.any():
        asked = " ".join(f"--{name} {','.join(values)}" for name, values in choices.items())
        raise InputError(f"no atom has {asked}")
    return np.flatnonzero(keep)
