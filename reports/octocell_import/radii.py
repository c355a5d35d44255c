# SPDX-License-Identifier: MIT
"""Which radius each atom gets: given by name, or from the file, or by element, or one for all."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from octocell_import import InputError, quote
from octocell_import.decimals import Column, Floats, to_float32
from octocell_import.elements import RADII
from octocell_import.frame import Frame, Kind

_MOST_NAMES = 12  # in what is printed


@dataclass(frozen=True)
class Given:
    """What --radius and --radii said; lengths in the unit that is written."""

    by_name: dict[str, str]  # element, or the file's own name; "" is all others
    source: str | None = None  # "file", "element" or None: the best there is


def given(options: Sequence[str], source: str | None) -> Given:
    """Each option is R, or NAME=R. Throws InputError."""
    by_name: dict[str, str] = {}
    for option in options:
        name, equals, word = (part.strip() for part in option.rpartition("="))
        try:
            if bool(equals) != bool(name) or name in by_name:
                raise InputError("R or NAME=R, each name once")
            if to_float32([word])[0] < 0:
                raise InputError("is negative")
        except InputError as error:
            raise InputError(f"--radius {quote(option)}: {error}") from error
        by_name[name] = word
    if "" in by_name and source is not None:
        raise InputError(f"--radius {by_name['']} is for all, --radii {source} says otherwise")
    return Given(by_name, source)


def radii_of(
    frame: Frame, wanted: Given, exponent: int, angstrom: int, strict: bool
) -> tuple[Floats, list[str], set[str]]:
    """Returns the radii in the unit that is written, where they are from, and the names met.

    exponent: from the file's unit to the written one; angstrom: from Angstrom to it.
    """
    kinds = frame.kinds or [("", None)]
    kind_of = frame.columns.get("kind", np.zeros(len(frame), np.int32))
    by_name = {name: word for name, word in wanted.by_name.items() if name}
    own = [by_name.get(label, by_name.get(str(element))) for label, element in kinds]
    named = to_float32([word or "nan" for word in own], strict=False)[kind_of]
    replaced = f"; {np.isfinite(named).sum()} replaced as given" if any(own) else ""
    for_all, column = wanted.by_name.get(""), _column(frame, wanted.source)
    if for_all is not None:
        radii: Floats = np.full(len(frame), to_float32([for_all])[0])
        said = [f"radii      {for_all} for all, as given{replaced}"]
    elif column:
        radii = _from_file(frame, column, exponent, strict)
        span = f"{np.nanmin(radii):g} to {np.nanmax(radii):g}" if len(radii) else "none"
        said = [f"radii      from the file, {span}{replaced}"]
    else:
        words = [RADII.get(element or "", "nan") for _, element in kinds]
        radii = to_float32(words, angstrom, strict=False)[kind_of]
    radii = np.where(np.isnan(named), radii, named)
    if for_all is None and not column:
        said = _about_elements(frame, kinds, kind_of, radii, wanted.by_name)
    return radii, said, {str(name) for kind in kinds for name in kind}


def _column(frame: Frame, source: str | None) -> str:
    """The file's radii, if they are to be used; those of unsure meaning only if asked for."""
    names = {"element": [], "file": ["radius", "diameter", "fifth"], None: ["radius", "diameter"]}
    column = next((name for name in names[source] if name in frame.columns), "")
    if source == "file" and not column:
        raise InputError("--radii file: it has no radii")
    return column


def _from_file(frame: Frame, column: str, exponent: int, strict: bool) -> Floats:
    radii = frame.numbers(column, exponent, strict)
    if strict and (radii < 0).any():
        first = int((radii < 0).argmax())
        raise InputError(f"{frame.place(first)}: {column} {radii[first]:g} is negative")
    return radii / np.float32(2) if column == "diameter" else radii


def _about_elements(
    frame: Frame, kinds: list[Kind], kind_of: Column, radii: Floats, by_name: dict[str, str]
) -> list[str]:
    """Refuses atoms that got no radius; else names, how many and how large, most frequent first."""
    if "kind" not in frame.columns:
        raise InputError("it has no radii and no elements: give --radius R, or --topology FILE")
    missing = np.flatnonzero(np.isnan(radii))
    if len(missing):
        label, element = kinds[kind_of[missing[0]]]
        why = f"the table has no radius for element {element}"
        if element is None:
            why = f"{quote(label)} is of no known element"
        name = element or label or "NAME"
        others = {kinds[k][1] or kinds[k][0] for k in set(kind_of[missing].tolist())} - {name}
        also = f" (and for {', '.join(sorted(others)[:_MOST_NAMES])})" if others else ""
        advice = f"give its radius, --radius {name}=1.5{also}, or --radius 1.5 for all"
        raise InputError(f"{frame.place(missing[0])}: {why}: {advice}")
    if frame.unit is None and len(frame):
        raise InputError("its unit of length is not known, radii by element are: give --radius R")
    tally: Counter[str] = Counter()
    for k, first in zip(*np.unique(kind_of, return_index=True), strict=True):
        label, element = kinds[k]
        name = label if label in by_name or element is None else element
        tally[f"{name} {radii[first]:.6g}"] += int((kind_of == k).sum())
    parts = [f"{count} {name}" for name, count in tally.most_common(_MOST_NAMES)]
    more = f", and {len(tally) - len(parts)} more" if len(tally) > len(parts) else ""
    shown = f"radii      by element (Bondi): {', '.join(parts)}{more}"
    return [shown, f"elements   from {frame.elements_from}"]
