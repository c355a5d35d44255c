# SPDX-License-Identifier: MIT
"""The bench JSON, read and checked: what gets past load() needs no second look."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

import pandas as pd

from octocell_report.context import Gpu, check_context, gpu_of
from octocell_report.fields import (
    Check,
    Fields,
    Json,
    ReportError,
    is_bool,
    is_bytes,
    is_filled,
    is_list,
    is_names,
    is_number,
    is_object,
    is_stages,
    is_text,
    is_times,
    is_whole,
    one_of,
    or_null,
    shown,
)
from octocell_report.files import read_json
from octocell_report.groups import Group as Group  # others take both from here
from octocell_report.groups import Place as Place
from octocell_report.groups import group_of
from octocell_report.motion import Motion, motion_of
from octocell_report.plan import Plan, plan_of, variant_of
from octocell_report.predicates import EXACT, Distances, distances_of, predicate_of
from octocell_report.row_frame import labels, motion_frame, rows_frame, stages_frame

SCHEMA = 2
DEVICE_RUNS = ("cold_cache", "graph", "transfers")  # of backends on a device, beside cold and warm
RUNS = ("cold", "warm", *DEVICE_RUNS, "first_update", "update", "dynamic")
STATUSES = ("ok", "wrong", "skipped")
KINDS = ("backend", "baseline")
SIDES = ("backend", "device", "baseline")  # ours on the host, ours on a device, and the others
# In the order in which they run; the JSON may hold them in any.
STAGES = (
    *("bounds", "cell_ids", "sort", "cell_index", "pair_tests", "resolve"),
    *("build", "update", "query"),
)


class Impl(NamedTuple):
    """What is compared: one backend or baseline, its method and rule, its thread count."""

    backend: str
    method: str | None
    rule: str | None
    threads: int
    predicate: str | None = None  # where it is not the one that users get


@dataclass(frozen=True)
class Row:
    name: str
    impl: Impl
    kind: str
    place: Place
    run: str
    negative_control: bool
    status: str
    reason: str | None
    pairs: int | None
    checksum: str | None
    missed: int | None
    false: int | None
    duplicates: int | None
    candidates: int | None
    uncertain_pairs: int | None
    total_ms: tuple[float, ...]  # one per round
    stage_ms: dict[str, tuple[float, ...]]
    fused: dict[str, str]  # stage -> the stage whose time holds it
    plan_ms: float | None
    stage_bytes: dict[str, int]  # the least that a stage must read and write; empty if unknown
    peak_bytes: int | None
    device_bytes: int | None  # the most device memory at a time; null on the host
    output_bytes: int | None
    motion: Motion | None  # of dynamic rows only, and not of all
    known_issues: str  # why its library can lose pairs however it is driven; empty if it cannot
    skips: str | None  # which variant of the planned row it is; None for rows as users have them
    plan: Plan | None  # what it came to; of our rows that ran, and not of all
    predicate: str | None  # None for baselines, and in files from before there was a choice
    distances: Distances | None  # None for skipped rows
    distinct_checksums: int | None  # over all its runs; above 1 it does not repeat its own answer

    @property
    def round_ms(self) -> tuple[float, ...]:
        """One time per round: the steady frame of a row with frames, else the total."""
        return self.motion.steady if self.motion else self.total_ms

    @property
    def median_ms(self) -> float:
        """Median over the rounds; NaN for a skipped row."""
        return median(self.round_ms) if self.round_ms else math.nan

    @property
    def excused(self) -> bool:
        """Wrong in the way that its library is known for: pairs are missed, nothing else."""
        only_missed = self.false == 0 and self.duplicates == 0
        return bool(self.status == "wrong" and self.known_issues and only_missed)

    @property
    def counts(self) -> bool:
        """True if its time may stand bare: exact, and not a negative control."""
        return self.status == "ok" and not self.negative_control


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
    context = Fields(document, "result").take("context", is_object)
    check_context(context)
    groups = [group_of(item, i) for i, item in enumerate(_list(document, "groups"))]
    rows = [_row(item, i) for i, item in enumerate(_list(document, "rows"))]
    _check_together(groups, rows)
    absent = _absent(rows)
    present = [row for row in rows if row.impl.backend not in absent]
    default = [row for row in present if row.skips is None]
    variants = [row for row in present if row.skips is not None]
    return Result(context, groups, default, absent, gpu_of(context), variants)


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


def _list(document: Json, key: str) -> list[Any]:
    found: list[Any] = Fields(document, "result").take(key, is_list)
    return found


# Fields that only a row that ran must have; a skipped row's are not looked at.
_MEASURED: dict[str, Check] = {
    "pairs": is_whole,
    "checksum": is_text,
    "missed": or_null(is_whole),
    "false": or_null(is_whole),
    "duplicates": or_null(is_whole),
    "candidates": or_null(is_whole),
    "uncertain_pairs": or_null(is_whole),
    "total_ms": is_times,
    "stage_ms": is_stages,
    "plan_ms": or_null(is_number),
    "fused": is_names,
    "peak_bytes": or_null(is_whole),
    "output_bytes": or_null(is_whole),
}

# The same, but files written before these were measured do not have them.
_OPTIONAL: dict[str, Check] = {
    "stage_bytes": or_null(is_bytes),
    "device_bytes": or_null(is_whole),
    "distinct_checksums": or_null(is_whole),
}


def _row(item: Any, index: int) -> Row:
    fields = Fields(item, f"row {index}")
    name = fields.take("name", is_filled)
    fields.title = f"row {index} ({name})"
    predicate = predicate_of(fields)
    impl = Impl(
        fields.take("backend", is_filled),
        fields.take("method", or_null(is_filled)),
        fields.take("rule", or_null(is_filled)),
        fields.take("threads", is_whole),
        predicate if predicate != EXACT else None,
    )
    status = fields.take("status", one_of(*STATUSES))
    return Row(
        name=name,
        impl=impl,
        kind=fields.take("kind", one_of(*KINDS)),
        place=Place(fields.take("scene", is_filled), fields.take("n", is_whole)),
        run=fields.take("run", one_of(*RUNS)),
        negative_control=fields.take("negative_control", is_bool),
        status=status,
        reason=fields.take("reason", is_text if status == "skipped" else or_null(is_text)),
        known_issues=fields.optional("known_issues", or_null(is_text)) or "",
        skips=variant_of(fields, impl.method),
        predicate=predicate,
        **(_unmeasured() if status == "skipped" else _measured(fields)),
    )


def _unmeasured() -> Json:
    nothing: Json = dict.fromkeys([*_MEASURED, *_OPTIONAL, "motion", "plan", "distances"])
    return nothing | {"total_ms": (), "stage_ms": {}, "stage_bytes": {}, "fused": {}}


def _measured(fields: Fields) -> Json:
    found = {key: fields.take(key, check) for key, check in _MEASURED.items()}
    found |= {key: fields.optional(key, check) for key, check in _OPTIONAL.items()}
    found["stage_bytes"] = found["stage_bytes"] or {}
    if not found["total_ms"]:
        raise ReportError(f"{fields.title}: field 'total_ms' has no round")
    found["total_ms"] = tuple(found["total_ms"])
    found["motion"], found["plan"] = motion_of(fields), plan_of(fields)
    found["distances"] = distances_of(fields)
    known = sorted(found["stage_ms"].items(), key=lambda item: _rank(item[0]))
    found["stage_ms"] = {stage: tuple(ms) for stage, ms in known if ms}
    return found


def _rank(stage: str) -> int:
    return STAGES.index(stage) if stage in STAGES else len(STAGES)


def _check_together(groups: list[Group], rows: list[Row]) -> None:
    """What no row shows alone: names met once, groups that exist, digests that fit the truth."""
    known = {group.place: group for group in groups}
    names: set[str] = set()
    for index, row in enumerate(rows):
        title = f"row {index} ({row.name})"
        if row.name in names:
            raise ReportError(f"{title}: an earlier row has the same name")
        names.add(row.name)
        group = known.get(row.place)
        if group is None:
            raise ReportError(f"{title}: no group has scene {row.place.scene}, n {row.place.n}")
        losses = (row.missed or 0) + (row.false or 0) + (row.duplicates or 0)
        truth = (group.truth_pairs, group.truth_checksum)
        differs = group.truth_pairs is not None and (row.pairs, row.checksum) != truth
        if row.status == "ok" and (losses > 0 or differs):
            raise ReportError(f"{title}: says ok, but its pairs differ from its group's truth")
        if row.status == "ok" and group.truth_pairs is None:
            raise ReportError(f"{title}: says ok, but its group has no truth to be held against")
