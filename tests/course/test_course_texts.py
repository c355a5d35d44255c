# SPDX-License-Identifier: MIT
"""The texts of the course: Chinese follows English, and the pictures are those of the program."""

from __future__ import annotations

import re
import subprocess
import sys
import xml.etree.ElementTree as Xml
from pathlib import Path

import pytest
from program import ROOT, Octocell
from test_documents import chinese_of, headings, in_chinese, links
from test_layout import files, name_of

PICTURES = ROOT / "course/pictures"
CHINESE = ".zh-CN"
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)


# The READMEs have a test of their own (tests/layout/test_documents.py).
TEXTS = [
    path
    for path in files(suffixes={".md"})
    if chinese_of(path).exists() and path != ROOT / "README.md"
]


def test_the_course_is_there_in_both_languages() -> None:
    chapters = {name_of(path) for path in TEXTS}
    wanted = {name_of(path) for path in (ROOT / "docs/stages").glob("[1-6]_*.md")}
    wanted = {name for name in wanted if CHINESE not in name}
    assert len(wanted) == 6
    assert wanted | {"course/README.md", "docs/glossary.md"} <= chapters
    texts = {path for path in (ROOT / "course").glob("*.md") if CHINESE not in path.name}
    assert {name_of(path) for path in texts} <= chapters


@pytest.mark.parametrize("path", TEXTS, ids=name_of)
def test_both_languages_have_the_same_parts(path: Path) -> None:
    english, chinese = path, chinese_of(path)
    assert headings(english) == headings(chinese)
    for kind in ("<details>", "\n| ", "\n* ", "\n1. "):
        here, there = (p.read_text(encoding="utf-8").count(kind) for p in (english, chinese))
        assert here == there, f"{kind.strip()}: {here} in English, {there} in Chinese"


@pytest.mark.parametrize("path", TEXTS, ids=name_of)
def test_both_languages_show_the_same_code(path: Path) -> None:
    texts = [p.read_text(encoding="utf-8") for p in (path, chinese_of(path))]
    assert FENCE.findall(texts[0]) == FENCE.findall(texts[1])


def led_to(path: Path, but: str) -> list[str]:
    """Where the links of a text lead, without those to its other language."""
    return [link for link in links(path) if link != but]


@pytest.mark.parametrize("path", TEXTS, ids=name_of)
def test_chinese_leads_to_chinese(path: Path) -> None:
    chinese = chinese_of(path)
    wanted = [in_chinese(path, link) for link in led_to(path, but=chinese.name)]
    assert led_to(chinese, but=path.name) == wanted


def rows(path: Path) -> list[list[str]]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return [re.split(r" (?<!\\)\| ", line.strip("| ")) for line in lines if line.startswith("| ")]


def test_both_glossaries_have_the_same_words() -> None:
    glossary = ROOT / "docs/glossary.md"
    english, chinese = rows(glossary), rows(chinese_of(glossary))
    assert len(english) > 80 and all(len(row) == 3 for row in english + chinese)
    assert [row[:2] for row in english] == [row[:2] for row in chinese]
    for row in chinese:
        assert re.search(r"[\u4e00-\u9fff]", row[2]), row


def test_the_pictures_are_those_of_the_program(octocell: Octocell) -> None:
    done = subprocess.run(
        [sys.executable, ROOT / "scripts/draw_course.py", "--octocell", octocell.path, "--check"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_picture_is_shown_and_is_whole() -> None:
    shown = set[str]()
    for text in files(suffixes={".md", ".html"}):
        found = re.findall(r"pictures/([\w.-]+\.svg)", text.read_text(encoding="utf-8"))
        shown |= set(found)
    there = {path.name for path in PICTURES.glob("*.svg")}
    assert there == shown
    for path in PICTURES.glob("*.svg"):
        assert Xml.parse(path).getroot().tag.endswith("svg")
