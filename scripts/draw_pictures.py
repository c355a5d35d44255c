#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the README's pictures into docs/pictures: `make pictures`.

overlaps.gif  discs that move over a grid; the pairs of each frame are those `octocell find` gives
mistake.png   two discs that overlap, and that a common textbook rule misses, as the program shows
speed.png     time per sphere against N from a published result of `octocell bench`
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Rectangle
from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "reports"))

from octocell_report import tables, words  # noqa: E402
from octocell_report.load import Place, Result, load  # noqa: E402
from octocell_report.readme_bench import best, plan  # noqa: E402

INK, PALE = "#1f2937", "#d1d5db"
HOME, PHANTOM, OVERLAP = "#0072b2", "#b9dcf0", "#d55e00"
SIDE, WIDTH, HEIGHT = 1.0, 16.0, 7.0  # of a cell, and of the picture, in the scene's units
DISCS, FRAMES, FRAMES_A_SECOND = 44, 48, 10


class Program:
    """The octocell that answers, in a folder for its files."""

    def __init__(self, path: Path, folder: Path) -> None:
        self.path, self.folder = path.resolve(), folder

    def pairs(self, spheres: np.ndarray, *options: str) -> np.ndarray:
        """Pairs (M, 2) of spheres (N, 4), by `octocell find`."""
        np.save(self.folder / "scene.npy", spheres.astype(np.float32))
        command = [self.path, "find", "scene.npy", *options, "-o", "pairs.npy", "--json"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=True)
        pairs = np.load(self.folder / "pairs.npy")
        assert len(pairs) == json.loads(done.stdout)["pairs"]
        return pairs


def moving_discs() -> Iterator[np.ndarray]:
    """Frames (N, 4) of discs that fly straight on and bounce off the walls, so that the last frame
    leads back to the first."""
    random = np.random.default_rng(7)
    radius = random.uniform(0.22, 0.5, DISCS)
    room = np.array([WIDTH, HEIGHT])
    start = random.uniform(0, 2, (DISCS, 2))  # of 2: there and back
    turns = random.choice([-1, 0, 1], (DISCS, 2), p=[0.3, 0.4, 0.3])
    for frame in range(FRAMES):
        phase = (start + turns * 2 * frame / FRAMES) % 2
        place = np.where(phase < 1, phase, 2 - phase) * (room - 2 * radius[:, None])
        yield np.column_stack([place + radius[:, None], np.zeros(DISCS), radius])


def draw_grid(ax: Axes, side: float) -> None:
    for x in np.arange(0, WIDTH + side / 2, side):
        ax.axvline(x, color=PALE, linewidth=0.7, zorder=0)
    for y in np.arange(0, HEIGHT + side / 2, side):
        ax.axhline(y, color=PALE, linewidth=0.7, zorder=0)


