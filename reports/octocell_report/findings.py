# SPDX-License-Identifier: MIT
"""Sentences computed from the data: what a plot shows, in words. None may outlive its numbers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from statistics import median

from octocell_report import check, tables, words
from octocell_report.load import Result, Row


def overview(result: Result) -> list[str]:
    """What stands under the headline."""
    verdict = check.judge(result)
    found = []
    if verdict.exhibits:
        found.append(_exhibits(result))
    if verdict.skipped:
        found.append(f"{_rows(verdict.skipped)} skipped, each with its reason below.")
    if verdict.unavailable:
        found.append(f"Not there: {', '.join(verdict.unavailable)}.")
    return found + speed(result, "warm")


def _rows(n: int) -> str:
    return "1 row was" if n == 1 else f"{n} rows were"


def _exhibits(result: Result) -> str:
    """How much the rules lose that are kept for their faults."""
    rows = [row for row in result.rows if row.exhibit and row.status != "skipped"]
    truth = {group.place: group.truth_pairs for group in result.groups}
    shares = [
        100 * row.missed / pairs
        for row in rows
        if row.missed and (pairs := truth[row.place]) is not None and pairs > 0
    ]
    rules = ", ".join(dict.fromkeys(words.labels(result)[row.impl] for row in rows))
    text = f"{len(rows)} more belong to exhibits ({rules}), kept because they are wrong"
    if not shares:
        return f"{text}; none of them missed a pair here."
    return f"{text}: they miss {_range(shares, words.number)} % of the pairs."


def _range(values: list[float], show: Callable[[float], str]) -> str:
    low, high = show(min(values)), show(max(values))
    return low if low == high else f"{low} to {high}"


def time(result: Result, run: str) -> list[str]:
    """Who is fastest at each largest size, and how time grows."""
    labels = words.labels(result)
    winners: Counter[str] = Counter()
    slopes: dict[str, list[float]] = {}
    for scene in result.scenes:
        curves = tables.curves(result, scene, run)
        place = result.largest(scene)
        last = [row for rows in curves.values() for row in rows if row.place == place]
        if last:
            winners[labels[min(last, key=lambda row: row.median_ms).impl]] += 1
        for impl, rows in curves.items():
            exponent = tables.slope(rows)
            who = labels[impl] if rows[0].kind == "backend" else "the baselines"
            if exponent is not None:
                slopes.setdefault(who, []).append(exponent)
    found = []
    if winners:
        parts = [f"{name} on {count}" for name, count in winners.most_common()]
        found.append(
            f"Fastest exact row at the largest size, of {_scenes(winners.total())}: "
            f"{', '.join(parts)}."
        )
    if slopes:
        grown = [f"{who} {_range(b, lambda v: f'n^{v:.2f}')}" for who, b in slopes.items()]
        found.append(f"Time grows: {', '.join(grown)}.")
    single = [scene for scene in result.scenes if len(_sizes(result, scene)) == 1]
    if single:
        found.append(f"One size only, so no curve: {', '.join(single)}.")
    return found


def _sizes(result: Result, scene: str) -> list[int]:
    return [n for n in result.sizes(scene) if n > 0]


def _scenes(n: int) -> str:
    return "1 scene" if n == 1 else f"{n} scenes"


def stages(result: Result, kind: str) -> list[str]:
    """Where the fastest exact row of that kind spends its time, scene by scene."""
    heaviest: Counter[str] = Counter()
    shares: dict[str, list[float]] = {}
    for place in filter(None, map(result.largest, result.scenes)):
        rows = [r for r in result.at(place, "warm") if r.kind == kind and r.counts and r.stage_ms]
        if not rows:
            continue
        stage, share = _heaviest(min(rows, key=lambda row: row.median_ms))
        heaviest[stage] += 1
        shares.setdefault(stage, []).append(100 * share)
    if not heaviest:
        return []
    parts = [
        f"{stage} in {count} ({_range(shares[stage], lambda v: f'{v:.0f}')} % of its time)"
        for stage, count in heaviest.most_common()
    ]
    who = "our fastest exact row" if kind == "backend" else "the fastest baseline"
    return [f"Heaviest stage of {who}, of {_scenes(heaviest.total())}: {', '.join(parts)}."]


def _heaviest(row: Row) -> tuple[str, float]:
    times = {stage: median(ms) for stage, ms in row.stage_ms.items()}
    stage = max(times, key=lambda name: times[name])
    return stage, times[stage] / (sum(times.values()) or 1.0)


def per_sphere(result: Result) -> list[str]:
    """How much the dearest scene costs over the cheapest, for each of our implementations."""
    labels, found = words.labels(result), []
    for impl in result.impls_of("backend"):
        places = [p for p in map(result.largest, result.scenes) if p]
        rows = [r for p in places for r in result.at(p, "warm") if r.impl == impl and r.counts]
        if len(rows) < 2:
            continue
        low, high = min(rows, key=tables.ns_per_sphere), max(rows, key=tables.ns_per_sphere)
        found.append(
            f"{labels[impl]}: {words.number(tables.ns_per_sphere(low))} ns/sphere on "
            f"{words.place(low.place)} to {words.number(tables.ns_per_sphere(high))} on "
            f"{words.place(high.place)}."
        )
    return found


def speed(result: Result, run: str) -> list[str]:
    """Our fastest exact row of each group against each library's fastest."""
    every = tables.ratios(result, run)
    found = []
    for family in tables.families(result):
        best: dict[tuple[str, int], float] = {}
        for ratio in every:
            if ratio.family == family:
                best[ratio.place] = max(ratio.median, best.get(ratio.place, 0.0))
        if not best:
            continue
        values = list(best.values())
        ahead = sum(value > 1 for value in values)
        found.append(
            f"{run.capitalize()}, our fastest exact row is ahead of "
            f"{words.family_title(family)}'s fastest in {ahead} of {len(values)} groups: "
            f"{_range(values, words.ratio)} as fast, median {words.ratio(median(values))}."
        )
    return found


def correctness(result: Result) -> list[str]:
    """The verdict, and where each implementation is wrong that should not be."""
    verdict = check.judge(result)
    labels = words.labels(result)
    places: dict[str, dict[str, None]] = {}
    for row in verdict.wrong:
        where = f"{words.place(row.place)} ({words.losses(row)})"
        places.setdefault(labels[row.impl], {})[where] = None
    return [check.headline(verdict)] + [
        f"{label} is wrong on {', '.join(where)}." for label, where in places.items()
    ]


def memory(result: Result) -> list[str]:
    """The least and the most that each kind needs, over the largest sizes."""
    needs: dict[str, list[float]] = {"backend": [], "baseline": []}
    for place in filter(None, map(result.largest, result.scenes)):
        for row in tables.memory(result, place).values():
            need = tables.beyond_bytes(row)
            if row.counts and need is not None:
                needs[row.kind].append(need)
    parts = [
        f"{who} {_range(values, words.grouped)}"
        for who, values in (("ours", needs["backend"]), ("the baselines", needs["baseline"]))
        if values
    ]
    return [f"Bytes per sphere, exact rows: {'; '.join(parts)}."] if parts else []
