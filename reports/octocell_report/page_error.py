# SPDX-License-Identifier: MIT
"""The page's tables of the error study: what exactness costs, what rounding the input did."""

from __future__ import annotations

import math

from octocell_report import words
from octocell_report.error import MILLION, Cost, Study
from octocell_report.language import say
from octocell_report.load import Group
from octocell_report.page_tables import Cell, Line, Table, column
from octocell_report.spread import Estimate


def costs(study: Study | None) -> Table | None:
    """Exact by float32, scene by scene; None where the two were not run together."""
    lines = [Line(_cost(cost)) for cost in study.costs] if study else []
    columns = [
        *(column(name, "text") for name in ("scene", "backend")),
        *map(column, ("deciding", "interval", "whole", "rounds", "candidates")),
    ]
    return Table(say("costs_table"), columns, lines) if lines else None


def _cost(cost: Cost) -> list[Cell]:
    candidates = None if math.isnan(cost.candidates) else cost.candidates
    return [
        Cell(words.place(cost.place), css="text"),
        Cell(cost.backend, css="text"),
        *_ratio(cost.stages),
        Cell(words.times(cost.whole.median), value=cost.whole.median),
        Cell(str(cost.whole.rounds), value=cost.whole.rounds),
        Cell(words.number(candidates), value=candidates),
    ]


def _ratio(estimate: Estimate | None) -> list[Cell]:
    if estimate is None:
        return [Cell(words.NONE, css="none"), Cell(words.NONE, css="none")]
    return [
        Cell(words.times(estimate.median), css="time", value=estimate.median),
        Cell(f"{words.times(estimate.low)} .. {words.times(estimate.high)}", value=estimate.low),
    ]


def rounding(study: Study | None) -> Table | None:
    """Pairs that the input's rounding to float32 changed; None where no scene tells."""
    groups = [group for group in study.groups if group.rounding is not None] if study else []
    lines = [Line(_rounding(group)) for group in groups]
    columns = [column("scene", "text"), *map(column, ("pairs", "lost", "gained", "changed"))]
    return Table(say("rounding_table"), columns, lines) if lines else None


def _rounding(group: Group) -> list[Cell]:
    assert group.rounding
    lost, gained, pairs = group.rounding.lost, group.rounding.gained, group.truth_pairs or 0
    changed = MILLION * (lost + gained) / max(1, pairs)
    return [
        Cell(words.place(group.place), css="text"),
        Cell(words.grouped(pairs), value=pairs),
        Cell(words.grouped(lost), value=lost),
        Cell(words.grouped(gained), value=gained),
        Cell(words.rate(changed), value=changed),
    ]
