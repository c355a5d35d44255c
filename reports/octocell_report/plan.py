# SPDX-License-Identifier: MIT
"""Names of variants of a plan."""

from __future__ import annotations

import re

PLANNED = "planned"  # the method of rows that the planner decides
REBUILT = "rebuilt"  # the variant whose frames take nothing over
NOTHING = "none"  # the variant for which every skip is forbidden

_FIRST = re.compile(r"first_(\d+)_(\w+)")
_WITHOUT = re.compile(r"no_(\w+)")


def allowed_last(variant: str) -> tuple[int, str] | None:
    """(3, 'phantoms') of 'first_3_phantoms': how many skips are allowed, and the last of them."""
    match = _FIRST.fullmatch(variant)
    return (int(match[1]), match[2]) if match else None


def forbidden(variant: str) -> str | None:
    """'sort' of 'no_sort': the one skip that is forbidden."""
    match = _WITHOUT.fullmatch(variant)
    return match[1] if match else None
