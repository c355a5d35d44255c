# SPDX-License-Identifier: MIT
"""The site: its pages are there, its packages are pinned, and it builds without a warning where
`make site` was run."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from program import ROOT
from test_documents import documents
from test_layout import name_of

SITE = ROOT / "scripts/site"
MKDOCS = ROOT / ".venv-site/bin/mkdocs"


def nav() -> list[str]:
    text = (SITE / "mkdocs.yml").read_text(encoding="utf-8")
    return re.findall(r"^ +- .+: (\S+\.md)$", text.partition("\nnav:\n")[2], re.M)


def test_the_pages_that_it_names_are_there_in_both_languages() -> None:
    pages = nav()
    assert len(pages) == len(set(pages)) > 30
    assert all((ROOT / page).exists() for page in pages)
    for page in pages:
        chinese = page.replace(".md", ".zh-CN.md")
        assert not (ROOT / chinese).exists() or chinese in pages, chinese
    course = {f"course/{path.name}" for path in (ROOT / "course").glob("*.md")}
    assert course <= set(pages)


def test_its_packages_are_pinned_and_only_its_own() -> None:
    lines = (SITE / "requirements.txt").read_text(encoding="utf-8").splitlines()
    assert all(re.fullmatch(r"#.*|[\w-]+==[\w.]+", line) for line in lines)
    for other in ("reports/requirements.txt", "tests/course/requirements.txt"):
        assert "mkdocs" not in (ROOT / other).read_text(encoding="utf-8")


def anchor(heading: str) -> str:
    """As GitHub makes it, and scripts/site/hooks.py."""
    plain = re.sub(r"[*`]|\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", plain.strip().lower()).replace(" ", "-")


@pytest.mark.parametrize("path", documents(), ids=name_of)
def test_links_lead_to_headings(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    for link, wanted in re.findall(r"\]\(([^)#\s]*)#([^)\s]+)\)", text):
        target = path if not link else path.parent / link
        if "://" in link or target.suffix != ".md":
            continue
        other = re.sub(r"^```.*?^```$", "", target.read_text(encoding="utf-8"), flags=re.M | re.S)
        assert wanted in map(anchor, re.findall(r"^#+ (.+)$", other, re.M)), f"{link}#{wanted}"


@pytest.mark.skipif(not MKDOCS.exists(), reason="no MkDocs here; make site installs it")
def test_it_builds_without_a_warning(tmp_path: Path) -> None:
    done = subprocess.run(
        [MKDOCS, "build", "--strict", "-f", SITE / "mkdocs.yml", "-d", tmp_path / "site"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    for page in nav():
        built = page.replace("README.md", "index.html").replace(".md", ".html")
        assert (tmp_path / "site" / built).exists()
    chapter = (tmp_path / "site/docs/stages/2_cell_ids.html").read_text(encoding="utf-8")
    assert "core/grid.hpp.source.html" in chapter
    assert "monotone" in (tmp_path / "site/core/grid.hpp.source.html").read_text(encoding="utf-8")
    for file in (tmp_path / "site").rglob("*.html"):
        loads = re.findall(r'(?:src|href)="(https?://[^"]+\.(?:js|css))"', file.read_text())
        assert not loads, (file, loads)
