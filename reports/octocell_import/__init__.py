# SPDX-License-Identifier: MIT
"""Turns files of molecules, particles and points into scenes that octocell reads."""

from octocell_report.fields import ReportError

__version__ = "0.1.0"
_LONGEST = 60


class InputError(ReportError):
    """Input that cannot be used; the message is one line for people."""


def quote(text: str | bytes) -> str:
    """Returns at most 60 characters in quotes, all of them printable."""
    shown = ascii((text if isinstance(text, str) else text.decode("utf-8", "replace")).strip())
    return shown if len(shown) <= _LONGEST else f"{shown[:_LONGEST]}..."
