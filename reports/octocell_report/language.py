# SPDX-License-Identifier: MIT
"""One language alone of the texts in texts.py."""

from __future__ import annotations

from octocell_report.texts import say


def tell(language: str, key: str, **values: object) -> str:
    return str(getattr(say(key, **values), language))


def listed(parts: list[str], language: str) -> str:
    return str(getattr(say("comma"), language)).join(parts)
