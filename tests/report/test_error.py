# SPDX-License-Identifier: MIT
"""Run time against error: rows and what stands for them, rates, fronts, prices, sentences."""

from __future__ import annotations

import pytest

from octocell_report import (
    captions,
    page_tables,
    style,
    words,
)
from octocell_report.cli import main
from octocell_report.error import MILLION, Study
from octocell_report.fields import ReportError
from octocell_report.load import parse
from octocell_report.plots import error_map
from octocell_report.predicates import PREDICATES
from octocell_report.spread import Estimate

import synthetic
import synthetic_error
from synthetic_error import document, row


def study_of(*documents):
    return Study(parse(document) for document in documents)


@pytest.fixture(scope="module")
def both():
    return study_of(synthetic_error.host(), synthetic_error.device())


def point(study, label, scene):
    (found,) = study.points.query("series == @label and scene == @scene").itertuples()
    return found


def test_fields_are_read():
    known = row(predicate="f32", losses=(3, 2), worst_missed_depth=0.25, distinct_checksums=2)
    result = parse(document(known))
    found = result.frame.iloc[0]
    assert (found["predicate"], found["distinct_checksums"]) == ("f32", 2)
    assert (found["worst_missed_depth"], found["worst_false_gap"]) == (0.25, 3.1e-8)
    assert result.groups[0].scene_class == "random" and result.groups[0].rounding is None


def test_files_without_the_fields_are_read_as_before():
    frame = parse(synthetic.document([synthetic.group("gas", 1000)], [synthetic.row()])).frame
    names = ["predicate", "distinct_checksums", "worst_missed_depth", "worst_false_gap"]
    assert frame[names].isna().all(axis=None)


@pytest.mark.parametrize(
    ("where", "changes", "message"),
    [
        ("rows", {"predicate": "float"}, "is \"float\": Expected 'str' matching regex '^(exact|"),
        ("rows", {"kind": "baseline"}, "'predicate' is set, but it is a baseline"),
        ("rows", {"worst_false_gap": -1.0}, "is -1.0: Expected"),
        ("groups", {"scene_class": "odd"}, "(random|structured|extreme)"),
        ("groups", {"input_rounding": {"lost": 1}}, "missing required field 'gained'"),
    ],
)
def test_bad_fields_are_named(where, changes, message):
    known = document(row())
    known[where][0] |= changes
    with pytest.raises(ReportError) as caught:
        parse(known)
    assert message in str(caught.value)


def test_predicates_are_implementations_of_their_own():
    result = parse(document(row(), row(predicate="f32")))
    assert list(words.titles(result).items()) == [
        ("impl_cpu half_shell", "impl_cpu half_shell"),
        ("impl_cpu half_shell f32", "impl_cpu half_shell f32 (negative control)"),
    ]


def test_rates_are_per_million_true_pairs(both):
    found = point(both, "impl_cpu f32", "lattice(spacing=0.1)")
    assert found.true_pairs == 2_970_000
    assert found.missed_per_million == pytest.approx(2105, abs=0.5)
    assert found.false_per_million == pytest.approx(940, abs=0.5)
    (alone,) = study_of(document(row(n=1, predicate="f32", losses=(0, 5)))).points.itertuples()
    assert alone.true_pairs == 0 and alone.false_per_million == alone.errors * MILLION > 0


def test_of_two_files_the_first_stands_and_the_second_adds(both):
    alone = study_of(synthetic_error.host())
    added = set(both.points["backend"]) - set(alone.points["backend"])
    assert added == {"impl_cuda_custom", "impl_thrust_cuda"}
    assert (both.points["series"] == "impl_cpu exact").sum() == 9


def test_of_a_backend_the_configuration_with_most_predicates_stands():
    rows = [
        row(method="planned", ns=1.0),
        row(ns=2.0),
        row(ns=1.9, predicate="f32"),
        row(method="home_phantom", rule="lowest_cell", ns=3.0),
        row(method="home_phantom", rule="lowest_cell", ns=0.5, predicate="f32"),
        row(method="home_phantom", rule="as_written", ns=0.1, losses=(9, 0), negative_control=True),
    ]
    assert list(study_of(document(*rows)).points["method"]) == ["half_shell"] * 2


