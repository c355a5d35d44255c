# SPDX-License-Identifier: MIT
"""The one list of formats: which suffix means which reader."""

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

from octocell_import import InputError
from octocell_import.frame import Frame
from octocell_import.octocell import frames_by_octocell
from octocell_import.text import DAMAGED, PACKED, File, open_bytes

OCTOCELL = "octocell"
# A format's reader is `read` in the module of its name, which is loaded when it is wanted.
FORMATS = {
    OCTOCELL: [".pqr", ".npy", ".csv", ".tsv", ".txt", ".dat", ".xyzr", ".spheres"],
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


def frames(path: Path, name: str, **options: str) -> Iterator[Frame]:
    """Gives frames, read as they are asked for. Throws InputError."""
    if name == OCTOCELL:
        yield from frames_by_octocell(path)
        return
    module, _, part = name.partition("-")
    reader = import_module(f"octocell_import.{module}")
    read = getattr(reader, f"read_{part}" if part else "read")
    try:
        with open_bytes(path) as raw:
            yield from read(File(raw, path.suffix), **options)
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
