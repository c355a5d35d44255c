# SPDX-License-Identifier: MIT
"""Arrays of any package with DLPack go in, and come out of the same package."""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any

import numpy as np
import octocell
import pytest
from exact import exact_pairs

SPHERES = np.random.default_rng(2).uniform(0, 3, (60, 4)).astype(np.float32)


class Tensor:
    """An array that can do nothing but DLPack."""

    def __init__(self, held: Any) -> None:
        self.held = np.asarray(held)

    def __dlpack__(self, **how: Any) -> Any:
        return self.held.__dlpack__(**how)

    def __dlpack_device__(self) -> tuple[int, int]:
        return self.held.__dlpack_device__()


@pytest.fixture
def package(monkeypatch: pytest.MonkeyPatch) -> None:
    module = ModuleType("someones")
    module.from_dlpack = lambda array: Tensor(np.from_dlpack(array))  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "someones", module)
    monkeypatch.setattr(Tensor, "__module__", "someones.tensors")


@pytest.mark.usefixtures("package")
def test_results_are_of_the_package_of_the_centers() -> None:
    found = octocell.pairs(Tensor(SPHERES))
    results = [found.i, found.j, found.array, *found.to_csr(), found.to_edge_index()]
    results += [found.to_edge_index(both=False), found.to_matrix(60)]
    assert all(type(result) is Tensor for result in results)
    np.testing.assert_array_equal(found.array.held, exact_pairs(SPHERES))
    apart = octocell.pairs(Tensor(SPHERES[:, :3].copy()), Tensor(SPHERES[:, 3].copy()))
    np.testing.assert_array_equal(apart.array.held, exact_pairs(SPHERES))
    assert type(next(octocell.chunks(Tensor(SPHERES))).i) is Tensor
    assert type(octocell.Finder().find(Tensor(SPHERES)).i) is Tensor


@pytest.mark.usefixtures("package")
def test_nothing_is_copied_on_the_way() -> None:
    found = octocell.pairs(Tensor(SPHERES))
    assert np.shares_memory(found.i.held, np.asarray(found))


def test_without_a_way_back_results_are_numpys() -> None:
    found = octocell.pairs(Tensor(SPHERES))
    np.testing.assert_array_equal(found.array, exact_pairs(SPHERES))
