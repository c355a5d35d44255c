# SPDX-License-Identifier: MIT
"""The one list of formats: which suffix means which reader."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

from octocell_import.errors import InputError
from octocell_import.frame import Frame
from octocell_import.gro import read_gro
from octocell_import.lammps_data import read_lammps_data
from octocell_import.lammps_dump import read_lammps_dump
from octocell_import.pdb import read_pdb, read_pqr
from octocell_import.text import COMPRESSED
from octocell_import.trr import read_trr
from octocell_import.xyz import read_xyz

Reader = Callable[[Path], Iterator[Frame]]


def _read_ply(path: Path) -> Iterator[Frame]:
    from octocell_import.ply import read_ply  # only PLY needs the library

    return read_ply(path)


class Format(NamedTuple):
    suffixes: tuple[str, ...]
    read: Reader


FORMATS = {
    "gro": Format((".gro",), read_gro),
    "pdb": Format((".pdb", ".ent"), read_pdb),
    "pqr": Format((".pqr",), read_pqr),
    "xyz": Format((".xyz", ".extxyz"), read_xyz),
    "lammps-data": Format((".data", ".lmp", ".lammps"), read_lammps_data),
    "lammps-dump": Format((".dump", ".lammpstrj"), read_lammps_dump),
    "ply": Format((".ply",), _read_ply),
    "trr": Format((".trr",), read_trr),
}
_ELSEWHERE = {
    ".xtc": "'gmx trjconv -f IN.xtc -o OUT.trr' makes a .trr of it",
    ".dcd": "write it as .xyz or .pdb with the program that made it",
    ".npy": "octocell reads it as it is",
    ".csv": "octocell reads it as it is",
}


def frames(path: Path, name: str | None, atom_style: str | None) -> tuple[str, Iterator[Frame]]:
    """The format's name and its frames, read as they are asked for. Throws InputError."""
    chosen = name or _by_suffix(path)
    read = FORMATS[chosen].read
    if chosen == "lammps-data":
        read = partial(read_lammps_data, atom_style=atom_style)
    elif atom_style is not None:
        raise InputError(f"{path}: --atom-style is for LAMMPS data files, this is {chosen}")
    return chosen, read(path)


def stem(path: Path) -> str:
    """The name without .gz or the like, and without the format's suffix."""
    return _uncompressed(path).stem


def _uncompressed(path: Path) -> Path:
    return path.with_suffix("") if path.suffix.lower() in COMPRESSED else path


def _by_suffix(path: Path) -> str:
    suffix = _uncompressed(path).suffix.lower()
    for name, known in FORMATS.items():
        if suffix in known.suffixes:
            return name
    hint = _ELSEWHERE.get(suffix, f"give --format: {', '.join(FORMATS)}")
    raise InputError(f"{path}: no format is known by the suffix '{suffix}'; {hint}")
