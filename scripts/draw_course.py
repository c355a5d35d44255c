#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws course/pictures, in English and Chinese: `make course-pictures`.

  scripts/draw_course.py --octocell build/octocell           writes
  scripts/draw_course.py --octocell build/octocell --check   exits 1 if a picture is old

Cells, arrays and pairs are those that the program prints; times are those of the published result.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "scripts"))

from course_lost import LOST_SCENES, lost  # noqa: E402
from course_sort import ladder, look_back, lsd  # noqa: E402
from course_svg import FINE, GREY, HOME, INK, LOST, PHANTOM, Canvas, Plane  # noqa: E402

FOUR = ["docs/stages/four.csv", "--cell-side", "4", "--no-skip", "uncertain_pairs"]
ID_BITS, PHANTOM_BIT = (1 << 28) - 1, 1 << 31  # of an object word
WAITING = "#e5e7eb"
CELL_COLOURS = {0: "#cfe8d5", 1: "#f6dfa6", 2: "#e6d3ee", 3: "#cfe0f2"}
Json = dict[str, Any]
Say = Callable[[str, str], str]  # English or Chinese


class Program:
    def __init__(self, path: Path) -> None:
        self.path = path.resolve()

    def printed(self, *arguments: str) -> str:
        done = subprocess.run([self.path, *arguments], cwd=ROOT, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"octocell {' '.join(arguments)}: {done.stderr.strip()}")
        return done.stdout

    def trace(self, *arguments: str) -> Json:
        with TemporaryDirectory() as folder:
            path = Path(folder) / "trace.json"
            self.printed("trace", *arguments, "-o", str(path))
            recorded: Json = json.loads(path.read_text(encoding="utf-8"))
        return recorded


def label(word: int) -> str:
    return f"{word & ID_BITS}{'P' if word & PHANTOM_BIT else 'H'}"


def fills(cell_ids: list[int]) -> list[str]:
    return [CELL_COLOURS[i] for i in cell_ids]


def balls_alone(program: Program, say: Say) -> Canvas:
    """The scene of the chapters, before anything is known."""
    canvas = Canvas(760, 400, say("Four balls: which pairs overlap?", "四个球：哪些球对重叠？"))
    plane = Plane(canvas, (150, 15), (-1.3, -1.3), (7, 5.6), 54)
    for i, (x, y, _, r) in enumerate(program.trace(*FOUR)["spheres"]):
        plane.ball(x, y, r, i)
    return canvas


