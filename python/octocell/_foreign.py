# SPDX-License-Identifier: MIT
"""Arrays of other packages, by DLPack: read without a copy, and results in the same package."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Convert = Callable[[NDArray[Any]], Any]

_CPU, _PINNED = 1, 3  # DLDeviceType


def to_numpy(array: Any, name: str) -> NDArray[Any]:
    """Returns an array in the memory of the CPU as NumPy sees it; of sequences, a new array."""
    if isinstance(array, np.ndarray):
        return array
    if hasattr(array, "__cuda_array_interface__") or _device_of(array) not in (_CPU, _PINNED):
        raise NotImplementedError(
            f"{name} lie on a GPU, and arrays are read in the memory of the CPU: copy them there"
            " (torch: .cpu(), cupy: .get())"
        )
    if hasattr(array, "__dlpack__"):
        if getattr(array, "requires_grad", False):  # pairs have no gradient
            array = array.detach()
        view: NDArray[Any] = np.from_dlpack(array)
        return view
    return np.asarray(array)


def _device_of(array: Any) -> int:
    device = getattr(array, "__dlpack_device__", None)
    return int(device()[0]) if device is not None else _CPU


def converter_for(array: Any) -> Convert | None:
    """Returns what makes an array of the same package of a NumPy array; None for NumPy's own."""
    if isinstance(array, np.ndarray) or not hasattr(array, "__dlpack__"):
        return None
    package = type(array).__module__.partition(".")[0]
    package = {"jaxlib": "jax"}.get(package, package)
    module = sys.modules.get("jax.numpy" if package == "jax" else package)
    convert: Convert | None = getattr(module, "from_dlpack", None)
    return convert
