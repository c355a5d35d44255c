# SPDX-License-Identifier: MIT
"""Run time against error: which overlap test costs what, and which pairs it gets wrong.

A series is one of our backends with one predicate, or one broad phase of a library. Of each
backend one configuration (method, rule, threads) stands for it on a scene: that which ran with most
predicates, of several the one whose exact row is fastest; so predicates differ and nothing else.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from statistics import median
from typing import NamedTuple

import pandas as pd

from octocell_report import tables, words
from octocell_report.fields import ReportError
from octocell_report.load import Group, Place, Result, Row
from octocell_report.predicates import EXACT, FLOAT32, PREDICATES, SCENE_CLASSES
from octocell_report.spread import Estimate, estimate, ratios

RUN = "warm"
SHARE = 95  # per cent that intervals hold here
MILLION = 1_000_000
JUDGING = ("pair_tests", "resolve")  # the stages that a predicate is part of
CONFIGURATION = ["method", "rule", "threads"]


class Series(NamedTuple):
    backend: str
    predicate: str | None  # None for a library's broad phase
    side: str  # as in Result.frame

    @property
    def label(self) -> str:
        return f"{self.backend} {self.predicate}" if self.predicate else self.backend

    @property
    def lane(self) -> str:
        """What shares a line where nothing is wrong: the predicate, or the library."""
        return self.predicate or words.family_title(words.family(self.backend))

    @property
    def on_device(self) -> bool:
        return self.side == "device"


class Point:
    """One series on one scene."""

    def __init__(self, series: Series, row: Row, group: Group) -> None:
        self.series, self.row, self.group = series, row, group
        self.ns = tables.ns_per_sphere(row)
        self.pairs = group.truth_pairs or 0
        self.missed = row.missed or 0
        self.false = (row.false or 0) + (row.duplicates or 0)
        self.errors = self.missed + self.false
        self.claimed = not row.negative_control and not row.known_issues  # it claims to be exact
        # Of the worst pairs, by the sum of the radii: how deep the overlap, how wide the gap is.
        self.depth, self.gap = row.worst_missed_depth, row.worst_false_gap

    def rate(self, errors: int) -> float:
        """Per million true pairs; of a scene without any, as if it had one."""
        return MILLION * errors / max(1, self.pairs)


class Summary:
    """One series over the scenes of one class."""

    def __init__(self, series: Series, points: list[Point]) -> None:
        self.series, self.points = series, points
        self.ns = median(point.ns for point in points)
        self.errors = sum(point.errors for point in points)
        self.exact = self.errors == 0 and all(point.claimed for point in points)  # not by luck

    def worst(self, kind: str) -> Point | None:
        """The scene with most pairs of that kind (missed, false) per true pair; None without."""
        wrong = [point for point in self.points if getattr(point, kind)]
        return max(wrong, key=lambda p: p.rate(getattr(p, kind)), default=None)


class Cost(NamedTuple):
    """What exact decisions cost beside plain float32 ones: stages 5 and 6, within rounds."""

    place: Place
    backend: str
    stages: Estimate | None  # exact / float32 of the stages that decide; None where not marked
    whole: Estimate  # the same of all stages
    candidates: float  # looked at, per true pair; NaN if unknown


class Study:
    """Results, maybe of several machines: of a row that two of them hold the first one's stands."""

    def __init__(self, results: Iterable[Result]) -> None:
        self.results = list(results)
        found: dict[tuple[Series, Place], Point] = {}
        for result in self.results:
            for point in _points(result):
                found.setdefault((point.series, point.row.place), point)
        ordered = sorted(dict.fromkeys(series for series, _ in found), key=_order)
        self.points = sorted(found.values(), key=lambda point: ordered.index(point.series))

    @cached_property
    def series(self) -> list[Series]:
        """In the order of tables: by predicate, exact first; then the libraries."""
        return list(dict.fromkeys(point.series for point in self.points))

    @cached_property
    def groups(self) -> list[Group]:
        """The scenes, by class, then as in the files."""
        met = {point.group.place: point.group for point in self.points}
        every = (group.place for result in self.results for group in result.groups)
        groups = [met[place] for place in dict.fromkeys(every) if place in met]
        return sorted(groups, key=lambda group: SCENE_CLASSES.index(group.scene_class or ""))

    @property
    def classes(self) -> list[str]:
        return list(dict.fromkeys(group.scene_class or "" for group in self.groups))

    @property
    def predicates(self) -> list[str]:
        met = {series.predicate for series in self.series}
        return [predicate for predicate in PREDICATES if predicate in met]

    def summaries(self, scene_class: str) -> list[Summary]:
        here = [point for point in self.points if point.group.scene_class == scene_class]
        met = dict.fromkeys(point.series for point in here)
        return [Summary(series, [p for p in here if p.series == series]) for series in met]

    def fronts(self, scene_class: str) -> dict[bool, Summary]:
        """The fastest exact series of the host (False) and of a device (True), if there is one."""
        found: dict[bool, Summary] = {}
        for summary in sorted(self.summaries(scene_class), key=lambda s: s.ns):
            if summary.exact:
                found.setdefault(summary.series.on_device, summary)
        return found

    def pairs(self, scene_class: str) -> int:
        """True pairs of all its scenes together."""
        return sum(g.truth_pairs or 0 for g in self.groups if g.scene_class == scene_class)

    @cached_property
    def costs(self) -> list[Cost]:
        """By backend and scene, where both predicates ran and gave a time."""
        held = {(p.series.backend, p.series.predicate, p.row.place): p for p in self.points}
        both = (
            (exact, held.get((backend, FLOAT32, place)))
            for (backend, predicate, place), exact in held.items()
            if predicate == EXACT
        )
        return [cost for exact, plain in both if plain and (cost := _cost(exact, plain))]

    @property
    def compares(self) -> bool:
        """There is a predicate beside exact, so there is an experiment to show."""
        return any(series.predicate not in (None, EXACT) for series in self.series)

    @property
    def unsteady(self) -> list[Point]:
        """Rows whose answer is not the same in all runs."""
        return [point for point in self.points if (point.row.distinct_checksums or 1) > 1]


