# SPDX-License-Identifier: MIT
"""Sentences computed from the data: what a plot shows, in words. None may outlive its numbers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from itertools import product
from statistics import median

from octocell_report import check, dynamic, tables, words
from octocell_report.language import listed, scenes, spanned, tell
from octocell_report.load import Result, Row


def origins(results: Iterable[Result], language: str = "en") -> list[str]:
    """Of rows that have files of their own, maybe of several machines: where they come from."""
    return [_origin(result, language) for result in results]


def _origin(result: Result, language: str) -> str:
    context = result.context
    commit = tell(language, "commit_dirty" if context["dirty"] else "commit_clean")
    gpu = f"{result.gpu.name}, " if result.gpu else ""
    return tell(
        language,
        "origin" if context["finished"] else "origin_interrupted",
        cpu=f"{gpu}{context['machine']['cpu']}",
        date=context["date"][:10],
        commit=f"{context['commit'][:12]} ({commit})",
        rounds=context["rounds"],
    )


def overview(result: Result, language: str = "en") -> list[str]:
    """What stands under the headline."""
    verdict = check.judge(result)
    found = []
    if verdict.negative_controls:
        found.append(_negative_controls(result, language))
    if verdict.excused:
        names = list(dict.fromkeys(words.labels(result)[row.impl] for row in verdict.excused))
        values = {"rows": len(verdict.excused), "names": listed(names, language)}
        found.append(tell(language, "excused", **values))
    if verdict.skipped:
        key = "rows_skipped_one" if verdict.skipped == 1 else "rows_skipped"
        found.append(tell(language, key, rows=verdict.skipped))
    if result.absent:
        reasons = [f"{backend} ({reason})" for backend, reason in result.absent.items()]
        found.append(tell(language, "absent", backends=listed(reasons, language)))
    if verdict.unavailable:
        found.append(tell(language, "not_there", scenes=listed(verdict.unavailable, language)))
    return found + speed(result, "warm", language)


def _negative_controls(result: Result, language: str) -> str:
    """How much the rules lose that are kept for their faults."""
    rows = [row for row in result.rows if row.negative_control and row.status != "skipped"]
    truth = {group.place: group.truth_pairs for group in result.groups}
    shares = [
        100 * row.missed / pairs
        for row in rows
        if row.missed and (pairs := truth[row.place]) is not None and pairs > 0
    ]
    rules = list(dict.fromkeys(words.labels(result)[row.impl] for row in rows))
    text = tell(language, "negative_controls", rows=len(rows), rules=listed(rules, language))
    if not shares:
        return tell(language, "negative_controls_missed_none", negative_controls=text)
    share = spanned(shares, words.number, language)
    return tell(language, "negative_controls_missed", negative_controls=text, share=share)


def time(result: Result, run: str, language: str = "en") -> list[str]:
    """Who is fastest at each largest size, and how time grows."""
    labels = words.labels(result)
    winners: Counter[str] = Counter()
    slopes: dict[str, list[float]] = {}
    for scene in result.scenes:
        curves = tables.curves(result, scene, run)
        place = tables.compared(result, scene, run)
        last = [row for rows in curves.values() for row in rows if row.place == place]
        if last:
            winners[labels[min(last, key=lambda row: row.median_ms).impl]] += 1
        for impl, rows in curves.items():
            exponent = tables.slope(rows)
            if exponent is not None:
                ours = rows[0].kind == "backend"
                who = labels[impl] if ours else tell(language, "the_baselines")
                slopes.setdefault(who, []).append(exponent)
    return [*_time_sentences(winners, slopes, language), *_single_sizes(result, run, language)]


def _time_sentences(
    winners: Counter[str], slopes: dict[str, list[float]], language: str
) -> list[str]:
    found = []
    if winners:
        parts = [tell(language, "won", name=n, scenes=count) for n, count in winners.most_common()]
        values = {"scenes": scenes(winners.total(), language), "winners": listed(parts, language)}
        found.append(tell(language, "fastest", **values))
    if slopes:
        grown = [
            f"{who} {spanned(b, lambda v: f'n^{v:.2f}', language)}" for who, b in slopes.items()
        ]
        found.append(tell(language, "grows", slopes=listed(grown, language)))
    return found


def _single_sizes(result: Result, run: str, language: str) -> list[str]:
    held = {row.place.scene for row in result.rows if row.run == run}
    single = [scene for scene in result.scenes if len(_sizes(result, scene)) == 1 and scene in held]
    return [tell(language, "one_size", scenes=listed(single, language))] if single else []


def _sizes(result: Result, scene: str) -> list[int]:
    return [n for n in result.sizes(scene) if n > 0]


def stages(result: Result, side: str, language: str = "en") -> list[str]:
    """Where the fastest exact row of that side spends its time, scene by scene."""
    impls = result.impls_of(side)
    heaviest: Counter[str] = Counter()
    shares: dict[str, list[float]] = {}
    for place in tables.largest(result, "warm", impls):
        rows = [r for r in result.at(place, "warm") if r.impl in impls and r.counts and r.stage_ms]
        if not rows:
            continue
        stage, share = _heaviest(min(rows, key=lambda row: row.median_ms))
        heaviest[stage] += 1
        shares.setdefault(stage, []).append(100 * share)
    if not heaviest:
        return []
    parts = []
    for stage, count in heaviest.most_common():
        part = spanned(shares[stage], lambda v: f"{v:.0f}", language)
        parts.append(tell(language, "heaviest_one", stage=stage, scenes=count, share=part))
    values = {"scenes": scenes(heaviest.total(), language), "stages": listed(parts, language)}
    return [tell(language, f"heaviest_{side}", **values)]


def _heaviest(row: Row) -> tuple[str, float]:
    times = {stage: median(ms) for stage, ms in row.stage_ms.items()}
    stage = max(times, key=lambda name: times[name])
    return stage, times[stage] / (sum(times.values()) or 1.0)


def per_sphere(result: Result, language: str = "en") -> list[str]:
    """How much the dearest scene costs over the cheapest, for each of our implementations."""
    labels, found = words.labels(result), []
    for impl in [*result.impls_of("backend"), *result.impls_of("device")]:
        places = tables.largest(result, "warm", result.impls_of(result.sides[impl]))
        rows = [r for p in places for r in result.at(p, "warm") if r.impl == impl and r.counts]
        if len(rows) < 2:
            continue
        low, high = min(rows, key=tables.ns_per_sphere), max(rows, key=tables.ns_per_sphere)
        sentence = tell(
            language,
            "per_sphere",
            name=labels[impl],
            low=words.number(tables.ns_per_sphere(low)),
            cheap=words.place(low.place),
            high=words.number(tables.ns_per_sphere(high)),
            dear=words.place(high.place),
        )
        found.append(sentence)
    return found


def speed(result: Result, run: str, language: str = "en") -> list[str]:
    """Our fastest exact row of each group, on host and device, against each library's fastest."""
    every, sides = tables.ratios(result, run), result.sides
    ran = {sides[ratio.impl] for ratio in every}
    found = []
    for side, family in product(("backend", "device"), tables.families(result)):
        best: dict[tuple[str, int], float] = {}
        for ratio in every:
            if ratio.family == family and sides[ratio.impl] == side:
                best[ratio.place] = max(ratio.median, best.get(ratio.place, 0.0))
        if not best:
            continue
        values = list(best.values())
        sentence = tell(
            language,
            "speed",
            run=tell(language, f"speed_{run}"),
            where=tell(language, f"where_{side}") if "device" in ran else "",
            family=words.family_title(family),
            ahead=sum(value > 1 for value in values),
            groups=len(values),
            ratios=spanned(values, words.ratio, language),
            median=words.ratio(median(values)),
        )
        found.append(sentence)
    return found


