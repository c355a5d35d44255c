# SPDX-License-Identifier: MIT
"""Run time against error: its figures, the files of the command, and its part of the page."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd
import pytest

from octocell_report import page, plots, study_files
from octocell_report.cli import main
from octocell_report.error import Study
from octocell_report.load import parse
from octocell_report.plots import butterfly
from octocell_report.predicates import PREDICATES

import synthetic
import synthetic_error
from synthetic_error import document, row


def study_of(*documents):
    return Study(parse(document) for document in documents)


@pytest.fixture(scope="module")
def both():
    return study_of(synthetic_error.host(), synthetic_error.device())


@pytest.fixture(scope="module")
def drawn(both):
    """Its figures by name."""
    return dict(plots.draw_error(both))


def texts(figure):
    return [text.get_text().strip() for text in figure.findobj(plt.Text)]


def figures_of(study):
    """The texts of each, by name."""
    return {name: texts(figure) for name, figure in plots.draw_error(study)}


def test_the_figures_say_what_stands_in_the_numbers(drawn):
    assert tuple(drawn) == plots.ERROR_NAMES
    said = texts(drawn["error_pareto"])
    for text in (
        *("random", "structured", "extreme"),
        "0 of 2.66M true pairs wrong:\nbelow 1.1 per million (95 %: 3/N)",
        "gas, poly, dense\n"
        "GPU: impl_cuda_custom q16_exact, 0.211 ns\nCPU: impl_cpu q16_exact, 37.5 ns",
        *("fcl_interval_tree", "aabb_only", "f32: float32, D ≤ s²", "impl_thrust_cuda", "Bullet"),
    ):
        assert text in said, text
    beside = [text.get_text().strip() for ax in drawn["error_pareto"].axes for text in ax.texts]
    assert beside.count("f16_cell") == 6  # it loses and invents pairs in each class
    assert {"exact", "0", "−2.1k\n+940", "+5.1M", "−446k"} <= set(texts(drawn["error_map"]))
    assert "deepest pair lost / (rᵢ + rⱼ)" in texts(drawn["error_depth"])


def test_bold_marks_stand_at_the_median_time(both, drawn):
    """Not at that of their worst scene: that would tell scenes apart, not tests."""
    medians = set(both.points.groupby(["scene_class", "series"])["ns_per_sphere"].median())
    found = [
        mark.get_xdata()[0]
        for name in ("error_pareto", "error_depth")
        for ax in drawn[name].axes
        for mark in ax.lines
        if mark.get_linestyle() == "None" and mark.get_markersize() >= butterfly.BOLD
    ]
    assert len(found) > 40
    assert set(found) <= medians


def test_labels_of_marks_do_not_cover_each_other(drawn):
    met = 0
    for name in ("error_pareto", "error_depth"):
        figure = drawn[name]
        renderer = figure.canvas.get_renderer()
        for ax in figure.axes:
            known = {*PREDICATES, "fcl_interval_tree"}
            notes = [text for text in ax.texts if text.get_text().strip() in known]
            boxes = [note.get_window_extent(renderer) for note in notes]
            for one, other in itertools.combinations(boxes, 2):
                assert not one.overlaps(other), (name, [note.get_text() for note in notes])
            met += len(notes)
    assert met > 30


def test_one_class_and_one_backend_are_enough():
    rows = [row(ns=2.0), row(ns=1.0, predicate="f32", losses=(3, 0))]
    figures = figures_of(study_of(document(*rows)))
    assert tuple(figures) == plots.ERROR_NAMES
    assert "gas\nCPU: impl_cpu exact, 2.08 ns" in figures["error_pareto"]


def test_without_an_error_there_is_nothing_to_plot_against():
    figures = figures_of(study_of(document(row(), row(predicate="f32"))))
    assert tuple(figures) == ("error_map",) and "0" in figures["error_map"]


def test_files_from_before_predicates_show_libraries_beside_exact():
    rows = [row(), row("fcl_a", None, None, None, ns=900.0, losses=(7, 0))]
    rows[0]["predicate"] = None
    study = study_of(document(*rows))
    assert not study.compares and study.points["predicate"][0] == "exact"
    assert "fcl_a" in figures_of(study)["error_pareto"]


def test_a_missed_tie_is_drawn_although_its_depth_is_zero():
    rows = [row(), row(predicate="f32", losses=(3, 0), worst_missed_depth=0.0)]
    assert "error_depth" in figures_of(study_of(document(*rows)))


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    folder = tmp_path_factory.mktemp("results")
    for name in ("host", "device"):
        made = getattr(synthetic_error, name)()
        (folder / f"{name}.json").write_text(json.dumps(made))
    return folder


def test_files_of_the_command(saved, tmp_path, capsys):
    out = tmp_path / "out"
    files = [str(saved / f"{name}.json") for name in ("host", "device")]
    assert main(["error", *files, "-o", str(out)]) == 0
    assert {path.name for path in out.iterdir()} == study_files.of_error(
        study_of(synthetic_error.host())
    ).owned
    assert "54 of the 54 rows that claim to be exact are" in capsys.readouterr().out
    table = pd.read_csv(out / "error.csv")
    f32 = table.query("backend == 'impl_cpu' and predicate == 'f32' and scene == 'fcc'")
    assert f32.false_per_million.item() == pytest.approx(1014, abs=0.5)
    assert f32.bound_per_million.item() == pytest.approx(3e6 / 5_850_400)
    assert not f32.claims_exact.item() and math.isnan(f32.worst_missed_depth.item())
    costs = pd.read_csv(out / "error_costs.csv")
    assert len(costs) == 4 * 9 and costs.rounds.tolist() == [5] * 36
    assert pd.read_csv(out / "error_rounding.csv").lost.tolist() == [410_000, 1204]
    text = (out / "error.md").read_text()
    assert "Example GPU 100" in text and "| gas 1M | impl_cpu | 1.07 (" in text


def test_no_experiment_is_refused_in_one_line(save, tmp_path, capsys):
    path = save(synthetic.document([synthetic.group("gas", 1000)], [synthetic.row()]))
    for command in (["error", str(path)], ["build", str(path), "--error", str(path)]):
        assert main([*command, "-o", str(tmp_path / "out")]) == 2
        said = capsys.readouterr().err
        assert said.startswith(f"octocell-report: {path}: no warm row that ran is on a scene")
    assert not (tmp_path / "out").exists()


def test_the_page_has_the_sections_if_the_folder_holds_results(saved, save, tmp_path):
    out = tmp_path / "out"
    bench = save(synthetic.document([synthetic.group("gas", 1000)], [synthetic.row()]))
    out.mkdir()
    for name in ("host", "device"):
        (out / f"error_{name}.json").write_text((saved / f"{name}.json").read_text())
    assert main(["build", str(bench), "-o", str(out)]) == 0
    html = (out / "index.html").read_text()
    names = (*plots.ERROR_NAMES, "costs", "rounding")
    places = [html.index(f'<details id="block-{name}"') for name in names]
    assert places == sorted(places)
    for text in ("运行时间与误差", "54 of the 54 rows", "410\u202f000"):
        assert text in html
    assert study_files.of_error(study_of(synthetic_error.host())).owned <= {
        path.name for path in out.iterdir()
    }


def test_a_page_without_them_has_no_such_section():
    bench = parse(synthetic.document([synthetic.group("gas", 1000)], [synthetic.row()]))
    html = page.render(bench, Path("nowhere"))
    assert "error_pareto" not in html and "block-costs" not in html


def test_a_result_that_is_an_experiment_itself_has_the_sections(save, tmp_path):
    known = document(row(ns=2.0), row(predicate="f32", losses=(0, 5)))
    assert main(["build", str(save(known)), "-o", str(tmp_path / "out")]) == 0
    html = (tmp_path / "out" / "index.html").read_text()
    assert 'id="block-error_pareto"' in html and "Exact: all 1 default rows." in html
