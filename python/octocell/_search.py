# SPDX-License-Identifier: MIT
"""The functions: one scene at a time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _native
from ._foreign import to_numpy
from ._input import Input, options_of, read
from ._pairs import Pairs, Rounding, index_type

Device = Literal["cpu", "cuda"]
Cast = Literal["nearest"]


def pairs(
    centers: Any,
    radii: Any = None,
    *,
    flags: Any = None,
    cast: Cast | None = None,
    index_dtype: DTypeLike | None = None,
    sort: bool = True,
    threads: int = 0,
    device: Device = "cpu",
) -> Pairs:
    """Finds every pair of overlapping spheres, exactly.

    Spheres i and j are a pair if ``|p_i - p_j|**2 <= (r_i + r_j)**2`` over the real numbers, for
    the float32 values as they are given. Spheres that touch are a pair. Each pair is reported once,
    with i < j. No list is ever cut.

    Parameters
    ----------
    centers : array (N, 3), or (N, 4) if there are no radii
        Positions x, y, z; the fourth column holds radii. In any unit of length, which radii share.
        float32, or numbers that float32 holds exactly: float16, small integers, lists of such
        numbers. From NumPy, or from any package with DLPack, in the memory of the CPU.
    radii : number or array (N,)
        A Python number is rounded to float32, as in NumPy's arithmetic. For all pairs within a
        cutoff, give half of it.
    flags : array (N,) of uint32
        With what each sphere may collide: see :func:`octocell.flags`.
    cast : "nearest"
        Accepts float64 and integers of any size, and rounds them to float32. ``Pairs.rounding``
        counts the decisions that differ from those for the numbers before rounding. That takes
        about twice the time and 80 bytes a sphere.
    index_dtype : int32 (default), int64 or uint32
        The type of ids. There are at most 2**28 spheres, so int32 always suffices.
    sort : bool
        True: pairs are sorted by (i, j). False: any order, which may differ from run to run.
    threads : int
        On how many threads to search; 0: on all that this process may use.
    device : "cpu" or "cuda"
        Where to search. Arrays lie in the memory of the CPU in both cases.

    Returns
    -------
    Pairs
        ``.i`` and ``.j``, and conversions; in the package of ``centers``.

    Raises
    ------
    InvalidSphere
        A ValueError: a number is not finite or a radius is negative; names the first such sphere.
    TypeError
        float64, or other numbers that float32 would round, without ``cast``.
    ValueError, LimitError, MemoryError, Unavailable
        A wrong shape or option; more than 2**28 spheres; too little memory; no such device.
    KeyboardInterrupt
        A search can be interrupted.

    Notes
    -----
    Memory: 8 bytes a pair (8 more for int64) and about 40 bytes a sphere while it searches. Spheres
    as float32 (N, 4) in C order are read where they lie; centres and radii apart are first joined,
    16 bytes a sphere. Pairs are not copied.

    Threads: the search runs without the GIL. The arrays must not change meanwhile.

    Determinism: the set of pairs depends on the spheres alone; sorted pairs are always the same.

    Not exact: the conversion of other numbers to float32, which is why it must be asked for.

    Examples
    --------
    >>> import numpy as np
    >>> centers = np.array([[0, 0, 0], [1.5, 0, 0], [9, 9, 9]], np.float32)
    >>> found = octocell.pairs(centers, 1.0)
    >>> found.i, found.j
    (array([0], dtype=int32), array([1], dtype=int32))
    >>> octocell.pairs(np.array([[0.1, 0, 0], [0.3, 0, 0]]), 0.1, cast="nearest").rounding
    Rounding(lost=1, gained=0)
    >>> octocell.pairs(centers, [1, -1, 1])
    Traceback (most recent call last):
    ...
    octocell.InvalidSphere: sphere 1: x=1.5 y=0 z=0 r=-1; all four must be finite and r >= 0
    """
    given = read(centers, radii, cast)
    dtype = index_type(index_dtype)
    options = options_of(len(given.spheres), threads, sort, device, flags)
    found = _native.find(given.spheres, options)
    rounding = rounding_of(given, found, sort, threads, device, flags)
    return Pairs(found, len(given.spheres), dtype, given.convert, rounding)


def rounding_of(
    given: Input, found: NDArray[np.uint32], sort: bool, threads: int, device: str, flags: Any
) -> Rounding | None:
    """Returns what rounding changed; None if nothing was rounded."""
    if given.float64 is None or given.wide is None:
        return None
    options = options_of(len(given.wide), threads, True, device, flags)
    wide = _native.find(given.wide, options)
    if not sort:
        found = found[np.lexsort((found[:, 1], found[:, 0]))]
    return Rounding(*_native.changed(given.float64, found, wide))


def count(
    centers: Any,
    radii: Any = None,
    *,
    flags: Any = None,
    threads: int = 0,
    device: Device = "cpu",
) -> int:
    """Counts the pairs. Needs no memory for them. Parameters and errors are those of :func:`pairs`.

    >>> octocell.count([[0, 0, 0], [1, 0, 0], [2, 0, 0]], 0.5)
    2
    """
    spheres = read(centers, radii).spheres
    return _native.count(spheres, options_of(len(spheres), threads, True, device, flags))


def chunks(
    centers: Any,
    radii: Any = None,
    *,
    pairs: int = 10_000_000,
    flags: Any = None,
    index_dtype: DTypeLike | None = None,
    sort: bool = True,
    threads: int = 0,
    device: Device = "cpu",
) -> Iterator[Pairs]:
    """Yields the pairs in chunks, for lists that are larger than memory.

    A chunk has at most ``pairs`` pairs, or those of a single sphere i if that one has more. Sorted
    chunks, one after the other, are the whole sorted list. Each chunk searches the spheres that are
    left once more, so large chunks are fast. The arrays must stay as they are until the end.
    Parameters and errors are those of :func:`pairs`.

    >>> sum(len(chunk) for chunk in octocell.chunks([[0, 0, 0]] * 100, 1, pairs=1000))
    4950
    """
    given = read(centers, radii)
    dtype = index_type(index_dtype)
    if pairs < 1:
        raise ValueError(f"pairs={pairs}: must be 1 or more")
    options = options_of(len(given.spheres), threads, sort, device, flags)
    native = _native.Chunks(given.spheres, pairs, options)

    def all_chunks() -> Iterator[Pairs]:
        while len(chunk := native.next()):
            yield Pairs(chunk, len(given.spheres), dtype, given.convert)

    return all_chunks()


class Verification(NamedTuple):
    """How a list of pairs differs from the answer. Of each kind, the first pair by (i, j)."""

    missed: int  #: pairs that the list lacks
    false_pairs: int  #: pairs of the list that are none, each counted once
    duplicates: int  #: entries that repeat another one
    first_missed: tuple[int, int] | None
    first_false: tuple[int, int] | None
    first_duplicate: tuple[int, int] | None

    @property
    def exact(self) -> bool:
        """True if the list has every pair once and nothing else."""
        return self.missed == self.false_pairs == self.duplicates == 0


def verify(
    centers: Any,
    radii: Any,
    i: ArrayLike,
    j: ArrayLike | None = None,
    *,
    flags: Any = None,
    threads: int = 0,
    device: Device = "cpu",
) -> Verification:
    """Compares anyone's list of pairs with the answer.

    The list is ``i`` and ``j``, (P,) each, or ``i`` alone, (P, 2): integers of any type, in any
    order; (j, i) counts as (i, j). A pair of a sphere with itself, or with a sphere that does not
    exist, is false. Needs 16 bytes an entry. Other parameters and errors are those of
    :func:`pairs`; ``radii`` is None for centers (N, 4).

    >>> result = octocell.verify([[0, 0, 0], [1, 0, 0], [2, 0, 0]], 0.5, [1, 0], [0, 2])
    >>> result.exact, result.missed, result.first_missed, result.false_pairs, result.first_false
    (False, 1, (1, 2), 1, (0, 2))
    """
    spheres = read(centers, radii).spheres
    options = options_of(len(spheres), threads, True, device, flags)
    return Verification(*_native.verify(spheres, _listed(i, j), options))


def _listed(i: ArrayLike, j: ArrayLike | None) -> NDArray[np.uint32]:
    """A list of pairs as (P, 2) words."""
    if j is None:
        entries = to_numpy(i, "pairs")
        if entries.size == 0:
            entries = np.empty((0, 2), np.uint32)
    else:
        first, second = to_numpy(i, "i"), to_numpy(j, "j")
        if first.shape != second.shape or first.ndim != 1:
            raise ValueError(f"i and j have the shapes {first.shape} and {second.shape}")
        entries = np.stack([first, second], axis=1) if len(first) else np.empty((0, 2), np.uint32)
    if entries.ndim != 2 or entries.shape[1] != 2:
        raise ValueError(f"pairs have the shape {entries.shape}: must be (P, 2)")
    if entries.dtype.kind not in "iu":
        raise TypeError(f"pairs are {entries.dtype}: must be integers")
    outside = (entries < 0) | (entries > 0xFFFFFFFF)
    if outside.any():
        k = int(outside.any(axis=1).argmax())
        raise ValueError(f"entry {k} is {tuple(entries[k].tolist())}: ids are words of 32 bits")
    return np.ascontiguousarray(entries, np.uint32)


class Plan:
    """How a scene would be searched. ``str(plan)`` is :meth:`explain`."""

    __slots__ = ("_text",)

    def __init__(self, text: str) -> None:
        self._text = text

    def explain(self) -> str:
        """A short tree of text: what was measured, what was chosen, and why."""
        return self._text

    def __str__(self) -> str:
        return self._text


def plan(
    centers: Any,
    radii: Any = None,
    *,
    flags: Any = None,
    threads: int = 0,
    device: Device = "cpu",
) -> Plan:
    """Plans a search without searching. Parameters and errors are those of :func:`pairs`.

    >>> print(octocell.plan([[0, 0, 0], [1, 0, 0], [2, 0, 0]], 0.5).explain())  # doctest: +ELLIPSIS
    scene      3 spheres, radii 0.5 to 0.5, centres in 2 x 0 x 0
    ...
    """
    spheres = read(centers, radii).spheres
    options = options_of(len(spheres), threads, True, device, flags)
    return Plan(_native.explain(spheres, options))


def flags(
    *, static: ArrayLike = False, group: ArrayLike = 1, mask: ArrayLike = 0xFFFF
) -> NDArray[np.uint32]:
    """Makes words that say with what spheres may collide; the arguments are broadcast to (N,).

    Spheres that overlap are a pair if not both are ``static``, ``group_i & mask_j`` is not 0, and
    ``group_j & mask_i`` is not 0. Groups have 15 bits, masks 16.

    Two sets, A against B only:

    >>> words = octocell.flags(group=[1, 1, 2], mask=[2, 2, 1])
    >>> list(octocell.pairs([[0, 0, 0], [1, 0, 0], [2, 0, 0]], 1, flags=words))
    [(0, 2), (1, 2)]
    """
    groups, masks = np.asarray(group), np.asarray(mask)
    for name, words, most in (("group", groups, 0x7FFF), ("mask", masks, 0xFFFF)):
        if words.dtype.kind not in "iu" or words.min(initial=0) < 0 or words.max(initial=0) > most:
            raise ValueError(f"{name}: must be integers of 0 to {most:#x}")
    still = np.asarray(static, np.bool_).astype(np.uint32) << np.uint32(15)
    return np.atleast_1d(
        masks.astype(np.uint32) << np.uint32(16) | still | groups.astype(np.uint32)
    )


def why_unavailable(device: Device) -> str | None:
    """Returns why a device cannot be used here, in one line; None if it can.

    >>> octocell.why_unavailable("cpu")
    """
    if device not in ("cpu", "cuda"):
        raise ValueError(f'device={device!r}: must be "cpu" or "cuda"')
    return _native.reason_against(device == "cuda")
