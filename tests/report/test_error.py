# SPDX-License-Identifier: MIT
"""Run time against error: rows and what stands for them, rates, fronts, prices, sentences."""

from __future__ import annotations

import pytest

from octocell_report import (
    captions,
    error,
    page_tables,
    style,
    words,
)
from octocell_report.cli import main
from octocell_report.error import Series, Study
from octocell_report.fields import ReportError
from octocell_report.load import parse
from octocell_report.plots import error_map
from octocell_report.predicates import PREDICATES

import synthetic
import synthetic_error
from synthetic_error import document, row


def study_of(*documents):
    return Study(parse(document) for document in documents)


@pytest.fixture(scope="module")
def both():
    return study_of(synthetic_error.host(), synthetic_error.device())


def point(study, label, scene):
    return next(p for p in study.points if (p.series.label, p.row.place.scene) == (label, scene))


def test_fields_are_read():
    known = row(predicate="f32", losses=(3, 2), worst_missed_depth=0.25, distinct_checksums=2)
    result = parse(document(known))
    found = result.rows[0]
    assert (found.predicate, found.impl.predicate) == ("f32", "f32")
    assert (found.worst_missed_depth, found.worst_false_gap) == (0.25, 3.1e-8)
    assert found.distinct_checksums == 2
    assert result.groups[0].scene_class == "random" and result.groups[0].rounding is None


def test_files_without_the_fields_are_read_as_before():
    found = parse(synthetic.document([synthetic.group("gas", 1000)], [synthetic.row()])).rows[0]
    assert (found.predicate, found.impl.predicate, found.distinct_checksums) == (None, None, None)
    assert found.worst_missed_depth is None


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
    assert list(words.labels(result).values()) == ["impl_cpu half_shell", "impl_cpu half_shell f32"]
    assert words.titles(result)[result.rows[1].impl] == "impl_cpu half_shell f32 (negative control)"


def test_rates_are_per_million_true_pairs(both):
    found = point(both, "impl_cpu f32", "lattice(spacing=0.1)")
    assert found.pairs == 2_970_000 and found.rate(found.missed) == pytest.approx(2105, abs=0.5)
    assert found.rate(found.false) == pytest.approx(940, abs=0.5)
    (alone,) = study_of(document(row(n=1))).points
    assert alone.pairs == 0 and alone.rate(5) == 5 * error.MILLION


def test_of_two_files_the_first_stands_and_the_second_adds(both):
    alone = study_of(synthetic_error.host())
    added = {p.series.backend for p in both.points} - {p.series.backend for p in alone.points}
    assert added == {"impl_cuda_custom", "impl_thrust_cuda"}
    assert len([p for p in both.points if p.series.label == "impl_cpu exact"]) == 9


def test_of_a_backend_the_configuration_with_most_predicates_stands():
    rows = [
        row(method="planned", ns=1.0),
        row(ns=2.0),
        row(ns=1.9, predicate="f32"),
        row(method="home_phantom", rule="lowest_cell", ns=3.0),
        row(method="home_phantom", rule="lowest_cell", ns=0.5, predicate="f32"),
        row(method="home_phantom", rule="as_written", ns=0.1, losses=(9, 0), negative_control=True),
    ]
    assert [p.row.impl.method for p in study_of(document(*rows)).points] == ["half_shell"] * 2


def test_a_scene_is_shown_at_the_size_at_which_most_ran():
    rows = [row(n=1000), row(n=1000, predicate="f32"), row(n=9000)]
    assert {p.row.place.n for p in study_of(document(*rows)).points} == {1000}
    rows.append(row(n=9000, predicate="f32"))
    assert {p.row.place.n for p in study_of(document(*rows)).points} == {9000}


def test_scenes_without_a_class_and_rows_without_time_are_left_out():
    known = document(row(), row(predicate="f32"), row(scene="poly"), row(scene="fcc", run="cold"))
    known["groups"][1]["scene_class"] = None
    assert [p.row.place.scene for p in study_of(known).points] == ["gas", "gas"]


def test_fronts_are_the_fastest_that_guarantee_to_be_exact(both):
    fronts = both.fronts("structured")
    assert {side: s.series.label for side, s in fronts.items()} == {
        True: "impl_cuda_custom q16_exact",
        False: "impl_cpu q16_exact",
    }
    assert fronts[False].ns == pytest.approx(
        27.4 * 1.3 * 0.94 * 1.04
    )  # decimal or lattice, round 3
    lucky = [s for s in both.summaries("random") if s.series.label == "impl_cpu gram_f32"]
    assert lucky[0].errors == 0 and not lucky[0].exact and lucky[0].ns < fronts[False].ns * 2


def test_the_worst_scene_is_that_of_the_highest_rate(both):
    f16 = next(s for s in both.summaries("structured") if s.series.label == "impl_cpu f16_cell")
    assert f16.worst("missed").row.place.scene == "lattice(spacing=0.1)"
    assert f16.worst("false").row.place.scene == "fcc"
    assert next(s for s in both.summaries("random") if s.exact).worst("missed") is None


def test_the_price_is_taken_within_rounds_over_stages_5_and_6():
    exact, plain = row(), row(predicate="f32", ns=20.0)
    exact["stage_ms"] = {"pair_tests": [3.0, 8.0, 3.0], "resolve": [1.0, 2.0, 1.0]}
    plain["stage_ms"] = {"pair_tests": [2.0, 4.0, 2.0], "resolve": [0.0, 1.0, 0.5]}
    (cost,) = study_of(document(exact, plain)).costs
    assert cost.stages.median == 2.0 and (cost.stages.low, cost.stages.high) == (1.6, 2.0)
    assert cost.whole.median == pytest.approx(27.4 / 20) and cost.candidates == 155
    exact["stage_ms"] = {}
    (cost,) = study_of(document(exact, plain)).costs
    assert cost.stages is None
    (line,) = page_tables.english(page_tables.costs(study_of(document(exact, plain)))).to_numpy()
    assert line[2] == words.NONE and line[3].startswith("1.37 (")


def test_another_configuration_gives_no_price():
    rows = [row(method="planned"), row(method="planned", predicate="f64"), row(predicate="f32")]
    assert study_of(document(*rows)).costs == []


def test_a_broken_guarantee_stands_out():
    rows = [row(losses=(0, 2)), row(predicate="f32"), row("fcl_a", None, None, None, losses=(7, 0))]
    study = study_of(document(*rows))
    assert error_map.text_of(point(study, "impl_cpu exact", "gas")) == "+5"
    assert captions.claims(study).en.startswith("0 of the 1 rows that claim to be exact are;")
    assert study.fronts("random") == {}


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
    assert both.series[0] == Series("impl_cpu", "exact", "backend")
    assert [s.predicate for s in both.series[4:6]] == ["q16_exact", "q16_exact"]
    assert [s.lane for s in both.series[-3:]] == ["Bullet", "FCL", "FCL"]
