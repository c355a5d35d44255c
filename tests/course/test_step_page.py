# SPDX-License-Identifier: MIT
"""The step page in headless Chromium: it opens from disk, steps both ways, and tells the truth."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hard_scenes import Spheres
from program import ROOT, RULES, Octocell

pytest.importorskip("selenium", reason="no selenium: scripts/setup_browser.sh installs it")
if not (shutil.which("chromium") and shutil.which("chromedriver")):
    pytest.skip("no Chromium: scripts/setup_browser.sh installs it", allow_module_level=True)

from selenium import webdriver  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402

PAGE = ROOT / "course/page"
SIZES = ((1280, 720), (1920, 1080), (1024, 768))
EMPTY = 0xFFFFFFFF

Trace = dict[str, Any]


@pytest.fixture(scope="module")
def page(octocell: Octocell, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What `make steps` writes."""
    path = tmp_path_factory.mktemp("page") / "steps.html"
    scenes = sorted((ROOT / "course/scenes").glob("*.csv"), key=lambda path: path.stem != "eight")
    octocell.ok("trace", *scenes, "--rule", "as_written", "--html", path)
    return path


@pytest.fixture(scope="module")
def browser() -> Iterator[webdriver.Chrome]:
    options = webdriver.ChromeOptions()
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    options.binary_location = str(shutil.which("chromium"))
    service = webdriver.ChromeService(str(shutil.which("chromedriver")))
    driver = webdriver.Chrome(options, service)
    yield driver
    driver.quit()


def open_page(browser: webdriver.Chrome, page: Path, query: str = "") -> None:
    browser.get(f"{page.as_uri()}?{query}")
    ready = "const done = arguments[0]; const ask = () => document.body.classList.contains('ready')"
    browser.execute_async_script(f"{ready} ? done() : setTimeout(ask, 20); ask();")


def press(browser: webdriver.Chrome, *keys: str) -> None:
    ActionChains(browser).send_keys(*keys).perform()


def shown(browser: webdriver.Chrome) -> str:
    return str(browser.execute_script("return document.body.innerHTML"))


def step_shown(browser: webdriver.Chrome) -> int:
    text = browser.find_element(By.ID, "where").text
    return int(re.findall(r"\d+", text)[0])


def traced(browser: webdriver.Chrome, spheres: Spheres, rule: str) -> Trace:
    script = "return tracer.trace(arguments[0], arguments[1], 0)"
    found: Trace = browser.execute_script(script, spheres.tolist(), rule)
    return found


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
    assert "missed" in browser.find_element(By.ID, "say").text
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
            "const right = document.querySelector('.right'); return right.scrollHeight - right.clientHeight"
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


def test_the_module_agrees_with_runs_on_random_scenes(
    browser: webdriver.Chrome, page: Path, octocell: Octocell, tmp_path: Path
) -> None:
    """Cells, homes, phantoms, pairs: a thousand runs."""
    open_page(browser, page)
    ways = [(b, r) for b in ("impl_cpu", "impl_thrust") for r in RULES]
    for number, spheres in enumerate(random_scenes(1000)):
        backend, rule = ways[number % len(ways)]
        np.save(tmp_path / "scene.npy", spheres)
        asked = (tmp_path / "scene.npy", "--backend", backend, "--rule", rule)
        octocell.ok("trace", *asked, "-o", tmp_path / "trace.json")
        recorded = json.loads((tmp_path / "trace.json").read_text(encoding="utf-8"))
        script = "return compareWith(arguments[0], tracer).key"
        assert browser.execute_script(script, recorded) == "recorded_same", (number, rule)


def random_scenes(count: int) -> Iterator[Spheres]:
    random = np.random.default_rng(3)
    for _ in range(count):
        n, size = random.integers(2, 25), random.uniform(2, 12)
        places = random.uniform(-size / 4, size, (n, 3))
        places[:, 2] *= random.choice([0.0, 1.0])
        yield np.column_stack([places, random.uniform(0.2, 1, n)]).astype(np.float32)


def test_the_module_gives_the_pairs_of_octocell(
    browser: webdriver.Chrome, page: Path, octocell: Octocell, tmp_path: Path
) -> None:
    open_page(browser, page)
    for spheres in random_scenes(25):
        np.save(tmp_path / "scene.npy", spheres)
        for options in (
            ("--rule", "as_written"),
            ("--rule", "chapter32"),
            ("--rule", "lowest_cell"),
            ("--method", "half_shell"),
        ):
            octocell.ok("find", tmp_path / "scene.npy", *options, "-o", tmp_path / "pairs.npy")
            found = traced(browser, spheres, options[1])
            assert found["pairs"] == np.load(tmp_path / "pairs.npy").tolist(), options
        assert found["exact"] == np.load(tmp_path / "pairs.npy").tolist()


