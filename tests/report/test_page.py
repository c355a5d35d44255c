# SPDX-License-Identifier: MIT
"""The built folder, the page in it, and the command's exit codes."""

from __future__ import annotations

import itertools
import json
import re
import shutil

import matplotlib.pyplot as plt
import pandas as pd
import pytest

from octocell_report import check, findings, page, page_tables, plots, style
from octocell_report.cli import main
from octocell_report.load import STAGES, parse

import synthetic
from synthetic import group, row, wrong

PNG = b"\x89PNG\r\n"


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A folder built from every case; not to be changed."""
    folder = tmp_path_factory.mktemp("built")
    result, out = folder / "result.json", folder / "out"
    result.write_text(json.dumps(synthetic.every_case()))
    assert main(["build", str(result), "-o", str(out)]) == 0
    return out


def test_build_writes_every_plot_every_table_and_a_page(built):
    names = {path.name for path in built.iterdir()}
    device = ("stages_device", "bandwidth", "bandwidth_by_size")
    absent = {f"{name}.{ending}" for name in (*device, "dynamic") for ending in ("png", "svg")}
    assert names == page.owned_names() - absent - {"bandwidth.csv", "frames.csv"}
    for path in built.glob("*.png"):
        assert path.read_bytes().startswith(PNG)
    for path in built.glob("*.svg"):
        assert "<svg" in path.read_text() and "<text" not in path.read_text()  # no font needed


def test_svg_files_are_the_same_in_every_run(save, tmp_path):
    path = save(synthetic.document([group("gas", 1000)], [row()]))
    for name in ("a", "b"):
        assert main(["build", str(path), "-o", str(tmp_path / name)]) == 0
    first, second = ((tmp_path / name / "correctness.svg").read_bytes() for name in ("a", "b"))
    assert first == second


def test_the_page_needs_nothing_from_outside(built):
    html = (built / "index.html").read_text()
    sources = re.findall(r'src="(.{22})', html)
    assert len(sources) == len(list(built.glob("*.png")))
    assert set(sources) == {"data:image/png;base64,"}
    outside = r"(https?:)?//[a-z]|@import|<script[^>]|<link|url\(|fetch\(|XMLHttp|import\("
    assert not re.search(outside, re.sub(r'src="[^"]*"', "", html))


def test_the_page_is_complete_without_its_script(built):
    html = re.sub(r"<script>.*?</script>", "", (built / "index.html").read_text(), flags=re.DOTALL)
    assert 'id="language-en" value="en" checked' in html
    assert "#language-en:checked ~ main [lang=zh]" in html
    assert "<button" not in html and 'type="search"' not in html  # made by the script alone
    for text in ("Time against size, warm", "时间与规模，热运行", "lowest to highest round"):
        assert text in html


def test_names_of_scenes_do_not_run_into_each_other():
    names = ("poly(ratio=1e6)", "shifted(offset=1e7)", "lattice", "two_clusters_far_apart")
    groups = [group(name, 1000) for name in names]
    result = parse(synthetic.document(groups, [row(scene=name) for name in names]))
    figure = plots.correctness.draw(result, style.looks(result))
    figure.canvas.draw()
    headings = [text for text in figure.axes[0].texts if text.get_weight() == "bold"]
    assert [text.get_text().replace("\n", "") for text in headings] == list(names)
    assert len({text.get_fontsize() for text in headings}) == 1
    boxes = [text.get_window_extent() for text in headings]
    assert all(left.x1 < right.x0 for left, right in itertools.pairwise(boxes))
    plt.close(figure)


def test_speed_ups_have_a_table_for_every_run(every_case):
    found = page_tables.speedups(parse(every_case))
    assert list(found) == ["cold", "warm", "first_update", "update"]
    line = next(
        line for line in found["update"].lines if line.cells[2].text == "impl_cpu lowest_cell"
    )
    # Ours, warm, 1.5e-4 n^1.04; FCL's fastest at update, 0.7 * 7e-4 n^1.11; round k alike.
    law = 0.7 * 7e-4 * 1000**1.11 / (1.5e-4 * 1000**1.04)
    assert line.cells[4].value == pytest.approx(law)
    assert (line.cells[5].text, line.cells[6].text) == ("5.30× .. 5.30×", "3")


def test_cells_are_sorted_by_their_numbers(built):
    html = (built / "index.html").read_text()
    assert '<td class="size" data-value="100000">100k</td>' in html
    assert re.search(r'<td class="time" data-value="0\.\d+">0\.\d+<small>', html)


def test_the_page_says_what_happened(built):
    html = (built / "index.html").read_text()
    assert "This run was interrupted." in html
    assert "4 of" in html and "default rows are wrong." in html
    assert "data/1A2C.pqr is not there: fetch it first" in html
    assert "chapter32 needs radii within a factor of 2" in html
    assert "wrong −3 +20 ×2" in html
    assert "One size only, so no curve: giant." in html
    assert "bullet_dbvt is wrong on poly 10k (−3 +20 ×2)." in html
    assert "Example CPU 9000" in html and "0123456789ab" in html


def test_the_page_tells_no_tale_of_an_interruption_that_was_not(every_case):
    every_case["context"]["finished"] = True
    assert "interrupted." not in page.render(parse(every_case), page.Path("nowhere"))


def test_names_are_escaped(every_case):
    every_case["context"]["machine"]["cpu"] = "<b>fast</b>"
    assert "&lt;b&gt;fast" in page.render(parse(every_case), page.Path("nowhere"))


def test_tables_hold_unrounded_numbers(built):
    times = pd.read_csv(built / "times.csv")
    mine = times.query("scene == 'gas' and n == 1000 and run == 'warm' and rule == 'lowest_cell'")
    expected = synthetic.times(1.5e-4, 1.04, 1000)
    assert mine.median_ms.item() == pytest.approx(expected[1], rel=1e-12)
    assert mine.ns_per_sphere.item() == pytest.approx(expected[1] * 1e3)
    slopes = pd.read_csv(built / "slopes.csv").query("scene == 'gas' and run == 'warm'")
    assert slopes.set_index("implementation").slope["bullet_dbvt"] == pytest.approx(1.08)
    ratios = pd.read_csv(built / "ratios.csv").query("scene == 'gas' and n == 1000")
    bullet = ratios.query("run == 'warm' and against == 'bullet'").set_index("implementation")
    law = 4e-4 * 1000**1.08 / (1.5e-4 * 1000**1.04)
    assert bullet.times_as_fast_median["impl_cpu lowest_cell"] == pytest.approx(law)
    assert "−3 +20 ×2" in (built / "correctness.csv").read_text()


def test_old_plots_go_and_other_files_stay(built, save, tmp_path):
    out = shutil.copytree(built, tmp_path / "out")
    (out / "notes.txt").write_text("mine")
    small = synthetic.document([group("gas", 1000)], [row()])
    assert main(["build", str(save(small)), "-o", str(out)]) == 0
    names = {path.name for path in out.iterdir()}
    assert "notes.txt" in names and "correctness.png" in names
    assert "time_warm.png" not in names and "skipped.csv" not in names
    assert not [name for name in names if name.startswith(".")]


@pytest.mark.parametrize("text", ["{", '{"schema": 9}', None])
def test_bad_input_exits_2_and_writes_nothing(tmp_path, text, capsys):
    path, out = tmp_path / "bad.json", tmp_path / "out"
    if text is not None:
        path.write_text(text)
    for command in (["build", str(path), "-o", str(out)], ["check", str(path)]):
        assert main(command) == 2
        error = capsys.readouterr().err
        assert error.startswith(f"octocell-report: {path}: ") and error.count("\n") == 1
    assert not out.exists()


def test_a_failure_half_way_leaves_the_folder_as_it_was(every_case, save, tmp_path, monkeypatch):
    out = tmp_path / "out"
    out.mkdir()
    (out / "index.html").write_text("old")

    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(page, "render", fail)
    assert main(["build", str(save(every_case)), "-o", str(out)]) == 2
    assert [(p.name, p.read_text()) for p in out.iterdir()] == [("index.html", "old")]


def test_an_output_that_is_a_file_is_an_error(every_case, save, tmp_path, capsys):
    (tmp_path / "out").write_text("")
    assert main(["build", str(save(every_case)), "-o", str(tmp_path / "out")]) == 2
    assert "is not a folder" in capsys.readouterr().err


def test_check_lists_wrong_rows_but_no_negative_controls(every_case, save, capsys):
    assert main(["check", str(save(every_case))]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 5  # cold, warm, first and later update of one baseline, and the summary
    assert all("backend:bullet_dbvt/" in line and "−3 +20 ×2" in line for line in lines[:4])
    assert "interrupted" in lines[4] and "1A2C" in lines[4]


def test_check_passes_with_one_line_when_only_negative_controls_are_wrong(save, capsys):
    rows = [row(), row(run="cold"), wrong(row(rule="as_written", negative_control=True), missed=9)]
    assert main(["check", str(save(synthetic.document([group("gas", 1000)], rows)))]) == 0
    assert (
        capsys.readouterr().out == "All 2 default rows are exact. 0 skipped, 1 negative controls.\n"
    )


def test_a_known_fault_excuses_missed_pairs_and_nothing_else(save, capsys):
    known = row("fcl_sap", None, None, known_issues="ties are lost")
    for losses, code in (({"missed": 3}, 0), ({"missed": 3, "false": 1}, 1)):
        document = synthetic.document([group("gas", 1000)], [row(), wrong(known, **losses)])
        assert main(["check", str(save(document))]) == code
    assert "1 miss pairs by known" not in capsys.readouterr().out.splitlines()[-1]
    result = parse(synthetic.document([group("gas", 1000)], [row(), wrong(known, missed=3)]))
    assert check.summary(check.judge(result)).startswith("The only default row is exact. 0 skipped")
    assert "fcl_sap is wrong on gas 1k (−3 +0)." in findings.correctness(result)
    assert "1 rows of baselines miss pairs" in findings.overview(result)[0]


def test_check_does_not_pass_where_nothing_was_checked(save, capsys):
    assert main(["check", str(save(synthetic.document([], [])))]) == 1
    assert "nothing was checked" in capsys.readouterr().out


def test_a_result_without_rows_still_makes_a_page(save, tmp_path):
    assert main(["build", str(save(synthetic.document([], []))), "-o", str(tmp_path / "o")]) == 0
    assert [path.name for path in (tmp_path / "o").iterdir()] == ["index.html"]


def axes_of(document, name):
    for found, figure in plots.draw_all(parse(document)):
        if found == name:
            return figure, [ax for ax in figure.axes if ax.get_visible()]
    raise AssertionError(f"no plot {name}")


def texts(figure):
    return [t.get_text() for t in figure.findobj(plt.Text)]


def test_time_has_a_facet_per_scene_of_two_sizes_and_no_line_for_negative_controls(every_case):
    _, axes = axes_of(every_case, "time_warm")
    assert [ax.get_title(loc="left") for ax in axes] == ["gas", "poly"]
    legend = [text.get_text() for text in axes[0].get_legend().get_texts()]
    assert "impl_cpu lowest_cell   n^1.04" in legend
    assert "impl_cpu as_written (negative control)   −missed +false" in legend
    assert not any("as_written" in entry and "n^" in entry for entry in legend)
    assert "−334 +0" in [text.get_text() for text in axes[0].texts]


def test_a_fused_stage_is_named(every_case):
    figure, _ = axes_of(every_case, "stages_backend")
    assert any("resolve is inside pair_tests" in text for text in texts(figure))


def test_the_matrix_picture_holds_every_verdict(every_case):
    figure, _ = axes_of(every_case, "correctness")
    shown = {text.replace("\n", " ") for text in texts(figure)}
    assert {"exact", "−3 +20 ×2", "−334 +0", "over limit", "no scene"} <= shown


def test_one_look_per_implementation(every_case):
    every_case["rows"] += [row(f"impl_{k}", name=f"extra {k}") for k in range(9)]
    looks = style.looks(parse(every_case)).values()
    assert len({(look.colour, str(look.line)) for look in looks}) == len(looks)
    assert len({(look.colour, str(look.marker)) for look in looks}) == len(looks)


def test_every_stage_has_a_colour_of_its_own():
    assert len({style.stage_colour(stage) for stage in STAGES}) == len(STAGES)


def test_sentences_come_from_the_numbers():
    rows = [
        row(total_ms=[1.0]),
        row("fcl_a", None, None, total_ms=[3.0]),
        row("bullet_a", None, None, total_ms=[0.5]),
    ]
    result = parse(synthetic.document([group("gas", 1000)], rows))
    fcl, bullet = findings.speed(result, "warm")
    assert fcl == (
        "Warm, our fastest exact row is ahead of FCL's fastest in 1 of 1 groups: "
        "3.00× as fast, median 3.00×."
    )
    assert "in 0 of 1 groups: 0.50×" in bullet
    assert check.headline(check.judge(result)) == "All 3 default rows are exact."
