# SPDX-License-Identifier: MIT
"""octocell near-tangent: compares the predicate with integers on pairs that nearly touch."""

from pathlib import Path

from program import Octocell, load

FAMILIES = ["tangent", "offset", "exponents", "lattice", "wide", "decimals"]


def test_counts_near_tangent_of_every_family(octocell: Octocell, tmp_path: Path) -> None:
    octocell.ok("near-tangent", "--pairs", "2000", "-o", tmp_path / "near_tangent.json")
    document = load(tmp_path / "near_tangent.json")
    assert document["where"] == "CPU" and "commit" in document["context"]
    assert [family["name"] for family in document["families"]] == FAMILIES
    for family in document["families"]:
        assert family["tried"] >= family["pairs"] >= 2000
        assert family["mismatches"] == 0
        assert 0 < family["float32_wrong"] < family["pairs"]


def test_refuses_what_makes_no_sense(octocell: Octocell, tmp_path: Path) -> None:
    for arguments in (["--pairs", "0"], ["--pairs", "nan"], ["-o", tmp_path]):
        result = octocell.run("near-tangent", *arguments)
        assert result.rc == 2 and result.stderr.count("\n") == 1, result.stderr
