# SPDX-License-Identifier: MIT
"""Rows of moving scenes: frames, their steady state, and results that have none."""

from __future__ import annotations

from statistics import median

import pytest

from octocell_report import (
    frames,
    page,
    page_tables,
    plots,
    readme_bench,
    style,
    tables,
    words,
)
from octocell_report.fields import ReportError
from octocell_report.load import parse

import synthetic
from synthetic import group, row, skipped

WARMUP = 2


def moving(*backend, factor, rounds=3, motion="gas_brownian", **changes):
    """Two warm-up frames ten times as slow, then factor, 2 factor, 3 factor."""
    times = [10 * factor, 10 * factor, factor, 2 * factor, 3 * factor]
    frame_ms = [[t * (1 + 0.1 * k) for t in times] for k in range(rounds)]
    known = row(*backend, scene="gas_brownian", run="dynamic", total_ms=[99.0] * rounds)
    known["name"] += motion
    known["frames"] = {"scene": motion, "frame_ms": frame_ms, "warmup_frames": WARMUP}
    return known | changes


def result_of(*rows):
    return parse(synthetic.document([group("gas_brownian", 1000)], list(rows)))


def figure_of(result):
    return plots.dynamic.draw(result, style.looks(result))


def three():
    return [
        moving(factor=1.0),
        moving("fcl_a", None, None, factor=3.0),
        moving("bullet_a", None, None, factor=0.5),
    ]


def test_the_steady_state_leaves_warm_up_frames_out():
    known = result_of(moving(factor=1.0)).frame.iloc[0]
    assert known["round_ms"] == pytest.approx((2.0, 2.2, 2.4))
    assert known["median_ms"] == pytest.approx(2.2)
    assert known["frames"].by_frame == pytest.approx([11.0, 11.0, 1.1, 2.2, 3.3])


def test_where_all_is_warm_up_all_frames_count():
    known = moving(factor=1.0)
    known["frames"]["warmup_frames"] = 5
    assert result_of(known).frame["round_ms"][0][0] == 3.0


def test_ratios_are_of_steady_frames_round_by_round():
    found = tables.speedups(result_of(*three())).set_index("family_ref")
    assert found["ratios"]["fcl"] == pytest.approx((3.0, 3.0, 3.0))
    assert median(found["ratios"]["bullet"]) == pytest.approx(0.5)
    assert set(found["motion"]) == {"gas_brownian"} and set(found["own_run"]) == {"dynamic"}


def test_two_motions_of_one_scene_are_two_facets_and_no_ratio():
    result = result_of(*three(), moving(factor=7.0, motion="gravity"))
    titles = [ax.get_title() for ax in figure_of(result).axes]
    assert titles == ["gas_brownian 1k", "gas_brownian 1k, gravity"]
    assert "gravity" not in set(tables.speedups(result)["motion"])


def test_the_table_has_steady_and_first_frames():
    table = page_tables.english(page_tables.steady_frames(result_of(*three())))
    first = ["gas_brownian", "1k", "impl_cpu lowest_cell", "2.20 (2.00–2.40)", "11.0", "5", "2"]
    assert list(table.iloc[0]) == first


def test_frames_as_csv_mark_the_warm_up():
    frame = frames.all_frames(result_of(*three()))["frames"].query("implementation == 'fcl_a'")
    assert frame.warmup.tolist() == [True, True, False, False, False]
    assert frame.median_ms.tolist() == pytest.approx([33, 33, 3.3, 6.6, 9.9])


def test_the_plot_marks_warm_up_frames_apart():
    drawn = dict.fromkeys(name for name, _ in plots.draw_all(result_of(*three())))
    assert "dynamic" in drawn and not any(name.startswith("time_") for name in drawn)
    for name, figure in plots.draw_all(result_of(*three())):
        if name == "dynamic":
            early, steady = figure.axes[0].get_lines()[-2:]  # of the fastest, drawn last
            assert list(early.get_xdata()) == [0, 1, 2] and list(steady.get_xdata()) == [2, 3, 4]
            assert early.get_markerfacecolor() == "white" != steady.get_markerfacecolor()


def test_a_row_stands_beside_the_same_frames_searched_again():
    ours = ("impl_cpu", "planned", None)
    rows = [moving(*ours, factor=1.0), moving(*ours, factor=4.0, skips="rebuilt", name="again")]
    result = result_of(*rows)
    table = page_tables.english(page_tables.steady_frames(result))
    assert list(table["by again"]) == ["0.25"]
    figure = figure_of(result)
    found = {line.get_label(): line for line in figure.axes[0].get_lines()}
    beside = found["the same, searched again   8.80 ms"]
    assert list(beside.get_ydata()) == pytest.approx([44.0, 44.0, 4.4, 8.8, 13.2])
    plain = figure_of(result_of(rows[0]))
    assert len(plain.axes[0].get_lines()) == len(found) - 1


def test_a_moving_scene_has_no_table_of_runs_at_rest():
    result = result_of(*three())
    assert page_tables.times(result).empty and tables.runs(result) == []
    html = page.render(result, page.Path("nowhere"))
    assert "steady frame [ms]" in html and "稳态帧 [ms]" in html


def test_dynamic_rows_without_frames_are_tolerated():
    plain = row(run="dynamic", frames=None)
    less = skipped(row("fcl_a", None, None, run="dynamic"), "crashed: signal 11")
    result = parse(synthetic.document([group("gas", 1000)], [plain, less]))
    assert result.frame["round_ms"][0] == (1.0, 1.02, 1.04)
    assert page_tables.steady_frames(result).empty
    assert "crashed: signal 11" in page.render(result, page.Path("nowhere"))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            {"frame_ms": [[1.0], [1.0, 2.0]]},
            r"frames \(.*\): 'frame_ms' has no frame, or rounds of",
        ),
        ({"frame_ms": [[]]}, r"frames \(.*\): 'frame_ms' has no frame"),
        ({"frame_ms": []}, r"frames \(.*\): 'frame_ms' has no frame"),
        ({"frame_ms": [[-1.0]]}, r"frames\.frame_ms\[0\]\[0\] \(.*\) is -1.0"),
        ({"warmup_frames": None}, r"frames\.warmup_frames \(.*\) is null"),
    ],
)
def test_bad_frames_are_named(changes, message):
    known = moving(factor=1.0)
    known["frames"] |= changes
    with pytest.raises(ReportError, match=rf"^rows\[0\]\.{message}"):
        result_of(known)


def test_the_readme_holds_the_steady_frame_against_each_library():
    block = readme_bench.moving(result_of(*three()))
    size = words.grouped(1000)
    assert f"| gas_brownian | {size} | impl_cpu lowest_cell | 2.20 | 3.00× | 0.50× |" in block
    with pytest.raises(ReportError, match="needs a moving scene"):
        readme_bench.moving(parse(synthetic.document([group("gas", 1000)], [row()])))
