# SPDX-License-Identifier: MIT
"""Decimals to float32, rounded once.

By way of float64 a decimal is rounded twice, which goes wrong when the first rounding lands midway
between two float32. Those decimals, and results below the normal numbers, are rounded exactly.
"""

import math
from collections.abc import Sequence
from decimal import Context, Decimal
from typing import Any

import numpy as np
from numpy.typing import NDArray

from octocell_import import InputError, quote

Column = NDArray[Any]  # words as in the file, as bytes; or the numbers of a binary file
Floats = NDArray[np.float32]

_BELOW_FLOAT32 = (1 << 29) - 1  # the bits of a float64 that a float32 lacks
_MIDWAY = 1 << 28
_LONGEST = 1000  # characters of a number: enough for any midpoint of two float32
_UNSURE = 4  # last places of a float64, more than shifting the point may cost
_LEAST_NORMAL = float(np.finfo(np.float32).smallest_normal)


class NotAFloat(InputError):
    """A word that is no finite float32. `index` says which."""

    def __init__(self, index: int, word: Any) -> None:
        text = word.decode("utf-8", "replace") if isinstance(word, bytes) else str(word)
        why = "not a number"
        if len(text) > _LONGEST:
            why += f": it has {len(text)} characters, of {_LONGEST} at most"
        elif text.strip().lower().lstrip("+-") in ("nan", "inf", "infinity"):
            why = "not a number: not a finite one"
        elif not math.isnan(_number(text.encode())):
            why = "too large for float32"
        super().__init__(f"{quote(text)} is {why}")
        self.index = index


def to_float32(column: Column | Sequence[str], exponent: int = 0, strict: bool = True) -> Floats:
    """Returns column * 10^exponent. What is no finite float32 throws NotAFloat, or becomes NaN."""
    if not isinstance(column, np.ndarray):
        column = np.array([word.encode() for word in column], object)
    are_words = column.dtype.kind in "SO"
    with np.errstate(all="ignore"):
        double = _numbers(column) if are_words else column.astype(np.float64)
        double = double * 10.0**exponent if exponent >= 0 else double / 10.0**-exponent
        if are_words:
            below = (double.view(np.int64) & _BELOW_FLOAT32) - _MIDWAY
            tiny = (np.abs(double) < _LEAST_NORMAL) & (double != 0)
            for index in np.flatnonzero((np.abs(below) <= _UNSURE) | tiny):
                double[index] = _to_odd(column[index], exponent)
        single = double.astype(np.float32)
    single[np.isinf(single)] = np.nan
    if strict and np.isnan(single).any():
        index = int(np.isnan(single).argmax())
        raise NotAFloat(index, column[index])
    return single


def to_float64(words: Column) -> NDArray[np.float64]:
    """For numbers that are still to be computed with. Throws NotAFloat."""
    numbers = _numbers(words)
    if not np.isfinite(numbers).all():
        index = int((~np.isfinite(numbers)).argmax())
        raise NotAFloat(index, words[index])
    return numbers


def _numbers(words: Column) -> NDArray[np.float64]:
    """NaN for what is no number."""
    try:
        if words.dtype.kind == "S" and not (words.view(np.uint8) == ord("_")).any():
            return words.astype(np.float64)
    except ValueError:
        pass
    return np.fromiter(map(_number, words), np.float64, len(words))


def _number(word: bytes) -> float:
    try:
        is_strange = b"_" in word or len(word) > _LONGEST  # Python reads 1_0 as 10
        return math.nan if is_strange else float(word)
    except ValueError:
        return math.nan


def _to_odd(word: bytes, exponent: int) -> float:
    """The decimal as a float64 that may be rounded to float32: odd wherever it is not exact."""
    exact = Decimal(word.decode().strip())
    exact = exact.scaleb(exponent, Context(prec=len(word) + 1))
    near = float(exact)
    if exact != near and not np.float64(near).view(np.int64) & 1:
        near = math.nextafter(near, math.inf if exact > near else -math.inf)
    return near
