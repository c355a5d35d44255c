# SPDX-License-Identifier: MIT
"""The answer, and the layouts that other packages expect."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _native
from ._foreign import Convert

_INDEX_TYPES = (np.dtype(np.int32), np.dtype(np.int64), np.dtype(np.uint32))
_PAIRS_PER_STEP = 65536


class Rounding(NamedTuple):
    """What rounding to float32 changed, decided over the reals for the numbers as given."""

    lost: int  #: pairs of the given numbers that are none after rounding
    gained: int  #: pairs that are some only after rounding

    @property
    def changed(self) -> int:
        """The number of decisions that rounding changed."""
        return self.lost + self.gained


def index_type(given: DTypeLike | None) -> np.dtype[Any]:
    """Returns the type of ids: int32 unless another is asked for."""
    if given is None:
        return _INDEX_TYPES[0]
    wanted = np.dtype(given)
    if wanted not in _INDEX_TYPES:
        raise TypeError(f"index_dtype={wanted}: must be int32, int64 or uint32")
    return wanted


class Pairs:
    """The pairs of a scene: sphere ``i[k]`` overlaps sphere ``j[k]``, and ``i[k] < j[k]``.

    ``i``, ``j`` and ``array`` are views of one list in memory, (P, 2): 8 bytes a pair, or 16 with
    int64. Conversions return new arrays in the package of the input (NumPy, PyTorch, ...), with the
    ids' type.

    >>> pairs = octocell.pairs([[0, 0, 0], [1, 0, 0], [2, 0, 0]], 0.5)
    >>> pairs
    Pairs(2 pairs of 3 spheres)
    >>> list(pairs)
    [(0, 1), (1, 2)]
    """

    __slots__ = ("_convert", "_pairs", "rounding", "sphere_count")

    #: How many spheres the scene has.
    sphere_count: int
    #: With ``cast="nearest"``: what rounding changed.
    rounding: Rounding | None

    def __init__(
        self,
        pairs: NDArray[np.uint32],
        sphere_count: int,
        dtype: np.dtype[Any],
        convert: Convert | None = None,
        rounding: Rounding | None = None,
    ) -> None:
        # Ids have 28 bits, so a signed and an unsigned word of 32 are the same.
        ids: NDArray[Any] = pairs.view(dtype) if dtype.itemsize == 4 else pairs.astype(dtype)
        self._pairs = ids
        self._convert = convert
        self.sphere_count = sphere_count
        self.rounding = rounding

    @property
    def i(self) -> Any:
        """The smaller ids, (P,); a view."""
        return self._out(self._pairs[:, 0])

    @property
    def j(self) -> Any:
        """The larger ids, (P,); a view."""
        return self._out(self._pairs[:, 1])

    @property
    def array(self) -> Any:
        """Both, (P, 2); a view."""
        return self._out(self._pairs)

    @property
    def count(self) -> int:
        """The number of pairs, P."""
        return len(self._pairs)

    def __len__(self) -> int:
        return len(self._pairs)

    def __iter__(self) -> Iterator[tuple[int, int]]:
        for begin in range(0, len(self._pairs), _PAIRS_PER_STEP):
            yield from map(tuple, self._pairs[begin : begin + _PAIRS_PER_STEP].tolist())

    def __repr__(self) -> str:
        return f"Pairs({len(self)} pairs of {self.sphere_count} spheres)"

    def __array__(self, dtype: DTypeLike = None, copy: bool | None = None) -> NDArray[Any]:
        return np.array(self._pairs, dtype=dtype, copy=copy)

    def __dlpack__(self, **how: Any) -> Any:
        return self._pairs.__dlpack__(**how)

    def __dlpack_device__(self) -> tuple[int, int]:
        return self._pairs.__dlpack_device__()

    def to_csr(self, *, both: bool = True) -> tuple[Any, Any]:
        """The neighbors of each sphere, one after the other: ``(indptr, indices)``.

        Those of sphere ``s`` are ``indices[indptr[s]:indptr[s + 1]]``, in ascending order if the
        pairs are sorted. ``indptr`` is int64, (N + 1,). Without ``both``, only the larger id of
        each pair is a neighbor. Needs 4 bytes an index (12 for int64) and 16 a sphere.

        >>> pairs = octocell.pairs([[0, 0, 0], [1, 0, 0], [2, 0, 0]], 0.5)
        >>> indptr, indices = pairs.to_csr()
        >>> indptr.tolist(), indices.tolist()
        ([0, 1, 3, 4], [1, 0, 2, 1])
        """
        indptr, indices = self._csr(both)
        return self._out(indptr), self._out(indices)

    def to_edge_index(self, *, both: bool = True) -> Any:
        """Edges as graph networks expect them, (2, E), sorted by the first row if the pairs are.

        With ``both``, each pair is two edges, (i, j) and (j, i).

        >>> octocell.pairs([[0, 0, 0], [1, 0, 0], [2, 0, 0]], 0.5).to_edge_index().tolist()
        [[0, 1, 1, 2], [1, 0, 2, 1]]
        """
        if not both:
            return self._out(np.ascontiguousarray(self._pairs.T))
        indptr, indices = self._csr(both)
        _native.require_memory(2.0 * indices.nbytes, "edges")
        edges = np.empty((2, len(indices)), indices.dtype)
        edges[0] = np.repeat(np.arange(self.sphere_count, dtype=indices.dtype), np.diff(indptr))
        edges[1] = indices
        return self._out(edges)

    def to_matrix(self, k: int, *, both: bool = True, fill: int | None = None) -> Any:
        """The neighbors of each sphere as a row of ``k`` ids, (N, k), filled up with ``fill``.

        ``fill`` is -1 by default, and N for unsigned ids. Raises ValueError that names a sphere
        and the width that is needed, if some sphere has more than ``k`` neighbors.

        >>> octocell.pairs([[0, 0, 0], [1, 0, 0], [2, 0, 0]], 0.5).to_matrix(2).tolist()
        [[1, -1], [0, 2], [1, -1]]
        """
        if k < 0:
            raise ValueError(f"k={k}: must be 0 or more")
        indptr, indices = self._csr(both)
        degrees = np.diff(indptr)
        if self.sphere_count and degrees.max() > k:
            most = int(degrees.argmax())
            raise ValueError(f"k={k}: sphere {most} has {degrees[most]} neighbors")
        if fill is None:
            fill = -1 if indices.dtype.kind == "i" else self.sphere_count
        _native.require_memory(self.sphere_count * k * (indices.itemsize + 1.0), "the matrix")
        matrix = np.full((self.sphere_count, k), fill, indices.dtype)
        matrix[np.arange(k) < degrees[:, None]] = indices
        return self._out(matrix)

    def _csr(self, both: bool) -> tuple[NDArray[np.int64], NDArray[Any]]:
        ids: NDArray[Any] = self._pairs
        entries = (1 + both) * len(ids)
        _native.require_memory(
            entries * (4.0 + 8.0 * (ids.itemsize == 8)) + 16.0 * self.sphere_count, "neighbor lists"
        )
        words = ids.view(np.uint32) if ids.itemsize == 4 else ids.astype(np.uint32)
        indptr, indices = _native.csr(words, self.sphere_count, both)
        indptr = indptr.view(np.int64)  # the same by another name, which NumPy prints more shortly
        if ids.itemsize == 4:
            return indptr, indices.view(ids.dtype)
        return indptr, indices.astype(ids.dtype)

    def _out(self, array: NDArray[Any]) -> Any:
        return array if self._convert is None else self._convert(array)
