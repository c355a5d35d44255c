# SPDX-License-Identifier: MIT
"""`octocell check`, `list`, `--help` and `--version`."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from program import ROOT, Octocell
from exact import exact_pairs
from hard_scenes import SCENES

GENERATORS = "gas dense poly cluster lattice shifted giant discs identical chain fcc".split()


def labels(octocell: Octocell) -> list[str]:
    """What stands at the head of each row of `check`."""
    rows = []
    for _, backend, *rest in octocell.implementations():
        kind = {"--rule": "home_phantom ", "--method": ""}.get(rest[0], "") if rest else ""
        rows.append(" ".join([backend, f"{kind}{rest[1]}"]) if rest else backend)
    return rows


def test_check_tries_every_implementation_on_every_generator(octocell: Octocell) -> None:
    text = octocell.ok("check", timeout=240).stdout
    heads = re.findall(r"^(\w+):n=2000\S* \(2000 spheres, \d+ pairs\)$", text, re.MULTILINE)
    assert heads == GENERATORS
    unavailable = octocell.unavailable()
    blocks = re.split(r"^\S+ \(2000 spheres.*\n", text, flags=re.MULTILINE)[1:]
    for block in blocks:
        rows = re.findall(r"^  \w.*$", block, re.MULTILINE)
        assert [row[:44].strip() for row in rows] == labels(octocell)
        for row in rows:
            backend, verdict = row.split()[0], row[44:].strip()
            if backend in unavailable:
                assert verdict == f"skipped: {unavailable[backend]}"
                continue
            excused = "as_written" in row or "a known issue of the library" in row
            assert verdict == "exact" or excused, row
    last = r"^\d+ exact, 0 wrong, \d+ known issues, \d+ negative controls with losses, (\d+) skipped$"
    skipped = re.search(last, text, re.MULTILINE)
    assert skipped and int(skipped[1]) == text.count(" skipped: ")


def test_check_reports_known_issues_and_fails_for_them_if_strict(octocell: Octocell) -> None:
    assert octocell.faulty() == {"fcl_sap", "fcl_interval_tree", "fcl_spatial_hashing"}
    args = ("check", "lattice:n=3000", "--backend", "fcl_sap")
    text = octocell.ok(*args).stdout
    row = (
        r"^  fcl_sap +wrong: missed [1-9]\d* \([\d.e+]+ per million, deepest 0 of r1 \+ r2\), false 0,"
        r" duplicates 0 \(a known issue of the library"
    )
    assert re.search(row, text, re.MULTILINE), text
    assert "0 exact, 0 wrong, 1 known issues, 0 negative controls with losses, 0 skipped" in text
    assert octocell.run(*args, "--strict").rc == 1
    assert octocell.run("check", "gas:n=500", "--strict").rc == 0


def test_check_says_what_a_baseline_cannot_hold(octocell: Octocell) -> None:
    text = octocell.ok("check", "gas:n=33000", "--backend", "bullet_axis_sweep").stdout
    assert "skipped: btAxisSweep3 holds at most 32766 proxies, and there are 33000 spheres" in text


def test_the_timeout_ends_a_baseline(octocell: Octocell) -> None:
    args = ("check", "gas:n=30000", "--backend", "bullet_simple", "--timeout", 0.05)
    text = octocell.ok(*args).stdout
    assert "skipped: no answer within 0.05 s" in text
    for bad in ("0", "-1", "nan", "1e9"):
        result = octocell.run("check", "gas:n=9", "--timeout", bad)
        assert (result.rc, result.stderr.count("\n")) == (2, 1), bad
        assert "--timeout" in result.stderr


@pytest.mark.parametrize("name", ["an_ulp_apart", "nine_decades_of_radius", "empty", "denormals"])
def test_check_of_a_file(octocell: Octocell, name: str, tmp_path: Path) -> None:
    path = tmp_path / f"{name}.npy"
    np.save(path, SCENES[name])
    text = octocell.ok("check", path).stdout
    assert f"({len(SCENES[name])} spheres, {len(exact_pairs(SCENES[name]))} pairs)" in text
    assert ", 0 wrong, " in text


def test_check_of_one_backend(octocell: Octocell) -> None:
    text = octocell.ok("check", "gas:n=100", "--backend", "bullet_dbvt").stdout
    assert len(text.splitlines()) == 3
    assert "1 exact, 0 wrong, 0 known issues, 0 negative controls with losses, 0 skipped" in text


def test_check_shows_the_losses_of_as_written(octocell: Octocell) -> None:
    text = octocell.ok("check", "gas:n=2000", "--backend", "impl_cpu").stdout
    row = next(line for line in text.splitlines() if "as_written" in line)
    losses = r"missed (\d+) \((\S+) per million, deepest (\S+) of r1 \+ r2\), false 0, duplicates 0"
    missed = re.search(losses + r" \(a negative control", row)
    assert missed and int(missed[1]) > 0
    true_pairs = int(re.search(r"(\d+) pairs\)", text)[1])
    assert float(missed[2]) == pytest.approx(1e6 * int(missed[1]) / true_pairs, rel=1e-2)
    assert 0 < float(missed[3]) <= 1
    assert "1 negative controls with losses" in text


def test_check_says_why_a_row_is_skipped(octocell: Octocell) -> None:
    text = octocell.ok("check", "shifted:n=99,offset=1e9", "--backend", "impl_cpu").stdout
    row = next(line for line in text.splitlines() if " chapter32 " in line[:44])
    assert "skipped: rule chapter32 does not hold for this scene" in row
    assert text.endswith("1 skipped\n")


def test_the_candidate_limit_skips_rows(octocell: Octocell) -> None:
    text = octocell.ok("check", "gas:n=1000", "--candidate-limit", 10).stdout
    assert "0 exact" in text
    assert "skipped: 499500 candidates, over the limit of 10" in text  # brute force


def test_list_prints_everything(octocell: Octocell) -> None:
    folders = {path.name for path in ROOT.glob("impl_*")}
    assert {name.removesuffix("_cuda") for name in octocell.listed("backends")} == folders
    assert set(octocell.listed("baselines")) >= {"bullet_dbvt", "fcl_dynamic_aabb_tree"}
    assert octocell.listed("scenes") == GENERATORS
    text = octocell.ok("list").stdout
    for word in ("home_phantom", "brute_force", "lowest_cell", "chapter32", "as_written"):
        assert word in text
    for line in text.splitlines():
        if re.match(r"  (impl|fcl|bullet)_", line):
            assert line.endswith("available") or "not here: " in line


def test_help_and_version(octocell: Octocell) -> None:
    text = octocell.ok("--help").stdout
    for command in ("find", "check", "list", "generate", "bench"):
        assert command in text
        assert octocell.ok(command, "--help").stdout
    assert re.fullmatch(r"\d+\.\d+\.\d+\n", octocell.ok("--version").stdout)
