# SPDX-License-Identifier: MIT
"""What CSV files and tables hold: curves' slopes, speed against libraries, what is right."""

from __future__ import annotations

import pytest

from octocell_report import frames, tables, words
from octocell_report.load import parse

import synthetic
from synthetic import group, row, skipped, times, unavailable_group, wrong


def result_of(*rows, sizes=(1000,), scene="gas"):
    return parse(synthetic.document([group(scene, n) for n in sizes], list(rows)))


@pytest.mark.parametrize("power", [1.0, 1.04, 2.0])
def test_the_slope_of_a_power_law_is_its_exponent(power):
    sizes = (100_000, 1000, 10_000)
    rows = [row(n=n, total_ms=times(3e-4, power, n)) for n in sizes]
    slope = frames.slopes(result_of(*rows, sizes=sizes))
    assert slope["slope"].item() == pytest.approx(power, abs=1e-9)
    assert slope[["scene", "run", "sizes"]].values.tolist() == [["gas", "warm", 3]]


def test_slopes_are_of_exact_rows_of_two_sizes():
    def slopes(*rows):
        return frames.slopes(result_of(row(), *rows, sizes=(0, 1000, 2000)))

    assert slopes().empty
    assert len(slopes(row(n=2000))) == 1
    assert slopes(row(n=0, total_ms=[0.5])).empty
    assert slopes(wrong(row(n=2000), missed=1)).empty
    assert slopes(row(n=2000, negative_control=True)).empty
    assert slopes(skipped(row(n=2000), "over the limit of 1")).empty


def speedups(*rows, run="warm"):
    """Of each library: its row that was compared with, and the ratios."""
    found = tables.speedups(result_of(*rows)).query("run == @run")
    return {r.family_ref: (r.backend_ref, r.ratios) for r in found.itertuples()}


def test_ratios_are_taken_round_by_round():
    assert speedups(
        row(total_ms=[1.0, 2.0, 4.0]),
        row("fcl_a", None, None, total_ms=[3.0, 8.0, 20.0]),
        row("fcl_b", None, None, total_ms=[50.0, 50.0, 50.0]),
        row("bullet_a", None, None, total_ms=[0.5, 1.0, 3.0]),
    ) == {"fcl": ("fcl_a", (3.0, 4.0, 5.0)), "bullet": ("bullet_a", (0.5, 0.5, 0.75))}


def test_the_median_of_ratios_is_not_the_ratio_of_medians():
    rows = row(total_ms=[1.0, 10.0, 2.0]), row("fcl_a", None, None, total_ms=[2.0, 10.0, 8.0])
    ratios = frames.all_frames(result_of(*rows))["ratios"]
    assert ratios["times_as_fast_median"].item() == 2.0  # not 8 / 2


def test_a_wrong_baseline_is_no_reference_however_fast():
    assert speedups(
        row(total_ms=[1.0]),
        wrong(row("fcl_fast", None, None, total_ms=[0.1]), missed=5),
        row("fcl_slow", None, None, total_ms=[2.0]),
    ) == {"fcl": ("fcl_slow", (2.0,))}


def test_cold_is_compared_with_cold_and_a_warm_row_with_updates():
    rows = (
        row(total_ms=[1.0]),
        row(run="cold", total_ms=[2.0]),
        row("fcl_a", None, None, total_ms=[4.0]),
        row("fcl_a", None, None, run="cold", total_ms=[6.0]),
        row("fcl_a", None, None, run="update", total_ms=[0.5]),
    )
    found = {run: speedups(*rows, run=run) for run in ("warm", "cold", "update", "first_update")}
    assert [ratios["fcl"][1] for ratios in list(found.values())[:3]] == [(4.0,), (3.0,), (0.5,)]
    assert found["first_update"] == {}


def test_wrong_rows_and_negative_controls_get_no_ratio():
    assert not speedups(
        wrong(row(), missed=1),
        row(rule="as_written", negative_control=True),
        row("fcl_a", None, None),
    )


def test_cells_say_what_happened_in_the_worst_run():
    document = synthetic.document(
        [group("gas", 1000), group("gas", 2000), unavailable_group()],
        [
            row(),
            wrong(row(run="cold"), missed=5, false=2, duplicates=1),
            row(n=2000),
            skipped(row("impl_cpu", "brute_force", None), "9 candidates, over the limit of 3"),
            wrong(row(rule="as_written", negative_control=True), missed=123_456),
            wrong(row("fcl_a", None, None), missed=1) | {"missed": None, "false": None},
        ],
    )
    assert frames.correctness(parse(document)).values.tolist() == [
        ["impl_cpu lowest_cell", "−5 +2 ×1", "exact", "no scene"],
        ["impl_cpu brute_force", "over limit", "", "no scene"],
        ["impl_cpu as_written", "−123k +0", "", "no scene"],
        ["fcl_a", "−? +?", "", "no scene"],
    ]


def test_a_fused_stage_has_a_host_and_no_time():
    stages = {"pair_tests": [2.0, 4.0, 3.0]}
    result = result_of(row(stage_ms=stages, fused={"resolve": "pair_tests"}))
    frame = frames.all_frames(result)["stages"]
    assert frame["median_ms"].fillna(-1).tolist() == [3.0, -1]
    assert frame["fused_into"].tolist() == [None, "pair_tests"]


def test_labels_are_short_and_never_the_same():
    result = result_of(
        row(),
        row(method="half_shell", name="b"),
        row(threads=2, name="c"),
        row(method="brute_force", rule=None),
        row("bullet_dbvt", None, None),
    )
    assert list(result.frame["label"]) == [
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
