# SPDX-License-Identifier: MIT
"""Rows of moving scenes, course by course: one scene at one size, moving one way."""

from __future__ import annotations

from typing import NamedTuple

from octocell_report import words
from octocell_report.load import Impl, Place, Result, Row
from octocell_report.tables import DYNAMIC

REBUILT = "rebuilt"  # the variant whose frames take nothing over


class Course(NamedTuple):
    place: Place
    motion: str

    @property
    def title(self) -> str:
        """The scene is not named twice where it is called as its motion."""
        if self.place.scene == self.motion:
            return words.place(self.place)
        return f"{words.place(self.place)}, {self.motion}"


def courses(result: Result) -> dict[Course, list[Row]]:
    """Dynamic rows that ran and have frames, in table order of their implementations."""
    order = {impl: index for index, impl in enumerate(result.impls)}
    found: dict[Course, list[Row]] = {}
    for row in result.rows:
        if row.run == DYNAMIC and row.motion:
            found.setdefault(Course(row.place, row.motion.scene), []).append(row)
    return {course: sorted(rows, key=lambda r: order[r.impl]) for course, rows in found.items()}


def searched_again(result: Result) -> dict[tuple[Impl, Place], Row]:
    """The same frames as a planned row's, none of which takes over from the last."""
    return {
        (row.impl, row.place): row
        for row in result.variants
        if row.skips == REBUILT and row.run == DYNAMIC and row.counts
    }
