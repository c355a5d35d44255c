# SPDX-License-Identifier: MIT
"""The tables of docs/how_to/import_files.md, and that the page says what the code does."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from octocell_import.formats import FORMATS, OCTOCELL
from octocell_report import readme, readme_import
from octocell_report.fields import ReportError

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/how_to/import_files.md"
SPEED = {
    "date": "2026-01-02",
    "machine": {"cpu": "Example 9", "cores": 2, "os": "Debian"},
    "versions": {"NumPy": "2.0"},
    "atoms": 1000,
    "rows": [
        {"format": "pdb", "file_bytes": 2_000_000, "cpu_seconds": 1.25, "peak_bytes": 3_000_000}
    ],
}
COMPARED = {"date": "2026-01-02", "packages": ["a==1", "b"], "files": {"pdb": {"equal": 3}}}


def saved(folder: Path, document: object) -> Path:
    path = folder / "a.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


def lines(block: str) -> dict[str, list[str]]:
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in block.splitlines()]
    return {row[0]: row[1:] for row in rows if row}


def test_the_pages_tables_are_those_of_code_and_results():
    assert readme.rewrite(PAGE, check_only=True) == []


def test_every_format_has_a_reader_whose_module_is_there():
    pins = readme_import.read_requirements(ROOT / "reports/requirements.txt")
    found = lines(readme_import.readers(pins))
    for name, suffixes in FORMATS.items():
        known, ours, importer = found[f"`{name}`"]
        assert known.split() == suffixes
        assert (ours == "itself") == (importer == "through `octocell`") == (name in OCTOCELL)
        module = re.fullmatch(r"own, `(\w+\.py)`", importer)
        assert module is None or (ROOT / "reports/octocell_import" / module[1]).exists()
    assert found["`mmcif`"][2] == f"gemmi {pins['gemmi']}"


def test_every_format_of_the_importers_has_a_row_of_what_is_refused():
    rows = re.findall(
        r"^\| `([\w-]+)`[^|]*\|[^|]+\|[^|]+\|[^|]+\| [^|]+ \|$", PAGE.read_text(), re.M
    )
    assert set(FORMATS) - set(OCTOCELL) <= set(rows)


def test_speed_is_measured_for_every_format_of_the_importers():
    found = readme_import.read_speed(PAGE.with_name("import_speed.json"))
    assert {row.format for row in found.rows} == set(FORMATS) - set(OCTOCELL)


def test_speed(tmp_path):
    block = readme_import.speed(readme_import.read_speed(saved(tmp_path, SPEED)))
    assert lines(block)["`pdb`"] == ["2", "1.2", "3"]
    assert "one core in use; Example 9, 2 cores, Debian; NumPy 2.0; 2026-01-02." in block


def test_comparison(tmp_path):
    block = readme_import.comparison(readme_import.read_comparison(saved(tmp_path, COMPARED)))
    assert lines(block)["`pdb`"] == ["3", "–", "–", "–", "–"]
    assert block.endswith("3 files of a==1, b; 2026-01-02.")


@pytest.mark.parametrize(
    ("read", "document", "why"),
    [
        (readme_import.read_speed, SPEED | {"atoms": -1}, "atoms is -1"),
        (readme_import.read_comparison, COMPARED | {"files": {"pdb": {"fine": 1}}}, "called fine"),
    ],
)
def test_results_that_say_something_else_are_refused(tmp_path, read, document, why):
    with pytest.raises(ReportError, match=why):
        read(saved(tmp_path, document))


def test_a_library_without_a_pin_is_noticed(tmp_path):
    (tmp_path / "a.txt").write_text("numpy==2.0\n", encoding="utf-8")
    with pytest.raises(ReportError, match="pins no gemmi"):
        readme_import.read_requirements(tmp_path / "a.txt")
