# SPDX-License-Identifier: MIT
"""Frames become scenes: spheres in one unit, with what was assumed on the way."""

from argparse import Namespace
from pathlib import Path

import numpy as np

from octocell_import import InputError
from octocell_import.decimals import Floats
from octocell_import.elements import symbol
from octocell_import.frame import EXPONENTS, Frame, choose
from octocell_import.radii import given, radii_of
from octocell_report.fields import naming

CHOICES = ("altloc", "chain", "residue")


class Converter:
    """Makes spheres of frames, one after the other."""

    def __init__(self, options: Namespace) -> None:
        self._unit, self._strict = options.length_unit, not options.drop_invalid
        self._by_name, self._source = given(options.radius), options.radii
        self._unmet = set(self._by_name) - {""}
        chosen = {name: getattr(options, name) for name in CHOICES}
        self._choices = {name: words.split(",") for name, words in chosen.items() if words}
        self._topology: tuple[Path, Frame, Floats, list[str]] | None = None

    def take_names(self, path: Path, frame: Frame) -> None:
        """From now on names and radii are those of this frame."""
        if not frame.kinds and "radius" not in frame.columns:
            raise InputError(f"{path}: has neither names nor radii")
        self._topology = (path, frame, *self._sized(path, frame))

    def spheres(self, path: Path, frame: Frame) -> tuple[Floats, list[str]]:
        """Returns x, y, z, r as [count, 4], and lines about them. Throws InputError."""
        source, names, radii, said = self._topology or (path, frame, *self._sized(path, frame))
        if len(names) != len(frame):
            raise InputError(f"{path}: {len(frame)} atoms, but {source} has {len(names)}")
        frame = frame.take(choose(names, self._choices))
        scene = np.empty((len(radii), 4), np.float32)
        scene[:, 3] = radii
        with naming(path):
            for k, name in enumerate("xyz"):
                scene[:, k] = frame.numbers(name, self._exponent(frame.unit), self._strict)
        about = [self._length(frame.unit), *said, *frame.said]
        about += [f"names      from {source}"] * (source != path)
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

    def _sized(self, path: Path, frame: Frame) -> tuple[Floats, list[str]]:
        """The radii of the atoms that are chosen."""
        self._unmet -= {str(name) for kind in frame.kinds for name in kind}
        with naming(path):
            atoms = frame.take(choose(frame, self._choices))
            exponents = self._exponent(frame.unit), self._exponent("angstrom")
            radii, said = radii_of(atoms, self._by_name, self._source, exponents, self._strict)
        chosen = f"chosen     {len(radii)} of {len(frame)} atoms"
        return radii, said + [chosen] * bool(self._choices)

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
