#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the step page: one file with style, script, scenes, programs and module inside.

  scripts/build_pages.py -o reports/out/steps.html [SPHERES.csv ...]

Without scenes it takes those of course/scenes, the scene of the course first.
"""

from __future__ import annotations

import argparse
import base64
import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "course/page"
PROGRAMS = ("1_as_written.cpp", "6_control_bits.cpp", "8_exact.cpp")
SCRIPTS = ("texts.js", "steps.js", "module.js", "draw.js", "page.js")


def read_scene(path: Path) -> dict[str, object]:
    """Name and spheres of lines x,y,z,r; comments and a heading are left out."""
    lines = path.read_text(encoding="utf-8").splitlines()
    rows = [line.split(",") for line in lines if line and line[0] not in "#x"]
    return {"name": path.stem, "spheres": [[float(value) for value in row] for row in rows]}


def course_scenes() -> list[Path]:
    return sorted((ROOT / "course/scenes").glob("*.csv"), key=lambda path: path.stem != "eight")


def page(scenes: list[Path]) -> str:
    programs = {
        name: (ROOT / "course/pipeline" / name).read_text(encoding="utf-8").splitlines()
        for name in PROGRAMS
    }
    data = {
        "SCENES": [read_scene(path) for path in scenes],
        "PROGRAMS": programs,
        "MODULE": base64.b64encode((PAGE / "module.wasm").read_bytes()).decode(),
    }
    constants = "".join(
        f"const {name} = {json.dumps(value)};\n".replace("</", "<\\/")
        for name, value in data.items()
    )
    scripts = [(PAGE / name).read_text(encoding="utf-8") for name in SCRIPTS]
    text = (PAGE / "page.html").read_text(encoding="utf-8")
    text = text.replace("/*{{style}}*/", (PAGE / "page.css").read_text(encoding="utf-8"))
    return text.replace("/*{{script}}*/", constants + "\n".join(scripts))


def main() -> int:
    parser = argparse.ArgumentParser(description="Writes the step page.")
    parser.add_argument("scenes", type=Path, nargs="*", metavar="SPHERES.csv")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "reports/out/steps.html")
    options = parser.parse_args()
    options.output.parent.mkdir(parents=True, exist_ok=True)
    options.output.write_text(page(options.scenes or course_scenes()), encoding="utf-8")
    print(f"{options.output}: written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
