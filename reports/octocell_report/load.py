# SPDX-License-Identifier: MIT
"""The bench JSON, read and checked: what gets past load() needs no second look."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from octocell_report.fields import Json, ReportError, convert, naming, shown
from octocell_report.files import read_json
from octocell_report.row_frame import labels, motion_frame, rows_frame, stages_frame
from octocell_report.schema import (
    DEVICE_RUNS,
    KINDS,
    RUNS,
    STAGES,
    Document,
    Gpu,
    Group,
    Impl,
    Place,
    Row,
)

__all__ = [
    "DEVICE_RUNS",
    "RUNS",
    "STAGES",
    "Group",
    "Impl",
    "Place",
    "Result",
    "Row",
    "load",
    "parse",
]

SCHEMA = 2
SIDES = ("backend", "device", "baseline")  # ours on the host, ours on a device, and the others


@dataclass(frozen=True)
class Result:
    context: Json
    groups: list[Group]
    rows: list[Row]  # as users have them
    absent: dict[str, str]  # backends that could not run at all, and why; they have no rows here
    gpu: Gpu | None = None  # that the device rows ran on
    variants: list[Row] = field(default_factory=list)  # planned rows with skips forbidden

    @cached_property
    def frame(self) -> pd.DataFrame:
        """A line per row as users have them; row_frame.py lists the columns."""
        return rows_frame(self, self.rows)

    @cached_property
    def variants_frame(self) -> pd.DataFrame:
        """The same for planned rows with skips forbidden."""
        return rows_frame(self, self.variants)

    @cached_property
    def stages(self) -> pd.DataFrame:
        """A line per row and stage; row_frame.py lists the columns."""
        return stages_frame(self.rows)

    @cached_property
    def motion_frames(self) -> pd.DataFrame:
        """A line per row and frame of a moving scene; row_frame.py lists the columns."""
        return motion_frame(self.rows)

    @cached_property
    def labels(self) -> dict[Impl, str]:
        """One label per implementation, as short as it can be while no two are the same."""
        return labels(self.impls)

    @property
    def impls(self) -> list[Impl]:
        """In table order: backends before baselines, else as first met."""
        seen: dict[Impl, str] = {}
        for row in self.rows:
            seen.setdefault(row.impl, row.kind)
        return sorted(seen, key=lambda impl: KINDS.index(seen[impl]))

    def impls_of(self, side: str) -> list[Impl]:
        sides = self.sides
        return [impl for impl in self.impls if sides[impl] == side]

    @property
    def sides(self) -> dict[Impl, str]:
        """Which of SIDES each is on; a backend is on a device if it takes memory there."""
        on_device = {row.impl.backend for row in self.rows if row.device_bytes is not None}
        return {
            row.impl: "device" if row.impl.backend in on_device else row.kind for row in self.rows
        }

    @property
    def scenes(self) -> list[str]:
        return list(dict.fromkeys(group.scene for group in self.groups))

    def sizes(self, scene: str) -> list[int]:
        """Ascending; an unavailable scene has none."""
        return sorted(g.n for g in self.groups if g.scene == scene and g.unavailable is None)

    def at(self, place: Place, run: str) -> list[Row]:
        return [row for row in self.rows if row.place == place and row.run == run]

    def largest(self, scene: str, fits: Callable[[Row], bool] | None = None) -> Place | None:
        """The scene at its largest size that has spheres, and a row that fits if that is asked."""
        sizes = [n for n in self.sizes(scene) if n > 0]
        if fits is not None:
            met = {row.place.n for row in self.rows if row.place.scene == scene and fits(row)}
            sizes = [n for n in sizes if n in met]
        return Place(scene, sizes[-1]) if sizes else None


def load(path: Path) -> Result:
    """Reads and checks one result. Throws ReportError naming the file, and the row if it is one."""
    return read_json(path, parse)


def parse(document: Any) -> Result:
    """The same for a document already decoded."""
    if not isinstance(document, dict) or "schema" not in document:
        raise ReportError("not a bench result: it has no field 'schema'")
    if document["schema"] != SCHEMA or isinstance(document["schema"], bool):
        raise ReportError(
            f"schema {shown(document['schema'])} is not the schema {SCHEMA} read here"
        )
    found = convert(document, Document)
    groups = {group.place: group for group in found.groups}
    names: set[str] = set()
    for index, row in enumerate(found.rows):
        with naming(f"rows[{index}] ({row.name})"):
            if row.name in names:
                raise ReportError("an earlier row has the same name")
            names.add(row.name)
            _check_truth(row, groups.get(row.place))
    absent = _absent(found.rows)
    present = [row for row in found.rows if row.backend not in absent]
    return Result(
        context=document["context"],
        groups=found.groups,
        rows=[row for row in present if row.skips is None],
        absent=absent,
        gpu=found.context.gpu,
        variants=[row for row in present if row.skips is not None],
    )


def _check_truth(row: Row, group: Group | None) -> None:
    """What no row shows alone: its group exists, and a digest that is said to be right is."""
    if group is None:
        raise ReportError(f"no group has scene {row.scene}, n {row.n}")
    if row.status != "ok":
        return
    if group.truth is None:
        raise ReportError("says ok, but its group has no truth to be compared with")
    losses = (row.missed or 0) + (row.false or 0) + (row.duplicates or 0)
    if losses > 0 or (row.pairs, row.checksum) != (group.truth.pairs, group.truth.checksum):
        raise ReportError("says ok, but its pairs differ from its group's truth")


def _absent(rows: list[Row]) -> dict[str, str]:
    """Backends whose rows were all skipped for one reason: no device, say."""
    reasons: dict[str, set[str | None]] = {}
    for row in rows:
        if row.kind == "backend":
            skipped = row.reason if row.status == "skipped" else None
            reasons.setdefault(row.impl.backend, set()).add(skipped)
    return {
        backend: reason
        for backend, (reason, *others) in reasons.items()
        if reason is not None and not others
    }
