# SPDX-License-Identifier: MIT
"""octocell.pairs and its relatives against the definition."""

from __future__ import annotations

import doctest
import gc
import importlib
import itertools
import pickle
import pkgutil
import threading
import tracemalloc
from typing import Any

import numpy as np
import octocell
import pytest
from exact import exact_pairs
from numpy.typing import NDArray

Spheres = NDArray[np.float32]


def gas(count: int, seed: int = 1, side: float = 6.0) -> Spheres:
    random = np.random.default_rng(seed)
    spheres = random.uniform(0, side, (count, 4)).astype(np.float32)
    spheres[:, 3] = random.uniform(0.1, 0.5, count)
    return spheres


def lattice() -> Spheres:
    """All neighbors touch."""
    places = np.stack(np.meshgrid(*[np.arange(5)] * 3), axis=-1).reshape(-1, 3)
    return np.hstack([places, np.full((125, 1), 0.5)]).astype(np.float32)


SCENES = [
    gas(300),
    lattice(),
    np.zeros((20, 4), np.float32),
    np.empty((0, 4), np.float32),
    gas(1),
]


@pytest.mark.parametrize("spheres", SCENES, ids=["gas", "lattice", "points", "empty", "one"])
def test_all_functions_agree_with_the_definition(spheres: Spheres) -> None:
    expected = exact_pairs(spheres)
    found = octocell.pairs(spheres)
    np.testing.assert_array_equal(found.array, expected)
    np.testing.assert_array_equal(found.i, expected[:, 0])
    np.testing.assert_array_equal(found.j, expected[:, 1])
    apart = octocell.pairs(spheres[:, :3], spheres[:, 3])
    np.testing.assert_array_equal(apart.array, expected)
    assert found.count == len(found) == octocell.count(spheres) == len(expected)
    assert list(found) == [tuple(pair) for pair in expected.tolist()]
    in_chunks = [chunk.array for chunk in octocell.chunks(spheres, pairs=7)]
    assert all(len(chunk) > 0 for chunk in in_chunks)
    np.testing.assert_array_equal(np.concatenate([np.empty((0, 2)), *in_chunks]), expected)
    assert octocell.verify(spheres, None, expected).exact
    np.testing.assert_array_equal(octocell.Finder().find(spheres).array, expected)


def test_unsorted_pairs_are_the_same_set() -> None:
    spheres = gas(2000, side=12)
    sets = [set(octocell.pairs(spheres, sort=sort, threads=2)) for sort in (True, False)]
    assert sets[0] == sets[1] and len(sets[0]) > 100


@pytest.mark.parametrize("dtype", ["int32", "int64", "uint32"])
def test_ids_have_the_type_that_was_asked_for(dtype: str) -> None:
    spheres = gas(100)
    found = octocell.pairs(spheres, index_dtype=dtype)
    assert found.i.dtype == found.j.dtype == found.array.dtype == dtype
    np.testing.assert_array_equal(found.array, exact_pairs(spheres))
    indptr, indices = found.to_csr()
    assert (indptr.dtype, indices.dtype) == (np.int64, dtype)
    assert found.to_edge_index().dtype == found.to_edge_index(both=False).dtype == dtype
    assert found.to_matrix(100).dtype == dtype
    assert octocell.Finder(index_dtype=dtype).find(spheres).i.dtype == dtype
    assert next(octocell.chunks(spheres, index_dtype=dtype)).i.dtype == dtype


def test_layouts_hold_the_same_pairs() -> None:
    spheres = gas(200, side=3)
    pairs = {tuple(pair) for pair in exact_pairs(spheres).tolist()}
    both = pairs | {(j, i) for i, j in pairs}
    found = octocell.pairs(spheres)
    for ordered, wanted in ((True, both), (False, pairs)):
        indptr, indices = found.to_csr(both=ordered)
        rows = [indices[a:b].tolist() for a, b in itertools.pairwise(indptr)]
        assert all(row == sorted(row) for row in rows)
        listed = [(i, j) for i, row in enumerate(rows) for j in row]
        assert listed == sorted(wanted)
        assert [tuple(edge) for edge in found.to_edge_index(both=ordered).T.tolist()] == listed
        width = max(map(len, rows))
        matrix = found.to_matrix(width, both=ordered, fill=-7).tolist()
        assert [[j for j in row if j != -7] for row in matrix] == rows
        with pytest.raises(ValueError, match=rf"k={width - 1}: sphere \d+ has {width} neighbors"):
            found.to_matrix(width - 1, both=ordered)
    unsigned = octocell.pairs(spheres, index_dtype="uint32")
    assert unsigned.to_matrix(200).max() == 200
    np.testing.assert_array_equal(np.asarray(found), exact_pairs(spheres))
    np.testing.assert_array_equal(np.from_dlpack(found), exact_pairs(spheres))


def test_rows_of_four_floats_are_read_where_they_lie() -> None:
    spheres = gas(100_000, side=60)
    tracemalloc.start()
    total = octocell.count(spheres)
    assert tracemalloc.get_traced_memory()[1] < 10_000, "a copy of the spheres was made"
    tracemalloc.stop()
    spheres.flags.writeable = False
    found = octocell.pairs(spheres)
    assert len(found) == total
    assert np.shares_memory(found.i, found.array) and np.shares_memory(found.j, found.array)
    assert found.array.flags.writeable


def test_arrays_outlive_what_made_them() -> None:
    spheres = gas(3000, side=10)
    expected = octocell.pairs(spheres).array.copy()
    column = octocell.pairs(spheres).j
    finder = octocell.Finder()
    lent = finder.find(spheres, copy=False).i
    del finder
    gc.collect()
    octocell.pairs(gas(3000, seed=2, side=10))  # would reuse memory that was freed
    np.testing.assert_array_equal(column, expected[:, 1])
    np.testing.assert_array_equal(lent, expected[:, 0])


