# SPDX-License-Identifier: MIT
"""The slides: both languages have the same, they ask no network, and nothing is cut off."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from program import ROOT

SLIDES = ROOT / "course/slides"
ENGLISH, CHINESE = SLIDES / "slides.html", SLIDES / "slides.zh-CN.html"
LONGER_THAN_ITS_PLACE = """
  return [...slides[shown() - 1].querySelectorAll('*'), slides[shown() - 1]].filter((e) =>
    e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0 ||
    e.scrollHeight > e.clientHeight + 1 && e.clientHeight > 0 ||
    e.getBoundingClientRect().bottom > innerHeight).map((e) => e.outerHTML.slice(0, 80))
"""


def slides_of(path: Path) -> list[str]:
    text = path.read_text(encoding="utf-8")
    return re.findall(r"<section[^>]*>\n(.*?)\n</section>", text, re.S)


def test_both_languages_have_the_same_slides() -> None:
    english, chinese = slides_of(ENGLISH), slides_of(CHINESE)
    assert len(english) == len(chinese) > 20
    for here, there in zip(english, chinese, strict=True):
        assert re.findall(r"<(\w+)", here) == re.findall(r"<(\w+)", there)
        assert re.search(r"[\u4e00-\u9fff]", there), there
        pictures = [re.findall(r'src="(\S+?)"', slide) for slide in (here, there)]
        assert [name.replace(".svg", ".zh-CN.svg") for name in pictures[0]] == pictures[1]
        assert all((SLIDES / name).exists() for name in pictures[0] + pictures[1])


def test_they_ask_no_network() -> None:
    for path in SLIDES.iterdir():
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"https?://|@import|fetch\(", text), path


def test_the_lesson_names_the_slides_that_there_are() -> None:
    text = (ROOT / "course/lesson.md").read_text(encoding="utf-8")
    named = [list(map(int, found)) for found in re.findall(r"Slides (\d+) to (\d+)", text)]
    assert named[0][0] == 1 and max(map(max, named)) < len(slides_of(ENGLISH))
    for (_, end), (begin, _) in pairwise(named):
        assert begin == end + 1


@pytest.mark.parametrize("path", [ENGLISH, CHINESE], ids=lambda path: path.name)
def test_nothing_is_cut_off(browser: Any, path: Path) -> None:
    browser.set_window_size(1280, 860)
    browser.get(path.as_uri())
    for number in range(1, len(slides_of(path)) + 1):
        browser.execute_script(f"go({number}); show()")
        assert browser.execute_script("return shown()") == number
        assert browser.execute_script(LONGER_THAN_ITS_PLACE) == [], number
        loaded = "return [...document.images].every((i) => i.complete && i.naturalWidth > 0)"
        assert browser.execute_script(loaded)


def test_keys_step(browser: Any) -> None:
    from selenium.webdriver.common.keys import Keys

    browser.get(ENGLISH.as_uri())
    body = browser.find_element("tag name", "body")
    body.send_keys(Keys.ARROW_RIGHT, Keys.SPACE, Keys.ARROW_LEFT)
    assert browser.execute_script("return shown()") == 2
    body.send_keys("l")
    assert browser.current_url.endswith("slides.zh-CN.html#2")
