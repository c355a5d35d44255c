# SPDX-License-Identifier: MIT
"""A slice of scripts/mutate_import.py: mutants are refused, or read as a plain reader does."""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path

import pytest

from octocell_import.formats import FORMATS, OCTOCELL

sys.path.insert(0, str(Path(__file__).parents[2] / "scripts"))

import mutate_import
from import_mutants import PLAIN_READERS, SAMPLES

MUTANTS = 200  # of each format; a second for all


def test_every_format_has_a_plain_reader():
    assert set(PLAIN_READERS) == set(SAMPLES) == set(FORMATS) - set(OCTOCELL)


@pytest.mark.parametrize("name", sorted(SAMPLES))
def test_samples_are_read_alike(name):
    for content in SAMPLES[name]:
        assert mutate_import.judge(name, content) == ("read by both", "")


@pytest.mark.parametrize("name", sorted(SAMPLES))
def test_mutants_are_refused_or_read_alike(name):
    outcomes = Counter()
    for mutant in mutate_import.mutants(name, MUTANTS, seed=3):
        outcome, detail = mutate_import.judge(name, mutant)
        assert outcome != "fault", (detail, mutant)
        outcomes[outcome] += 1
    assert outcomes["read by both"] > 10 and outcomes["refused by both"] > 10


@pytest.mark.parametrize("fault", ["value", "more", "exception"])
def test_faults_are_seen(monkeypatch, fault):
    def wrong(name: str, content: bytes) -> list:
        if fault == "exception":
            raise ValueError("a traceback")
        return [[(11.5, 6.134, -6.504)]] if fault == "value" else right(name, content) * 2

    right = mutate_import.read_ours
    monkeypatch.setattr(mutate_import, "read_ours", wrong)
    assert mutate_import.judge("pdb", SAMPLES["pdb"][0])[0] == "fault"
