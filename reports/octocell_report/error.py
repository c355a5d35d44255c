# SPDX-License-Identifier: MIT
"""Run time against error: which overlap test costs what, and which pairs it gets wrong.

A series is one of our backends with one predicate, or one broad phase of a library. Of each
backend one configuration (method, rule, threads) stands for it on a scene: that which ran with most
predicates, of several the one whose exact row is fastest; so predicates differ and nothing else.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from statistics import median
from typing import NamedTuple

from octocell_report import tables, words
from octocell_report.fields import ReportError
from octocell_report.load import Group, Place, Result, Row
from octocell_report.predicates import EXACT, FLOAT32, PREDICATES, SCENE_CLASSES
from octocell_report.spread import Estimate, estimate, ratios

RUN = "warm"
SHARE = 95  # per cent that intervals hold here
MILLION = 1_000_000
JUDGING = ("pair_tests", "resolve")  # the stages that a predicate is part of


class Series(NamedTuple):
    backend: str
    predicate: str | None  # None for a library's broad phase
    side: str  # of load.SIDES

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


@dataclass(frozen=True)
class Point:
    """One series on one scene."""

    series: Series
    row: Row
    group: Group

    @property
    def ns(self) -> float:
        return tables.ns_per_sphere(self.row)

    @property
    def missed(self) -> int:
        return self.row.missed or 0

    @property
    def false(self) -> int:
        """Pairs that are none, and pairs given again."""
        return (self.row.false or 0) + (self.row.duplicates or 0)

    @property
    def errors(self) -> int:
        return self.missed + self.false

    @property
    def pairs(self) -> int:
        return self.group.truth_pairs or 0

    def rate(self, errors: int) -> float:
        """Per million true pairs; of a scene without any, as if it had one."""
        return MILLION * errors / max(1, self.pairs)

    @property
    def claimed(self) -> bool:
        """Its series claims to be exact, and is not known to be wrong."""
        return not self.row.negative_control and not self.row.known_issues

    @property
    def depth(self) -> float | None:
        """Of the missed pair that overlaps most: how deep, by the sum of the radii."""
        return self.row.worst_missed_depth

    @property
    def gap(self) -> float | None:
        """Of the false pair that lies farthest apart: how far, by the sum of the radii."""
        return self.row.worst_false_gap


@dataclass(frozen=True)
class Summary:
    """One series over the scenes of one class."""

    series: Series
    points: list[Point]

    @cached_property
    def ns(self) -> float:
        return median(point.ns for point in self.points)

    @property
    def pairs(self) -> int:
        return sum(point.pairs for point in self.points)

    @property
    def errors(self) -> int:
        return sum(point.errors for point in self.points)

    @property
    def exact(self) -> bool:
        """No error anywhere, and not by luck."""
        return self.errors == 0 and all(point.claimed for point in self.points)

    def worst(self, kind: str) -> Point | None:
        """The scene with most pairs of that kind (missed, false) per true pair; None without."""
        wrong = [point for point in self.points if getattr(point, kind)]
        return max(wrong, key=lambda p: p.rate(getattr(p, kind)), default=None)


@dataclass(frozen=True)
class Cost:
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
        order = {series: index for index, series in enumerate(_order(s for s, _ in found))}
        self.points = sorted(found.values(), key=lambda point: order[point.series])

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
        found: dict[Series, list[Point]] = {}
        for point in self.points:
            if point.group.scene_class == scene_class:
                found.setdefault(point.series, []).append(point)
        return [Summary(series, points) for series, points in found.items()]

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
        found = []
        for (backend, predicate, place), exact in held.items():
            plain = held.get((backend, FLOAT32, place))
            if (
                predicate == EXACT
                and plain is not None
                and plain.row.impl[1:4] == exact.row.impl[1:4]
            ):
                found += _cost(backend, exact, plain)
        return found

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
    groups = {group.place: group for group in result.groups if group.scene_class is not None}
    sides = {impl.backend: side for impl, side in result.sides.items()}
    rows = [row for row in result.rows if row.place in groups and _shown(row)]
    found: dict[Place, list[Point]] = {}
    for place in dict.fromkeys(row.place for row in rows):
        for row in _standing([row for row in rows if row.place == place]):
            side = sides[row.impl.backend]
            series = Series(row.impl.backend, _predicate(row), side)
            found.setdefault(place, []).append(Point(series, row, groups[place]))
    best: dict[str, Place] = {}
    for place, points in found.items():
        other = best.get(place.scene)
        if other is None or (len(points), place.n) > (len(found[other]), other.n):
            best[place.scene] = place
    return [point for place in best.values() for point in found[place]]


def _shown(row: Row) -> bool:
    """It ran, its errors are known, and they are the predicate's, not those of a wrong rule."""
    known = row.run == RUN and row.status != "skipped" and row.missed is not None
    wrong_rule = row.negative_control and row.predicate in (None, EXACT)
    return known and not wrong_rule and row.place.n > 0 and row.median_ms > 0


def _predicate(row: Row) -> str | None:
    return (row.predicate or EXACT) if row.kind == "backend" else None


def _standing(rows: list[Row]) -> list[Row]:
    """Of each backend the rows of the configuration that stands for it."""
    by_backend: dict[str, dict[tuple[object, ...], dict[str | None, Row]]] = {}
    for row in rows:
        configurations = by_backend.setdefault(row.impl.backend, {})
        configurations.setdefault(row.impl[1:4], {})[_predicate(row)] = row

    def rank(held: dict[str | None, Row]) -> tuple[int, float]:
        fastest = held.get(EXACT) or min(held.values(), key=lambda row: row.median_ms)
        return -len(held), fastest.median_ms

    return [row for held in by_backend.values() for row in min(held.values(), key=rank).values()]


def _order(every: Iterable[Series]) -> list[Series]:
    met = list(dict.fromkeys(every))
    ours = [series for series in met if series.predicate]
    libraries = [series for series in met if not series.predicate]
    ours.sort(key=lambda series: PREDICATES.index(series.predicate or ""))
    return ours + sorted(libraries, key=lambda series: series.lane)


def _cost(backend: str, exact: Point, plain: Point) -> list[Cost]:
    whole = _ratio(exact.row.round_ms, plain.row.round_ms)
    stages = _ratio(_judging_ms(exact.row), _judging_ms(plain.row))
    candidates = exact.row.candidates
    each = candidates / exact.pairs if candidates is not None and exact.pairs else float("nan")
    return [Cost(exact.row.place, backend, stages, whole, each)] if whole else []


def _judging_ms(row: Row) -> tuple[float, ...]:
    """The time of stages 5 and 6, round by round; a fused stage's is its host's, met once."""
    marked = [row.stage_ms[stage] for stage in JUDGING if stage in row.stage_ms]
    return tuple(sum(times) for times in zip(*marked, strict=False))


def _ratio(above: tuple[float, ...], below: tuple[float, ...]) -> Estimate | None:
    rounds = ratios(above, below)
    return estimate(rounds, SHARE) if rounds else None
