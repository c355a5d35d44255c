# SPDX-License-Identifier: MIT
"""Markdown: tables, and names that Markdown would read."""

import re
from collections.abc import Iterable

import pandas as pd

from octocell_report.words import NONE

_BAR = re.compile(r"(\\*)\|")
_CODE = re.compile(r"(`[^`]*`)")
_READ = re.compile(r"[$`]|<(?=[A-Za-z/!?])")


def table(lines: pd.DataFrame, note: str = "") -> str:
    """The first column to the left, the others to the right; a dash where there is nothing."""
    rule = "|---" + "|---:" * (len(lines.columns) - 1) + "|"
    rows = lines.where(lines.notna(), NONE).itertuples(index=False)
    below = ["", note] if note else []
    return "\n".join([_line(lines.columns), rule, *map(_line, rows), *below])


def _line(cells: Iterable[object]) -> str:
    return "| " + " | ".join(_BAR.sub(r"\1\1\|", str(cell)) for cell in cells) + " |"


def code(text: str) -> str:
    return f"`{text}`"


def bold(text: str) -> str:
    return f"**{text}**"


def plain(text: str) -> str:
    """The same without what names may hold and Markdown would read: formulas, tags, open code."""
    return "\n".join(map(_plain, text.split("\n")))


def _plain(line: str) -> str:
    parts = _CODE.split(line)  # every other one is code, where nothing else is read
    parts[::2] = [_READ.sub(lambda found: f"&#{ord(found[0])};", part) for part in parts[::2]]
    return "".join(parts)
