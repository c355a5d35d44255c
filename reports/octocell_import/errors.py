# SPDX-License-Identifier: MIT
"""The one error of this package, and how it shows what it found."""

from __future__ import annotations

from octocell_report.fields import ReportError

LONGEST = 60


class InputError(ReportError):
    """Input that cannot be used; the message is one line for people."""


def quote(text: str) -> str:
    """At most LONGEST characters, all of them printable."""
    shown = ascii(text.strip())
    return shown if len(shown) <= LONGEST else f"{shown[:LONGEST]}..."
