# SPDX-License-Identifier: MIT
"""What each skip is worth, and how far the plan is from the best that could have been chosen.

A study is one backend on one scene: its planned row, the variants of that row, and the methods that
can be forced. All were measured in the same rounds, so that ratios are taken within rounds.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

from octocell_report import tables, words
from octocell_report.fields import ReportError
from octocell_report.load import Place, Result, Row
from octocell_report.plan import NOTHING, PLANNED, allowed_last, forbidden
from octocell_report.spread import Estimate, estimate, ratios
from octocell_report.tables import ns_per_sphere

TARGET = 1.10  # planned time by the best forced choice's: what the planner is asked to stay below
WORTH_TELLING = 0.02  # a step that changes less of the time with nothing skipped is not named


class Key(NamedTuple):
    backend: str
    threads: int
    place: Place
    run: str
    motion: str | None


@dataclass
class Study:
    key: Key
    planned: Row | None = None
    variants: list[Row] = field(default_factory=list)
    forced: list[Row] = field(default_factory=list)

    @property
    def title(self) -> str:
        """The scene, and of the rest what is not the rule."""
        place, run, motion, threads = (
            self.key.place,
            self.key.run,
            self.key.motion,
            self.key.threads,
        )
        parts = [words.place(place)]
        parts += [words.run(run)] if run not in ("warm", tables.DYNAMIC) else []
        parts += [motion] if motion not in (None, place.scene) else []
        return ", ".join(parts) + (f" ({threads} threads)" if threads != 1 else "")

    @property
    def base(self) -> Row:
        """The planned row, of a study that is judged."""
        assert self.planned is not None
        return self.planned

    def variant(self, name: str) -> Row | None:
        return next((row for row in self.variants if row.skips == name), None)


def studies(result: Result) -> list[Study]:
    """Those whose planned row is exact; by backend, then as in the file."""
    return [study for study in _all(result) if _timed(study.planned)]


def unjudged(result: Result) -> list[Study]:
    """Those without an exact planned row to compare others with."""
    return [study for study in _all(result) if not _timed(study.planned)]


def backends(result: Result) -> dict[str, list[Study]]:
    found: dict[str, list[Study]] = {}
    for study in studies(result):
        found.setdefault(study.key.backend, []).append(study)
    return found


def require(result: Result) -> None:
    """Throws ReportError for a result that is no ablation."""
    if not result.variants:
        raise ReportError(
            "has no planned row with skips forbidden; octocell bench --preset ablation makes them"
        )


def _all(result: Result) -> list[Study]:
    found: dict[Key, Study] = {}
    for row in [*result.variants, *result.rows]:
        motion = row.motion.scene if row.motion else None
        key = Key(row.backend, row.threads, row.place, row.run, motion)
        if row.skips is not None:
            found.setdefault(key, Study(key)).variants.append(row)
        elif key in found and row.method == PLANNED:
            found[key].planned = row
        elif key in found and row.kind == "backend":
            found[key].forced.append(row)
    order = list(dict.fromkeys(key.backend for key in found))
    return sorted(found.values(), key=lambda study: order.index(study.key.backend))


def _timed(row: Row | None) -> bool:
    return row is not None and row.counts and row.median_ms > 0 and row.n > 0


def by_planned(study: Study, row: Row) -> Estimate | None:
    """Time of the row / time planned; None unless both are exact."""
    return _ratio(row, study.planned) if _timed(row) and _timed(study.planned) else None


def _ratio(above: Row, below: Row | None) -> Estimate | None:
    rounds = ratios(above.round_ms, below.round_ms if below else ())
    return estimate(rounds) if rounds else None


class Effect(NamedTuple):
    """One skip forbidden."""

    skip: str
    row: Row
    taken: bool  # by the plan; else the scene does not need the skip, and nothing should change
    ratio: Estimate | None  # time without it / time planned; None if the row is not exact


def effects(study: Study) -> list[Effect]:
    takes = study.base.plan.skips if study.base.plan else ()
    return [
        Effect(skip, row, skip in takes, by_planned(study, row))
        for row in study.variants
        if (skip := forbidden(row.skips or "")) is not None
    ]


def skips_of(every: Iterable[Study]) -> list[str]:
    """The skips that were forbidden one by one, in the order of the file."""
    return list(dict.fromkeys(effect.skip for study in every for effect in effects(study)))


@dataclass(frozen=True)
class Step:
    """One more skip allowed."""

    skip: str
    row: Row
    taken: bool  # by the plan that this row came to
    start: float  # ns per sphere with nothing skipped
    before: float  # of the last step that has a time
    after: float | None  # None if the row is not exact
    saved: Estimate | None  # within rounds; below zero is lost
    joint: bool  # the step before has no time, so this one holds what both change

    @property
    def change(self) -> float:
        """Of the medians, so that it is what lies between them in the figure."""
        return 0.0 if self.after is None else self.after - self.before

    @property
    def kind(self) -> str:
        """saved | lost | joint | noise (the interval holds 0, or too few rounds)."""
        if self.saved is None or not (self.saved.above(0.0) or self.saved.below(0.0)):
            return "noise"
        if self.joint:
            return "joint"
        return "saved" if self.saved.median > 0 else "lost"

    @property
    def told(self) -> bool:
        return self.kind != "noise" and abs(self.change) >= WORTH_TELLING * self.start


def steps(study: Study) -> list[Step]:
    """From nothing skipped to everything; none where the start has no time."""
    last = study.variant(NOTHING)
    if last is None or not _timed(last):
        return []
    rows = {allowed: row for row in study.variants if (allowed := allowed_last(row.skips or ""))}
    found: list[Step] = []
    start = ns_per_sphere(last)
    for (_, skip), row in sorted(rows.items()):
        taken = row.plan is not None and skip in row.plan.skips
        joint = bool(found) and found[-1].after is None
        after, saved = (ns_per_sphere(row), _saved(last, row)) if _timed(row) else (None, None)
        found.append(Step(skip, row, taken, start, ns_per_sphere(last), after, saved, joint))
        last = last if after is None else row
    return found


def _saved(before: Row, after: Row) -> Estimate | None:
    pairs = zip(before.round_ms, after.round_ms, strict=False)
    rounds = tuple((first - then) * 1e6 / after.n for first, then in pairs)
    return estimate(rounds) if rounds else None


def whole(study: Study) -> Estimate | None:
    """Time with nothing skipped / time planned."""
    start = study.variant(NOTHING)
    return by_planned(study, start) if start is not None else None


class Regret(NamedTuple):
    """The planned row against the fastest of the choices that could have been forced."""

    study: Study
    best: Row
    ratio: Estimate  # planned / best
    choices: int

    @property
    def same_plan(self) -> bool:
        """The best came to the same plan: what lies between the two is chance, or a test's cost."""
        return self.best.plan is not None and self.best.plan == self.study.base.plan

    @property
    def verdict(self) -> str:
        """within | above | unclear (the interval holds the target) | unknown (too few rounds)."""
        if not self.ratio.judged:
            return "unknown"
        if self.ratio.low > TARGET:
            return "above"
        return "within" if self.ratio.high <= TARGET else "unclear"


def regret(study: Study) -> Regret | None:
    """None where no other choice has a time. The best is found by median, after the fact."""
    choices = [row for row in [*study.forced, *study.variants] if _timed(row)]
    if not choices:
        return None
    best = min(choices, key=lambda row: row.median_ms)
    ratio = _ratio(study.base, best)
    return Regret(study, best, ratio, len(choices)) if ratio else None


def regrets(every: Iterable[Study]) -> list[Regret]:
    return [found for study in every if (found := regret(study))]


def choice(row: Row) -> str:
    """What was forced: 'home_phantom chapter32', or a variant's name."""
    if row.skips is not None:
        return row.skips
    return " ".join(part for part in (row.method, row.rule) if part)