def printed_entries(text: str, title: str) -> list[list[tuple[int, int, int, bool]]]:
    """Place, cell, sphere and phantom or not, under each heading of that name."""
    blocks = re.findall(rf"^{title}\n((?:  \[.*\n)*)", text, re.M)
    line = r"\[(\d+)\] cell (\d+): sphere (\d+) (\w+)"
    return [
        [(int(k), int(cell), int(s), kind == "phantom") for k, cell, s, kind in re.findall(line, b)]
        for b in blocks
    ]


def entries_of(arrays: Trace) -> list[tuple[int, int, int, bool]]:
    return [
        (k, id_, o["sphere"], o["phantom"])
        for k, (id_, o) in enumerate(zip(arrays["cell_ids"], arrays["objects"], strict=True))
        if id_ != EMPTY
    ]


def test_the_module_makes_the_arrays_of_the_text(
    browser: webdriver.Chrome, page: Path, tmp_path: Path
) -> None:
    program = tmp_path / "1_as_written"
    source = ROOT / "course/pipeline/1_as_written.cpp"
    subprocess.run(["g++", "-std=c++20", "-ffp-contract=off", source, "-o", program], check=True)
    open_page(browser, page)
    for spheres in random_scenes(1000):
        rows = [",".join(np.format_float_positional(v, unique=True) for v in s) for s in spheres]
        (tmp_path / "scene.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
        text = subprocess.run(
            [program, tmp_path / "scene.csv"], capture_output=True, text=True, check=True
        ).stdout
        found = traced(browser, spheres, "as_written")["stages"]
        assert printed_entries(text, "cells of each sphere") == [entries_of(found["cell_ids"])]
        assert printed_entries(text, " sorted") == [
            entries_of(one) for one in found["sort"]["passes"]
        ]
        cells = re.findall(r"cell (\d+): begins at (\d+), H = (\d+), P = (\d+)", text)
        names = ("cell", "begin", "homes", "phantoms")
        assert [[c[name] for name in names] for c in found["cell_index"]["cells"]] == [
            list(map(int, cell)) for cell in cells
        ]


@pytest.mark.parametrize(
    "options",
    [
        ("--rule", "as_written"),
        ("--rule", "chapter32"),
        ("--rule", "lowest_cell"),
        ("--rule", "lowest_cell", "--cell-side", "1.25", "--backend", "impl_thrust"),
        ("--method", "half_shell"),
        ("--method", "brute_force"),
    ],
    ids=" ".join,
)
def test_the_page_agrees_with_the_run_that_it_holds(
    browser: webdriver.Chrome, octocell: Octocell, tmp_path: Path, options: tuple[str, ...]
) -> None:
    scenes = ("course/scenes/eight.csv", "gas:n=32,phi=0.3", "poly:n=20")
    asked = [ROOT / scene if "/" in scene else scene for scene in scenes]
    octocell.ok("trace", *asked, *options, "--html", tmp_path / "page.html")
    open_page(browser, tmp_path / "page.html")
    for scene in range(len(scenes)):
        browser.execute_script(
            "const choice = document.getElementById('scene'); choice.value = arguments[0];"
            "choice.dispatchEvent(new Event('input'))",
            scene,
        )
        said = browser.find_element(By.ID, "recorded")
        assert said.text.startswith("A recorded run of impl_") and " has the same " in said.text
        side = browser.execute_script("return trace.side")
        if "--cell-side" in options:
            assert side == 1.25 and "cells of 1.25" in said.text
    browser.execute_script("SCENES[0].recorded.pairs.pop(); state.scene = 0; show()")
    assert "differs" in browser.find_element(By.ID, "recorded").text


def test_the_committed_module_is_built_of_these_sources() -> None:
    script = ROOT / "scripts/build_page_module.sh"
    done = subprocess.run([script, "--digest"], capture_output=True, text=True, check=True)
    recorded = (PAGE / "module.sha256").read_text(encoding="utf-8")
    assert done.stdout == recorded, "run scripts/build_page_module.sh"


def test_programs_that_the_page_shows_have_the_functions_it_names() -> None:
    steps = (PAGE / "steps.js").read_text(encoding="utf-8")
    named = re.findall(r'^  \w+: \["(\w+)", /(.*)/\],$', steps, re.M)
    assert len(named) == len(set(re.findall(r"code: CODE\.(\w+)", steps))) == 8
    for program in set(re.findall(r'"(\d_\w+\.cpp)"', steps)):
        lines = (ROOT / "course/pipeline" / program).read_text(encoding="utf-8").splitlines()
        for name, pattern in named:
            begin = next(k for k, text in enumerate(lines) if re.match(rf"\S.*\b{name}\(", text))
            end = lines.index("}", begin)
            assert any(re.search(pattern, text) for text in lines[begin:end]), (program, name)


def test_traces_are_json_throughout(browser: webdriver.Chrome, page: Path) -> None:
    open_page(browser, page)
    found = traced(browser, next(random_scenes(1)), "lowest_cell")
    assert set(found["stages"]) == {"cell_ids", "sort", "cell_index", "pair_tests"}
    assert json.loads(json.dumps(found)) == found
