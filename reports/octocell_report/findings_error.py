# SPDX-License-Identifier: MIT
"""Sentences on what simpler overlap tests save and get wrong, computed from the rows."""

from __future__ import annotations

from statistics import median

from octocell_report import words
from octocell_report.error import Point, Series, Study, Summary
from octocell_report.language import listed, scenes, spanned, tell
from octocell_report.predicates import EXACT

_MOST = 6  # named one by one; more are counted


def sentences(study: Study, name: str, language: str = "en") -> list[str]:
    """Under the figure of that name."""
    found = {"error_pareto": _pareto, "error_depth": _depth, "error_map": _map}
    return found[name](study, language)


def _pareto(study: Study, language: str) -> list[str]:
    classes = [_class(study, name, language) for name in study.classes]
    return classes + _savings(study, language) + _libraries(study, language)


def _class(study: Study, name: str, language: str) -> str:
    """Which predicates err on the scenes of a class, and the worst of them."""
    worst: dict[str, Point] = {}
    met = {summary.series.predicate for summary in study.summaries(name)}
    for point in study.points:
        predicate = point.series.predicate
        if predicate is None or point.group.scene_class != name or not point.errors:
            continue
        if predicate not in worst or _rate(point) > _rate(worst[predicate]):
            worst[predicate] = point
    right = [p for p in study.predicates if p in met and p not in worst]
    values: dict[str, object] = {
        "scenes": tell(language, f"class_{name}"),
        "pairs": words.count(study.pairs(name)),
        "right": listed(right, language) or words.NONE,
    }
    if not worst:
        return tell(language, "error_class_right", **values)
    order = sorted(worst, key=lambda predicate: -_rate(worst[predicate]))
    cases = [_case(predicate, worst[predicate], language) for predicate in order]
    return tell(language, "error_class", **values, cases=listed(cases, language))


def _rate(point: Point) -> float:
    return point.rate(point.errors)


def _case(name: str, point: Point, language: str) -> str:
    parts = [
        tell(language, key, rate=words.rate(point.rate(count)))
        for key, count in (("error_lost", point.missed), ("error_invented", point.false))
        if count
    ]
    scene = point.row.place.scene
    return tell(language, "error_case", name=name, what=" ".join(parts), scene=scene)


def prices(study: Study, language: str = "en") -> list[str]:
    """What exactness costs beside plain float32, backend by backend."""
    found = []
    for backend in dict.fromkeys(cost.backend for cost in study.costs):
        costs = [cost for cost in study.costs if cost.backend == backend]
        known = [cost.stages for cost in costs if cost.stages]
        if not known:
            continue
        dearer = sum(estimate.above(1.0) for estimate in known)
        cheaper = sum(estimate.below(1.0) for estimate in known)
        found.append(
            tell(
                language,
                "error_price",
                name=backend,
                ratio=words.times(median(estimate.median for estimate in known)),
                ratios=spanned([estimate.median for estimate in known], words.times, language),
                scenes=scenes(len(known), language),
                dearer=dearer,
                cheaper=cheaper,
                whole=words.times(median(cost.whole.median for cost in costs)),
            )
        )
    return found


def _savings(study: Study, language: str) -> list[str]:
    """Of each backend that predicate which saves most, and the errors that come with it."""
    cases = []
    times: dict[Series, list[float]] = {}
    held = {(p.series, p.row.place): p for p in study.points}
    for (series, place), point in held.items():
        exact = held.get((series._replace(predicate=EXACT), place))
        if series.predicate not in (None, EXACT) and exact is not None:
            times.setdefault(series, []).append(point.ns / exact.ns)
    for backend in dict.fromkeys(series.backend for series in times):
        own = {
            series: median(ratios) for series, ratios in times.items() if series.backend == backend
        }
        series = min(own, key=lambda s: own[s])
        points = [point for point in study.points if point.series == series]
        worst = max(points, key=_rate)
        if own[series] >= 1 or worst.errors == 0:
            continue
        case = _case(str(series.predicate), worst, language)
        ratio = words.times(own[series])
        cases.append(tell(language, "error_saving", name=backend, ratio=ratio, case=case))
    return [tell(language, "error_savings", cases=listed(cases, language))] if cases else []


def _libraries(study: Study, language: str) -> list[str]:
    """Each library's fastest by our fastest on the host, both exact, class by class."""
    ratios: dict[str, list[float]] = {}
    for name in study.classes:
        exact = [summary for summary in study.summaries(name) if summary.exact]
        ours = min((s.ns for s in exact if _host(s)), default=None)
        for lane in dict.fromkeys(s.series.lane for s in exact if s.series.predicate is None):
            theirs = min(s.ns for s in exact if s.series.lane == lane)
            if ours is not None:
                ratios.setdefault(lane, []).append(theirs / ours)
    cases = [
        tell(language, "error_library", name=lane, ratios=spanned(values, words.ratio, language))
        for lane, values in ratios.items()
    ]
    return [tell(language, "error_libraries_time", cases=listed(cases, language))] if cases else []


def _host(summary: Summary) -> bool:
    return summary.series.side == "backend"


def _depth(study: Study, language: str) -> list[str]:
    """The worst pair of each predicate that loses or invents some."""
    found = []
    for key, measure in (("depth_lost", "depth"), ("depth_invented", "gap")):
        worst: dict[str, Point] = {}
        for point in study.points:
            name = point.series.predicate or point.series.backend
            value = getattr(point, measure)
            if value is not None and (name not in worst or value > getattr(worst[name], measure)):
                worst[name] = point
        order = sorted(worst, key=lambda name: -getattr(worst[name], measure))
        cases = [
            tell(
                language,
                "depth_case",
                name=name,
                value=share(getattr(worst[name], measure)),
                scene=worst[name].row.place.scene,
            )
            for name in order
        ]
        if cases:
            found.append(tell(language, key, cases=listed(cases, language)))
    return found


def share(value: float) -> str:
    """Of the sum of the radii: '0.032 %', '3.1e-08', '110×'; of points, whose sum is 0, any gap
    is wide."""
    if value > 1e3:
        return "> 1000×"
    if value >= 1.0:
        return f"{words.number(value)}×"
    if value == 0.0:
        return "0"
    return f"{100 * value:.2g} %" if value >= 1e-4 else f"{value:.1e}"


def _map(study: Study, language: str) -> list[str]:
    """What should not be: a claim broken, an answer that does not repeat, a library's losses."""
    found = []
    ours = [p for p in study.points if p.series.predicate and p.claimed]
    broken = [point for point in ours if point.errors]
    if broken:
        found.append(tell(language, "error_broken", cases=_places(broken, language)))
    elif ours:
        places = len({point.row.place for point in ours})
        values = {"rows": len(ours), "scenes": scenes(places, language)}
        found.append(tell(language, "error_kept", **values))
    lost = [p for p in study.points if p.series.predicate is None and p.errors]
    if lost:
        found.append(tell(language, "error_libraries", cases=_places(lost, language)))
    if study.unsteady:
        found.append(tell(language, "error_unsteady", cases=_places(study.unsteady, language)))
    return found


def _places(points: list[Point], language: str) -> str:
    shown = [f"{p.series.label} {words.place(p.row.place)} ({words.losses(p.row)})" for p in points]
    more = len(shown) - _MOST
    if more > 0:
        shown = [*shown[:_MOST], tell(language, "error_more", count=more)]
    return listed(shown, language)
