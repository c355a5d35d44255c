# SPDX-License-Identifier: MIT
"""The step page in headless Chromium: it opens from disk, steps both ways, and tells the truth."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest
from program import ROOT
from step_page import PAGE, ActionChains, By, Keys, open_page, webdriver

SIZES = ((1280, 720), (1920, 1080), (1024, 768))


def press(browser: webdriver.Chrome, *keys: str) -> None:
    ActionChains(browser).send_keys(*keys).perform()


def shown(browser: webdriver.Chrome) -> str:
    return str(browser.execute_script("return document.body.innerHTML"))


def step_shown(browser: webdriver.Chrome) -> int:
    text = browser.find_element(By.ID, "where").text
    return int(re.findall(r"\d+", text)[0])


def test_the_page_is_one_file_that_asks_no_network(browser: webdriver.Chrome, page: Path) -> None:
    assert page.stat().st_size < 3e6
    open_page(browser, page)
    requests = browser.execute_script("return performance.getEntriesByType('resource').length")
    assert requests == 0
    assert browser.get_log("browser") == []
    assert "http" not in re.sub(r"http://www\.w3\.org/\S*", "", page.read_text(encoding="utf-8"))


def test_steps_go_forward_and_back(browser: webdriver.Chrome, page: Path) -> None:
    open_page(browser, page, "scene=smaller_home")
    seen = [shown(browser)]
    for step in range(2, 25):
        press(browser, Keys.ARROW_RIGHT)
        assert step_shown(browser) == step
        seen.append(shown(browser))
    assert len(set(seen)) == len(seen)
    for before in seen[-2::-1]:
        press(browser, Keys.ARROW_LEFT)
        assert shown(browser) == before
    press(browser, Keys.END)
    assert "Missed: 1 (red)" in browser.find_element(By.ID, "say").text
    press(browser, Keys.PAGE_UP)
    assert browser.find_element(By.ID, "stage").text == "Pair tests"
    press(browser, Keys.HOME)
    assert shown(browser) == seen[0]


def test_every_text_is_there_in_both_languages() -> None:
    text = (PAGE / "texts.js").read_text(encoding="utf-8")
    body = re.search(r"const TEXTS = (\{.*\});", text, re.DOTALL)
    assert body
    entries = re.findall(
        r'^  "?([\w\' ]+)"?: \[\s*"((?:[^"\\]|\\.)*)",\s*"((?:[^"\\]|\\.)*)",?\s*\]', body[1], re.M
    )
    assert len(entries) == len(re.findall(r"^  \S.*: \[", body[1], re.M)) > 60
    for key, english, chinese in entries:
        assert english and chinese, key
        names = [Counter(re.findall(r"\{(\w+)\}", spoken)) for spoken in (english, chinese)]
        assert names[0] == names[1], key


@pytest.mark.parametrize(
    ("scene", "reason"),
    [
        ("smaller_home", "so the pair is left to cell 1026, which does not list ball 1."),
        ("both_phantoms", "The pair (0, 1) is lost. Cell 2051 is the home of neither."),
        (
            "ninth_cell",
            "All 8 places of ball 3 are used; further cells that it meets were left out.",
        ),
        ("negative", "The pair (0, 1) is lost: no cell lists both."),
    ],
)
def test_a_lost_pair_has_its_reason(
    browser: webdriver.Chrome, page: Path, scene: str, reason: str
) -> None:
    open_page(browser, page, f"scene={scene}")
    press(browser, Keys.END, Keys.ARROW_LEFT)
    assert reason in browser.find_element(By.ID, "say").text
    open_page(browser, page, f"scene={scene}&step=2")
    is_elsewhere = "but its centre is not there" in browser.find_element(By.ID, "say").text
    assert is_elsewhere == (scene == "negative")


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("size", SIZES, ids=str)
def test_nothing_is_cut_or_overlaps(
    browser: webdriver.Chrome, page: Path, size: tuple[int, int], language: str
) -> None:
    browser.set_window_rect(0, 0, *size)
    for step in (1, 5, 40, 150):
        open_page(browser, page, f"lang={language}&step={step}")
        sizes = browser.execute_script(
            "const d = document.documentElement; return [d.scrollWidth, innerWidth, d.scrollHeight,"
            " innerHeight]"
        )
        assert sizes[0] <= sizes[1] and sizes[2] <= sizes[3]
        panel = browser.execute_script(
            "const right = document.querySelector('.right');"
            " return right.scrollHeight - right.clientHeight"
        )
        assert panel <= 0, (step, "the arrays do not fit")
        boxes = browser.execute_script(
            "return [...document.querySelectorAll('header > *, footer > *, .left > *, .right > *')]"
            ".map(e => e.getBoundingClientRect()).filter(b => b.width && b.height)"
            ".map(b => [b.left, b.top, b.right, b.bottom])"
        )
        for k, a in enumerate(boxes):
            for b in boxes[k + 1 :]:
                apart = a[2] <= b[0] + 1 or b[2] <= a[0] + 1 or a[3] <= b[1] + 1 or b[3] <= a[1] + 1
                assert apart, (step, a, b)


def test_dragging_a_ball_over_a_border_changes_its_cells(
    browser: webdriver.Chrome, page: Path
) -> None:
    browser.set_window_rect(0, 0, 1280, 720)
    open_page(browser, page)
    before = browser.execute_script("return trace.stages.cell_index.cells")
    ball = browser.find_element(By.CSS_SELECTOR, '[data-ball="7"] circle')
    ActionChains(browser).drag_and_drop_by_offset(ball, 60, -45).perform()
    after = browser.execute_script("return trace.stages.cell_index.cells")
    assert [c["phantoms"] for c in before] != [c["phantoms"] for c in after]
    places = browser.execute_script("return trace.spheres[7]")
    ball = browser.find_element(By.CSS_SELECTOR, '.ball[data-ball="7"]')
    browser.execute_script("arguments[0].focus()", ball)
    ActionChains(browser).key_down(Keys.SHIFT).send_keys(Keys.ARROW_RIGHT).key_up(
        Keys.SHIFT
    ).perform()
    assert browser.execute_script("return trace.spheres[7]")[0] > places[0]


def test_questions_come_before_answers(browser: webdriver.Chrome, page: Path) -> None:
    open_page(browser, page, "step=2")
    browser.find_element(By.ID, "predict").click()
    assert browser.find_element(By.ID, "say").text == ""
    options = browser.find_elements(By.CLASS_NAME, "option")
    assert len(options) == 4 and len({option.text for option in options}) == 4
    right = browser.execute_script("return String(steps[state.step].question.answer)")
    next(option for option in options if option.text == right).click()
    assert browser.find_element(By.CLASS_NAME, "verdict").text == "Right."
    assert browser.find_element(By.ID, "score").text == "1 of 1 right"


def test_programs_that_the_page_shows_have_the_functions_it_names() -> None:
    steps = (PAGE / "steps.js").read_text(encoding="utf-8")
    named = re.findall(r'^  \w+: \["(\w+)", /(.*)/\],$', steps, re.M)
    assert len(named) == len(set(re.findall(r"CODE\.(\w+)", steps))) == 8
    for program in set(re.findall(r'"(\d_\w+\.cpp)"', steps)):
        lines = (ROOT / "course/pipeline" / program).read_text(encoding="utf-8").splitlines()
        for name, pattern in named:
            begin = next(k for k, text in enumerate(lines) if re.match(rf"\S.*\b{name}\(", text))
            end = lines.index("}", begin)
            assert any(re.search(pattern, text) for text in lines[begin:end]), (program, name)
