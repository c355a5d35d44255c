# SPDX-License-Identifier: MIT
"""A frame as spheres in one unit, with what was assumed on the way."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from octocell_import import radii
from octocell_import.decimals import Floats, NotAFloat, to_float32
from octocell_import.errors import InputError
from octocell_import.frame import Frame

POWERS = {"angstrom": -10, "nm": -9}  # of ten, in metres
_SHOWN = {"angstrom": "Angstrom", "nm": "nm"}


@dataclass(frozen=True)
class Source:
    """A frame and the file it is of, for messages."""

    path: Path
    frame: Frame


@dataclass(frozen=True)
class Options:
    unit: str | None  # of what is written; None: Angstrom, or the file's own if that is unknown
    radii: radii.Given


def spheres(moving: Source, names: Source | None, options: Options) -> tuple[Floats, list[str]]:
    """x, y, z, r as [count, 4], and lines about them.

    `names` gives radii and elements instead, if there is one. Throws InputError.
    """
    frame = moving.frame
    exponent = _exponent(moving, options.unit)
    scene = np.empty((frame.count, 4), np.float32)
    for k, name in enumerate("xyz"):
        try:
            scene[:, k] = to_float32(frame.xyz[k], exponent)
        except NotAFloat as error:
            place = frame.place(error.index)
            raise InputError(f"{moving.path}: {place}: {name}: {error}") from error
    scene[:, 3], said = _radii(moving, names, options)
    about = [_length(frame.unit, options.unit), *said, *frame.remarks]
    if names is not None:
        about.append(f"names      from {names.path}")
        about += names.frame.remarks
    return scene, about


def _radii(moving: Source, names: Source | None, options: Options) -> tuple[Floats, list[str]]:
    source = names or moving
    if source.frame.count != moving.frame.count:
        raise InputError(
            f"{moving.path}: {moving.frame.count} atoms, but {source.path} has {source.frame.count}"
        )
    unused = radii.unused_names(source.frame, options.radii)
    if unused:
        hint = radii.spelling(unused[0])
        raise InputError(f"{source.path}: --radius {unused[0]}=...: no atom is so called{hint}")
    angstrom = POWERS["angstrom"] - POWERS[options.unit or "angstrom"]
    try:
        return radii.choose(source.frame, options.radii, _exponent(source, options.unit), angstrom)
    except InputError as error:
        raise InputError(f"{source.path}: {error}") from error


def _exponent(source: Source, written: str | None) -> int:
    unit = source.frame.unit
    if unit is not None:
        return POWERS[unit] - POWERS[written or "angstrom"]
    if written is not None:
        raise InputError(f"{source.path}: its unit is not known: it cannot be written in {written}")
    return 0


def _length(unit: str | None, written: str | None) -> str:
    if unit is None:
        return "length     as in the file, in its own unit"
    target = written or "angstrom"
    if unit == target:
        return f"length     {_SHOWN[unit]}"
    factor = "10" if POWERS[unit] > POWERS[target] else "0.1"
    return f"length     {_SHOWN[unit]} in the file, times {factor}: {_SHOWN[target]}"