def four_balls(program: Program, say: Say) -> Canvas:
    """The same, with the cells of ball 1."""
    run = program.trace(*FOUR)
    canvas = Canvas(
        760, 400, say("Four balls and the cells of ball 1", "四个球，以及球 1 的单元格")
    )
    plane = Plane(canvas, (15, 15), (-1.3, -1.3), (7, 5.6), 54)
    plane.grid(4, range(2), range(2))
    entries = run["stages"]["cell_ids"]
    for cell, word in zip(entries["cell_ids"], entries["objects"], strict=True):
        if word & ID_BITS == 1:
            fill = PHANTOM if word & PHANTOM_BIT else "#66aad7"
            plane.cell(cell % 2, cell // 2, 4, fill, GREY)
    for cell, x in enumerate((3.85, 6.85) * 2):
        canvas.text(plane.x(x), plane.y(cell // 2 * 4 + 0.2),
                    say(f"cell {cell}", f"单元格 {cell}"), 14, anchor="end")  # fmt: skip
    for i, j in run["pairs"]:
        plane.join(run["spheres"][i], run["spheres"][j], FINE)
    for i, (x, y, _, r) in enumerate(run["spheres"]):
        plane.ball(x, y, r, i)
    pairs = " ".join(f"({i}, {j})" for i, j in run["pairs"])
    key = [
        ("#66aad7", say("home of ball 1: its centre is here", "球 1 的主单元格：球心在此")),
        (PHANTOM, say("phantoms: its box reaches here", "球 1 的幻影单元格：包围盒触及")),
        (FINE, say(f"overlap: {pairs}", f"重叠：{pairs}")),
    ]
    for k, (colour, words) in enumerate(key):
        canvas.box(480, 40 + 38 * k, 18, 18, colour, GREY)
        canvas.text(506, 54 + 38 * k, words, 15, anchor="start")
    words = say("side 4; the grid begins at (0, 0)", "边长 4；网格始于 (0, 0)")
    canvas.text(480, 180, words, 15, GREY, "start")
    return canvas


def sort_pass(program: Program, say: Say) -> Canvas:
    """The one pass of the worked example: where each entry goes."""
    stages = program.trace(*FOUR)["stages"]
    before, done = stages["cell_ids"], stages["sort"]["passes"][0]
    canvas = Canvas(760, 330, say("A pass of the sort moves entries", "一趟排序移动各个元素"))
    left, width = 200, 64
    names = [
        (say("cell id", "单元格编号"), 35),
        (say("sphere", "球"), 69),
        (say("place", "位置"), 105),
        (say("cell id", "单元格编号"), 225),
        (say("sphere", "球"), 259),
    ]
    for name, y in names:
        canvas.text(left - 14, y + 22, name, 14, GREY, "end")
    for y, part in ((35, before), (225, done)):
        canvas.cell_row(left, y, [str(i) for i in part["cell_ids"]], fills(part["cell_ids"]), width)
        canvas.cell_row(left, y + 34, [label(w) for w in part["objects"]],
                        fills(part["cell_ids"]), width)  # fmt: skip
    for k, to in enumerate(done["destinations"]):
        canvas.text(left + (k + 0.5) * width, 124, k, 12, GREY)
        canvas.line(left + (k + 0.5) * width, 130, left + (to + 0.5) * width, 222, INK, 1.4, True)
    starts = [
        say(f"cell {digit} from place {offset}", f"单元格 {digit} 始于位置 {offset}")
        for digit, offset in enumerate(done["offsets"])
    ]
    canvas.text(left + 4 * width, 318, " · ".join(starts), 13, GREY)
    return canvas


def cell_index(program: Program, say: Say) -> Canvas:
    """The sorted array and the cells that stage 4 lists."""
    stages = program.trace(*FOUR)["stages"]
    ids, words = stages["sort"]["cell_ids"], stages["sort"]["objects"]
    canvas = Canvas(
        760, 220, say("Cells are runs of the sorted array", "单元格是有序数组中的连续段")
    )
    left, width = 120, 74
    canvas.text(left - 12, 62, say("cell id", "单元格编号"), 14, GREY, "end")
    canvas.text(left - 12, 96, say("sphere", "球"), 14, GREY, "end")
    canvas.cell_row(left, 40, [str(i) for i in ids], fills(ids), width)
    canvas.cell_row(left, 74, [label(w) for w in words], fills(ids), width)
    for k in range(len(ids)):
        canvas.text(left + (k + 0.5) * width, 32, k, 12, GREY)
    for cell in stages["cell_index"]["cells"]:
        size = cell["homes"] + cell["phantoms"]
        x1, x2 = left + cell["begin"] * width + 5, left + (cell["begin"] + size) * width - 5
        canvas.line(x1, 124, x2, 124, HOME, 3)
        for row, text in enumerate((
            say(f"begins at {cell['begin']}", f"起点 {cell['begin']}"),
            f"H = {cell['homes']}, P = {cell['phantoms']}",
            say(f"candidates: {size * (size - 1) // 2}", f"候选对：{size * (size - 1) // 2}"),
        )):  # fmt: skip
            canvas.text((x1 + x2) / 2, 146 + 20 * row, text, 14, HOME)
    listed = {cell["cell"] for cell in stages["cell_index"]["cells"]}
    (alone,) = set(ids) - listed
    at = left + (ids.index(alone) + 0.5) * width
    for row, text in enumerate((say("alone:", "独自一个："), say("not listed", "不列入"))):
        canvas.text(at, 146 + 20 * row, text, 14, GREY)
    return canvas


def warp(program: Program, say: Say) -> Canvas:
    """What the lanes of a warp do in stage 5: entry k against those behind it in its cell."""
    ids = program.trace("course/scenes/eight.csv", "--rule", "as_written")
    ids = ids["stages"]["sort"]["cell_ids"]
    lanes = 24
    work = [sum(other == ids[k] for other in ids[k + 1 :]) for k in range(lanes)]
    canvas = Canvas(760, 250, say("A warp waits for its longest lane", "线程束等待最长的一路"))
    canvas.text(20, 30, say(
        "24 lanes of a warp, one entry of the sorted array each: tests (blue), waiting (grey)",
        "线程束的 24 路，每路负责有序数组的一个元素：检测（蓝）、等待（灰）"),
        14, INK, "start")  # fmt: skip
    most, width, height = max(work), 29, 42
    for lane, tests in enumerate(work):
        x = 30 + lane * width
        for step in range(most):
            y = 190 - (step + 1) * height
            canvas.box(x, y, width - 4, height - 4, HOME if step < tests else WAITING, "white")
        canvas.text(x + width / 2 - 2, 208, lane, 12, GREY)
        canvas.text(x + width / 2 - 2, 226, ids[lane], 9, GREY)
    used, all_ = sum(work), most * lanes
    canvas.text(30, 245, say(
        f"below: lane, cell id. {used} of {all_} lane steps do work",
        f"下方：路号、单元格编号。{all_} 步中有 {used} 步在工作"), 12, GREY, "start")  # fmt: skip
    return canvas


def slots(printed: str, ball: int) -> list[tuple[int, int, str]]:
    """Slot, cell id and label of each entry of a ball, in the text's order: 8i is the home."""
    (lines,) = re.findall(rf"^sphere {ball} .*\n((?:  .*\n)+)", printed, re.M)
    kinds = re.findall(r"^  (h|p).* id (\d+)$", lines, re.M)
    return [(8 * ball + k, int(i), f"{ball}{kind.upper()}") for k, (kind, i) in enumerate(kinds)]


def phantom_first(program: Program, say: Say) -> Canvas:
    """A cell of eight.csv in which a stable sort puts a phantom before a home."""
    shared = 1025
    printed = [
        program.printed("why", "course/scenes/eight.csv", "3", other, "--rule", "as_written")
        for other in ("2", "5")
    ]
    entries = slots(printed[0], 2) + slots(printed[0], 3) + slots(printed[1], 5)
    inside = [entry for entry in entries if entry[1] == shared]
    assert [kind for _, _, kind in inside] == ["2P", "3H", "5P"], inside
    canvas = Canvas(760, 250, say("Stable does not mean homes first", "稳定并不意味着主单元格在前"))
    left, width, gap = 170, 84, 124
    for y, words in ((62, say("cell id", "单元格编号")), (96, say("sphere", "球"))):
        canvas.text(left - 12, y, words, 14, GREY, "end")
    for k, (place, cell, ball) in enumerate(inside):
        x = left + k * gap
        canvas.text(x + width / 2, 32, say(f"place {place}", f"位置 {place}"), 12, GREY)
        canvas.cell_row(x, 40, [str(cell)], ["#f6dfa6"], width)
        canvas.cell_row(x, 74, [ball], ["#f6dfa6"], width)
        canvas.line(x + width / 2, 110, left + (k + 0.5) * width, 157, INK, 1.5, True)
    canvas.cell_row(left, 160, [ball for _, _, ball in inside], ["#f6dfa6"] * 3, width)
    canvas.text(left - 12, 182, say(f"cell {shared}, sorted", f"单元格 {shared}，排序后"), 14, GREY,
                "end")  # fmt: skip
    canvas.text(30, 225, say(
        "2P stood before 3H, because sphere 2 comes before sphere 3. A stable sort keeps that.",
        "2P 原本就在 3H 之前，因为球 2 在球 3 之前；稳定排序保持顺序。"),
        15, LOST, "start")  # fmt: skip
    return canvas


def pictures(program: Program) -> dict[str, Callable[[Say], Canvas]]:
    own = {
        "balls_alone": balls_alone,
        "four_balls": four_balls,
        "sort_pass": sort_pass,
        "cell_index": cell_index,
        "warp": warp,
        "phantom_first": phantom_first,
    }
    all_ = {name: partial(draw, program) for name, draw in own.items()}
    for name, scene in LOST_SCENES.items():
        all_[f"lost_{name}"] = partial(lost, program.printed, scene)
    return all_ | {"lsd": lsd, "look_back": look_back, "sort_ladder": ladder}


def main() -> int:
    parser = argparse.ArgumentParser(description="Draws the pictures of the course.")
    parser.add_argument("--octocell", type=Path, required=True)
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 if one is old")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "course/pictures")
    options = parser.parse_args()
    old = []
    for name, draw in pictures(Program(options.octocell)).items():
        for language, ending in enumerate((".svg", ".zh-CN.svg")):
            canvas = draw(lambda *words, language=language: words[language])
            path = options.output / (name + ending)
            before = path.read_text(encoding="utf-8") if path.exists() else ""
            if canvas.svg() == before:
                continue
            old.append(path)
            if not options.check:
                path.write_text(canvas.svg(), encoding="utf-8")
    for path in old:
        print(f"{path}: {'old: run make course-pictures' if options.check else 'written'}")
    return 1 if options.check and old else 0


if __name__ == "__main__":
    sys.exit(main())