@pytest.mark.parametrize(
    "change",
    [
        lambda s: np.asfortranarray(s),
        lambda s: np.repeat(s, 2, axis=0)[::2],
        lambda s: s.astype(">f4"),
        lambda s: s[::-1][::-1],
        lambda s: np.frombuffer(b"x" + s.tobytes(), np.uint8)[1:].view(np.float32).reshape(s.shape),
        lambda s: s.tolist(),
    ],
    ids=["fortran", "strided", "big endian", "reversed twice", "unaligned", "lists"],
)
def test_the_form_in_memory_does_not_matter(change: Any) -> None:
    spheres = gas(200)
    expected = exact_pairs(spheres)
    np.testing.assert_array_equal(octocell.pairs(change(spheres)).array, expected)
    apart = change(spheres[:, :3].copy()), change(np.repeat(spheres[:, 3:], 3, axis=1))
    found = octocell.pairs(apart[0], np.asarray(apart[1], np.float32)[:, 0])
    np.testing.assert_array_equal(found.array, expected)


def test_numbers_that_float32_holds_are_accepted() -> None:
    whole = np.random.default_rng(3).integers(0, 9, (60, 3))
    expected = exact_pairs(np.hstack([whole, np.full((60, 1), 1)]).astype(np.float32))
    for dtype in ("int8", "uint16", "int64", "uint64", "float16"):
        np.testing.assert_array_equal(octocell.pairs(whole.astype(dtype), 1).array, expected)
        halves = np.full(60, 1, dtype)
        np.testing.assert_array_equal(octocell.pairs(whole, halves).array, expected)


def test_a_finder_follows_its_frames() -> None:
    spheres = gas(150, side=5)
    finder = octocell.Finder(threads=2)
    random = np.random.default_rng(4)
    for frame in range(7):
        expected = exact_pairs(spheres)
        found = finder.find(spheres, copy=frame % 2 == 0)
        np.testing.assert_array_equal(found.array, expected)
        del found
        spheres[:, :3] += random.normal(0, 0.02, (len(spheres), 3)).astype(np.float32)
        if frame == 5:
            spheres = spheres[:120].copy()


def test_pairs_that_are_lent_stop_the_next_frame() -> None:
    finder = octocell.Finder()
    lent = finder.find(gas(200), copy=False)
    before = lent.array.copy()
    with pytest.raises(BufferError, match="in use: delete them"):
        finder.find(gas(200, seed=9))
    np.testing.assert_array_equal(lent.array, before)
    del lent
    np.testing.assert_array_equal(finder.find(gas(200)).array, before)


def test_searches_run_side_by_side() -> None:
    """Threads of Python run while a search does, and may share a finder."""
    spheres = gas(300)
    finder, expected = octocell.Finder(threads=1), exact_pairs(spheres)
    wrong: list[int] = []

    def work(number: int) -> None:
        for _ in range(20):
            for found in (finder.find(spheres), octocell.pairs(spheres, threads=1)):
                if not np.array_equal(found.array, expected):
                    wrong.append(number)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_the_gil_is_free_during_a_search() -> None:
    """While a thread searches for long, this one goes on."""
    clump = np.zeros((15_000, 4), np.float32)  # 1e8 pairs: a tenth of a second
    clump[:, 3] = 1
    done = threading.Event()

    def work() -> None:
        octocell.count(clump, threads=1)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    steps = 0
    while not done.wait(0.001):
        steps += 1
    thread.join()
    assert steps >= 3


def test_flags_say_who_meets_whom() -> None:
    spheres = np.zeros((4, 4), np.float32)
    still = octocell.flags(static=[True, True, False, False])
    assert set(octocell.pairs(spheres, flags=still)) == {(0, 2), (0, 3), (1, 2), (1, 3), (2, 3)}
    assert octocell.count(spheres, flags=still) == 5
    assert octocell.Finder(flags=still).find(spheres).count == 5
    assert sum(len(c) for c in octocell.chunks(spheres, pairs=1, flags=still)) == 5
    assert octocell.verify(spheres, None, [[0, 1]], flags=still).false_pairs == 1
    assert octocell.flags().tolist() == [0xFFFF0001]


def test_verify_names_what_is_wrong() -> None:
    spheres = [[0, 0, 0, 1], [1, 0, 0, 1], [2, 0, 0, 1], [9, 9, 9, 1]]
    result = octocell.verify(spheres, None, [1, 0, 0, 7], [0, 1, 3, 8])
    assert result == (2, 2, 1, (0, 2), (0, 3), (0, 1)) and not result.exact
    assert octocell.verify(spheres, None, np.empty((0, 2), np.int64)).missed == 3


def test_results_can_be_stored() -> None:
    found = octocell.pairs(gas(100))
    again = pickle.loads(pickle.dumps(found))
    np.testing.assert_array_equal(again.array, found.array)
    assert repr(again) == repr(found) == f"Pairs({len(found)} pairs of 100 spheres)"


def test_docstrings_show_what_happens() -> None:
    tried = 0
    for module in pkgutil.walk_packages(octocell.__path__, "octocell."):
        if module.name.startswith(("octocell._native", "octocell.compat")):
            continue
        names = {"octocell": octocell}
        result = doctest.testmod(importlib.import_module(module.name), extraglobs=names)
        assert result.failed == 0, module.name
        tried += result.attempted
    result = doctest.testmod(octocell, extraglobs={"octocell": octocell})
    assert result.failed == 0 and tried + result.attempted > 20