def draw_cells(ax: Axes, disc: np.ndarray, side: float) -> None:
    """The cell that holds the centre, and the others that the disc's box meets."""
    x, y, _, r = disc
    home = (int(x // side), int(y // side))
    for i in range(int((x - r) // side), int((x + r) // side) + 1):
        for j in range(int((y - r) // side), int((y + r) // side) + 1):
            colour = HOME if (i, j) == home else PHANTOM
            corner = (i * side, j * side)
            ax.add_patch(Rectangle(corner, side, side, color=colour, alpha=0.45, linewidth=0))


def draw_discs(ax: Axes, discs: np.ndarray, pairs: np.ndarray) -> None:
    for k, (x, y, _, r) in enumerate(discs):
        fill = OVERLAP if k in pairs else "white"
        ax.add_patch(Circle((x, y), r, facecolor=fill, edgecolor=INK, linewidth=1.1, alpha=0.75))
    for i, j in pairs:
        ax.plot(
            discs[[i, j], 0], discs[[i, j], 1], color=INK, linewidth=2, marker="o", markersize=3
        )


def overlaps(program: Program, output: Path) -> None:
    figure, ax = plt.subplots(figsize=(8, 3.9), dpi=80)
    figure.subplots_adjust(0.005, 0.01, 0.995, 0.9)
    images = []
    for discs in moving_discs():
        ax.clear()
        ax.set(xlim=(0, WIDTH), ylim=(0, HEIGHT), aspect="equal", xticks=[], yticks=[])
        pairs = program.pairs(discs, "--method", "home_phantom", "--cell-side", str(SIDE))
        draw_grid(ax, SIDE)
        draw_cells(ax, discs[0], SIDE)
        draw_discs(ax, discs, pairs)
        ax.set_title(
            f"{DISCS} spheres, {len(pairs):2d} pairs overlap (orange). One sphere's home cell is "
            "dark blue, its phantom cells light.",
            fontsize=9.5,
            loc="left",
        )

        figure.canvas.draw()
        image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
        images.append(image.quantize(24, dither=Image.Dither.NONE))
    images[0].save(output, save_all=True, append_images=images[1:], loop=0,
                   duration=1000 // FRAMES_A_SECOND, optimize=True)  # fmt: skip
    plt.close(figure)


def mistake(program: Program, output: Path) -> None:
    """Two discs that meet in one cell only, home to neither (course/lost_pairs.md)."""
    discs = np.array([[0.4, 1.6, 0.75, 1.0], [1.6, 0.4, 0.75, 1.0]])
    assert len(program.pairs(discs)) == 1
    assert len(program.pairs(discs, "--rule", "as_written")) == 0
    side = 1.5
    figure, ax = plt.subplots(figsize=(4.2, 4.4))
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.86)
    ax.set(xlim=(-0.9, 3.15), ylim=(-0.9, 3.15), aspect="equal", xticks=[], yticks=[])
    for at in (0, side, 2 * side):
        ax.axvline(at, color=PALE, zorder=0)
        ax.axhline(at, color=PALE, zorder=0)
    ax.add_patch(Rectangle((0, 0), side, side, color=OVERLAP, alpha=0.25, linewidth=0))
    for corner in ((0, side), (side, 0)):
        ax.add_patch(Rectangle(corner, side, side, color=HOME, alpha=0.3, linewidth=0))
    for name, (x, y, _, r) in zip("AB", discs, strict=True):
        ax.add_patch(Circle((x, y), r, fill=False, edgecolor=INK, linewidth=1.8))
        ax.plot(x, y, marker="o", color=INK)
        ax.annotate(name, (x, y), (6, 4), textcoords="offset points", fontsize=13)
    ax.text(0.75, 2.83, "home of A", ha="center", color=HOME)
    ax.text(2.93, 0.08, "home\nof B", ha="right", color=HOME)
    ax.text(0.72, 0.06, "the one cell both reach:\nhome to neither", ha="center", fontsize=8.5)
    ax.set_title(
        "A and B overlap. A textbook rule that tests homes\n"
        "with homes and phantoms never tests them: pair lost.",
        fontsize=9.5,
        loc="left",
    )
    figure.savefig(output, dpi=110)
    plt.close(figure)


def fastest(result: Result, family: str | None) -> dict[int, float]:
    """By N: ns per sphere of the fastest exact cold row of one thread, of a library or our plan."""
    found = {}
    for n in filter(None, result.sizes("gas")):
        where = {"scene": "gas", "n": n, "run": "cold", "threads": 1, "counts": True}
        theirs = best(result.frame, **where, kind="baseline", family=family) if family else None
        row = theirs if family else plan(result, Place("gas", n))
        if row is not None:
            found[n] = row.ns_per_sphere
    return found


def speed(result: Result, output: Path) -> None:
    figure, ax = plt.subplots(figsize=(6.2, 3.6), layout="constrained")
    families: dict[str | None, str] = {None: "Octocell"}
    families |= {f: f"{words.family_title(f)}'s fastest" for f in tables.families(result)}
    for (family, label), colour in zip(families.items(), (HOME, OVERLAP, "#009e73"), strict=True):
        known = fastest(result, family)
        ns, per_sphere = list(known), list(known.values())
        ax.plot(ns, per_sphere, marker="o", color=colour)
        ax.annotate(label, (ns[-1], per_sphere[-1]), (8, 0), textcoords="offset points",
                    color=colour, va="center", fontweight="bold")  # fmt: skip
    machine = result.context["machine"]["cpu"]
    ax.set(xscale="log", yscale="log", xlabel="spheres", ylabel="ns per sphere, cold")
    ax.set(xlim=(0.7 * min(ns), 25 * max(ns)), xticks=ns)  # room for the names
    ax.set_title(
        f"A gas of spheres, one thread of {machine}, commit {result.context['commit'][:8]}",
        fontsize=10,
    )
    ax.grid(color=PALE, linewidth=0.6)
    ax.spines[["top", "right"]].set_visible(False)
    figure.savefig(output, dpi=120)
    plt.close(figure)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--octocell", type=Path, default=ROOT / "build/octocell")
    parser.add_argument(
        "--result", type=Path, required=True, help="of octocell bench --preset quick"
    )
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs/pictures")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory() as folder:
        program = Program(arguments.octocell, Path(folder))
        overlaps(program, arguments.output / "overlaps.gif")
        mistake(program, arguments.output / "mistake.png")
    speed(load(arguments.result), arguments.output / "speed.png")
    print(f"{arguments.output}: overlaps.gif, mistake.png, speed.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
