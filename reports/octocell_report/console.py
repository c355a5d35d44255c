# SPDX-License-Identifier: MIT
"""What a command says: lines that stay lines, and one of them in place of a traceback."""

import argparse
import io
import os
import sys
import warnings
from collections.abc import Callable
from contextlib import suppress
from typing import NoReturn

from octocell_report.fields import ReportError, printable

BAD_INPUT, INTERRUPTED, NO_READER = 2, 130, 141
_LONGEST = 2000  # characters of a message
# Of plots with names that are very long, or in letters that the font lacks: they are seen there.
_LAYOUT = r"Glyph \d+ .*missing|constrained_layout not applied"


class Parser(argparse.ArgumentParser):
    """One that refuses in one line, without its usage."""

    def error(self, message: str) -> NoReturn:
        self.exit(BAD_INPUT, f"{self.prog}: {_shortened(message)}\n")


def say(*lines: object) -> None:
    """On standard output, each on one line, however the names in it are spelled."""
    for line in lines:
        print(printable(str(line)))


def run(program: str, work: Callable[[], int]) -> int:
    """The exit code of `work`; or one line on standard error, and the code that goes with it."""
    _prepare()
    try:
        try:
            with warnings.catch_warnings():
                warnings.filterwarnings("ignore", _LAYOUT, UserWarning)
                return work()
        finally:
            sys.stdout.flush()
    except KeyboardInterrupt:
        code, why = INTERRUPTED, "interrupted"
    except BrokenPipeError:
        _discard_output()
        return NO_READER
    except ReportError as error:
        code, why = BAD_INPUT, str(error)
    except MemoryError:
        code, why = BAD_INPUT, "not enough memory"
    except OSError as error:
        _discard_output()
        where = error.filename or "standard output"
        code, why = BAD_INPUT, f"{os.fsdecode(where)}: {error.strerror or error}"
    print(f"{program}: {_shortened(why)}", file=sys.stderr)
    return code


def _shortened(message: str) -> str:
    shown = printable(message)
    return shown if len(shown) <= _LONGEST else f"{shown[:_LONGEST]}..."


def _prepare() -> None:
    """Both streams take any text, even where they were closed or know ASCII alone."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _discard_output() -> None:
    """What is still in the buffer would fail once more when Python ends."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
