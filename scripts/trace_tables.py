#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes what `octocell trace` prints of a stage into documents.

  scripts/trace_tables.py --octocell build/octocell docs/stages/*.md           writes
  scripts/trace_tables.py --octocell build/octocell --check docs/stages/*.md   exits 1 if one is old

A block begins with <!-- octocell trace ARGUMENTS: SECTION --> and ends with <!-- end -->; its text
is what the command prints below the heading SECTION, such as "3 sort".
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BLOCK = re.compile(
    r"(?P<begin><!-- octocell (?P<command>trace [^:>]*): (?P<section>[^>]*?) -->\n)"
    r".*?(?P<end><!-- end -->)",
    re.DOTALL,
)


def section_of(octocell: Path, command: str, section: str) -> str:
    """The lines below a heading, without their indentation."""
    done = subprocess.run(
        [octocell.resolve(), *command.split()],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        sys.exit(f"octocell {command}: {done.stderr.strip()}")
    found = re.search(
        rf"^{re.escape(section)}\b.*\n((?:  .*\n|\n(?=  ))*)", done.stdout, re.MULTILINE
    )
    if not found:
        sys.exit(f"octocell {command} prints no section {section!r}")
    return re.sub(r"^  ", "", found[1], flags=re.MULTILINE)


def written(text: str, octocell: Path) -> str:
    def block(found: re.Match[str]) -> str:
        table = section_of(octocell, found["command"], found["section"])
        return f"{found['begin']}```\n{table}```\n{found['end']}"

    return BLOCK.sub(block, text)


def main() -> int:
    parser = argparse.ArgumentParser(description="Writes tables of traces into documents.")
    parser.add_argument("documents", type=Path, nargs="+", metavar="FILE.md")
    parser.add_argument("--octocell", type=Path, required=True)
    parser.add_argument(
        "--check", action="store_true", help="write nothing; exit 1 if a table is old"
    )
    options = parser.parse_args()
    old = []
    for path in options.documents:
        before = path.read_text(encoding="utf-8")
        after = written(before, options.octocell)
        if after != before:
            old.append(str(path))
            if not options.check:
                path.write_text(after, encoding="utf-8")
    for path in old:
        print(f"{path}: {'old: run make traces' if options.check else 'written'}")
    return 1 if options.check and old else 0


if __name__ == "__main__":
    sys.exit(main())
