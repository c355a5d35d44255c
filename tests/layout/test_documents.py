# SPDX-License-Identifier: MIT
"""Documents: links lead somewhere, the README stays short, both languages say the same, and words
that were given up do not come back."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from test_layout import ROOT, SOURCES, files, name_of

README, CHINESE = ROOT / "README.md", ROOT / "README.zh-CN.md"

# Archaic words and private ones, and what to write instead (docs/glossary.md has the field's).
GIVEN_UP = {
    r"anew": "again, from scratch",
    r"lest": "so that ... not",
    r"to and fro": "back and forth",
    r"whence": "where ... from",
    r"doubts?": "uncertain pair",
    r"exhibits?": "negative control",
    r"known_faults?": "known issue",
    r"near[ _-]ties": "near-tangent pairs",
    r"near pairs": "neighbor pairs",
    r"served_by": "reused",
    r"supposed_wrongly": "mispredicted",
    r"untold": "without flags",
    r"kept copy": "snapshot",
    r"rungs?": "variant",
    r"(safe|fast|float32) band": "filter",
    r"octocell:promise": "octocell:guarantee",
}
# Their history and their tests speak of them; so does English of the benefit of the doubt.
MAY_SAY = {"CHANGELOG.md", "tests/layout/test_documents.py"}
FIXED_PHRASES = re.compile(r"benefit of the doubt|beyond doubt|in doubt", re.IGNORECASE)


def documents() -> list[Path]:
    return list(files(suffixes={".md"}))


def headings(path: Path) -> list[str]:
    text = re.sub(r"^```.*?^```$", "", path.read_text(encoding="utf-8"), flags=re.M | re.S)
    return re.findall(r"^(#+) ", text, re.MULTILINE)


def links(path: Path) -> list[str]:
    """What a document links to or shows, outside of its own page, in order."""
    text = path.read_text(encoding="utf-8")
    found = re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)|<img src=\"([^\"]+)\"", text)
    return [first or second for first, second in found]


@pytest.mark.parametrize("path", documents(), ids=name_of)
def test_links_lead_somewhere(path: Path) -> None:
    for link in links(path):
        if not link.startswith(("http:", "https:", "mailto:")):
            assert (path.parent / link).exists(), link


def test_the_readme_is_a_front_door() -> None:
    text = README.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 120
    assert len(text.split()) <= 1200


def chinese_of(path: Path) -> Path:
    return path.with_name(f"{path.stem}.zh-CN{path.suffix}")


def in_chinese(path: Path, link: str) -> str:
    """Where the Chinese text beside a document should lead instead: to Chinese, if there is any."""
    there = chinese_of(path.parent / link)
    return str(Path(link).with_name(there.name)) if there.exists() else link


def test_both_readmes_have_the_same_parts() -> None:
    assert headings(README) == headings(CHINESE)
    between = {"README.md", "README.zh-CN.md"}
    assert [in_chinese(README, x) for x in links(README) if x not in between] == [
        x for x in links(CHINESE) if x not in between
    ]


@pytest.mark.parametrize("word", GIVEN_UP)
def test_words_that_were_given_up_stay_away(word: str) -> None:
    pattern = re.compile(rf"\b(?:{word})\b", re.IGNORECASE)
    for path in files(suffixes=SOURCES | {".md"}):
        if name_of(path) in MAY_SAY or "fuzz/corpus" in name_of(path):
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            plain = FIXED_PHRASES.sub("", line)
            assert not pattern.search(plain), (
                f"{name_of(path)}:{number}: write '{GIVEN_UP[word]}': {line.strip()}"
            )
