# SPDX-License-Identifier: MIT
"""Two results side by side: what is called faster or slower, and what is not."""

from __future__ import annotations

import json

import pytest

from octocell_report.cli import main
from octocell_report.compare import compare, interval, report, warnings
from octocell_report.load import parse

import synthetic
from synthetic import group, row, skipped, unavailable_group, wrong

STEADY = [1.0, 1.01, 0.99, 1.02, 0.98]


def result_of(*rows, **changes):
    groups = [group("gas", 1000), unavailable_group()]
    return parse(synthetic.document(groups, list(rows), **changes))


def scaled(times, factor):
    return [factor * t for t in times]


def verdict(old, new, threshold=0.05):
    found = compare(result_of(row(total_ms=old)), result_of(row(total_ms=new)), threshold)
    return found["verdict"].item()


@pytest.mark.parametrize(
    ("factor", "expected"),
    [
        (1.0, "within the noise"),
        (1.04, "within the noise"),
        (1.2, "slower"),
        (0.8, "faster"),
        (0.97, "within the noise"),
    ],
)
def test_only_what_is_beyond_threshold_and_spread_is_a_change(factor, expected):
    assert verdict(STEADY, scaled(STEADY, factor)) == expected


def test_a_large_change_within_the_spread_is_none():
    assert verdict([1.0, 2.0, 0.5, 1.5, 0.7], [1.3, 2.2, 0.6, 1.6, 0.9]) == "within the noise"


def test_a_row_compared_with_itself_is_the_same():
    assert interval(STEADY, STEADY)[0] < 1 < interval(STEADY, STEADY)[1]
    assert verdict(STEADY, STEADY, threshold=0.0) == "within the noise"


def test_the_threshold_is_the_caller_s():
    slower = scaled(STEADY, 1.2)
    assert verdict(STEADY, slower, threshold=0.3) == "within the noise"
    assert verdict(STEADY, scaled(STEADY, 1.07), threshold=0.0) == "slower"


def test_the_interval_holds_the_ratio_and_narrows_with_rounds():
    wide, narrow = (
        interval(times, scaled(times, 1.5)) for times in (STEADY, STEADY * 8)
    )  # fmt: skip
    for low, high in (wide, narrow):
        assert low < 1.5 < high
    assert narrow[1] - narrow[0] < wide[1] - wide[0]
    assert wide == interval(STEADY, scaled(STEADY, 1.5))  # no chance in it


def test_two_rounds_are_too_few_to_judge():
    assert verdict([1.0, 1.0], [5.0, 5.0]) == "not judged"
    assert verdict([1.0, 1.0, 1.0], [5.0, 5.0, 5.0]) == "slower"


def test_moving_scenes_are_compared_by_their_steady_frames():
    def moving(first):
        frame_ms = [[first, t, t] for t in STEADY]
        frames = {"scene": "gas", "frame_ms": frame_ms, "warmup_frames": 1}
        return result_of(row(run="dynamic", frames=frames, total_ms=[first] * 5))

    assert compare(moving(1.0), moving(50.0), 0.05)["ratio"].item() == 1.0


def test_rows_of_one_file_and_changed_verdicts_are_listed():
    old = result_of(
        row(),
        row(run="cold"),
        row("fcl_a", None, None),
        row(rule="as_written", negative_control=True),
    )
    new = result_of(
        wrong(row(), missed=3),
        skipped(row("fcl_a", None, None), "crashed"),
        row("bullet_a", None, None),
        row(rule="as_written", negative_control=True),
    )
    text = "\n".join(report(old, new, 0.05)[0])
    assert "lowest_cell/scene:gas/n:1000/threads:1/run:warm: exact -> wrong −3 +0" in text
    assert "run:warm: exact -> skipped (crashed)" in text
    assert "only in the old file: 1\n  find_pairs/" in text
    assert "only in the new file: 1\n  find_pairs/backend:bullet_a" in text
    assert "0 rows compared" in text and "as_written" not in text


def test_scenes_that_are_not_the_same_are_not_compared():
    old, other = result_of(row()), synthetic.document([group("gas", 1000)], [row(pairs=7)])
    other["groups"][0]["truth"]["pairs"] = 7
    found = compare(old, parse(other), 0.05)
    assert found["verdict"].item() == "other scene" and found["ratio"].isna().all()


def test_other_machines_and_compilers_are_warned_of():
    old, new = result_of(row()), result_of(row(), compiler="g++ 13.1", dirty=True, finished=False)
    new.context["machine"] |= {"cpu": "Other CPU"}
    new.context["libraries"] = {"fcl": "0.7.1", "benchmark": "1.7.1"}
    new.context["gpu"] = {"name": "Example GPU", "copy_gigabytes_per_second": 1.0}
    assert warnings(old, old) == []
    assert warnings(old, new) == [
        "other compiler: g++ 12.2.0 / g++ 13.1",
        "other machine cpu: Example CPU 9000 / Other CPU",
        "other libraries fcl: 0.7.0 / 0.7.1",
        "other libraries bullet: 3.24 / None",
        "other gpu name: None / Example GPU",
        "the new result was built from changed sources",
        "the new run was interrupted",
    ]


@pytest.fixture
def files(tmp_path):
    """Paths of an old file and of one in which one row is slower and another faster."""

    def write(name, ours, theirs):
        rows = [row(total_ms=ours), row("fcl_a", None, None, total_ms=theirs)]
        path = tmp_path / name
        path.write_text(json.dumps(synthetic.document([group("gas", 1000)], rows)))
        return str(path)

    return write("old.json", STEADY, STEADY), write(
        "new.json", scaled(STEADY, 1.5), scaled(STEADY, 0.5)
    )


def test_the_command_prints_a_table_and_exits_0(files, capsys):
    assert main(["compare", *files]) == 0
    text = capsys.readouterr().out
    assert "\nslower: 1\n" in text and "\nfaster: 1\n" in text
    assert "1.500" in text and "backend:impl_cpu/" in text
    assert "2 rows compared: 1 slower, 1 faster, 0 within the noise, 0 not judged" in text
    assert "baselines, as a measure of drift: median ratio 0.500 of 1 rows" in text


def test_slower_rows_fail_only_if_asked(files):
    old, new = files
    assert main(["compare", old, new, "--fail-on-slower"]) == 1
    assert main(["compare", old, new, "--fail-on-slower", "--threshold", "0.9"]) == 0
    assert main(["compare", old, old, "--fail-on-slower"]) == 0


def test_another_schema_is_refused(files, tmp_path, capsys):
    path = tmp_path / "other.json"
    path.write_text('{"schema": 3}')
    assert main(["compare", files[0], str(path)]) == 2
    assert "schema 3 is not the schema 2" in capsys.readouterr().err


@pytest.mark.parametrize("share", ["-1", "much", "nan", "inf"])
def test_a_bad_threshold_is_refused(files, share, capsys):
    with pytest.raises(SystemExit) as error:
        main(["compare", *files, f"--threshold={share}"])
    assert error.value.code == 2 and "is not a number, 0 or more" in capsys.readouterr().err
