# SPDX-License-Identifier: MIT
"""Figures: nothing is cut off, every series is there, and what is not exact is marked."""

from __future__ import annotations

import matplotlib.pyplot as plt
import pytest
from PIL import Image

from octocell_report import images, plots, style
from octocell_report.error import Study
from octocell_report.load import parse
from octocell_report.plots import facets

import synthetic
import synthetic_ablation
import synthetic_error
import synthetic_gpu
from synthetic import group, row, skipped, wrong


def drawn(figures, *names):
    """Those of these names; they are closed with the test."""
    return {name: figure for name, figure in figures if not names or name in names}


def bench(*names):
    return drawn(plots.draw_all(parse(synthetic.every_case())), *names)


def device(*names):
    return drawn(plots.draw_all(parse(synthetic_gpu.whole_run())), *names)


def error(*names):
    study = Study([parse(synthetic_error.host()), parse(synthetic_error.device())])
    return drawn(plots.draw_error(study), *names)


def error_of_a_host(*names):
    return drawn(plots.draw_error(Study([parse(synthetic_error.host())])), *names)


def ablation(*names):
    return drawn(plots.draw_ablation(parse(synthetic_ablation.every_case())), *names)


def texts(ax):
    return [text.get_text() for text in ax.texts]


def names_of(ax):
    return [label.get_text() for label in ax.get_yticklabels()]


@pytest.mark.parametrize(
    ("figures", "names"),
    [
        (bench, ("time_warm", "stages_backend", "stages_per_sphere", "speed_warm", "memory")),
        (device, ("bandwidth", "bandwidth_by_size")),
        (error, plots.ERROR_NAMES),
        (error_of_a_host, ("error_pareto",)),  # few entries of the key stand in the short column
        (ablation, plots.ABLATION_NAMES),
    ],
)
def test_nothing_is_cut_off(figures, names):
    with plt.rc_context({"figure.max_open_warning": 0}):
        found = figures(*names)
        assert set(found) == set(names)
        for name, figure in found.items():
            figure.draw_without_rendering()
            box = figure.get_tightbbox(figure.canvas.get_renderer())  # inches
            width, height = figure.get_size_inches()
            assert box.x0 > -0.01 and box.y0 > -0.01, name
            assert box.x1 < width + 0.01 and box.y1 < height + 0.01, name
            plt.close(figure)


def test_figures_are_all_as_wide():
    figures = bench("time_warm", "memory") | ablation("ablation_skips") | error("error_map")
    assert {figure.get_size_inches()[0] for figure in figures.values()} == {12.5}


def test_speed_has_a_facet_per_place_and_a_mark_per_library():
    figure = bench("speed_warm")["speed_warm"]
    first = figure.axes[0]
    assert first.get_title(loc="left") == "gas 1k"
    assert names_of(first) == ["impl_cpu lowest_cell", "impl_cpu chapter32", "impl_cpu brute_force"]
    # 7e-4 n^1.11 and 4e-4 n^1.08 by 1.5e-4 n^1.04, at 1000
    assert {"▲ FCL", "▼ Bullet", "7.57×", "3.52×"} <= set(texts(first))
    marks = [line.get_marker() for line in first.lines if line.get_marker() != "None"]
    assert sorted(marks) == ["^"] * 3 + ["v"] * 3
    assert first.get_xlabel() == "fcl_dynamic_aabb_tree_morton, bullet_dbvt"
    assert first.get_xscale() == "log"


def test_bars_that_are_not_exact_are_hatched():
    for name in ("stages_backend", "memory"):
        ax = bench(name)[name].axes[0]
        middles = [
            p.get_y() + p.get_height() / 2 for p in ax.patches if p.get_hatch() and p.get_width()
        ]
        hatched = {names_of(ax)[round(y)] for y in middles}
        assert hatched == {"impl_cpu as_written (negative control)"}, name


