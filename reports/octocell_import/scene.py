# SPDX-License-Identifier: MIT
"""Frames become scenes: spheres in one unit, with what was assumed on the way."""

from argparse import Namespace
from pathlib import Path

import numpy as np

from octocell_import import InputError
from octocell_import.decimals import Column, Floats
from octocell_import.elements import symbol
from octocell_import.frame import EXPONENTS, Frame, choose
from octocell_import.radii import given, radii_of
from octocell_report.fields import naming

CHOICES = ("altloc", "chain", "residue")
_Sizes = tuple[
    int, Column | slice, Floats, list[str]
]  # all atoms, those kept, their radii, what to say


class Converter:
    """Makes spheres of frames, one after the other."""

    def __init__(self, options: Namespace) -> None:
        self._unit, self._strict = options.length_unit, not options.drop_invalid
        self._given = given(options.radius, options.radii)
        self._unmet = set(self._given.by_name) - {""}
        chosen = {name: getattr(options, name) for name in CHOICES}
        self._choices = {name: words.split(",") for name, words in chosen.items() if words}
        self._topology: tuple[Path, _Sizes] | None = None

    def take_names(self, path: Path, frame: Frame) -> None:
        """From now on names and radii are those of this frame."""
        if "kind" not in frame.columns and "radius" not in frame.columns:
            raise InputError(f"{path}: has neither names nor radii")
        self._topology = path, self._sizes(path, frame)

    def spheres(self, path: Path, frame: Frame) -> tuple[Floats, list[str]]:
        """Returns x, y, z, r as [count, 4], and lines about them. Throws InputError."""
        source, sizes = self._topology or (path, self._sizes(path, frame))
        count, kept, radii, said = sizes
        if count != len(frame):
            raise InputError(f"{path}: {len(frame)} atoms, but {source} has {count}")
        frame, scene = frame.take(kept), np.empty((len(radii), 4), np.float32)
        with naming(path):
            for k, name in enumerate("xyz"):
                scene[:, k] = frame.numbers(name, self._exponent(frame.unit), self._strict)
        scene[:, 3] = radii
        about = [self._length(frame.unit), *said, *frame.said]
        if self._topology:
            about.append(f"names      from {source}")
        bad = np.isnan(scene).any(axis=1) | (radii < 0)  # refused by now unless they may be dropped
        if bad.any():
            where = frame.place(int(bad.argmax()))
            about.append(f"dropped    {bad.sum()} spheres that are invalid, the first in {where}")
        return scene[~bad], about

    def check_names(self, path: Path) -> None:
        """Refuses names given that no atom of any frame has: most likely they are misspelt."""
        for name in sorted(self._unmet):
            known = symbol(name)  # elements are written as Ca, names as the file has them
            hint = f"; the element is written {known}" if known and known != name else ""
            raise InputError(f"{path}: --radius {name}=...: no atom is so called{hint}")

    def _sizes(self, path: Path, frame: Frame) -> _Sizes:
        with naming(path):
            kept = choose(frame, self._choices)
            exponent, angstrom = self._exponent(frame.unit), self._exponent("angstrom")
            radii, said, met = radii_of(
                frame.take(kept), self._given, exponent, angstrom, self._strict
            )
        self._unmet -= met
        if self._choices:
            said.append(f"chosen     {len(radii)} of {len(frame)} atoms")
        return len(frame), kept, radii, said

    def _exponent(self, unit: str | None) -> int:
        if unit is None and self._unit is not None:
            raise InputError(f"its unit is not known: it cannot be written in {self._unit}")
        return EXPONENTS[unit or "angstrom"] - EXPONENTS[self._unit or "angstrom"]

    def _length(self, unit: str | None) -> str:
        if unit is None:
            return "length     as in the file, in its own unit"
        times = {0: "", 1: "nm in the file, times 10: ", -1: "Angstrom in the file, times 0.1: "}
        written = "nm" if self._unit == "nm" else "Angstrom"
        return f"length     {times[self._exponent(unit)]}{written}"
