# SPDX-License-Identifier: MIT
"""Which radius each atom gets: given by name, or from the file, or by element, or one for all."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from octocell_import.decimals import Floats, NotAFloat, shifted, to_float32
from octocell_import.elements import RADII, symbol
from octocell_import.errors import InputError, quote
from octocell_import.frame import Frame

_MOST_NAMES = 12  # in what is printed


@dataclass(frozen=True)
class Given:
    """What --radius and --radii said; lengths in the unit that is written."""

    for_all: str | None = None
    by_name: dict[str, str] = field(default_factory=dict)  # element or the file's own name
    source: str | None = None  # "file", "element" or None: the best there is


def given(options: Sequence[str], source: str | None) -> Given:
    """Each option is R, or NAME=R. Throws InputError."""
    for_all: str | None = None
    by_name: dict[str, str] = {}
    for option in options:
        name, equals, word = (part.strip() for part in option.rpartition("="))
        if (equals and not name) or name in by_name or (not equals and for_all is not None):
            raise InputError(f"--radius {quote(option)}: R or NAME=R, each name once")
        try:
            negative = to_float32([word])[0] < 0
        except NotAFloat as error:
            raise InputError(f"--radius {quote(option)}: {error}") from error
        if negative:
            raise InputError(f"--radius {quote(option)}: is negative")
        if equals:
            by_name[name] = word
        else:
            for_all = word
    if for_all is not None and source is not None:
        raise InputError(f"--radius {for_all} is for all, --radii {source} says otherwise")
    return Given(for_all, by_name, source)


def choose(frame: Frame, wanted: Given, exponent: int, angstrom: int) -> tuple[Floats, list[str]]:
    """The radii in the unit that is written, and lines that say where they are from.

    exponent: from the file's unit to the written one; angstrom: from Angstrom to it.
    Throws InputError without the file's name, which the caller knows.
    """
    if wanted.source == "file" and frame.radii is None:
        raise InputError("--radii file: it has no radii")
    if wanted.for_all is not None:
        base: Floats = np.full(frame.count, to_float32([wanted.for_all])[0], np.float32)
        source = f"{wanted.for_all} for all, as given"
    elif frame.radii is not None and wanted.source != "element":
        base = from_file(frame, exponent)
        source = f"from the file, {base.min():g} to {base.max():g}"
    else:
        return _by_element(frame, wanted, angstrom)
    replaced = _replace(base, frame, wanted)
    return base, [f"radii      {source}" + (f"; {replaced} replaced as given" if replaced else "")]


def from_file(frame: Frame, exponent: int) -> Floats:
    assert frame.radii is not None
    try:
        radii = to_float32(frame.radii, exponent)
    except NotAFloat as error:
        raise InputError(f"{frame.place(error.index)}: radius {error}") from error
    negative = np.flatnonzero(radii < 0)
    if len(negative):
        first = int(negative[0])
        raise InputError(f"{frame.place(first)}: radius {frame.radii[first]} is negative")
    return radii


def _given_for(label: str, element: str | None, by_name: dict[str, str]) -> str | None:
    """The file's own name goes before the element: it says more."""
    return by_name.get(label, by_name.get(element) if element else None)


def _replace(base: Floats, frame: Frame, wanted: Given) -> int:
    rounded = {name: to_float32([word])[0] for name, word in wanted.by_name.items()}
    replaced = 0
    for atom, (label, element) in enumerate(zip(frame.labels, frame.elements, strict=True)):
        word = _given_for(label, element, wanted.by_name)
        if word is not None:
            base[atom] = rounded[label if label in rounded else str(element)]
            replaced += 1
    return replaced


def _by_element(frame: Frame, wanted: Given, angstrom: int) -> tuple[Floats, list[str]]:
    if not frame.labels:
        raise InputError("it has no radii and no elements: give --radius R, or --topology FILE")
    if frame.unit is None:
        raise InputError("its unit of length is not known, radii by element are: give --radius R")
    kinds = list(zip(frame.labels, frame.elements, strict=True))
    words: dict[tuple[str, str | None], str] = {}
    for kind in set(kinds):
        own = _given_for(*kind, wanted.by_name)
        table = RADII.get(kind[1] or "")
        if own is not None:
            words[kind] = own
        elif table is not None:
            words[kind] = shifted(table, angstrom)
    missing = [atom for atom, kind in enumerate(kinds) if kind not in words]
    if missing:
        raise InputError(_complaint(frame, missing))
    names = list(words)
    number = {kind: k for k, kind in enumerate(names)}
    table_of_radii = to_float32([words[kind] for kind in names])
    radii = table_of_radii[[number[kind] for kind in kinds]]
    return radii, [
        f"radii      by element (Bondi): {_tally(kinds, radii, wanted)}",
        f"elements   from {frame.elements_from}",
    ]


def _complaint(frame: Frame, missing: list[int]) -> str:
    label, element = frame.labels[missing[0]], frame.elements[missing[0]]
    if element is None:
        why = f"{quote(label)} is of no known element"
        name = label
    else:
        why = f"the table has no radius for element {element}"
        name = element
    kinds = {frame.elements[atom] or frame.labels[atom] for atom in missing} - {name}
    others = f" (and for {', '.join(sorted(kinds)[:_MOST_NAMES])})" if kinds else ""
    example = f"--radius {name or 'NAME'}=1.5{others}, or --radius 1.5 for all"
    return f"{frame.place(missing[0])}: {why}: give its radius, {example}"


def _tally(kinds: list[tuple[str, str | None]], radii: Floats, wanted: Given) -> str:
    """Names, how many and how large, the most frequent first."""
    named: Counter[tuple[str, str]] = Counter()
    for (label, element), radius in zip(kinds, radii.tolist(), strict=True):
        own = label if label in wanted.by_name or element is None else element
        named[own, f"{radius:.6g}"] += 1
    parts = [f"{count} {name} {radius}" for (name, radius), count in named.most_common(_MOST_NAMES)]
    more = len(named) - len(parts)
    return ", ".join(parts) + (f", and {more} more" if more > 0 else "")


def unused_names(frame: Frame, wanted: Given) -> list[str]:
    """Names given that no atom has: most likely misspelt."""
    met = set(frame.labels) | {element for element in frame.elements if element}
    return [name for name in wanted.by_name if name not in met]


def spelling(name: str) -> str:
    """Elements are written as Ca, names as the file has them; who writes ZN may mean Zn."""
    known = symbol(name)
    return f"; the element is written {known}" if known and known != name else ""
