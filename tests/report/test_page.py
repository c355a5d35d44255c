# SPDX-License-Identifier: MIT
"""The built folder, the page in it, and the command's exit codes."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd
import pytest

from octocell_report import captions, check, front, images, page, page_tables, plots, style, words
from octocell_report.cli import main
from octocell_report.load import STAGES, load, parse

import synthetic
from synthetic import group, row, wrong

PUBLISHED = Path(__file__).resolve().parents[2] / "reports/results/epyc-zen5-2core/quick.json.gz"
PNG = b"\x89PNG\r\n"
LAWS = ((1.5e-4, 1.04), (7e-4, 1.11), (4e-4, 1.08))  # [ms] of ours, FCL's and Bullet's fastest


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
        assert path.read_text().startswith("<svg")
        assert path.read_text().count("@font-face") == 2  # it needs no font of the reader's


def test_svg_files_are_the_same_in_every_run(save, tmp_path):
    path = save(synthetic.document([group("gas", 1000)], [row()]))
    for name in ("a", "b"):
        assert main(["build", str(path), "-o", str(tmp_path / name)]) == 0
    first, second = ((tmp_path / name / "front.svg").read_bytes() for name in ("a", "b"))
    assert first == second


def test_the_page_needs_nothing_from_outside(built):
    html = (built / "index.html").read_text()
    assert html.count("<svg") == len(list(built.glob("*.svg")))
    outside = (
        r"(https?:)?//[a-z]|@import|<script[^>]|<link|<img|url\((?!#|data:font)"
        r"|fetch\(|XMLHttp|import\("
    )
    assert not re.search(outside, re.sub(r"base64,[^)]*", "", html))


def test_pictures_in_the_page_share_nothing_but_fonts_and_looks(built):
    """What a picture refers to lies in it: another one may be hidden. A class that no picture has
    defined would leave its part black."""
    html = (built / "index.html").read_text()
    style, pictures = html.partition("</style>")[0], re.findall("<svg.*?</svg>", html, re.DOTALL)
    for picture in pictures:
        ids = re.findall(r' id="([^"]*)"', picture)
        assert {*re.findall(r'(?:url\(|href=")#([^")]*)', picture)} <= {*ids}
        assert 'style="' not in picture
        for name in {*re.findall(r' class="([^"]*)"', picture)}:
            assert f".{name}{{" in style
    every = re.findall(r' id="([^"]*)"', "".join(pictures))
    assert len(every) == len({*every})


def test_the_published_page_weighs_at_most_3_mb(tmp_path):
    """Its tables, and its pictures: with both studies they weigh 14 times what this one does."""
    result = load(PUBLISHED)
    tables = page.render(result, tmp_path)
    with plt.rc_context(style.RC):
        figure = plots.DRAWS["time_warm"](result, style.looks(result))
        (tmp_path / "time_warm.svg").write_text(images.svg(figure), encoding="utf-8")
        plt.close(figure)
    picture = images.Gallery(tmp_path).pictures["time_warm"]
    assert picture.count("<text") > 100
    assert len(tables.encode()) + 14 * len(picture.encode()) < 3e6


def test_the_page_is_complete_without_its_script(built):
    html = re.sub(r"<script>.*?</script>", "", (built / "index.html").read_text(), flags=re.DOTALL)
    assert 'id="language-en" value="en" checked' in html
    assert "#language-en:checked ~ .page [lang=zh]" in html
    assert "<button" not in html and 'type="search"' not in html  # made by the script alone
    for text in ("Time against size", "时间与规模", "times as fast", "速度倍数"):
        assert text in html


def test_the_page_opens_with_the_answer(built):
    """Exact or not, then the one plot, then its numbers; everything else comes later."""
    html = (built / "index.html").read_text().partition("<main")[2]
    marks = ("<h1", "<svg", "<figcaption", "<table", "<dl", "<section")
    places = [html.index(mark) for mark in marks]
    assert places == sorted(places)
    first = html.partition("</h1>")[0]
    assert 'class="wrong"' in first and "Wrong: 4 of" in first and "错误：" in first
    ours, fcl, bullet = (f * 1e6 * 100_000 ** (b - 1) * 1.02 for f, b in LAWS)
    assert f"Octocell {words.number(ours)} ns per sphere" in html
    assert f"FCL {words.number(fcl)} ns, {words.number(fcl / ours)} times" in html
    assert f"Bullet {words.number(bullet)} ns, {words.number(bullet / ours)} times" in html


def test_the_front_holds_the_fastest_exact_rows_of_one_run(every_case):
    fast = wrong(row("bullet_dbvt", None, None, name="fast", n=1000, total_ms=[1e-9]), missed=1)
    every_case["rows"] += [fast, row(run="cold", name="colder", total_ms=[1e-9])]
    times = front.best(parse(every_case))
    assert list(times.columns) == ["Octocell", "FCL", "Bullet"]
    assert times.index[0] == ("gas", 1000)
    laws = [f * 1e6 * 1000 ** (b - 1) * 1.02 for f, b in LAWS]
    assert list(times.loc[("gas", 1000)]) == pytest.approx(laws)
    largest = front.at_largest(times)
    assert list(largest.index.unique(0)) == list(times.index.unique(0)) and largest.index.is_unique
    ratios, first = front.ratios(largest), largest.iloc[0]
    assert list(ratios.columns) == ["FCL", "Bullet"]
    assert ratios["FCL"].iloc[0] == pytest.approx(first["FCL"] / first["Octocell"])


def test_planned_rows_stand_for_ours_where_there_are_any():
    rows = [row(total_ms=[1.0]), row(method="planned", rule=None, total_ms=[2.0])]
    rows.append(row(method="planned", rule=None, threads=2, name="two", total_ms=[3.0]))
    times = front.best(parse(synthetic.document([group("gas", 1000)], rows)))
    assert times.iloc[0].to_dict() == {"Octocell": 2000.0, "Octocell, 2 threads": 3000.0}


@pytest.mark.parametrize("sizes", [{"gas": [1000]}, {"poly": [1000], "gas": [10, 100]}, {}])
def test_the_front_is_drawn_for_one_size_and_for_many(sizes):
    figure = plots.front.draw(parse(synthetic.whole_run(sizes)))
    if not sizes:
        assert figure is None
        return
    titles = [ax.get_title() for ax in figure.axes]
    several = sizes["gas"] != [1000]
    assert titles == (["gas"] if several else []) + ["each scene at its largest size"]
    if several:
        assert list(figure.axes[0].lines[0].get_xdata()) == [10, 100]
    plt.close(figure)


def test_the_picture_of_errors_is_small_and_absent_where_all_is_exact(every_case):
    figure, (ax,) = axes_of(every_case, "correctness")
    assert len(ax.get_yticks()) < parse(every_case).frame["label"].nunique()
    assert ax.get_yticklabels()[-1].get_text().endswith(" others")
    assert figure.get_figheight() < 4
    drawn = dict(plots.draw_all(parse(synthetic.document([group("gas", 1000)], [row()]))))
    assert "correctness" not in drawn


def test_speed_ups_are_taken_round_by_round(every_case):
    table = page_tables.english(page_tables.speedups(parse(every_case)))
    assert set(table["run"]) == {"cold", "warm", "first update", "update"}
    line = table.query("run == 'update' and implementation == 'impl_cpu lowest_cell'").iloc[0]
    # Ours, warm, 1.5e-4 n^1.04; FCL's fastest at update, 0.7 * 7e-4 n^1.11; round k alike.
    law = 0.7 * 7e-4 * 1000**1.11 / (1.5e-4 * 1000**1.04)
    assert f"{law:.2f}" == "5.30"
    assert (line["times as fast"], line["rounds"]) == ("5.30× (5.30×–5.30×)", "3")


def test_cells_are_sorted_by_their_numbers(built):
    html = (built / "index.html").read_text()
    assert '<td data-value="100000">100k</td>' in html
    assert re.search(r'<td data-value="0\.\d+">0\.\d+<small>', html)


def test_the_page_says_what_happened(built):
    html = (built / "index.html").read_text()
    assert "This run was interrupted." in html
    assert "data/1A2C.pqr is not there: fetch it first" in html
    assert "chapter32 needs radii within a factor of 2" in html
    assert "<td>bullet_dbvt</td>" in html and "−3 +20 ×2" in html
    assert "Example CPU 9000" in html and "0123456789ab" in html


def test_wrong_rows_are_listed_with_what_they_lose(every_case):
    table = page_tables.english(page_tables.wrong([parse(every_case)])).set_index("implementation")
    line = table.loc["bullet_dbvt"]
    assert list(line) == ["wrong", "poly", "10k", "3", "0.0150", "20", "2"]
    assert (table.loc["impl_cpu as_written", "kind"] == "negative control").all()


def test_the_page_tells_no_tale_of_an_interruption_that_was_not(every_case):
    every_case["context"]["finished"] = True
    assert "was interrupted." not in page.render(parse(every_case), page.Path("nowhere"))


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
    assert "notes.txt" in names and "front.png" in names
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
    assert capsys.readouterr().out == "Exact: all 2 default rows. 0 skipped, 1 negative controls.\n"


def test_a_known_fault_excuses_missed_pairs_and_nothing_else(save, capsys):
    known = row("fcl_sap", None, None, known_issues="ties are lost")
    for losses, code in (({"missed": 3}, 0), ({"missed": 3, "false": 1}, 1)):
        document = synthetic.document([group("gas", 1000)], [row(), wrong(known, **losses)])
        assert main(["check", str(save(document))]) == code
    assert "1 miss pairs by known" not in capsys.readouterr().out.splitlines()[-1]
    result = parse(synthetic.document([group("gas", 1000)], [row(), wrong(known, missed=3)]))
    assert check.summary(result).startswith("Exact: all 1 default rows. 0 skipped")
    (line,) = page_tables.english(page_tables.wrong([result])).to_dict("records")
    assert (line["implementation"], line["kind"]) == ("fcl_sap", "known issue")
    assert "1 wrong by known issues" in captions.counts(result, check.judge(result))[0].en


def test_check_does_not_pass_where_nothing_was_checked(save, capsys):
    assert main(["check", str(save(synthetic.document([], [])))]) == 1
    assert "Nothing was checked" in capsys.readouterr().out


def test_a_result_without_rows_still_makes_a_page(save, tmp_path):
    assert main(["build", str(save(synthetic.document([], []))), "-o", str(tmp_path / "o")]) == 0
    assert [path.name for path in (tmp_path / "o").iterdir()] == ["index.html"]
    html = (tmp_path / "o" / "index.html").read_text()
    assert "Nothing was checked" in html and "<img" not in html


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
    assert "impl_cpu as_written (negative control)   up to −33.3k +0" in legend
    assert not any("as_written" in entry and "n^" in entry for entry in legend)
    hollow = next(line for line in axes[0].lines if "as_written" in line.get_label())
    assert (hollow.get_linestyle(), hollow.get_markerfacecolor()) == ("None", "white")


def test_a_fused_stage_is_named(every_case):
    figure, _ = axes_of(every_case, "stages_backend")
    assert any("resolve is inside pair_tests" in text for text in texts(figure))


def test_the_matrix_picture_holds_every_verdict(every_case):
    figure, _ = axes_of(every_case, "correctness")
    shown = {text.partition("\n")[0] for text in texts(figure)}
    assert {"exact", "−3 +20 ×2"} <= shown


def test_one_look_per_implementation(every_case):
    every_case["rows"] += [row(f"impl_{k}", name=f"extra {k}") for k in range(9)]
    looks = style.looks(parse(every_case)).values()
    assert len({(look.colour, str(look.line)) for look in looks}) == len(looks)
    assert len({(look.colour, str(look.marker)) for look in looks}) == len(looks)


def test_every_stage_has_a_colour_of_its_own():
    assert len({style.stage_colour(stage) for stage in STAGES}) == len(STAGES)
