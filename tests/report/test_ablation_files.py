# SPDX-License-Identifier: MIT
"""What the command writes for an ablation, and what it adds to the page."""

from __future__ import annotations

import json

import pandas as pd
import pytest

from octocell_report import plots, study_files
from octocell_report.cli import main
from octocell_report.load import parse

import synthetic
import synthetic_ablation
from synthetic_ablation import document, group_rows, planned

TABLES = ["ablation.csv", "ablation.md"]


def owned():
    return study_files.of_ablation(parse(synthetic_ablation.every_case())).owned


def test_files_of_the_command(save, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["ablation", str(save(synthetic_ablation.every_case())), "-o", str(out)]) == 0
    assert {path.name for path in out.iterdir()} == owned()
    printed = capsys.readouterr().out.splitlines()
    assert len([line for line in printed if line.startswith("wrong: ")]) == 3
    table = pd.read_csv(out / "ablation.csv")
    assert len(table) == len(synthetic_ablation.every_case()["rows"])
    bad = table[table.status != "ok"]
    assert len(bad) == 4 and bad.by_planned_median.isna().all()
    assert table.query("skips == 'no_phantoms' and n == 1000").by_planned_median.tolist() == (
        pytest.approx([2.0, 2.0, 2.0])
    )
    regret = pd.read_csv(out / "regret.csv")
    assert regret.verdict.tolist() == ["above", "within", "within", "within"]
    text = (out / "ablation.md").read_text()
    assert "| dense 5k | impl_cpu | **1.11** |" in text and "wrong −3 +1 | skipped |" in text
    chapter = "## Each skip forbidden alone\n\n![Time without the skip by the planned time;"
    assert chapter in text and "nothing should change.](ablation_skips.png)" in text


def test_one_scene_of_variants_alone_makes_no_figure_but_its_tables(tmp_path):
    result = parse(document(planned(1, "no_sort")))
    assert study_files.of_ablation(result).build(tmp_path / "out") == TABLES
    assert len(pd.read_csv(tmp_path / "out" / "ablation.csv")) == 1


def test_no_ablation_is_refused_in_one_line(save, tmp_path, capsys):
    path = save(synthetic.document([synthetic.group("gas", 1000)], [synthetic.row()]))
    for command in (["ablation", str(path)], ["build", str(path), "--ablation", str(path)]):
        assert main([*command, "-o", str(tmp_path / "out")]) == 2
        error = capsys.readouterr().err
        assert error.startswith(f"octocell-report: {path}: has no planned row with skips")
    assert not (tmp_path / "out").exists()


def built(save, out, *options):
    bench = save(synthetic.document([synthetic.group("gas", 1000)], [synthetic.row()]))
    assert main(["build", str(bench), "-o", str(out), *options]) == 0
    return (out / "index.html").read_text()


def test_the_page_has_the_sections_if_the_folder_holds_an_ablation(save, tmp_path):
    out = tmp_path / "out"
    assert "ablation_skips" not in built(save, out)
    (out / "ablation.json").write_text(json.dumps(synthetic_ablation.every_case()))
    html = built(save, out)
    names = (*plots.ABLATION_NAMES, "regret")
    places = [html.index(f'<details id="block-{name}"') for name in names]
    assert places == sorted(places)
    told = (
        *("Measured on Example CPU 9000, 2026-01-02", "测于 Example CPU 9000", "逐一禁止每项省略"),
        *("<td>impl_cpu planned, no_sort</td>", "first_11_skin (same plan)"),
    )
    for text in told:
        assert text in html
    assert owned() <= {path.name for path in out.iterdir()}
    assert "Exact: all 1 default rows." in html


def test_an_ablation_may_be_named_and_its_files_stay_when_none_is(save, tmp_path):
    path, out = tmp_path / "other.json", tmp_path / "out"
    path.write_text(json.dumps(document(*group_rows())))
    assert 'id="block-regret"' in built(save, out, "--ablation", str(path))
    assert 'id="block-regret"' not in built(save, out)
    assert (out / "ablation_regret.png").exists()


def test_an_ablation_that_cannot_be_read_is_named(save, tmp_path, capsys):
    out = tmp_path / "out"
    out.mkdir()
    (out / "ablation.json").write_text("{")
    assert main(["build", str(save(document(*group_rows()))), "-o", str(out)]) == 2
    assert f"{out / 'ablation.json'}: not JSON" in capsys.readouterr().err
