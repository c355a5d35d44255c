# SPDX-License-Identifier: MIT
"""Markdown: tables, and chapters on figures."""

from __future__ import annotations

from octocell_report.language import tell


def table(header: list[str], lines: list[list[str]], note: str = "") -> str:
    """The first column to the left, the others to the right."""
    rule = "|---" + "|---:" * (len(header) - 1) + "|"
    below = ["", note] if note else []
    return "\n".join([_line(header), rule, *map(_line, lines), *below])


def _line(cells: list[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def chapter(name: str, sentences: list[str]) -> list[str]:
    """On a figure that lies beside the file: what is seen, and how to read it."""
    title, how = tell("en", f"title_{name}"), tell("en", f"how_{name}")
    return [f"## {title}", " ".join(sentences), how, f"![{title}]({name}.png)"]
