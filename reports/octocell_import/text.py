# SPDX-License-Identifier: MIT
"""A file, unpacked on the way, and its text as columns of bytes."""

import bz2
import gzip
import io
import lzma
import zlib
from collections.abc import Iterator, Sequence
from itertools import chain, islice
from typing import Any, NoReturn

import numpy as np

from octocell_import import InputError, quote
from octocell_import.decimals import Column

PACKED: dict[str, Any] = {".gz": gzip.open, ".bz2": bz2.open, ".xz": lzma.open}
DAMAGED = (OSError, EOFError, zlib.error, lzma.LZMAError)  # what reading may throw
_MAGIC = {b"\x1f\x8b": ".gz", b"BZh": ".bz2", b"\xfd7zXZ": ".xz"}
_CHUNK = 10_000  # lines that are held at a time
_PIECE = 1 << 26  # bytes; what a header says of its file's size need not be so
_WIDEST = 64  # bytes of a word; a column with longer ones holds objects, to save memory


class File:
    """Lines keep their ends, so none is empty; `number` is the last one's, from 1, and `position`
    is how many bytes are read, without a byte order mark.

    Errors name the line, but not the file, which the caller knows.
    """

    def __init__(self, raw: Any, suffix: str) -> None:
        self.number, self.position = 0, 0
        start = raw.peek(8)
        magic = next((name for key, name in _MAGIC.items() if start.startswith(key)), "")
        opener = PACKED.get(suffix.lower()) or PACKED.get(magic)
        self._stream = io.BufferedReader(opener(raw)) if opener else raw
        if self._stream.peek(3).startswith(b"\xef\xbb\xbf"):  # a byte order mark
            self._stream.read(3)
        self._lines = iter(self._stream)

    def __iter__(self) -> Iterator[bytes]:
        return iter(self.line, b"")

    def line(self, before: str = "") -> bytes:
        """Returns the next line; at the end nothing, or refuses if `before` is what is missing."""
        line: bytes = next(self._lines, b"")
        self.number += bool(line)
        self.position += len(line)
        if before and not line:
            raise InputError(f"ends after line {self.number}, before {before}")
        return line

    def some(self, count: int) -> list[bytes]:
        """Returns the next lines, fewer at the end."""
        lines = list(islice(self._lines, count))
        self.number += len(lines)
        self.position += sum(map(len, lines))
        return lines

    def give_back(self, lines: list[bytes]) -> None:
        """The next lines are these."""
        self._lines = chain(lines, self._lines)
        self.number -= len(lines)
        self.position -= sum(map(len, lines))

    def filled(self) -> bytes:
        """Returns the next line that is not blank; nothing at the end."""
        return next(filter(bytes.strip, self), b"")

    def take(self, size: int, what: str) -> bytes:
        """Returns exactly that many bytes, of a file that is no text."""
        pieces = []
        while size > 0 and (piece := self._stream.read(min(size, _PIECE))):
            pieces.append(piece)
            size, self.position = size - len(piece), self.position + len(piece)
        if size > 0:
            raise InputError(f"byte {self.position}: the file ends within {what}")
        return b"".join(pieces)

    def ended(self) -> bool:
        return not self._stream.peek(1)

    def count(self, word: bytes, what: str) -> int:
        if not is_whole(word.strip()):
            self.refuse(f"{quote(word)} is no {what}")
        return int(word)

    def split(self, line: bytes) -> list[bytes]:
        """Returns the words of the line that was read last."""
        if b"\0" in line:  # NumPy would strip it
            self.refuse(f"a zero byte: {quote(line)}")
        return line.split()

    def refuse(self, why: str, line: int = 0) -> NoReturn:
        raise InputError(f"line {line or self.number}: {why}")

    def words(
        self,
        count: int,
        names: Sequence[str] = (),
        least: int = 0,
        more: int = 0,
        comment: bytes = b"",
    ) -> tuple[dict[str, Column], Column]:
        """Returns the columns of the next `count` lines, and the lines' numbers.

        Every line must have a word for each name, and may have just `more` that are not read.
        Without names the columns are called "0", "1" and so on: as many as the first line has
        words, but at least `least`.
        """
        if len(set(names)) < len(names):
            self.refuse(f"two columns of one name: {quote(' '.join(names))}")
        before, parts, done = self.number, [np.empty((0, len(names) or least), "S1")], 0
        while done < count:
            lines = self.some(min(_CHUNK, count - done))
            if not lines:
                self.line(f"atom {done + 1} of {count}")
            done += len(lines)
            if comment:
                lines = [line.partition(comment)[0] for line in lines]
            widths = [len(line.split()) if b"\0" not in line else 0 for line in lines]
            width = len(names) or max(least, widths[0])
            for k, (line, found) in enumerate(zip(lines, widths, strict=True), done - len(lines)):
                if found not in (width, width + more):
                    why = "a zero byte" if b"\0" in line else f"{found} words, expected {width}"
                    self.refuse(f"atom {k + 1} of {count}: {why}", before + k + 1)
            if more:
                lines = [b" ".join(line.split()[:width]) for line in lines]
            names = names or [str(k) for k in range(width)]
            parts.append(as_column(b" ".join(lines).split()).reshape(-1, width))
        table = np.concatenate(parts[bool(count) :])
        names = names or [str(k) for k in range(least)]
        return as_columns(table, names), np.arange(count) + before + 1


def is_whole(word: bytes) -> bool:
    """Tells whether it is a number of things, which fits into 64 bits."""
    return word.isdigit() and len(word) <= 18


def whole_numbers(words: Column) -> Column:
    """Returns -1 for each word that is no whole number."""
    return np.array([int(word) if is_whole(word) else -1 for word in words.tolist()], np.int64)


def as_column(words: list[bytes]) -> Column:
    if b"\0" in b"".join(words):  # NumPy would strip it
        raise InputError("a word holds a zero byte")
    return np.array(words, object if max(map(len, words), default=0) > _WIDEST else "S")


def as_columns(table: Column, names: Sequence[str]) -> dict[str, Column]:
    return {name: np.ascontiguousarray(table[:, k]) for k, name in enumerate(names)}


def card(file: File, line: bytes, least: int, width: int) -> bytes:
    """Returns the line cut or filled to a width; refuses one of fewer than `least` columns."""
    text = line.rstrip()
    if len(text) < least or b"\t" in text or b"\0" in text:
        why = "too short for x, y and z" if len(text) < least else "a tab or zero byte in columns"
        file.refuse(f"{why}, which end at column {least}: {quote(text)}")
    return text[:width].ljust(width)


def fields(cards: bytearray, width: int, ends: dict[str, tuple[int, int]]) -> dict[str, Column]:
    """Returns columns of cards of one width: each is from one place up to another."""
    starts, sizes = [a for a, _ in ends.values()], [f"S{b - a}" for a, b in ends.values()]
    kind = np.dtype({"names": list(ends), "formats": sizes, "offsets": starts, "itemsize": width})
    return {name: np.ascontiguousarray(np.frombuffer(cards, kind)[name]) for name in ends}
