# SPDX-License-Identifier: MIT
"""What callers bring, as the arrays that the library reads."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._foreign import Convert, converter_for, to_numpy

_EXACT_INTEGERS = 2**24  # float32 has all integers up to here


class Input(NamedTuple):
    """The spheres of a call."""

    spheres: NDArray[np.float32]  # (N, 4)
    # With cast="nearest": the numbers before rounding, and spheres that keep each of their pairs.
    float64: NDArray[np.float64] | None
    wide: NDArray[np.float32] | None
    convert: Convert | None  # for results in the package of the centres


def read(centers: Any, radii: Any = None, cast: str | None = None) -> Input:
    """Returns the spheres of (N, 3) and radii, or of (N, 4). Copies only what has another form."""
    if cast not in (None, "nearest"):
        raise ValueError(f'cast={cast!r}: must be None or "nearest"')
    convert = converter_for(centers)
    places = _table(centers, radii is None)
    if radii is None:
        sizes = None
    elif type(radii) in (float, int):  # weak, as in NumPy: it takes the type of the centres
        sizes = np.array([radii], np.float64 if places.dtype == np.float64 else np.float32)
    else:
        sizes = _sizes(radii, len(places))
    if cast is None:
        spheres = _float32(places, "centers", centers)
        if sizes is not None:
            spheres = _native.join(spheres, _float32(sizes, "radii", radii))
        return Input(spheres, None, None, convert)
    return _rounded(places, sizes, convert)


def _table(centers: Any, with_radii: bool) -> NDArray[Any]:
    places = to_numpy(centers, "centers")
    columns = 4 if with_radii else 3
    if places.size == 0 and places.ndim <= 2:
        return np.empty((0, columns), places.dtype if places.ndim == 2 else np.float32)
    if places.ndim != 2 or places.shape[1] != columns:
        form = "(N, 4), x y z r, where there are no radii" if with_radii else "(N, 3)"
        raise ValueError(f"centers have the shape {places.shape}: must be {form}")
    return places


def _sizes(radii: Any, count: int) -> NDArray[Any]:
    sizes = np.atleast_1d(to_numpy(radii, "radii"))
    if sizes.ndim != 1 or len(sizes) not in (1, count):
        raise ValueError(f"radii have the shape {sizes.shape}: must be a number or ({count},)")
    return sizes


def _float32(array: NDArray[Any], name: str, given: Any) -> NDArray[np.float32]:
    """The array itself, or an exact copy of it."""
    if array.dtype == np.float32:
        return np.require(array, requirements=("C", "A"))
    if array.dtype.kind not in "iufb":
        raise TypeError(f"{name} are {array.dtype}: must be numbers")
    native = array.dtype.newbyteorder("=")
    if native.kind == "f" and native.itemsize <= 4:
        return np.ascontiguousarray(array, np.float32)
    if native.kind in "iub":
        if array.size == 0 or max(-int(array.min()), int(array.max())) <= _EXACT_INTEGERS:
            return np.ascontiguousarray(array, np.float32)
    elif not hasattr(given, "dtype"):  # Python's own numbers, in a list
        with np.errstate(over="ignore"):
            copy = np.ascontiguousarray(array, np.float32)
        if np.array_equal(copy, array, equal_nan=True):
            return copy
    raise TypeError(
        f"{name} are {array.dtype}, which float32 would round, and answers are exact for float32:"
        ' pass float32, or cast="nearest" to pairs(), which counts what rounding changes'
    )


def _rounded(places: NDArray[Any], sizes: NDArray[Any] | None, convert: Convert | None) -> Input:
    for name, array in (("centers", places), ("radii", sizes)):
        if array is not None and (array.dtype.kind not in "iufb" or array.dtype.itemsize > 8):
            raise TypeError(f"{name} are {array.dtype}: must be numbers of at most 8 bytes")
    numbers = np.empty((len(places), 4))
    if sizes is None:
        numbers[:] = places
    else:
        numbers[:, :3], numbers[:, 3] = places, sizes
    spheres, wide = _native.rounded(numbers)
    return Input(spheres, numbers, wide, convert)


def options_of(
    count: int | None, threads: int, sort: bool, device: str, flags: Any
) -> _native.Options:
    """Returns the options of a search. `count`: of spheres, if it is known already."""
    if device not in ("cpu", "cuda"):
        raise ValueError(f'device={device!r}: must be "cpu" or "cuda"')
    words = None
    if flags is not None:
        words = to_numpy(flags, "flags")
        if words.dtype != np.uint32 or words.ndim != 1:
            raise TypeError(f"flags are {words.dtype} {words.shape}: must be uint32 (N,)")
        if count is not None and len(words) != count:
            raise ValueError(f"{len(words)} flags for {count} spheres")
        words = np.require(words, requirements=("C", "A"))
    return _native.Options(threads, sort, device == "cuda", words)
