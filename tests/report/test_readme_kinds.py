# SPDX-License-Identifier: MIT
"""Tables beside libraries, by kind of scene, and frame by frame."""

from __future__ import annotations

import pytest

from octocell_report import readme_bench
from octocell_report.fields import ReportError
from octocell_report.load import parse

from synthetic import document, group, row, skipped, wrong

OURS = {"method": "planned", "rule": None}
LIBRARY = {"method": None, "rule": None}


def cells(block):
    return [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in block.splitlines()
        if line.startswith("|")
    ]


def note(block):
    return block.splitlines()[-1]


def planned(scene="gas", ms=(1.0, 2.0, 3.0), n=1000, run="cold", **changes):
    return row(**OURS, scene=scene, run=run, n=n, total_ms=list(ms), **changes)


def moving(scene, frame_ms, **changes):
    course = {"scene": "brownian", "warmup_frames": 1, "frame_ms": frame_ms}
    return planned(scene, [1.0] * len(frame_ms), run="dynamic", frames=course, **changes)


def test_libraries_are_held_against_the_plan_round_by_round():
    rows = [
        planned(),
        row("bullet_dbvt", **LIBRARY, run="cold", total_ms=[50.0, 110.0, 120.0]),
        wrong(row("fcl_sap", **LIBRARY, run="cold"), missed=7),
        skipped(row("fcl_naive", **LIBRARY, run="cold"), "too slow"),
    ]
    block = readme_bench.against(parse(document([group("gas", 1000)], rows)))
    assert cells(block)[2:] == [
        ["impl_cpu planned", "2.00", "–"],
        ["bullet_dbvt", "110", "50.0 (40.0 to 55.0)"],
        ["fcl_sap", "**wrong −7 +0**", "–"],
    ]
    assert "median of 3 interleaved rounds" in note(block)


def test_scenes_cost_by_sphere_and_true_pair_beside_the_first():
    groups = [
        group("gas", 10),
        group("gas", 1000),
        group("poly", 1000, spec="poly:n=1000,seed=1,phi=0.1,ratio=1000000"),
        group("far", 1000, spec="/tmp/far.npy", truth={"pairs": 0, "checksum": "0x0"}),
        group("bad", 1000),
    ]
    rows = [
        planned(n=10),
        planned(),
        planned("poly", (2.0, 4.0, 6.6)),
        planned("far", (1.0, 1.0, 1.0), pairs=0, checksum="0x0"),
        wrong(planned("bad"), missed=3),
        planned(ms=(0.5, 0.5, 0.5), threads=2, name="two threads"),
        row("impl_thrust", **OURS, run="cold"),  # on one scene alone: no column
    ]
    block = readme_bench.kinds(parse(document(groups, rows)), "cold")
    assert cells(block)[0] == ["scene", "spheres", "pairs", "impl_cpu [ms]", "of gas 1k"]
    assert cells(block)[2:] == [
        ["gas", "10", "20", "2.00", "100 (100 to 100)"],
        ["gas", "1\u202f000", "2\u202f000", "2.00", "1"],
        ["poly, phi 0.1, ratio 1\u202f000\u202f000", *cells(block)[4][1:4], "2.00 (2.00 to 2.20)"],
        ["far", "1\u202f000", "0", "1.00", "1.50 (1.00 to 3.00)"],
        ["bad", "1\u202f000", "2\u202f000", "**wrong −3 +0**", "–"],
    ]
    with pytest.raises(ReportError, match="'kinds_warm' needs warm rows"):
        readme_bench.kinds(parse(document(groups, rows)), "warm")


def test_frames_are_held_against_searches_and_against_silent_flags():
    groups = [
        group("gas_still", 1000),
        group("gas_still_without_flags", 1000),
        group("alone", 1000),
    ]
    times = [[9.0, 1.0, 2.0, 3.0], [9.0, 2.0, 2.0, 2.0], [9.0, 2.0, 2.0, 9.0]]
    slow = [[4 * ms for ms in frames] for frames in times]
    rows = [
        moving("gas_still", times),
        moving("gas_still", slow, skips="rebuilt", name="again"),
        moving("gas_still_without_flags", [[2 * ms for ms in frames] for frames in times]),
        moving("gas_still_without_flags", slow, skips="rebuilt", name="again, without flags"),
        moving("alone", times),  # nothing to hold it against
    ]
    block = readme_bench.frames(parse(document(groups, rows)))
    assert cells(block)[2:] == [
        ["gas_still", "impl_cpu", "2.00", "0.25 (0.25 to 0.25)", "0.50 (0.50 to 0.50)"],
        ["gas_still_without_flags", "impl_cpu", "4.00", "0.50 (0.50 to 0.50)", "–"],
    ]
    assert "4 frames, the first 1 left out" in note(block)
    with pytest.raises(ReportError, match="the variant 'rebuilt'"):
        readme_bench.frames(parse(document(groups, rows[-1:])))


def test_a_plan_alone_is_held_against_nothing():
    with pytest.raises(ReportError, match="of a baseline"):
        readme_bench.against(parse(document([group("gas", 1000)], [planned()])))