def test_a_scene_is_shown_at_the_size_at_which_most_ran():
    rows = [row(n=1000), row(n=1000, predicate="f32"), row(n=9000)]
    assert set(study_of(document(*rows)).points["n"]) == {1000}
    rows.append(row(n=9000, predicate="f32"))
    assert set(study_of(document(*rows)).points["n"]) == {9000}


def test_scenes_without_a_class_and_rows_without_time_are_left_out():
    known = document(row(), row(predicate="f32"), row(scene="poly"), row(scene="fcc", run="cold"))
    known["groups"][1]["scene_class"] = None
    assert list(study_of(known).points["scene"]) == ["gas", "gas"]


def test_fronts_are_the_fastest_that_guarantee_to_be_exact(both):
    fronts = both.fronts.query("scene_class == 'structured'").set_index("place")
    assert fronts["series"].to_dict() == {
        "GPU": "impl_cuda_custom q16_exact",
        "CPU": "impl_cpu q16_exact",
    }
    decimal = 27.4 * 1.3 * 0.94 * 1.04  # decimal or lattice, round 3
    assert fronts.ns["CPU"] == pytest.approx(decimal)
    lucky = both.points.query("scene_class == 'random' and series == 'impl_cpu gram_f32'")
    assert lucky["errors"].sum() == 0 and not lucky["claims_exact"].any()
    assert "impl_cpu gram_f32" not in set(both.fronts["series"])


def test_the_price_is_taken_within_rounds_over_stages_5_and_6():
    exact, plain = row(), row(predicate="f32", ns=20.0)
    exact["stage_ms"] = {"pair_tests": [3.0, 8.0, 3.0], "resolve": [1.0, 2.0, 1.0]}
    plain["stage_ms"] = {"pair_tests": [2.0, 4.0, 2.0], "resolve": [0.0, 1.0, 0.5]}
    (cost,) = study_of(document(exact, plain)).costs.itertuples()
    assert cost.deciding_stages == Estimate(2.0, 1.6, 2.0, 3)
    assert cost.whole.median == pytest.approx(27.4 / 20) and cost.candidates_per_pair == 155
    exact["stage_ms"] = {}
    (cost,) = study_of(document(exact, plain)).costs.itertuples()
    assert cost.deciding_stages is None
    (line,) = page_tables.english(page_tables.costs(study_of(document(exact, plain)))).to_numpy()
    assert line[2] == words.NONE and line[3].startswith("1.37 (")


def test_another_configuration_gives_no_price():
    rows = [row(method="planned"), row(method="planned", predicate="f64"), row(predicate="f32")]
    assert study_of(document(*rows)).costs.empty


def test_a_broken_guarantee_stands_out():
    rows = [row(losses=(0, 2)), row(predicate="f32"), row("fcl_a", None, None, None, losses=(7, 0))]
    study = study_of(document(*rows))
    assert error_map.text_of(point(study, "impl_cpu exact", "gas")) == "+5"
    assert captions.claims(study).en.startswith("0 of the 1 rows that claim to be exact are;")
    assert study.fronts.empty


def test_an_answer_that_changes_is_told():
    rows = [row(distinct_checksums=3), row(predicate="f32")]
    told = captions.claims(study_of(document(*rows)))
    assert told.en.endswith("are; 1 rows changed their answer between runs.")
    assert told.zh.endswith("1 行各次运行的结果不一致。")


def test_predicates_have_a_colour_each():
    assert len({style.predicate_colour(p) for p in (*PREDICATES, None)}) == len(PREDICATES) + 1


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.25, "0.25"), (9.9, "10"), (37.7, "38"), (999.7, "1k"), (24_835, "24.8k"), (5.1e6, "5.1M")],
)
def test_rates_are_short(value, text):
    assert words.rate(value) == text


def test_negative_controls_do_not_fail_the_check(save, capsys):
    known = document(row(), row(predicate="f32", losses=(2, 0)))
    assert main(["check", str(save(known))]) == 0
    assert capsys.readouterr().out == "Exact: all 1 default rows. 0 skipped, 1 negative controls.\n"


def test_series_are_ordered_by_predicate_then_library(both):
    series = both.points.drop_duplicates("series")
    assert list(series["series"][:1]) == ["impl_cpu exact"]
    assert list(series["predicate"][4:6]) == ["q16_exact", "q16_exact"]
    assert list(series["lane"][-3:]) == ["Bullet", "FCL", "FCL"]
