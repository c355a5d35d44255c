# SPDX-License-Identifier: MIT
"""A digit of one bit: entries with a 0 move to the front, those with a 1 behind them."""

import numpy as np


def exclusive_sum(numbers):
    return np.cumsum(numbers) - numbers


def sort_by_bit(ids, objects, bit):
    ones = ids >> bit & 1
    zeros = 1 - ones
    places = np.where(ones == 0, exclusive_sum(zeros), zeros.sum() + exclusive_sum(ones))
    to_ids, to_objects = np.empty_like(ids), np.empty_like(objects)
    to_ids[places], to_objects[places] = ids, objects
    return to_ids, to_objects


def sort(ids, objects, key_bits):
    ids = ids.astype(np.int64)
    for bit in range(key_bits):
        ids, objects = sort_by_bit(ids, objects, bit)
    return ids, objects
