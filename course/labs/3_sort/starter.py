# SPDX-License-Identifier: MIT
"""A digit of one bit: entries with a 0 move to the front, those with a 1 behind them."""

import numpy as np


def exclusive_sum(numbers):
    """Your part: [3, 0, 2] becomes [0, 3, 3]."""
    return np.zeros_like(numbers)


def sort_by_bit(ids, objects, bit):
    """Your part: entries with a 0 in this bit of their id first, then those with a 1; within each,
    in the order in which they were."""
    return ids, objects


def sort(ids, objects, key_bits):
    ids = ids.astype(np.int64)
    for bit in range(key_bits):
        ids, objects = sort_by_bit(ids, objects, bit)
    return ids, objects
