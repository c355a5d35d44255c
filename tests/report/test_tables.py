# SPDX-License-Identifier: MIT
from __future__ import annotations

import math

import pytest

from octocell_report import frames, tables, words
from octocell_report.load import Impl, Place, parse

import synthetic
from synthetic import group, row, skipped, times, unavailable_group, wrong

CPU = Impl("impl_cpu", "home_phantom", "lowest_cell", 1)
GAS = Place("gas", 1000)


def result_of(*rows, sizes=(1000,), scene="gas"):
    return parse(synthetic.document([group(scene, n) for n in sizes], list(rows)))


@pytest.mark.parametrize("power", [1.0, 1.04, 2.0])
def test_the_slope_of_a_power_law_is_its_exponent(power):
    sizes = (1000, 10_000, 100_000)
    rows = [row(n=n, total_ms=times(3e-4, power, n)) for n in sizes]
    curve = tables.curves(result_of(*rows, sizes=sizes), "gas", "warm")[CPU]
    assert tables.slope(curve) == pytest.approx(power, abs=1e-9)
    factor, exponent = tables.power_law(curve)
    assert factor == pytest.approx(3e-4 * 1.02) and exponent == pytest.approx(power)


def test_one_size_has_no_slope():
    assert tables.slope(result_of(row()).rows) is None


def test_curves_hold_exact_rows_alone():
    result = result_of(
        row(),
        wrong(row(rule="chapter32"), missed=1),
        row(rule="as_written", negative_control=True),
        skipped(row("x", "brute_force", None), "over the limit of 1"),
        row(run="cold"),
    )
    assert list(tables.curves(result, "gas", "warm")) == [CPU]
    assert {r.impl.rule for r in tables.marked(result, "gas", "warm")} == {
        "chapter32", "as_written"
    }  # fmt: skip


def test_no_spheres_make_no_point_and_no_cost_per_sphere():
    result = result_of(row(n=0, total_ms=[0.5]), sizes=(0,))
    assert tables.curves(result, "gas", "warm") == {}
    assert math.isnan(tables.ns_per_sphere(result.rows[0]))
    assert result.largest("gas") is None


def test_ratios_are_taken_round_by_round():
    result = result_of(
        row(total_ms=[1.0, 2.0, 4.0]),
        row("fcl_a", None, None, total_ms=[3.0, 8.0, 20.0]),
        row("fcl_b", None, None, total_ms=[50.0, 50.0, 50.0]),
        row("bullet_a", None, None, total_ms=[0.5, 1.0, 3.0]),
    )
    against = {ratio.family: ratio for ratio in tables.ratios(result, "warm")}
    assert against["fcl"].rounds == (3.0, 4.0, 5.0)
    assert against["fcl"].median == 4.0
    assert against["fcl"].reference.backend == "fcl_a"
    assert against["bullet"].rounds == (0.5, 0.5, 0.75)


def test_the_median_of_ratios_is_not_the_ratio_of_medians():
    result = result_of(
        row(total_ms=[1.0, 10.0, 2.0]), row("fcl_a", None, None, total_ms=[2.0, 10.0, 8.0])
    )
    assert tables.ratios(result, "warm")[0].median == 2.0  # 8 / 2 = 4 otherwise


def test_a_wrong_baseline_is_no_reference_however_fast():
    result = result_of(
        row(total_ms=[1.0]),
        wrong(row("fcl_fast", None, None, total_ms=[0.1]), missed=5),
        row("fcl_slow", None, None, total_ms=[2.0]),
    )
    assert [r.reference.backend for r in tables.ratios(result, "warm")] == ["fcl_slow"]


def test_cold_is_held_against_cold():
    result = result_of(
        row(total_ms=[1.0]),
        row(run="cold", total_ms=[2.0]),
        row("fcl_a", None, None, total_ms=[4.0]),
        row("fcl_a", None, None, run="cold", total_ms=[6.0]),
    )
    assert [r.median for r in tables.ratios(result, "warm")] == [4.0]
    assert [r.median for r in tables.ratios(result, "cold")] == [3.0]


