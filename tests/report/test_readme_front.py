# SPDX-License-Identifier: MIT
"""The README's three numbers, in both languages."""

from __future__ import annotations

import pytest

from octocell_report import readme_bench, readme_gpu, readme_guarantee, verification, words
from octocell_report.fields import ReportError
from octocell_report.load import parse

import synthetic
import synthetic_guarantee
from synthetic import group, row


@pytest.fixture
def headline():
    rows = [
        row(method="planned", rule=None, run="cold", total_ms=[2.0, 2.0, 2.0]),
        row("fcl_a", None, None, run="cold", total_ms=[9.0, 8.0, 7.0]),
        row("fcl_b", None, None, run="cold", total_ms=[90.0, 80.0, 70.0]),
        row("bullet_dbvt", None, None, run="cold", total_ms=[30.0, 30.0, 30.0]),
    ]
    return synthetic.document([group("gas", 1000)], rows)


def test_a_library_is_held_against_our_plan_by_its_fastest(headline):
    said, chinese = readme_bench.front(parse(headline))
    n = words.grouped(1000)
    assert said == (
        "**4 times** as fast as FCL's fastest broad phase, **15 times** as fast as Bullet's "
        f"fastest broad phase: {n} spheres, from nothing, in 2.00 ms on one thread of "
        "Example CPU 9000 (commit 01234567)"
    )
    assert all(word in chinese for word in ("**4 倍**", "**15 倍**", "2.00", "01234567"))


def test_there_must_be_a_plan(headline):
    headline["rows"] = headline["rows"][1:]
    with pytest.raises(ReportError, match="front_libraries"):
        readme_bench.front(parse(headline))


def test_a_device_must_have_a_million_spheres(headline):
    with pytest.raises(ReportError, match="front_gpu"):
        readme_gpu.front(parse(headline))


def test_wrong_answers_are_counted_by_owner(tmp_path):
    found = verification.read(synthetic_guarantee.save_all(tmp_path))
    english, chinese = readme_guarantee.front(found)
    assert english.startswith("wrong answers on scenes made to break broad phases: Octocell **")
    assert "FCL **" in english and "FCL" in chinese and english.count("**") == chinese.count("**")
