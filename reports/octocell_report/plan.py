# SPDX-License-Identifier: MIT
"""What the planner chose for a row, and which variant of the plan a row is."""

from __future__ import annotations

import re
from dataclasses import dataclass

from octocell_report.fields import (
    Fields,
    ReportError,
    is_filled,
    is_object,
    is_text,
    is_texts,
    is_whole,
    or_null,
)

PLANNED = "planned"  # the method of rows that the planner decides
NOTHING = "none"  # the variant for which every skip is forbidden

_FIRST = re.compile(r"first_(\d+)_(\w+)")
_WITHOUT = re.compile(r"no_(\w+)")


@dataclass(frozen=True)
class Plan:
    method: str
    levels: int
    key_bits: int
    sort_passes: int
    skips: tuple[str, ...]  # that were taken


def plan_of(row: Fields) -> Plan | None:
    """The row's plan, checked; None for baselines, and in files from before there were plans."""
    if row.value.get("plan") is None:
        return None
    fields = Fields(row.take("plan", is_object), f"{row.title}: plan")
    return Plan(
        method=fields.take("method", is_text),
        levels=fields.take("levels", is_whole),
        key_bits=fields.take("key_bits", is_whole),
        sort_passes=fields.take("sort_passes", is_whole),
        skips=tuple(fields.take("skips", is_texts)),
    )


def variant_of(row: Fields, method: str | None) -> str | None:
    """The name of the variant; None for a row that may skip whatever its scene does not need."""
    found: str | None = row.optional("skips", or_null(is_filled))
    if found is not None and method != PLANNED:
        raise ReportError(f"{row.title}: field 'skips' is set, but its method is not {PLANNED}")
    return found


def allowed_last(variant: str) -> tuple[int, str] | None:
    """(3, 'phantoms') of 'first_3_phantoms': how many skips are allowed, and the last of them."""
    match = _FIRST.fullmatch(variant)
    return (int(match[1]), match[2]) if match else None


def forbidden(variant: str) -> str | None:
    """'sort' of 'no_sort': the one skip that is forbidden."""
    match = _WITHOUT.fullmatch(variant)
    return match[1] if match else None
