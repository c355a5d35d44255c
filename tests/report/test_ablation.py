# SPDX-License-Identifier: MIT
"""Planned rows, their variants and forced methods: numbers, figures, files, and the page."""

from __future__ import annotations

import math
import re
from itertools import pairwise

import matplotlib.pyplot as plt
import pytest

from octocell_report import (
    ablation,
    captions,
    check,
    frames,
    page,
    page_tables,
    plots,
    readme_bench,
    spread,
    style,
)
from octocell_report.cli import main
from octocell_report.load import parse

import synthetic
import synthetic_ablation
from synthetic_ablation import document, forced, group_rows, moving_rows, planned

HAN = re.compile(r"[\u4e00-\u9fff]")
END = 100 * 0.9 * 0.95 * 0.5 * 0.8  # ns per sphere, planned


def studied(*rows, **changes):
    return parse(document(*rows, **changes))


def effects(*rows):
    """By skip."""
    return {row.skip: row for row in ablation.effects(studied(*rows)).itertuples()}


def steps(*rows):
    return list(ablation.steps(studied(*rows)).itertuples())


def regret(*rows):
    (found,) = ablation.regrets(studied(*rows)).itertuples()
    return found


def every_ablation():
    return parse(synthetic_ablation.every_case())


def shown(table):
    return page_tables.english(table).to_dict("records")


def drawn(result):
    """Texts of each figure, by its name."""
    return {
        name: [text.get_text() for text in figure.findobj(plt.Text)]
        for name, figure in plots.draw_ablation(result)
    }


def test_an_effect_is_the_median_over_the_rounds_of_ratios_within_them():
    fast, slow = planned(10, None, ["sort"]), planned(10, "no_sort")
    fast["total_ms"], slow["total_ms"] = [1.0, 2.0, 4.0], [3.0, 2.0, 20.0]
    found = effects(fast, slow)
    assert list(found) == ["sort"] and found["sort"].taken
    assert found["sort"].by_planned == spread.Estimate(3.0, 1.0, 5.0, 3)  # of 3, 1, 5; not 3 / 2


def test_effects_tell_what_the_plan_takes_from_what_it_does_not_need():
    found = effects(*group_rows())
    taken = [skip for skip, effect in found.items() if effect.taken]
    assert taken == ["key_bits", "safe_band", "phantoms", "sort"]
    assert found["phantoms"].by_planned.median == pytest.approx(2)
    assert found["layers"].by_planned.median == pytest.approx(1)


def test_steps_hang_together_from_nothing_skipped_to_the_plan():
    found = steps(*group_rows())
    assert [step.skip for step in found] == list(synthetic_ablation.STEPS)
    assert found[0].before == pytest.approx(102) and found[-1].after == pytest.approx(1.02 * END)
    assert all(a.after == b.before for a, b in pairwise(found))
    assert found[2].change == pytest.approx(-1.02 * 100 * 0.9 * 0.95 * 0.5)
    assert [step.kind for step in found[:4]] == ["saved", "saved", "saved", "noise"]


def test_a_step_beyond_ten_comes_after_the_ninth():
    found = steps(*moving_rows())
    assert [step.skip for step in found] == list(synthetic_ablation.MOVING)
    assert found[-1].kind == "saved"


def test_a_wrong_step_has_no_time_and_the_next_one_is_told_as_joint():
    found = ablation.steps(every_ablation()).query("title == 'dense 5k'")
    wrong, after = found[2:4].itertuples()
    assert math.isnan(wrong.after) and wrong.kind == "noise"
    assert after.joint and after.kind == "joint" and after.before == wrong.before


def test_too_few_rounds_judge_nothing():
    rows = group_rows(half_shell=0.5)
    for row in rows:
        row["total_ms"] = row["total_ms"][:2]
        row["stage_ms"] = {}
    assert {step.kind for step in steps(*rows)} == {"noise"}
    assert regret(*rows).verdict == "unknown"
    (line,) = shown(page_tables.regret(studied(*rows)))
    assert line["verdict"] == "too few rounds"


VERDICTS = [
    ([10.0, 10.0, 10.0], [9.5, 9.5, 9.5], "within"),
    ([10.0, 10.0, 10.0], [8.0, 8.0, 8.0], "above"),
    ([10.0, 10.0, 10.0], [8.0, 9.5, 9.5], "unclear"),
    ([9.0, 9.0, 9.0], [10.0, 10.0, 10.0], "within"),  # no choice is as good as the plan
]


@pytest.mark.parametrize(("ours", "theirs", "verdict"), VERDICTS)
def test_regret_is_judged_by_its_interval(ours, theirs, verdict):
    rows = [planned(1), planned(1, "none"), forced("half_shell", None, 1)]
    for row, times in zip(rows, (ours, [99.0] * 3, theirs), strict=True):
        row["total_ms"] = times
    found = regret(*rows)
    assert (found.verdict, found.choice) == (verdict, "half_shell")
    assert found.choices == 2


def test_the_best_choice_is_exact_and_no_negative_control():
    rows = group_rows(half_shell=0.5, home_phantom=0.4)
    rows[-1] = synthetic.wrong(rows[-1], missed=1)
    rows[-2] |= {"negative_control": True}
    assert regret(*rows).skips is not None