def require(study: Study) -> None:
    """Throws ReportError for results without a row to show."""
    if not study.points:
        raise ReportError("no warm row that ran is on a scene with a scene_class")


def _points(result: Result) -> list[Point]:
    """One result's, each scene at the size at which most series ran."""
    frame = result.frame
    rows = frame[
        (frame["run"] == RUN)
        & frame["scene_class"].notna()
        & frame["missed"].notna()  # so its errors are known
        & ~(frame["negative_control"] & frame["predicate"].isna())  # they are not a wrong rule's
        & (frame["ns_per_sphere"] > 0)
    ]
    exact = rows.assign(ms=rows["median_ms"].where(rows["predicate"].isna()))
    by = exact.groupby(["scene", "n", "backend", *CONFIGURATION], dropna=False)
    fastest = by["ms"].transform("min").fillna(by["median_ms"].transform("min"))
    known = {"configuration": by.ngroup(), "met": by["ms"].transform("size"), "speed": 1 / fastest}
    rows = _best(rows.assign(**known), ["scene", "n", "backend"], "configuration", ["met", "speed"])
    met = rows.groupby(["scene", "n"])["backend"].transform("size")
    rows = _best(rows.assign(met=met), ["scene"], "n", ["met", "n"])
    groups = {group.place: group for group in result.groups}
    every = [(result.rows[at], side) for at, side in rows["side"].items()]
    every.sort(key=lambda known: result.scenes.index(known[0].scene))
    return [Point(_series(row, side), row, groups[row.place]) for row, side in every]


def _best(rows: pd.DataFrame, of: list[str], column: str, rank: list[str]) -> pd.DataFrame:
    """Of each group those lines whose column holds what that of the highest rank holds."""
    ranked = rows.sort_values(rank, kind="stable").groupby(of)[column].transform("last")
    return rows[rows[column] == ranked.reindex(rows.index)]


def _series(row: Row, side: str) -> Series:
    predicate = (row.predicate or EXACT) if row.kind == "backend" else None
    return Series(row.backend, predicate, side)


def _order(series: Series) -> tuple[int, str]:
    ours = PREDICATES.index(series.predicate) if series.predicate else len(PREDICATES)
    return ours, "" if series.predicate else series.lane


def _cost(exact: Point, plain: Point) -> Cost | None:
    whole = _ratio(exact.row.round_ms, plain.row.round_ms)
    if whole is None or exact.row.impl[1:4] != plain.row.impl[1:4]:
        return None
    stages = _ratio(_judging_ms(exact.row), _judging_ms(plain.row))
    known = exact.row.candidates is not None and exact.pairs
    each = (exact.row.candidates or 0) / exact.pairs if known else float("nan")
    return Cost(exact.row.place, exact.series.backend, stages, whole, each)


def _judging_ms(row: Row) -> tuple[float, ...]:
    """The time of stages 5 and 6, round by round; a fused stage's is its host's, met once."""
    marked = [row.stage_ms[stage] for stage in JUDGING if stage in row.stage_ms]
    return tuple(sum(times) for times in zip(*marked, strict=False))


def _ratio(above: tuple[float, ...], below: tuple[float, ...]) -> Estimate | None:
    rounds = ratios(above, below)
    return estimate(rounds, SHARE) if rounds else None
