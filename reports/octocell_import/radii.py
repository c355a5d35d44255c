# SPDX-License-Identifier: MIT
"""Which radius each atom gets: given by name, or from the file, or by element, or one for all."""

from collections import Counter
from collections.abc import Sequence

import numpy as np

from octocell_import import InputError, quote
from octocell_import.decimals import Column, Floats, to_float32
from octocell_import.elements import RADII
from octocell_import.frame import Frame

_MOST_NAMES = 12  # in what is printed
# The file's columns by what --radii says; what may be something else only if it is asked for.
_SOURCES = {None: ["radius", "diameter"], "file": ["radius", "diameter", "fifth"], "element": []}
_NO_UNIT = "its unit of length is not known, radii by element are: give --radius R"
_NO_NAMES = "it has no radii and no elements: give --radius R, or --topology FILE"


def given(options: Sequence[str]) -> dict[str, str]:
    """Returns what --radius says: by element or the file's own name; "" is for all others."""
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
    return by_name


def radii_of(
    frame: Frame,
    by_name: dict[str, str],
    source: str | None,
    exponents: tuple[int, int],
    strict: bool,
) -> tuple[Floats, list[str]]:
    """Returns the radii in the unit that is written, and lines that say where they are from.

    exponents: of ten, from the file's unit to the written one, and from Angstrom to it.
    """
    kinds = frame.kinds or [("", None)]
    kind_of = frame.columns.get("kind", np.zeros(len(frame), np.int32))
    names = {name: word for name, word in by_name.items() if name}
    own = [names.get(label, names.get(element or "")) for label, element in kinds]
    named = to_float32([word or "nan" for word in own], strict=False)[kind_of]
    replaced = f"; {np.isfinite(named).sum()} replaced as given" if any(own) else ""
    column = next((name for name in _SOURCES[source] if name in frame.columns), "")
    if "" in by_name:
        if source is not None:
            raise InputError(f"--radius {by_name['']} is for all, --radii {source} says otherwise")
        radii: Floats = np.full(len(frame), to_float32([by_name[""]])[0])
        said = [f"radii      {by_name['']} for all, as given{replaced}"]
    elif column:
        radii = _from_file(frame, column, exponents[0], strict)
        span = f"{np.nanmin(radii):g} to {np.nanmax(radii):g}" if len(radii) else "none"
        said = [f"radii      from the file, {span}{replaced}"]
    elif source == "file":
        raise InputError("--radii file: it has no radii")
    else:
        words = [RADII.get(element or "", "nan") for _, element in kinds]
        radii = to_float32(words, exponents[1], strict=False)[kind_of]
        said = []
    radii = np.where(np.isnan(named), radii, named)
    return radii, said or _by_element(frame, kind_of, radii, by_name)


def _from_file(frame: Frame, column: str, exponent: int, strict: bool) -> Floats:
    radii = frame.numbers(column, exponent, strict)
    if strict and (radii < 0).any():
        first = int((radii < 0).argmax())
        raise InputError(f"{frame.place(first)}: {column} {radii[first]:g} is negative")
    return radii / np.float32(2) if column == "diameter" else radii


def _by_element(frame: Frame, kind_of: Column, radii: Floats, by_name: dict[str, str]) -> list[str]:
    """Says names, how many and how large, the most frequent first; refuses atoms without radius."""
    if len(frame) and not frame.kinds:
        raise InputError(_NO_NAMES)
    missing = np.flatnonzero(np.isnan(radii))
    if len(missing):
        label, element = frame.kinds[kind_of[missing[0]]]
        name = element or label or "NAME"
        why = f"the table has no radius for element {element}"
        why = why if element else f"{quote(label)} is of no known element"
        others = {
            element or label
            for label, element in (frame.kinds[k] for k in set(kind_of[missing].tolist()))
        } - {name}
        also = f" (and for {', '.join(sorted(others)[:_MOST_NAMES])})" if others else ""
        advice = f"give its radius, --radius {name}=1.5{also}, or --radius 1.5 for all"
        raise InputError(f"{frame.place(missing[0])}: {why}: {advice}")
    if len(frame) and frame.unit is None:
        raise InputError(_NO_UNIT)
    tally: Counter[str] = Counter()
    met = np.unique(kind_of, return_index=True, return_counts=True)
    for k, first, count in zip(*met, strict=True):
        label, element = frame.kinds[k]
        name = label if label in by_name or not element else element
        tally[f"{name} {radii[first]:.6g}"] += int(count)
    parts = [f"{count} {name}" for name, count in tally.most_common(_MOST_NAMES)]
    more = f", and {len(tally) - len(parts)} more" if len(tally) > len(parts) else ""
    shown = f"radii      by element (Bondi): {', '.join(parts)}{more}"
    return [shown, f"elements   from {frame.elements_from}"]
