# SPDX-License-Identifier: MIT
"""The C++ inside the step page makes the arrays of course/pipeline and of recorded runs."""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hard_scenes import Spheres
from program import ROOT, RULES, Octocell
from step_page import PAGE, By, Trace, open_page, traced, webdriver

EMPTY = 0xFFFFFFFF


def random_scenes(count: int) -> Iterator[Spheres]:
    random = np.random.default_rng(3)
    for _ in range(count):
        n, size = random.integers(2, 25), random.uniform(2, 12)
        places = random.uniform(-size / 4, size, (n, 3))
        places[:, 2] *= random.choice([0.0, 1.0])
        yield np.column_stack([places, random.uniform(0.2, 1, n)]).astype(np.float32)


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


def test_the_page_of_the_course_loses_what_the_program_loses(
    browser: webdriver.Chrome, page: Path, octocell: Octocell
) -> None:
    open_page(browser, page)
    names = browser.execute_script("return SCENES.map(scene => scene.name)")
    script = "return SCENES.map(scene => compareWith(scene.recorded, tracer).key)"
    assert browser.execute_script(script) == ["recorded_same"] * len(names)
    counted = browser.execute_script(
        "return SCENES.map(scene => numbersOf(tracer.trace(scene.spheres, 'as_written', 0)))"
    )
    for name, numbers in zip(names, counted, strict=True):
        scene = ROOT / f"course/scenes/{name}.csv"
        checked = octocell.run("check", scene, "--backend", "impl_cpu").stdout
        row = re.search(r"impl_cpu home_phantom as_written +(.*)", checked)
        assert row
        lost = re.match(r"missed (\d+).*, false 0, duplicates (\d+)", row[1])
        assert (numbers["missed"], numbers["duplicates"]) == (
            (int(lost[1]), int(lost[2])) if lost else (0, 0)
        ), (name, row[1])


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
    browser.execute_script("SCENES[0].recorded.pairs.pop(); state.scene = 0; reset(); retrace()")
    assert "differs" in browser.find_element(By.ID, "recorded").text


def test_the_committed_module_is_built_of_these_sources() -> None:
    script = ROOT / "scripts/build_page_module.sh"
    done = subprocess.run([script, "--digest"], capture_output=True, text=True, check=True)
    recorded = (PAGE / "module.sha256").read_text(encoding="utf-8")
    assert done.stdout == recorded, "run scripts/build_page_module.sh"


def test_traces_are_json_throughout(browser: webdriver.Chrome, page: Path) -> None:
    open_page(browser, page)
    found = traced(browser, next(random_scenes(1)), "lowest_cell")
    assert set(found["stages"]) == {"cell_ids", "sort", "cell_index", "pair_tests"}
    assert json.loads(json.dumps(found)) == found
