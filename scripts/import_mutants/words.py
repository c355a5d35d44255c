# SPDX-License-Identifier: MIT
"""What the plain readers share: rules for numbers, lines and rows."""

import re
from collections.abc import Iterator

Frames = list[list[tuple[float, ...]]]
_NUMBER = re.compile(rb"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


class Refused(Exception):
    """The file breaks a rule."""


class Unjudged(Exception):
    """The mutant became something that the plain reader does not know."""


def need(condition: object) -> None:
    if not condition:
        raise Refused


def number(word: bytes, factor: float = 1.0) -> float:
    word = word.strip()
    need(_NUMBER.fullmatch(word) and len(word) <= 1000)
    value = float(word) * factor
    need(abs(value) < 3.4028235677973366e38)
    return value


def whole(word: bytes) -> int:
    need(re.fullmatch(rb"\d{1,18}", word.strip()))
    return int(word)


def lines_of(content: bytes) -> Iterator[bytes]:
    """Lines without their ends; a last one that is empty is none."""
    lines = content.removeprefix(b"\xef\xbb\xbf").split(b"\n")
    return iter(lines if lines[-1] else lines[:-1])


def take(lines: Iterator[bytes]) -> bytes:
    line = next(lines, None)
    need(line is not None)
    return line


def filled(lines: Iterator[bytes]) -> bytes:
    return next((line for line in lines if line.strip()), b"")


def rows(lines: Iterator[bytes], count: int, width: int = 0, comment: bytes = b"\n") -> list:
    """Rows of words, as many in each: `width`, or as many as in the first, at least 4."""
    found = []
    for _ in range(count):
        line = take(lines).partition(comment)[0]
        need(b"\0" not in line)
        found.append(line.split())
        width = width or max(4, len(found[0]))
        need(len(found[-1]) == width)
    return found
