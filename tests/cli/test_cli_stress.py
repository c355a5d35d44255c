# SPDX-License-Identifier: MIT
"""`octocell stress`: a slice of the suite over our backends, its JSON, and what it refuses."""

from __future__ import annotations

from pathlib import Path

import pytest

from program import Json, Octocell, Refused, load

ROW = """entry implementation backend kind method rule status cases spheres pairs missed false
duplicates candidates worst_case reason seconds""".split()
REAL = 14  # scenes, downloaded or not; a slice runs none of them
NOT_RUN = ["H42", "H43", "H44"]


@pytest.fixture(scope="module")
def ours(octocell: Octocell, tmp_path_factory: pytest.TempPathFactory) -> Json:
    path = tmp_path_factory.mktemp("stress") / "new folder" / "ours.json"
    text = octocell.ok(
        "stress", "--size", "slice", "--backend", "ours", "-o", path, timeout=600
    ).stdout
    assert " 0 failures; " in text.splitlines()[-1]
    return load(path)


def test_the_json_says_where_it_comes_from(ours: Json) -> None:
    assert (ours["schema"], ours["kind"]) == (2, "stress")
    context = ours["context"]
    assert context["finished"] is True
    assert context["size"] == "slice"
    assert {"commit", "compiler", "flags", "machine", "date"} <= set(context)


def test_every_entry_is_run_or_says_why_not(ours: Json) -> None:
    ids = [entry["id"] for entry in ours["entries"]]
    numbers = sorted(int(name[1:]) for name in ids if name[0] not in "MR")
    assert numbers == list(range(1, 45))
    assert [name for name in ids if name[0] == "M"] == [f"M{k}" for k in range(1, 11)]
    real = [name for name in ids if name[0] == "R"]
    assert real == [f"R{k}" for k in range(1, REAL + 1)]
    assert [e["id"] for e in ours["entries"] if e["not_run"] and e["id"] not in real] == NOT_RUN
    assert {row["entry"] for row in ours["rows"]} == set(ids) - set(NOT_RUN) - set(real)


def test_rows_of_ours_are_exact_or_refused(ours: Json, octocell: Octocell) -> None:
    backends = set(octocell.listed("backends")) - set(octocell.unavailable())
    assert {row["backend"] for row in ours["rows"]} == backends
    for row in ours["rows"]:
        assert list(row) == ROW
        assert row["kind"] == "backend"
        assert row["missed"] == row["false"] == row["duplicates"] == 0
        assert row["cases"]["wrong"] == row["cases"]["crashed"] == row["cases"]["late"] == 0
        assert (row["reason"] is None) == (row["status"] == "exact"), row
        if row["rule"] == "lowest_cell" or row["method"] == "brute_force":
            assert row["status"] == "exact", row


def test_no_negative_control_takes_part(ours: Json) -> None:
    assert not [row for row in ours["rows"] if row["rule"] == "as_written"]


def test_what_libraries_lose_is_recorded_and_no_failure(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "libraries.json"
    octocell.ok(
        "stress", "--size", "slice", "--backend", "fcl_sap", "--entry", "A1|C20", "-o", path
    )
    lattice, bad_input = load(path)["rows"]
    assert (lattice["status"], bad_input["status"]) == ("wrong", "skipped")
    assert lattice["missed"] > 0
    assert lattice["false"] == 0
    assert lattice["reason"].startswith("missed ")
    assert bad_input["reason"] == "takes its input unseen"


def test_a_library_that_takes_too_long_is_late(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "late.json"
    flags = ("--size", "quick", "--backend", "fcl_interval_tree", "--entry", "E25")
    octocell.ok("stress", *flags, "--timeout", 0.01, "-o", path)
    (row,) = load(path)["rows"]
    assert row["status"] == "late"
    assert row["cases"]["late"] == 1
    assert row["reason"] == "no answer within 0.01 s"


def test_the_list_names_sizes_and_reasons(octocell: Octocell) -> None:
    text = octocell.ok("stress", "--list").stdout
    assert len(text.splitlines()) == 1 + 44 + 10 + REAL
    for name in NOT_RUN:
        assert any(line.startswith(name) and "not run: " in line for line in text.splitlines())


@pytest.mark.parametrize(
    ("flags", "what"),
    [
        (("--size", "huge"), "unknown size 'huge'; known: slice, quick, full"),
        (("--entry", "Z9"), "--entry Z9: no entry of that name"),
        (("--entry", "("), "--entry (: "),
        (("--backend", "nobody"), "unknown backend 'nobody'"),
        (("--timeout", 0), "--timeout 0"),
        (("--threads", -1), "--threads -1"),
        (
            ("--size", "slice", "-o", "/proc/none/stress.json"),
            "cannot write /proc/none/stress.json",
        ),
    ],
)
def test_bad_flags_are_one_line(refused: Refused, flags: tuple[object, ...], what: str) -> None:
    assert what in refused("stress", *flags)
