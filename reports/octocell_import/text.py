# SPDX-License-Identifier: MIT
"""Files, compressed or not, read line by line with the line's number at hand."""

from __future__ import annotations

import bz2
import gzip
import lzma
import zlib
from pathlib import Path
from typing import IO, NoReturn, cast

from octocell_import.errors import InputError, quote

COMPRESSED = {".gz": gzip.GzipFile, ".bz2": bz2.BZ2File, ".xz": lzma.LZMAFile}
_DIGITS = 18  # of a number of things, which fits into 64 bits
DAMAGED = (OSError, EOFError, zlib.error, lzma.LZMAError)


def open_bytes(path: Path) -> IO[bytes]:
    """Throws InputError."""
    try:
        opener = COMPRESSED.get(path.suffix.lower())
        return path.open("rb") if opener is None else cast(IO[bytes], opener(path))
    except OSError as error:
        raise unreadable(path, error) from error


def unreadable(path: Path, error: BaseException) -> InputError:
    why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return InputError(f"{path}: cannot be read: {why}")


class TextFile:
    """Lines without their end; `number` is the last one's, from 1."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.number = 0
        self._stream = open_bytes(path)

    def __enter__(self) -> TextFile:
        return self

    def __exit__(self, *error: object) -> None:
        self._stream.close()

    def next(self) -> str | None:
        """None at the end."""
        try:
            line = self._stream.readline()
        except DAMAGED as error:
            raise unreadable(self.path, error) from error
        if not line:
            return None
        self.number += 1
        # Titles and comments may be in any encoding; numbers that are not ASCII are refused later.
        return line.decode("utf-8", errors="replace").rstrip("\r\n")

    def next_filled(self) -> str | None:
        """The next line that is not blank."""
        while (line := self.next()) is not None:
            if line.strip():
                return line
        return None

    def need(self, what: str) -> str:
        line = self.next()
        if line is None:
            raise InputError(f"{self.path}: ends after line {self.number}, before {what}")
        return line

    def refuse(self, why: str, line: int | None = None) -> NoReturn:
        raise InputError(f"{self.path}: line {line or self.number}: {why}")

    def whole(self, text: str, what: str) -> int:
        """A number of things; refuses the current line."""
        word = text.strip()
        if not (word.isascii() and word.isdigit() and len(word) <= _DIGITS):
            self.refuse(f"{quote(text)} is no {what}")
        return int(word)
