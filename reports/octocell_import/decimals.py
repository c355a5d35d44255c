# SPDX-License-Identifier: MIT
"""Decimals to float32, rounded once.

By way of float64 a decimal is rounded twice, which goes wrong when the first rounding lands midway
between two float32. Those, and results below the normal numbers, are decided in exact arithmetic.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from octocell_import.errors import InputError, quote
from octocell_import.frame import Column

Floats = NDArray[np.float32]

_BELOW_FLOAT32 = np.uint64((1 << 29) - 1)  # the bits of a float64 that a float32 lacks
_MIDWAY = np.uint64(1 << 28)
_LONGEST_WORD = 1000  # characters of a number: enough to write any midpoint of two float32
_LEAST_NORMAL = float(np.finfo(np.float32).smallest_normal)


class NotAFloat(InputError):
    """A word that is no finite float32. `index` says which."""

    def __init__(self, index: int, message: str) -> None:
        super().__init__(message)
        self.index = index


def to_float32(column: Column, exponent: int = 0) -> Floats:
    """Returns column * 10^exponent. Throws NotAFloat."""
    if isinstance(column, np.ndarray):
        return _round_numbers(column, exponent)
    words = column if exponent == 0 else [shifted(word, exponent) for word in column]
    double = _parse(words, column)
    with np.errstate(over="ignore"):
        single = double.astype(np.float32)
    midway = (double.view(np.uint64) & _BELOW_FLOAT32) == _MIDWAY
    tiny = (np.abs(double) < _LEAST_NORMAL) & (double != 0)
    for index in np.flatnonzero((midway | tiny) & np.isfinite(single)):
        single[index] = _nearest(Fraction(words[index].strip()), single[index])
    _check_finite(single, column)
    return single


def to_float64(words: Sequence[str]) -> NDArray[np.float64]:
    """For numbers that are still to be computed with. Throws NotAFloat."""
    return _parse(words, words)


def shifted(word: str, exponent: int) -> str:
    """The decimal word * 10^exponent, as text; what is no decimal stays none."""
    mantissa, e, old = word.strip().lower().partition("e")
    try:
        return f"{mantissa}e{(int(old) if e else 0) + exponent}"
    except ValueError:
        return word


def _round_numbers(column: NDArray[np.floating], exponent: int) -> Floats:
    numbers = column
    if exponent:  # a float32 times ten is exact in float64, so this too rounds once
        factor = 10.0 ** abs(exponent)
        double = column.astype(np.float64)
        numbers = double * factor if exponent > 0 else double / factor
    with np.errstate(over="ignore"):
        single = numbers.astype(np.float32)
    _check_finite(single, column)
    return single


def _parse(words: Sequence[str], shown: Sequence[str]) -> NDArray[np.float64]:
    strange = "_" in "".join(words) or not "".join(words).isascii()  # Python reads 1_0 as 10
    long = max(map(len, words), default=0) > _LONGEST_WORD
    try:
        if not strange and not long:
            return np.fromiter(map(float, words), np.float64, len(words))
    except ValueError:
        pass
    for index, word in enumerate(words):
        if len(word) > _LONGEST_WORD:
            why = f"has {len(word)} characters; a number has at most {_LONGEST_WORD}"
            raise NotAFloat(index, f"{quote(shown[index])} {why}")
        try:
            if "_" in word or not word.isascii():
                raise ValueError
            float(word)
        except ValueError:
            raise NotAFloat(index, f"{quote(shown[index])} is not a number") from None
    raise AssertionError("a word that was no number became one")


def _nearest(exact: Fraction, close: np.float32) -> np.float32:
    """The float32 nearest to exact, even if two are; close is one of its neighbours."""
    up, down = np.float32(np.inf), np.float32(-np.inf)
    near = [close, np.nextafter(close, up), np.nextafter(close, down)]

    def distance(candidate: np.float32) -> tuple[Fraction, bool]:
        odd = bool(candidate.view(np.uint32) & np.uint32(1))
        return abs(Fraction(float(candidate)) - exact), odd

    return min((x for x in near if np.isfinite(x)), key=distance)


def _check_finite(single: Floats, column: Column) -> None:
    bad = np.flatnonzero(~np.isfinite(single))
    if not len(bad):
        return
    index = int(bad[0])
    value = column[index]
    why = "too large for float32" if np.isfinite(float(value)) else "not a finite number"
    # "1e999" is a decimal like any other, though float64 holds it as infinity.
    if isinstance(value, str) and any(c.isdigit() for c in value):
        why = "too large for float32"
    raise NotAFloat(index, f"{quote(str(value))} is {why}")