def test_bars_of_stages_share_one_length_and_long_ones_are_cut():
    rows = [
        row(rule=rule, name=rule, total_ms=[ms]) for rule, ms in (("a", 1.0), ("b", 1.2), ("c", 9))
    ]
    rows.append(skipped(row(rule="d", name="d"), "no room"))
    result = parse(synthetic.document([group("gas", 1000)], rows))
    ax = drawn(plots.draw_all(result), "stages_backend")["stages_backend"].axes[0]
    assert names_of(ax) == ["impl_cpu a", "impl_cpu b", "impl_cpu c", "impl_cpu d"]
    ends = [
        sum(p.get_width() for p in ax.patches if round(p.get_y() + 0.31) == y) for y in range(4)
    ]
    assert ends == pytest.approx([1.0, 1.2, 3 * 1.2, 0.0])
    after = texts(ax)[-4:]
    assert after[2] == "» cut: 9.00 ms · 9\u202f000 ns/sphere" and after[3] == "skipped: no room"
    assert "40%" in texts(ax)  # pair_tests


def test_what_is_too_little_to_tell_is_hollow():
    tiny = {"bounds": 1000, "sort": 1_450_000_000}
    known = synthetic_gpu.device_row(stage_ms={"bounds": [1.0], "sort": [1.0]}, stage_bytes=tiny)
    document = synthetic.document([group("gas", 10**6)], [known], gpu=synthetic_gpu.gpu())
    ax = drawn(plots.draw_all(parse(document)), "bandwidth")["bandwidth"].axes[0]
    assert names_of(ax) == ["bounds", "sort", "all stages"]
    assert [bar.get_facecolor() == (1, 1, 1, 1) for bar in ax.patches] == [True, False, False]
    assert texts(ax)[1] == "1\u202f450 · 50 %" and texts(ax)[0].endswith("only 1000 bytes")


def test_a_wrong_row_has_a_hollow_mark_and_no_line():
    rows = [row(n=n, name=f"a{n}", total_ms=[n / 1e3]) for n in (1000, 2000)]
    rows += [wrong(row("fcl_a", None, None, n=n, name=f"b{n}"), missed=n) for n in (1000, 2000)]
    result = parse(synthetic.document([group("gas", 1000), group("gas", 2000)], rows))
    ax = drawn(plots.draw_all(result), "time_warm")["time_warm"].axes[0]
    lines = {line.get_label(): line for line in ax.lines}
    assert list(lines) == ["impl_cpu lowest_cell   n^1.00", "fcl_a   up to −2000 +0"]
    hollow = lines["fcl_a   up to −2000 +0"]
    assert (hollow.get_linestyle(), hollow.get_markerfacecolor()) == ("None", "white")
    assert ax.get_xscale() == ax.get_yscale() == "log"


def test_pale_and_rare_colours_are_kept_in_files(tmp_path):
    figure, (ax,) = facets.grid("title", [""], [4])
    ax.set_facecolor(style.APART_FILL)
    ax.scatter(range(400), range(400), c=range(400))
    ax.plot([300], [100], "s", color=style.VERMILLION)
    images.write([("a", figure)], tmp_path)
    plt.close(figure)
    with Image.open(tmp_path / "a.png") as image:
        counts = {colour: count for count, colour in image.convert("RGB").getcolors()}
    assert min(counts[255, 255, 255], counts[0xF1, 0xF2, 0xF4]) > 10_000
    assert counts[0xD5, 0x5E, 0x00] > 100


def test_names_are_moved_as_little_as_they_must_be():
    assert facets.apart([0.1, 0.5, 0.9], 0.1) == pytest.approx([0.1, 0.5, 0.9])
    assert facets.apart([0.5, 0.5, 0.8], 0.1) == pytest.approx([0.45, 0.55, 0.8])
    assert facets.apart([0.3, 0.4, 0.4, 0.5], 0.2) == pytest.approx([0.1, 0.3, 0.5, 0.7])
    assert facets.apart([0.0, 0.0, 1.0], 0.1) == pytest.approx([0.05, 0.15, 0.95])


def test_rows_beside_a_higher_facet_are_as_high():
    figure, axes = facets.grid("title", ["few", "many"], [2, 8], columns=2)
    for ax, count in zip(axes, (2, 8), strict=True):
        facets.rows(ax, [str(k) for k in range(count)])
    assert axes[0].get_ylim() == axes[1].get_ylim() == (7.6, -0.6)
    plt.close(figure)
