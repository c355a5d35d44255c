# SPDX-License-Identifier: MIT
"""`python -m octocell_grade`: a folder of hand-ins becomes a table, a page and a file for each."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from hand_in_sources import PYTHON
from program import ROOT, Octocell

from octocell_grade.rubric import Rubric, read_rubric
from octocell_report.fields import ReportError

RUBRIC = (
    '[speed]\nn = 1000\nfull_at = 1e5\nnone_at = 1e9\n[report]\npoints = 7\nnames = ["report.md"]'
)


def grade(octocell: Octocell, folder: Path, *options: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "octocell_grade", "class", "-o", "grades.csv"]
    limits = ["--octocell", str(octocell.path), "--budget", "0.01", "--timeout", "30"]
    return subprocess.run(
        [*command, *limits, *options],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT / "reports")},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


def test_a_class_is_graded(octocell: Octocell, tmp_path: Path) -> None:
    hand_ins = tmp_path / "class"
    (hand_ins / "=team").mkdir(parents=True)
    (hand_ins / "=team/find_pairs.py").write_text(PYTHON, encoding="utf-8")
    (hand_ins / "=team/helper.py").touch()
    (hand_ins / "=team/report.md").write_text("# Ours", encoding="utf-8")
    with zipfile.ZipFile(hand_ins / "wrong.zip", "w") as archive:
        archive.writestr("a/mine.py", "def find_pairs(s): return [[0, 1]] if len(s) == 2 else []")
    (hand_ins / "broken.zip").write_bytes(b"PK no archive")
    (hand_ins / "crash.py").write_text("import os\nos.abort()", encoding="utf-8")
    (tmp_path / "rubric.toml").write_text(RUBRIC, encoding="utf-8")

    done = grade(octocell, tmp_path, "--rubric", "rubric.toml")
    assert (done.returncode, done.stderr) == (0, "")
    with open(tmp_path / "grades.csv", encoding="utf-8", newline="") as file:
        rows = {row["name"]: row for row in csv.DictReader(file)}
    assert {name: row["verdict"] for name, row in rows.items()} == {
        "'=team": "exact",
        "broken.zip": "cannot be judged",
        "crash.py": "cannot be judged",
        "wrong.zip": "wrong",
    }
    team = rows["'=team"]
    points = [team[name] for name in ("small", "kinds", "stress", "larger", "speed", "report")]
    assert points == ["20.0", "20.0", "0.0", "10.0", "20.0", "7.0"]
    assert float(team["total"]) == 77 and float(team["ms"]) > 0 < float(team["reference_ms"])
    assert (rows["crash.py"]["kind"], rows["crash.py"]["total"]) == ("crashed", "0.0")
    assert rows["broken.zip"]["reason"].startswith("cannot be unpacked")
    assert rows["wrong.zip"]["at"] == "chain:n=3,spacing=1"
    page = (tmp_path / "grades.html").read_text(encoding="utf-8")
    assert page.index("=team") < page.index("wrong.zip") and "threads" in page
    kept = json.loads((tmp_path / "grades/wrong.zip.json").read_text(encoding="utf-8"))
    assert kept["trial"]["judgement"]["missed"] > 0

    # What was graded stays, unless it changed.
    (hand_ins / "crash.py").write_text("import os\nos._exit(3)", encoding="utf-8")
    again = grade(octocell, tmp_path, "--rubric", "rubric.toml").stdout
    assert again.count("graded before") == 3 and "crash.py: cannot be judged, 0 of 97" in again


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("[speed]\nfull_at = 9\nnone_at = 2", "speed.full_at must be above 0 and below"),
        ("[sped]\npoints = 9", "unknown field `sped`"),
        ("speed = ", "Invalid value"),
    ],
)
def test_a_bad_rubric_is_named(tmp_path: Path, text: str, reason: str) -> None:
    (tmp_path / "r.toml").write_text(text, encoding="utf-8")
    with pytest.raises(ReportError, match=f"r.toml: .*{reason}"):
        read_rubric(tmp_path / "r.toml")
    assert Rubric().most == 100


def test_a_folder_must_be_there(octocell: Octocell, tmp_path: Path) -> None:
    done = grade(octocell, tmp_path)
    assert (done.returncode, done.stderr) == (2, "octocell-grade: class: no such folder\n")
    (tmp_path / "class").mkdir()
    assert "holds no hand-ins" in grade(octocell, tmp_path).stderr
