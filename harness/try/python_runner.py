# SPDX-License-Identifier: MIT
"""The process of a hand-in in Python: answers questions until there are no more (protocol.hpp).

python3 -c "$(cat python_runner.py)" FILE FUNCTION
"""

import importlib.util
import mmap
import os
import struct
import sys
import traceback

ARRAYS, FAILED = 0, 1
FUNCTION = sys.argv[2]
questions = os.fdopen(3, "rb")
answers = os.fdopen(4, "wb")


def answer(ending, text="", arrays=()):
    raw = text.encode()[:4096]
    data = [array.tobytes() for array in arrays] + [b""] * (2 - len(arrays))
    answers.write(struct.pack("<IIQQ", ending, len(raw), *map(len, data)) + raw)
    for part in data:
        answers.write(part)
    answers.flush()


def fail(text):
    answer(FAILED, text)
    os._exit(0)


def load(path):
    """The hand-in's function."""
    sys.path.insert(0, os.path.dirname(os.path.abspath(path)))
    spec = importlib.util.spec_from_file_location("hand_in", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["hand_in"] = module
    spec.loader.exec_module(module)
    if not callable(getattr(module, FUNCTION, None)):
        fail(f"it defines no function {FUNCTION}({', '.join(PARAMETERS[FUNCTION])})")
    return getattr(module, FUNCTION)


def on_the_host(found, width, type_):
    """A NumPy array of what was returned: also arrays of CuPy, Torch, Warp, and lists of tuples."""
    for name in ("cpu", "get", "numpy"):
        if not isinstance(found, numpy.ndarray) and callable(getattr(found, name, None)):
            found = getattr(found, name)()
    array = numpy.asarray(found)
    if array.size == 0:
        return numpy.empty(0, type_)
    if array.ndim != (1 if width == 1 else 2) or (width > 1 and array.shape[1] != width):
        expected = "(M,)" if width == 1 else f"(M, {width})"
        fail(f"{FUNCTION} returned shape {array.shape}, expected {expected}")
    if array.dtype.kind not in "iu":
        fail(f"{FUNCTION} returned numbers of type {array.dtype}, expected integers")
    return array.astype(type_)  # an id of 2^63 and more becomes a negative one: out of range, too


def outputs_of(found):
    if FUNCTION in ("cell_ids", "sort"):
        if not isinstance(found, tuple | list) or len(found) != 2:
            fail(f"{FUNCTION} returned no ids, objects")
        return [on_the_host(array, 1, numpy.uint32) for array in found]
    if FUNCTION == "cell_index":
        return [on_the_host(found, 3, numpy.uint32)]
    return [on_the_host(found, 2, numpy.int64)]


class Grid:
    """corner: three floats; side: a float; cells: three whole numbers (octocell_stage.h)."""

    def __init__(self, raw):
        *corner, self.side, x, y, z = struct.unpack("<4d3I4x", raw)
        self.corner, self.cells = tuple(corner), (x, y, z)


def array_of(dtype, *shape):
    return lambda raw: numpy.frombuffer(raw, dtype).reshape(-1, *shape).copy()


# What each function takes, and how the bytes of a question become that.
SPHERES = {"spheres": array_of("<f4", 4)}
ENTRIES = {"ids": array_of("<u4"), "objects": array_of("<u4")}
PARAMETERS = {
    "find_pairs": SPHERES,
    "cell_ids": {**SPHERES, "grid": Grid},
    "sort": {**ENTRIES, "key_bits": None},
    "cell_index": ENTRIES,
    "pair_tests": {**SPHERES, **ENTRIES, "cells": array_of("<u4", 3)},
}


def answer_timed(function, n, capacity):
    """By the memories that are shared with the judge (board.hpp)."""
    list_at = 4096 + 65536
    spheres = numpy.frombuffer(mmap.mmap(5, 0, access=mmap.ACCESS_READ), "<f4", 4 * n)
    memory = mmap.mmap(6, 0)
    answer(ARRAYS)
    questions.read(1)
    found = on_the_host(function(spheres.reshape(n, 4)), 2, numpy.uint32)
    fits = found[:capacity]
    numpy.frombuffer(memory, "<u4", fits.size, list_at)[:] = fits.ravel()
    memory[:8] = struct.pack("<Q", len(found))
    answer(ARRAYS)


def answer_all(function):
    answer(ARRAYS)
    while head := questions.read(72):
        capacity, most, key_bits, is_timed, timed_spheres, *sizes = struct.unpack("<9Q", head)
        if is_timed:
            answer_timed(function, timed_spheres, capacity)
            continue
        raw = [questions.read(size) for size in sizes]
        takes = PARAMETERS[FUNCTION].values()
        given = [take(part) if take else key_bits for take, part in zip(takes, raw, strict=False)]
        outputs = outputs_of(function(*given))
        for value, part in zip(given, raw, strict=False):
            if isinstance(value, numpy.ndarray) and value.tobytes() != part:
                fail(
                    "it changed the spheres" if FUNCTION == "find_pairs" else "it changed its input"
                )
        entries = len(outputs[0])
        if entries > most:
            what = "pairs" if FUNCTION in ("find_pairs", "pair_tests") else "entries"
            fail(f"it gives {entries} {what}; at most {most} are read")
        answer(ARRAYS, arrays=outputs)


try:
    import numpy

    answer_all(load(sys.argv[1]))
except MemoryError:
    fail("not enough memory")
except Exception as error:  # the hand-in's own
    traceback.print_exc()
    last = traceback.extract_tb(error.__traceback__)[-1]
    fail(f"{type(error).__name__}: {error} ({os.path.basename(last.filename)}:{last.lineno})")
