# SPDX-License-Identifier: MIT
"""Frame after frame."""

from __future__ import annotations

import threading
from typing import Any

from numpy.typing import DTypeLike

from . import _native
from ._input import options_of, read
from ._pairs import Pairs, index_type
from ._search import Cast, Device, rounding_of


class Finder:
    """Finds the pairs of scene after scene, for example of the frames of a simulation.

    It keeps its memory and its threads (about 140 bytes a sphere), and reuses what it can prove to
    be still right if most spheres moved little. The number of spheres may change from frame to
    frame, unless there are flags. Threads that share a finder take turns. Parameters are those of
    :func:`octocell.pairs`.

    >>> import numpy as np
    >>> spheres = np.array([[0, 0, 0, 1], [3, 0, 0, 1], [6, 0, 0, 1]], np.float32)
    >>> finder = octocell.Finder()
    >>> for frame in range(3):
    ...     print(list(finder.find(spheres)))
    ...     spheres[0, 0] += 0.5
    []
    []
    [(0, 1)]
    """

    def __init__(
        self,
        *,
        flags: Any = None,
        index_dtype: DTypeLike | None = None,
        sort: bool = True,
        threads: int = 0,
        device: Device = "cpu",
    ) -> None:
        self._dtype = index_type(index_dtype)
        self._how = (sort, threads, device, flags)
        self._native = _native.Finder(options_of(None, threads, sort, device, flags))
        self._turn = threading.Lock()

    def find(
        self, centers: Any, radii: Any = None, *, cast: Cast | None = None, copy: bool = True
    ) -> Pairs:
        """Returns all pairs of this frame.

        With ``copy=False``, they lie in the finder's memory. Then the next frame must not be
        searched before the pairs and all arrays made of them are deleted: BufferError says so.
        """
        given = read(centers, radii, cast)
        with self._turn:
            found = self._native.find(given.spheres, not copy)
        rounding = rounding_of(given, found, *self._how)
        return Pairs(found, len(given.spheres), self._dtype, given.convert, rounding)
