# SPDX-License-Identifier: MIT
"""The overlap tests that rows may be run with, and how far off their wrong pairs are."""

from __future__ import annotations

from dataclasses import dataclass

from octocell_report.fields import (
    Fields,
    ReportError,
    is_number,
    is_object,
    is_whole,
    one_of,
    or_null,
)

EXACT = "exact"  # what users get; the others are run to be compared with it
FLOAT32 = "f32"  # what is usually written

# From what claims most to what is usually simplest; each in a few words of a formula.
MEANINGS = {
    EXACT: "float32 with a proved band, then integers",
    "q16_exact": "16-bit positions in the cell; survivors as exact",
    "f64": "float64, D ≤ s²",
    FLOAT32: "float32, D ≤ s²",
    "f32_sqrt": "float32, √D ≤ s",
    "q16_cell": "16-bit positions in the cell",
    "gram_f32": "float32, |p|² + |q|² − 2pq from the origin",
    "f16_cell": "float16 positions in the cell",
    "aabb_only": "bounding boxes alone; loses none",
}
PREDICATES = tuple(MEANINGS)
SCENE_CLASSES = ("random", "structured", "extreme")


@dataclass(frozen=True)
class Distances:
    """Of a row's worst pairs, by the sum s of their radii; None where there is no such pair."""

    missed_depth: float | None  # (s - distance) / s of the missed pair that overlaps most
    false_gap: float | None  # (distance - s) / s of the false pair that lies farthest apart


@dataclass(frozen=True)
class Rounded:
    """What rounding the scene's input to float32 did to its pairs, before any of our arithmetic."""

    lost: int
    gained: int


def predicate_of(row: Fields) -> str | None:
    """None for baselines, and in files from before there was a choice."""
    found: str | None = row.optional("predicate", or_null(one_of(*PREDICATES)))
    if found is not None and row.value.get("kind") == "baseline":
        raise ReportError(f"{row.title}: field 'predicate' is set, but it is a baseline")
    return found


def distances_of(row: Fields) -> Distances:
    return Distances(
        row.optional("worst_missed_depth", or_null(is_number)),
        row.optional("worst_false_gap", or_null(is_number)),
    )


def class_of(group: Fields) -> str | None:
    found: str | None = group.optional("scene_class", or_null(one_of(*SCENE_CLASSES)))
    return found


def rounding_of(group: Fields) -> Rounded | None:
    known = group.optional("input_rounding", or_null(is_object))
    if known is None:
        return None
    fields = Fields(known, f"{group.title}: input_rounding")
    return Rounded(fields.take("lost", is_whole), fields.take("gained", is_whole))