def test_a_best_choice_of_the_same_plan_is_told():
    rows = group_rows()
    same = next(row for row in rows if row["skips"] == "no_grid")
    same["total_ms"] = [0.99 * ms for ms in same["total_ms"]]
    found = regret(*rows)
    assert found.same_plan and found.choice == "no_grid"
    result = studied(*rows)
    assert shown(page_tables.regret(result))[0]["best choice"] == "no_grid (same plan)"


def test_moving_scenes_are_held_against_each_other_by_their_steady_frames():
    rows = moving_rows()
    for row in rows:
        row["total_ms"] = [ms * 7 for ms in row["total_ms"]]  # unlike the frames, to be told apart
    skin = effects(*rows)["skin"]
    assert skin.by_planned.median == pytest.approx(4) and skin.title == "gas_brownian 1k"


def test_studies_keep_backends_and_scenes_apart():
    found = ablation.regrets(every_ablation())
    assert list(found["backend"] + " " + found["title"]) == [
        *("impl_cpu gas 1k", "impl_cpu dense 5k", "impl_cpu gas_brownian 1k"),
        "impl_thrust gas 1k",
    ]
    assert ablation.unjudged(every_ablation()) == ["impl_cpu poly 2k"]


def test_variants_are_in_no_other_table_plot_or_sentence():
    rows = group_rows()
    with_them = studied(*rows)
    without = studied(*(row for row in rows if not row["skips"]))
    for name, frame in frames.all_frames(with_them).items():
        assert frame.equals(frames.all_frames(without)[name]), name
    pages = [page.render(result, page.Path("nowhere")) for result in (with_them, without)]
    assert pages[0] == pages[1]
    assert readme_bench.correctness(with_them) == readme_bench.correctness(without)
    assert list(style.looks(with_them)) == list(style.looks(without))
    assert check.judge(with_them).exact == check.judge(without).exact == 3


def test_a_wrong_variant_is_wrong_but_no_default_row(save, capsys):
    rows = group_rows()
    rows[1] = synthetic.wrong(rows[1], missed=2)
    assert main(["check", str(save(document(*rows)))]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert "skips:none/" in lines[0] and "−2 +0" in lines[0]
    assert lines[1].startswith("Exact: all 3 default rows. Wrong: 1 of 17 variants of the plan.")
    result = studied(*rows)
    assert check.judge(result).headline.zh.endswith("计划的 17 个变体中的 1 个。")
    (line,) = shown(page_tables.wrong([result]))
    assert (line["implementation"], line["missed"]) == ("impl_cpu planned, none", "2")


def test_a_variant_without_its_planned_row_is_still_judged():
    result = studied(
        synthetic.wrong(planned(1, "no_sort"), missed=1), forced("half_shell", None, 1)
    )
    assert not check.judge(result).passes
    (line,) = shown(page_tables.wrong([result]))
    assert (line["implementation"], line["kind"]) == ("impl_cpu, no_sort", "wrong")
    assert ablation.effects(result).empty and len(ablation.unjudged(result)) == 1


def test_the_map_has_a_cell_for_every_skip_with_wrong_and_skipped_ones_named():
    texts = drawn(every_ablation())["ablation_skips"]
    assert {"impl_cpu", "impl_thrust", "wrong\n−3 +1", "skipped", "few\nmovers"} <= set(texts)
    assert texts.count("2.00") >= 4  # phantoms on every scene; the colour bar may have one more


def test_what_is_not_needed_is_quiet():
    _, figure = next(plots.draw_ablation(studied(*group_rows())))
    weights = {t.get_text(): t.get_fontweight() for t in figure.axes[0].texts}
    assert (weights["2.00"], weights["1.00"]) == ("bold", "normal")


def test_one_facet_per_scene_with_the_change_of_each_step_that_tells():
    texts = drawn(studied(*group_rows()))["ablation_steps"]
    assert {"none", "+ phantoms", "planned", "−10.2", "−43.6"} <= set(texts)
    texts = drawn(every_ablation())["ablation_steps"]
    assert {"impl_thrust\ngas 1k", "wrong −3 +1", "several steps at once"} <= set(texts)


def test_the_regret_names_ratio_and_choice():
    texts = drawn(every_ablation())["ablation_regret"]
    assert {"1.67  half_shell", "1.03  half_shell"} <= set(texts)


def test_captions_come_from_the_numbers():
    _, cpu, thrust, left_out = captions.ablation(every_ablation())
    assert cpu.en == "impl_cpu: 2 of 3 scenes within 1.10; highest 1.67× on gas 1k."
    assert thrust.en.startswith("impl_thrust: 1 of 1 scenes within 1.10;")
    assert left_out.en.endswith("planned row: impl_cpu poly 2k.")
    assert all(HAN.search(note.zh) for note in (cpu, thrust, left_out))


def test_figures_are_in_english():
    texts = [text for texts in drawn(every_ablation()).values() for text in texts]
    assert not HAN.search(" ".join(texts))


def test_an_interrupted_run_and_changed_sources_are_told():
    result = studied(*group_rows(), finished=False, dirty=True)
    origin, interrupted = captions.origins([result])
    assert "with changes" in origin.en and interrupted.en.startswith("Interrupted")


def test_the_interval_is_that_of_the_rounds_and_the_same_every_time():
    values = tuple(1 + k / 100 for k in range(41))
    first = spread.estimate(values)
    assert first.median == pytest.approx(1.2) and 1.1 < first.low < 1.2 < first.high < 1.3
    spread.estimate.cache_clear()
    assert spread.estimate(values) == first
    assert spread.estimate((2.0,)) == spread.Estimate(2.0, 2.0, 2.0, 1)
