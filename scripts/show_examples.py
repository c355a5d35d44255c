#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Copies the examples into the pages that show them, and what they print.

A page names a file; the code block behind the name is the file without its licence line. It names a
program; the block behind that name is what the program prints:

    <!-- example: examples/find_pairs.cpp -->
    <!-- output: find_pairs -->

    scripts/show_examples.py PAGE.md                      writes the files
    scripts/show_examples.py PAGE.md --programs FOLDER    runs the programs there, and writes both
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = re.compile(r"(<!-- example: (\S+) -->\n)```\w*\n(.*?)```\n", re.DOTALL)
OUTPUT = re.compile(r"(<!-- output: (\S+) -->\n)```\w*\n(.*?)```\n", re.DOTALL)
LANGUAGES = {".cpp": "cpp", ".c": "c"}


def shown(path: Path) -> str:
    """A source as a page shows it."""
    text = path.read_text(encoding="utf-8")
    text = text.removeprefix("// SPDX-License-Identifier: MIT\n")
    return text.replace("/* SPDX-License-Identifier: MIT\n   ", "/* ")


def with_examples(text: str) -> str:
    """The text of a page with its blocks as the files are now."""

    def block(found: re.Match[str]) -> str:
        path = ROOT / found[2]
        return f"{found[1]}```{LANGUAGES[path.suffix]}\n{shown(path)}```\n"

    return EXAMPLE.sub(block, text)


def with_outputs(text: str, programs: Path) -> str:
    """The text of a page with what the programs print now."""

    def block(found: re.Match[str]) -> str:
        command = [programs / found[2]]
        printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        return f"{found[1]}```text\n{printed}```\n"

    return OUTPUT.sub(block, text)


def examples_in(text: str) -> set[str]:
    return {found[2] for found in EXAMPLE.finditer(text)}


def outputs_in(text: str) -> dict[str, str]:
    """What a page says that the programs print, by their names."""
    return {found[2]: found[3] for found in OUTPUT.finditer(text)}


def main() -> int:
    parser = argparse.ArgumentParser(
        description="Copies the examples into the pages that show them."
    )
    parser.add_argument("pages", nargs="+", type=Path, metavar="PAGE.md")
    parser.add_argument("--programs", type=Path, help="where the examples were built")
    options = parser.parse_args()
    for page in options.pages:
        text = with_examples(page.read_text(encoding="utf-8"))
        if options.programs:
            text = with_outputs(text, options.programs)
        page.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
