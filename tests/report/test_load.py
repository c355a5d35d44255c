# SPDX-License-Identifier: MIT
from __future__ import annotations

import gzip
import math

import pandas as pd
import pytest

from octocell_report import captions, check
from octocell_report.fields import ReportError
from octocell_report.load import load, parse

import synthetic
import synthetic_ablation
from synthetic import RUN_FACTORS, group, row, skipped, wrong

PLAN = synthetic_ablation.plan()


def one_row(**changes):
    return synthetic.document([group("gas", 1000)], [row() | changes])


def first(document):
    """The first row as users have it."""
    return parse(document).frame.iloc[0]


def test_backends_come_before_baselines_whatever_the_order_of_rows():
    rows = [row("bullet_dbvt", None, None), row()]
    frame = parse(synthetic.document([group("gas", 1000)], rows)).frame
    assert frame.sort_values("order")["backend"].tolist() == ["impl_cpu", "bullet_dbvt"]


@pytest.mark.parametrize(
    ("text", "message"),
    [("{", "not JSON"), ("[]", "no field 'schema'"), ('{"schema": 3}', "schema 3 is not")],
)
def test_what_is_not_a_result_is_named(tmp_path, text, message):
    path = tmp_path / "bad.json"
    path.write_text(text)
    with pytest.raises(ReportError, match=message) as error:
        load(path)
    assert str(path) in str(error.value)
    assert "\n" not in str(error.value)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ReportError, match=r"none\.json: cannot be read: No such file"):
        load(tmp_path / "none.json")


@pytest.mark.parametrize("where", ["context", "groups", "rows"])
def test_what_lacks_a_field_is_named(where):
    document = one_row()
    holder = document[where] if where == "context" else document[where][0]
    optional = {"iterations", "marked_total_ms", "candidate_limit"}
    for field in sorted(set(holder) - optional):
        known = holder.pop(field)
        with pytest.raises(
            ReportError, match=rf"^{where}.*: Object missing .* '{field}'$"
        ) as error:
            parse(document)
        assert where != "rows" or field == "name" or holder["name"] in str(error.value)
        holder[field] = known


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"n": "many"}, r"\.n \(.*\) is \"many\": Expected 'int', got 'str'"),
        ({"threads": True}, r"\.threads \(.*\) is true"),
        ({"run": "hot"}, r"\(cold\|warm\|cold_cache\|graph\|transfers\|first_update\|update"),
        ({"total_ms": []}, "says ok, but lacks a round"),
        ({"pairs": None}, "says ok, but lacks a round, its pairs"),
        ({"total_ms": [1.0, float("nan")]}, r"\.total_ms\[1\] \(.*\) is NaN: Expected"),
        ({"total_ms": [-1.0]}, r"\.total_ms\[0\] \(.*\) is -1.0: Expected"),
        ({"stage_ms": {"sort": 3}}, r"\.stage_ms\[\.\.\.\] \(.*\): Expected 'array', got 'int'"),
        ({"pairs": 7}, "says ok, but its pairs differ"),
        ({"checksum": "0x0"}, "says ok, but its pairs differ"),
        ({"missed": 1}, "says ok, but its pairs differ"),
        ({"scene": "fog"}, "no group has its scene and n"),
        ({"status": "skipped"}, "says skipped, but has a time, or no reason"),
        ({"status": "skipped", "total_ms": []}, "says skipped, but has a time, or no reason"),
        ({"skips": "no_sort"}, "'skips' is set, but its method is not planned"),
        ({"skips": "", "method": "planned"}, r"\.skips \(.*\) is \"\": Expected"),
        ({"plan": PLAN | {"levels": -1}}, r"\.plan\.levels \(.*\) is -1: Expected"),
        ({"known_issues": 3}, r"\.known_issues \(.*\) is 3: Expected"),
    ],
)
def test_a_row_with_a_bad_value_is_named(changes, message):
    with pytest.raises(ReportError, match=message) as error:
        parse(one_row(**changes))
    assert str(error.value).startswith("rows[0]") and "(find_pairs/" in str(error.value)


def test_two_rows_of_one_name_are_an_error():
    with pytest.raises(ReportError, match=r"rows\[1\] .* an earlier row has the same name"):
        parse(synthetic.document([group("gas", 1000)], [row(), row()]))


def test_ok_without_a_truth_is_an_error():
    document = one_row()
    document["groups"][0]["truth"] = None
    with pytest.raises(ReportError, match="no truth to be compared with"):
        parse(document)


def test_a_skipped_row_has_no_times():
    document = one_row()
    document["rows"] = [skipped(row(), "too many"), row(run="cold")]
    known = first(document)
    assert known["round_ms"] == () and math.isnan(known["median_ms"]) and not known["ran"]


