# SPDX-License-Identifier: MIT
"""Decimals become the nearest float32, as if there were no float64 on the way."""

from __future__ import annotations

import random
from fractions import Fraction

import numpy as np
import pytest

from octocell_import.decimals import NotAFloat, to_float32

MIDWAY = "1.000000059604644775390625"  # between 1 and the next float32


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        (MIDWAY, 1.0),  # a tie goes to the even one
        (MIDWAY + "0000000000001", np.nextafter(np.float32(1), np.float32(2))),
        (MIDWAY[:-1] + "4999999999", 1.0),
        ("16777217", 16777216),
        ("16777217.0000000000001", 16777218),
        ("-16777217.0000000000001", -16777218),
        ("7.006492321624085e-46", 0),
        ("7.006492321624086e-46", 2.0**-149),
        ("1e-400", 0),
        ("3.4028235e38", np.finfo(np.float32).max),
        (" 1.5 ", 1.5),
    ],
)
def test_words_are_rounded_once(word, expected):
    assert to_float32([word])[0] == np.float32(expected)


def test_going_by_way_of_float64_would_be_wrong():
    """The cases above can fail: the short way does."""
    assert np.float32(float(MIDWAY + "0000000000001")) == 1


def test_random_words_near_tangent_are_nearest():
    dice = random.Random(3)
    for _ in range(500):
        low = np.float32(dice.uniform(-100, 100))
        high = np.nextafter(low, np.float32(np.inf))
        middle = (Fraction(float(low)) + Fraction(float(high))) / 2
        offset = Fraction(dice.choice((-1, 1)), 10 ** dice.choice((20, 30)))
        digits = 60
        scaled = round((middle + offset) * 10**digits)
        found = to_float32([f"{scaled}e-{digits}"])[0]
        assert found == (high if offset > 0 else low)


@pytest.mark.parametrize("exponent", [-1, 0, 1])
@pytest.mark.parametrize("kind", ["S", object])
def test_shifted_words_near_ties_are_nearest_too(exponent, kind):
    """In float64 the shift itself is inexact: it must not decide."""
    dice = random.Random(5)
    words, nearest, by_float64 = [], [], []
    for _ in range(500):
        low = np.float32(dice.uniform(-100, 100))
        high = np.nextafter(low, np.float32(np.inf))
        middle = (Fraction(float(low)) + Fraction(float(high))) / 2
        offset = Fraction(dice.choice((-1, 1)), 10 ** dice.choice((15, 17, 20, 30)))
        digits = 60
        scaled = round((middle + offset) / Fraction(10) ** exponent * 10**digits)
        words.append(f"{scaled}e-{digits}".encode())
        nearest.append(high if offset > 0 else low)
        by_float64.append(np.float32(float(words[-1]) * 10.0**exponent))
    column = np.array(words, kind)
    np.testing.assert_array_equal(to_float32(column, exponent), nearest)
    assert by_float64 != nearest  # the short way fails


def test_the_largest_numbers_are_rounded_once():
    limit = Fraction(2) ** 128 - Fraction(2) ** 103  # midway between the largest and 2^128
    assert to_float32([f"{limit - 1}"])[0] == np.finfo(np.float32).max
    with pytest.raises(NotAFloat, match="too large"):
        to_float32([f"{limit}"])


def test_what_is_not_strict_is_nan():
    words = np.array([b"1", b"x", b"nan", b"1e99", b"1_0", b"2"])
    np.testing.assert_array_equal(to_float32(words, strict=False), [1, *[np.nan] * 4, 2])


@pytest.mark.parametrize(("word", "exponent"), [("0.126", 1), ("1.26e-1", 1), ("12.6", -1)])
def test_units_shift_the_point_of_the_decimal(word, exponent):
    assert to_float32([word], exponent)[0] == np.float32("1.26")


def test_a_shift_is_not_a_multiplication_of_what_was_rounded():
    words = [f"{k / 1000:.3f}" for k in range(1, 9000)]
    once = to_float32(words, 1)
    assert (once == to_float32([f"{k / 100:.2f}" for k in range(1, 9000)])).all()
    assert (once != to_float32(words) * np.float32(10)).any()


@pytest.mark.parametrize("word", ["", "x", "1_0", "\u0661", "0x10", "1,5", "1e"])
def test_what_is_no_number_is_named_with_its_index(word):
    for exponent in (0, 1):
        with pytest.raises(NotAFloat, match="is not a number") as error:
            to_float32(["1", word], exponent)
        assert error.value.index == 1


@pytest.mark.parametrize(("word", "why"), [("nan", "finite"), ("-inf", "finite"), ("1e39", "large"),
                                           ("1e999", "large"), ("4e38", "large")])  # fmt: skip
def test_what_has_no_float32_is_refused(word, why):
    with pytest.raises(NotAFloat, match=why):
        to_float32(["1", word])


def test_arrays_are_rounded_once_too():
    single = np.array([0.1, 1.7], np.float32)
    assert (to_float32(single) == single).all()
    assert (to_float32(single, 1) == (single.astype(np.float64) * 10).astype(np.float32)).all()
    with pytest.raises(NotAFloat, match="too large"):
        to_float32(np.array([1e39]))
    with pytest.raises(NotAFloat, match="not a finite"):
        to_float32(np.array([np.nan]))
