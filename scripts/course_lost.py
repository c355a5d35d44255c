# SPDX-License-Identifier: MIT
"""Pictures of the balls that the course text loses, from what `octocell why` says of them."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

from course_svg import (
    GREY,
    HOME,
    INK,
    LOST,
    OTHER,
    OTHER_PALE,
    PHANTOM,
    Canvas,
    Plane,
)

Say = Callable[[str, str], str]
Cell = tuple[int, int, int]
BOTH = "#d9c7d9"  # a phantom of both balls


@dataclass(frozen=True)
class LostScene:
    """Two balls of a scene, and the part of a layer of cells that is drawn."""

    name: str
    balls: tuple[int, int]
    columns: range
    rows: range
    scale: float
    layers: tuple[int, ...] = (0,)


LOST_SCENES = {
    "smaller_home": LostScene("smaller_home", (0, 1), range(1, 6), range(0, 3), 66),
    "both_phantoms": LostScene("both_phantoms", (0, 1), range(1, 6), range(1, 4), 66),
    "ninth_cell": LostScene("ninth_cell", (2, 3), range(1, 5), range(2, 5), 38, (1, 2, 3)),
    "negative": LostScene("negative", (0, 1), range(-8, 2), range(-1, 2), 44),
    "same_id": LostScene("same_id", (1, 2), range(1023, 1027), range(0, 2), 76),
}


@dataclass
class Ball:
    place: tuple[float, float, float]
    radius: float
    home: Cell
    phantoms: list[Cell]


def cells(text: str) -> list[Cell]:
    found = re.findall(r"\((-?\d+), (-?\d+), (-?\d+)\), id", text)
    return [(int(x), int(y), int(z)) for x, y, z in found]


def balls_of(printed: str) -> tuple[list[Ball], float, str]:
    """The two balls, the side of the cells, and whether the pair is found."""
    balls = []
    for x, y, z, r, lines in re.findall(
        r"^sphere \d+ +at \((\S+), (\S+), (\S+)\), radius (\S+)\n((?:  .*\n)+)", printed, re.M
    ):
        home, *phantoms = cells(lines)
        balls.append(Ball((float(x), float(y), float(z)), float(r), home, phantoms))
    side = re.search(r"cells of side (\S+)", printed)
    found = re.search(r"^found +(.*)$", printed, re.M)
    assert len(balls) == 2 and side and found, printed
    return balls, float(side[1]), found[1]


def meets(ball: Ball, cell: Cell, side: float) -> bool:
    gaps = [
        max(c * side - p, 0.0, p - (c + 1) * side) for c, p in zip(cell, ball.place, strict=True)
    ]
    return math.dist(gaps, [0, 0, 0]) <= ball.radius


def draw_layer(plane: Plane, scene: LostScene, balls: list[Ball], side: float, z: int) -> None:
    """The cells of one layer, then both balls as they cut its middle plane or lie behind it."""
    a, b = balls
    for i in scene.columns:
        for j in scene.rows:
            cell = (i, j, z)
            fill = "white"
            if cell in a.phantoms and cell in b.phantoms:
                fill = BOTH
            elif cell in a.phantoms:
                fill = PHANTOM
            elif cell in b.phantoms:
                fill = OTHER_PALE
            if cell == a.home:
                fill = "#66aad7"
            if cell == b.home:
                fill = "#e0b04a"
            plane.cell(i, j, side, fill, GREY)


def met(ball: Ball, side: float) -> list[Cell]:
    """The cells that the ball meets, as the text defines it."""
    x, y, z = ball.home
    near = [(x + i, y + j, z + k) for i, j, k in product((-1, 0, 1), repeat=3)]
    return [cell for cell in near if meets(ball, cell, side)]


def mark_dropped(plane: Plane, ball: Ball, scene: LostScene, side: float, z: int) -> None:
    """A cross in each cell that the ball meets and in which it is not listed."""
    for i in scene.columns:
        for j in scene.rows:
            cell = (i, j, z)
            if cell == ball.home or cell in ball.phantoms or cell not in met(ball, side):
                continue
            x, y, half = plane.x((i + 0.5) * side), plane.y((j + 0.5) * side), 9
            plane.canvas.line(x - half, y - half, x + half, y + half, LOST, 3)
            plane.canvas.line(x - half, y + half, x + half, y - half, LOST, 3)


VERDICTS = {
    "smaller_home": (
        "A is listed in B's home, but its own home is smaller: left to A's home, where B is not.",
        "A 登记在 B 的主单元格中，但 A 的主单元格编号较小：留给 A 的主单元格，而 B 不在那里。",
    ),
    "both_phantoms": (
        "All cells that list both (violet) are the home of neither: phantoms are not compared.",
        "同时登记两者的单元格（紫色）都不是任何一方的主单元格：幻影之间不比较。",
    ),
    "ninth_cell": (
        "B meets {met} cells; eight fit. A's home is among those that are dropped (crosses).",
        "B 触及 {met} 个单元格，只放得下 8 个；被丢弃的（叉号）包括 A 的主单元格。",
    ),
    "negative": (
        "The cast makes x = -10 cell 0, far from the balls: they meet no other cell there.",
        "强制转换把 x = -10 变成单元格 0，离球很远：球不触及那里的任何邻格。",
    ),
    "same_id": (
        "Cells (1024, 0) and (1024, 1) both have id 1024: the pair is met in both, found twice.",
        "单元格 (1024, 0) 与 (1024, 1) 编号同为 1024：两处都检测，同一对找到两次。",
    ),
}


def legend(canvas: Canvas, x: float, y: float, say: Say, three: bool) -> None:
    entries = [
        ("#66aad7", say("home of A", "A 的主单元格")),
        ("#e0b04a", say("home of B", "B 的主单元格")),
        (PHANTOM, say("phantoms of A", "A 的幻影")),
        (OTHER_PALE, say("phantoms of B", "B 的幻影")),
        (BOTH, say("phantoms of both", "两者的幻影")),
    ]
    for k, (colour, words) in enumerate(entries):
        dx, dy = (k * 148, 0) if three else (0, k * 28)
        canvas.box(x + dx, y + dy, 16, 16, colour, GREY)
        canvas.text(x + dx + 22, y + dy + 14, words, 15, anchor="start")


def lost(printed: Callable[..., str], scene: LostScene, say: Say) -> Canvas:
    i, j = map(str, scene.balls)
    path = f"course/scenes/{scene.name}.csv"
    balls, side, found = balls_of(printed("why", path, i, j, "--rule", "as_written"))
    assert "LOST" in found or "DUPLICATE" in found, found
    verdict = say(*VERDICTS[scene.name]).format(met=len(met(balls[1], side)))
    low = (scene.columns[0] * side, scene.rows[0] * side)
    high = ((scene.columns[-1] + 1) * side, (scene.rows[-1] + 1) * side)
    wide, tall = (high[0] - low[0]) * scene.scale, (high[1] - low[1]) * scene.scale
    below = len(scene.layers) > 1 or wide > 560
    canvas = Canvas(760, tall + (125 if below else 75), verdict)
    for k, z in enumerate(scene.layers):
        plane = Plane(canvas, (16 + k * (wide + 16), 30), low, high, scene.scale)
        draw_layer(plane, scene, balls, side, z)
        if len(scene.layers) > 1:
            canvas.text(
                plane.x(low[0]), 22, say(f"layer z = {z}", f"层 z = {z}"), 13, GREY, "start"
            )
        if scene.name == "same_id":
            for cell in ((1024, 0), (1024, 1)):
                canvas.text(plane.x((cell[0] + 0.05) * side), plane.y((cell[1] + 0.06) * side),
                            "id 1024", 13, LOST, "start", True)  # fmt: skip
        if scene.name == "ninth_cell":
            mark_dropped(plane, balls[1], scene, side, z)
        for name, ball, colour in zip("AB", balls, (HOME, OTHER), strict=True):
            plane.ball(ball.place[0], ball.place[1], ball.radius, name, colour)
        plane.join(balls[0].place[:2], balls[1].place[:2], LOST)
    if scene.name == "negative":
        canvas.line(plane.x(-9), plane.y(1.3), plane.x(-0.2), plane.y(1.3), INK, 1.5, True, "5 4")
        canvas.text(plane.x(-4.5), plane.y(1.5), "(unsigned)(x / d) = 0", 14)
    if below:
        legend(canvas, 16, tall + 46, say, True)
        canvas.text(16, tall + 98, verdict, 16, LOST, "start", True)
    else:
        legend(canvas, wide + 40, 40, say, False)
        canvas.text(16, tall + 60, verdict, 16, LOST, "start", True)
    return canvas