def test_wrong_rows_and_negative_controls_get_no_ratio():
    result = result_of(
        wrong(row(), missed=1),
        row(rule="as_written", negative_control=True),
        row("fcl_a", None, None),
    )
    assert tables.ratios(result, "warm") == []


def test_matrix_cells_say_what_happened():
    document = synthetic.document(
        [group("gas", 1000), group("gas", 2000), unavailable_group()],
        [
            row(),
            wrong(row(run="cold"), missed=5, false=2, duplicates=1),
            row(n=2000),
            skipped(row("impl_cpu", "brute_force", None), "9 candidates, over the limit of 3"),
            wrong(row(rule="as_written", negative_control=True), missed=123_456),
        ],
    )
    result = parse(document)
    cells = tables.correctness(result)
    brute, written = Impl("impl_cpu", "brute_force", None, 1), CPU._replace(rule="as_written")
    assert cells[CPU, GAS] == tables.Cell("wrong", "−5 +2 ×1")
    assert cells[CPU, Place("gas", 2000)] == tables.Cell("exact", "exact")
    assert cells[brute, GAS] == tables.Cell("skipped", "over limit")
    assert cells[brute, Place("gas", 2000)] == tables.Cell("absent", "")
    assert cells[written, GAS] == tables.Cell("negative_control", "−123k +0")
    assert cells[CPU, Place("1A2C", 0)] == tables.Cell("unavailable", "no scene")


def test_memory_is_what_input_and_output_leave():
    result = result_of(
        row(peak_bytes=50_000, output_bytes=10_000),
        row(run="cold", peak_bytes=70_000, output_bytes=10_000),
        row("fcl_a", None, None, peak_bytes=None),
    )
    needs = tables.memory(result, GAS)
    assert list(needs) == [CPU]
    assert tables.beyond_bytes(needs[CPU]) == 60.0


def test_candidates_are_counted_for_each_true_pair():
    result = result_of(row(candidates=9000), row("fcl_a", None, None))
    assert tables.candidates_per_pair(result, result.rows[0]) == 4.5
    assert math.isnan(tables.candidates_per_pair(result, result.rows[1]))


def test_a_fused_stage_has_a_host_and_no_time():
    stages = {"pair_tests": [2.0, 4.0, 3.0]}
    frame = frames.stages(result_of(row(stage_ms=stages, fused={"resolve": "pair_tests"})))
    assert frame.stage.tolist() == ["pair_tests", "resolve"]
    assert frame.median_ms[0] == 3.0 and math.isnan(frame.median_ms[1])
    assert frame.fused_into[1] == "pair_tests"


def test_labels_are_short_and_never_the_same():
    result = result_of(
        row(),
        row(method="half_shell", name="b"),
        row(threads=2, name="c"),
        row(method="brute_force", rule=None),
        row("bullet_dbvt", None, None),
    )
    assert list(words.labels(result).values()) == [
        "impl_cpu home_phantom/lowest_cell",
        "impl_cpu half_shell/lowest_cell",
        "impl_cpu home_phantom/lowest_cell (2 threads)",
        "impl_cpu brute_force",
        "bullet_dbvt",
    ]


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0123, "0.0123"), (0.123, "0.123"), (1.5, "1.50"), (99.94, "99.9"), (1234.4, "1\u202f234"),
     (float("nan"), "–"), (None, "–")],
)  # fmt: skip
def test_numbers_have_three_digits(value, text):
    assert words.number(value) == text


@pytest.mark.parametrize(
    ("n", "text"), [(0, "0"), (1000, "1k"), (2500, "2.5k"), (4231, "4\u202f231"), (10**6, "1M")]
)
def test_sizes_are_short_only_where_they_stay_exact(n, text):
    assert words.size(n) == text


@pytest.mark.parametrize(
    ("n", "text"), [(9999, "9999"), (33_333, "33.3k"), (999_600, "1M"), (None, "?")]
)
def test_counts_fit_a_cell(n, text):
    assert words.count(n) == text