def moving(result: Result, language: str = "en") -> list[str]:
    """Whose steady frame is fastest on each course, and how ours stands to the same frames searched
    again and to each library's."""
    labels, every, found = words.labels(result), tables.ratios(result, tables.DYNAMIC), []
    again = dynamic.searched_again(result)
    for course, rows in dynamic.courses(result).items():
        exact = [row for row in rows if row.counts]
        if not exact:
            continue
        best = min(exact, key=lambda row: row.median_ms)
        name, time_ms = labels[best.impl], words.number(best.median_ms)
        found.append(tell(language, "steady", course=course.title, name=name, time=time_ms))
        for row in exact:
            beside = again.get((row.impl, row.place))
            if rounds := tables.round_ratios(row, beside) if beside else ():
                share = f"{median(rounds):.2f}"
                values = {"course": course.title, "name": labels[row.impl], "share": share}
                found.append(tell(language, "steady_again", **values))
        for family in tables.families(result):
            ours = [
                ratio.median
                for ratio in every
                if (ratio.place, ratio.motion, ratio.family) == (*course, family)
            ]
            if ours:
                ratio, title = words.ratio(max(ours)), words.family_title(family)
                values = {"course": course.title, "ratio": ratio, "family": title}
                found.append(tell(language, "steady_speed", **values))
    return found


def correctness(result: Result, language: str = "en") -> list[str]:
    """The verdict, and where each implementation is wrong that should not be."""
    verdict = check.judge(result)
    labels = words.labels(result)
    places: dict[str, dict[str, None]] = {}
    for row in [*verdict.wrong, *verdict.excused]:
        where = f"{words.place(row.place)} ({words.losses(row)})"
        places.setdefault(labels[row.impl], {})[where] = None
    for row in verdict.wrong_variants:
        where = f"{words.place(row.place)} ({words.losses(row)})"
        places.setdefault(words.variant(row), {})[where] = None
    return [check.headline(verdict, language)] + [
        tell(language, "wrong_on", name=label, places=listed(list(where), language))
        for label, where in places.items()
    ]


def memory(result: Result, language: str = "en") -> list[str]:
    """The least and the most that each kind needs, over the largest sizes."""
    needs: dict[str, list[float]] = {"backend": [], "baseline": []}
    for place in tables.measured_memory(result):
        for row in tables.memory(result, place).values():
            need = tables.beyond_bytes(row)
            if row.counts and need is not None:
                needs[row.kind].append(need)
    parts = [
        f"{tell(language, who)} {spanned(values, words.grouped, language)}"
        for who, values in (("ours", needs["backend"]), ("the_baselines", needs["baseline"]))
        if values
    ]
    if not parts:
        return []
    return [tell(language, "bytes", needs=tell(language, "semicolon").join(parts))]