def test_a_backend_that_could_not_run_at_all_has_no_rows():
    document = one_row()
    document["rows"] = [row()] + [
        skipped(row(backend="impl_thrust_cuda", run=run), "no CUDA device") for run in RUN_FACTORS
    ]
    result = parse(document)
    assert result.frame["backend"].tolist() == ["impl_cpu"]
    assert result.absent == {"impl_thrust_cuda": "no CUDA device"}
    (_, absent) = captions.counts(result, check.judge(result))
    assert absent.en == "Could not run here: impl_thrust_cuda (no CUDA device)."
    document["rows"][-1]["reason"] = "another"
    assert parse(document).absent == {}


def test_a_wrong_row_may_not_know_its_losses():
    document = one_row()
    document["rows"] = [wrong(row(), missed=1) | {"missed": None, "false": None}]
    assert first(document)["status"] == "wrong"


def test_variants_of_the_plan_stand_apart_from_rows_as_users_have_them():
    document = synthetic_ablation.document(*synthetic_ablation.group_rows())
    result = parse(document)
    skips = [row["skips"] for row in document["rows"] if row["skips"]]
    assert result.variants_frame["skips"].tolist() == skips
    assert set(result.frame["method"]) == {"planned", "home_phantom", "half_shell"}
    known = result.frame.iloc[0]
    assert known["plan"].skips == ("key_bits", "safe_band", "phantoms", "sort")
    assert {known["label"], *result.variants_frame["label"]} == {"impl_cpu planned"}


def test_a_packed_result_reads_like_a_plain_one(every_case, save, tmp_path):
    plain, packed = save(every_case), tmp_path / "packed.json.gz"
    packed.write_bytes(gzip.compress(plain.read_bytes()))
    assert load(packed).frame.equals(load(plain).frame)


@pytest.mark.parametrize("content", [b"no gzip", gzip.compress(b"{}" * 999)[:-20]])
def test_a_packed_result_that_is_not_whole_is_named(tmp_path, content):
    path = tmp_path / "broken.json.gz"
    path.write_bytes(content)
    with pytest.raises(ReportError, match=r"broken\.json\.gz: cannot be read: not a whole gzip"):
        load(path)


def test_the_frame_has_a_line_for_every_row(every_case):
    frame = parse(every_case).frame
    assert frame["name"].tolist() == [row["name"] for row in every_case["rows"]]
    states = frame[["status", "negative_control", "ran", "counts"]].drop_duplicates()
    assert sorted(states.values.tolist()) == [
        ["ok", False, True, True],
        ["skipped", False, False, False],
        ["wrong", False, True, False],
        ["wrong", True, True, False],
    ]
    assert (frame["median_ms"].notna() == frame["ran"]).all()
    gas = frame[(frame["scene"] == "gas") & (frame["run"] == "warm") & frame["counts"]]
    ours = gas[(gas["rule"] == "lowest_cell") & (gas["n"] == 1000)].iloc[0]
    assert ours["median_ms"] == ours["round_ms"][1] and ours["rounds"] == 3
    assert ours["ns_per_sphere"] == pytest.approx(ours["median_ms"] * 1000)
    assert (ours["beyond_bytes"], ours["candidates_per_pair"]) == (96.0, 4.5)
    none = frame[frame["n"] == 0]
    assert none[["ns_per_sphere", "beyond_bytes", "candidates_per_pair"]].isna().all(axis=None)


def test_whole_numbers_stay_exact_in_the_frame():
    most = 2**63 - 1
    frame = parse(
        synthetic.document(
            [group("gas", 1000)],
            [row(candidates=most), row("fcl_a", None, None, candidates=None)],
        )
    ).frame
    assert frame["candidates"].tolist() == [most, pd.NA]


def test_stages_have_lines_of_their_own():
    stages = parse(
        one_row(
            stage_ms={"sort": [1.0], "pair_tests": [2.0, 4.0, 3.0], "resolve": [], "query": []},
            stage_bytes={"sort": 80},
            fused={"resolve": "pair_tests", "sort": "cell_ids"},
        )
    ).stages
    assert stages["stage"].tolist() == ["sort", "pair_tests", "resolve", "sort"]
    assert stages["median_ms"].tolist()[:2] == [1.0, 3.0]
    assert stages["least_bytes"].tolist() == [80, pd.NA, pd.NA, 80]
    assert stages["fused_into"].tolist() == [None, None, "pair_tests", "cell_ids"]


def test_frames_of_motion_have_lines_of_their_own():
    frames = {"scene": "gravity", "warmup_frames": 1, "frame_ms": [[9.0, 2.0], [7.0, 4.0]]}
    result = parse(one_row(run="dynamic", frames=frames))
    assert result.frame["motion"][0] == "gravity" and result.frame["round_ms"][0] == (2.0, 4.0)
    moving = result.motion_frames
    assert moving["warmup"].tolist() == [True, False]
    assert moving["median_ms"].tolist() == [8.0, 3.0] and moving["max_ms"][0] == 9.0
