# SPDX-License-Identifier: MIT
"""Pictures of the sort ladder: passes that compose, look-back, times of the published result."""

from __future__ import annotations

import gzip
import json
import math
from collections.abc import Callable
from pathlib import Path
from statistics import median

from course_svg import FINE, GREY, HOME, INK, LOST, PHANTOM, Canvas

ROOT = Path(__file__).resolve().parents[1]
PUBLISHED = ROOT / "reports/results/h100-80gb/sort.json.gz"
Say = Callable[[str, str], str]

KEYS = [42, 17, 45, 12, 47, 15]
TENS = {1: "#cfe8d5", 4: "#f6dfa6"}

VARIANTS = {
    "cuda_one_bit_split": ("1 one-bit split", "1 逐位划分"),
    "cuda_digit_passes": ("2 digit passes", "2 按数位多趟"),
    "cuda_reduce_then_scan": ("3 reduce then scan", "3 先归约后扫描"),
    "cuda_onesweep": ("4 onesweep", "4 单次扫描"),
    "cub": ("CUB", "CUB"),
}


def radix_pass(keys: list[int], digit: Callable[[int], int]) -> list[int]:
    """Counts, sums, then the place of each key: three phases, as on the device."""
    counts = [0] * 10
    for key in keys:
        counts[digit(key)] += 1
    places = [sum(counts[:d]) for d in range(10)]
    to = []
    for key in keys:
        to.append(places[digit(key)])
        places[digit(key)] += 1
    return to


def moved(keys: list[int], to: list[int]) -> list[int]:
    out = [0] * len(keys)
    for key, place in zip(keys, to, strict=True):
        out[place] = key
    return out


def lsd(say: Say) -> Canvas:
    """Two stable passes over decimal keys: first the ones, then the tens."""
    canvas = Canvas(760, 350, say("Why passes compose", "各趟为何能够叠加"))
    left, width = 230, 76
    first = radix_pass(KEYS, lambda key: key % 10)
    middle = moved(KEYS, first)
    second = radix_pass(middle, lambda key: key // 10)
    last = moved(middle, second)
    assert last == sorted(KEYS)
    rows = [
        (30, KEYS, say("as they come", "原来的顺序")),
        (140, middle, say("after the pass over the ones", "按个位一趟之后")),
        (250, last, say("after the pass over the tens", "按十位一趟之后")),
    ]
    for y, keys, words in rows:
        canvas.text(left - 14, y + 23, words, 14, GREY, "end")
        canvas.cell_row(left, y, [str(k) for k in keys], [TENS[k // 10] for k in keys], width)
    for y, places in ((64, first), (174, second)):
        for k, to in enumerate(places):
            canvas.line(left + (k + 0.5) * width, y + 2, left + (to + 0.5) * width, y + 73,
                        INK, 1.4, True)  # fmt: skip
    canvas.text(20, 318, say(
        "In the last pass, arrows of keys with equal tens do not cross:",
        "最后一趟中，十位相同的键的箭头不交叉："), 14, HOME, "start")  # fmt: skip
    canvas.text(20, 338, say(
        "so 42, 45, 47 keep the order that the first pass gave them.",
        "因此 42、45、47 保持第一趟得到的顺序。"), 14, HOME, "start")  # fmt: skip
    return canvas


def look_back(say: Say) -> Canvas:
    """Five tiles at one moment: the last adds up what the tiles before it have published."""
    counts = [3, 5, 2, 4, 6]  # how many keys of a tile have the digit
    known = {0: 3, 1: 8}  # tiles that know the sum over all tiles up to themselves
    canvas = Canvas(760, 330, say("Decoupled look-back", "解耦回看"))
    left, width = 20, 146
    canvas.text(left, 26, say(
        "How many keys with digit 7 lie in the tiles below tile 4?",
        "块 4 之前的各块共有多少个数位值为 7 的键？"), 16, INK, "start", True)  # fmt: skip
    for tile, count in enumerate(counts):
        x = left + tile * width
        state = "whole" if tile in known else "own" if tile < 4 else "here"
        fill = {"whole": "#bfe5d8", "own": PHANTOM, "here": "#f6dfa6"}[state]
        canvas.box(x, 60, width - 12, 100, fill, GREY)
        canvas.text(x + (width - 12) / 2, 84, say(f"tile {tile}", f"块 {tile}"), 15, bold=True)
        canvas.text(x + (width - 12) / 2, 112, say(f"own: {count}", f"本块：{count}"), 15)
        second = {
            "whole": say(f"all so far: {known.get(tile)}", f"累计：{known.get(tile)}"),
            "own": say("all so far: not yet", "累计：未知"),
            "here": say("looks back", "正在回看"),
        }[state]
        canvas.text(x + (width - 12) / 2, 140, second, 14)
    for step, tile in enumerate((3, 2, 1)):
        x = left + tile * width + (width - 12) / 2
        canvas.line(left + 4 * width + 60, 178 + 26 * step, x, 178 + 26 * step, INK, 1.5)
        canvas.line(x, 178 + 26 * step, x, 164, INK, 1.5, True)
        words = f"+ {known[tile]}" if tile in known else f"+ {counts[tile]}"
        canvas.text(
            x + 14, 173 + 26 * step, words, 15, FINE if tile in known else HOME, "start", True
        )
    total = counts[3] + counts[2] + known[1]
    assert total == sum(counts[:4])
    terms, after = f"{counts[3]} + {counts[2]} + {known[1]}", total + counts[4]
    canvas.text(left, 268, say(
        f"{terms} = {total}: tile 1 knows the sum of all below it, so nothing is read behind it.",
        f"{terms} = {total}：块 1 已知其前所有块之和，不必再往前读。"),
        15, INK, "start")  # fmt: skip
    canvas.text(left, 294, say(
        f"Tile 4 then publishes {total} + {counts[4]} = {after} as its own \"all so far\".",
        f"随后块 4 公布自己的累计：{total} + {counts[4]} = {after}。"),
        15, INK, "start")  # fmt: skip
    canvas.text(left, 318, say(
        "It waits only where a tile has published nothing at all.",
        "只有某块什么都还没公布时才需要等待。"), 15, LOST, "start")  # fmt: skip
    return canvas


def times(n: int, bits: int) -> dict[str, float]:
    """Median milliseconds of each variant."""
    with gzip.open(PUBLISHED) as file:
        rows = json.load(file)["rows"]
    return {
        row["algorithm"]: median(row["total_ms"])
        for row in rows
        if (row["n"], row["bits"], row["order"]) == (n, bits, "random") and row["status"] == "ok"
    }


def ladder(say: Say) -> Canvas:
    """Milliseconds of the variants, on a logarithmic scale."""
    ms = times(1 << 24, 32)
    canvas = Canvas(760, 290, say("The sort ladder, measured", "排序阶梯：实测"))
    canvas.text(20, 28, say(
        "2²⁴ pairs, keys of 32 bits, H100: milliseconds (logarithmic)",
        "2²⁴ 个键值对，32 位键，H100：毫秒（对数刻度）"), 15, INK, "start", True)  # fmt: skip
    low, high, left, width = 0.3, 12.0, 190, 470
    for k, (name, words) in enumerate(VARIANTS.items()):
        y = 52 + 46 * k
        length = width * math.log(ms[name] / low) / math.log(high / low)
        canvas.text(left - 12, y + 22, say(*words), 15, INK, "end")
        canvas.box(left, y, length, 32, GREY if name == "cub" else HOME, "white")
        canvas.text(left + length + 8, y + 22, f"{ms[name]:.2f} ms", 15, INK, "start")
    return canvas
