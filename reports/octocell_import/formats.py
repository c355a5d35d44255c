# SPDX-License-Identifier: MIT
"""The one list of formats: which suffix means which reader."""

from argparse import Namespace
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

from octocell_import import InputError
from octocell_import.frame import Frame
from octocell_import.octocell import frames_by_octocell
from octocell_import.text import DAMAGED, PACKED, File

# octocell reads these itself, and so for this program, too: each format has one reader.
OCTOCELL = {
    "npy": [".npy"],
    "table": [".csv", ".tsv", ".txt", ".dat", ".xyzr", ".spheres"],
    "pqr": [".pqr"],
}
# A format's reader is `read` in the module of its name, which is loaded when it is wanted.
FORMATS = OCTOCELL | {
    "gro": [".gro"],
    "lammps-data": [".data", ".lmp", ".lammps"],
    "lammps-dump": [".dump", ".lammpstrj"],
    "mmcif": [".cif", ".mmcif"],
    "pdb": [".pdb", ".ent", ".pdbqt"],
    "ply": [".ply"],
    "swc": [".swc"],
    "trr": [".trr"],
    "vtk": [".vtk"],
    "xyz": [".xyz", ".extxyz"],
}
_ELSEWHERE = {
    ".xtc": "'gmx trjconv -f IN.xtc -o OUT.trr' makes a .trr of it",
    ".dcd": "write it as .xyz or .pdb with the program that made it",
}


def frames(path: Path, options: Namespace) -> Iterator[Frame]:
    """Gives frames, read as they are asked for. Throws InputError."""
    name = options.format or format_of(path)
    style = {} if options.atom_style is None else {"atom_style": options.atom_style}
    if style and name != "lammps-data":
        raise InputError(f"{path}: --atom-style is for LAMMPS data files, this is {name}")
    if name in OCTOCELL:
        yield from frames_by_octocell(path, name, options)
        return
    module, _, part = name.partition("-")
    reader = import_module(f"octocell_import.{module}")
    read = getattr(reader, f"read_{part}" if part else "read")
    is_stdin = str(path) == "-"
    try:
        with open(0 if is_stdin else path, "rb", closefd=not is_stdin) as raw:
            yield from read(File(raw, path.suffix), **style)
    except DAMAGED as error:
        why = getattr(error, "strerror", None) or error
        raise InputError(f"{path}: cannot be read: {why}") from error
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def unpacked(path: Path) -> Path:
    return path.with_suffix("") if path.suffix.lower() in PACKED else path


def format_of(path: Path) -> str:
    """Throws InputError."""
    suffix = unpacked(path).suffix.lower()
    for name, suffixes in FORMATS.items():
        if suffix in suffixes:
            return name
    hint = _ELSEWHERE.get(suffix, f"give --format: {', '.join(FORMATS)}")
    raise InputError(f"{path}: no format is known by the suffix '{suffix}'; {hint}")
