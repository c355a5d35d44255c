# SPDX-License-Identifier: MIT
"""Tables in Markdown, line by line."""

from __future__ import annotations


def line(cells: list[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def rule(columns: int) -> str:
    """The first column to the left, the others to the right."""
    return "|---" + "|---:" * (columns - 1) + "|"


def table(header: list[str], lines: list[list[str]], note: str) -> str:
    return "\n".join([line(header), rule(len(header)), *map(line, lines), "", note])
