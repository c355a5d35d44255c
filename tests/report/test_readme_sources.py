# SPDX-License-Identifier: MIT
"""Markers that name the result their block is written from."""

from __future__ import annotations

import json

import pytest

from octocell_report import readme_gpu, sort
from octocell_report.cli import main
from octocell_report.fields import ReportError

import synthetic
import synthetic_gpu
import test_sort
from synthetic import group, row

TEXT = """<!-- octocell:machine ../result.json -->
<!-- /octocell:machine -->
<!-- octocell:machine results/gpu.json -->
<!-- /octocell:machine -->
<!-- octocell:gpu_speed results/gpu.json -->
<!-- /octocell:gpu_speed -->
<!-- octocell:gpu_stages results/gpu.json -->
<!-- /octocell:gpu_stages -->
<!-- octocell:gpu_sorts results/sort.json -->
<!-- /octocell:gpu_sorts -->
"""


@pytest.fixture
def plain():
    return synthetic.document([group("gas", 1000)], [row()])


def test_each_block_is_written_from_its_own_result(plain, save, tmp_path, monkeypatch, capsys):
    folder, path = tmp_path / "site", tmp_path / "site" / "README.md"
    (folder / "results").mkdir(parents=True)
    path.write_text(TEXT)
    (folder / "results/gpu.json").write_text(json.dumps(synthetic_gpu.whole_run(("gas",))))
    (folder / "results/sort.json").write_text(json.dumps(test_sort.gpu_cases()))
    monkeypatch.chdir(tmp_path)  # paths are the README's, not the shell's
    save(plain)
    command = ["readme", str(path)]
    assert main([*command, "--check"]) == 1
    differing = "machine ../result.json, machine results/gpu.json, gpu_speed results/gpu.json"
    assert differing in capsys.readouterr().out
    assert main(command) == 0 and main([*command, "--check"]) == 0
    text = path.read_text()
    first, second = (line for line in text.splitlines() if "Example CPU 9000" in line)
    assert second == f"Example GPU 100; {first}"
    path.write_text(text.replace("4.77 (1.10×)", "9.77 (2.10×)"))
    assert main([*command, "--check"]) == 1
    (folder / "results/gpu.json").unlink()
    assert main([*command, "--check"]) == 2
    assert "gpu.json: cannot be read: No such file" in capsys.readouterr().err


def lines_of(block):
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in block.splitlines()]


def test_sorts_stand_beside_their_ratio_to_cub():
    block = readme_gpu.sorts(sort.parse(test_sort.gpu_cases()))
    lines = lines_of(block)
    assert lines[0] == ["sort", "key bits", "2^20", "2^24"]
    assert ["4 onesweep", "20", "4.77 (1.10×)", "4.77 (1.10×)"] in lines
    assert ["CUB", "32", "2.71", "2.71"] in lines
    assert "8" not in [line[1] for line in lines if len(line) > 1]
    assert "on Example GPU 100" in block


def test_sorts_that_are_wrong_or_missing_have_no_rate():
    bad = {"status": "wrong", "reason": "not sorted"}
    rows = [
        test_sort.gpu_row("cuda_onesweep", n=1 << 20, bits=20, **bad),
        test_sort.gpu_row("cub", n=1 << 16, bits=20, total_ms=[1.0]),
    ]
    lines = lines_of(readme_gpu.sorts(sort.parse(test_sort.document(*rows))))
    assert lines[2] == ["4 onesweep", "20", "–", "**wrong**"]
    assert lines[3] == ["CUB", "20", "0.0655", "–"]
    with pytest.raises(ReportError, match="'gpu_sorts' needs rows of a GPU"):
        readme_gpu.sorts(sort.parse(test_sort.document(test_sort.row())))
