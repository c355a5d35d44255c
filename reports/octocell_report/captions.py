# SPDX-License-Identifier: MIT
"""Captions with numbers in them; how to read a picture stands in texts.py alone."""

from collections.abc import Iterable

from octocell_report import front, words
from octocell_report.ablation import TARGET, regrets, unjudged
from octocell_report.check import Verdict
from octocell_report.error import Study
from octocell_report.load import Place, Result
from octocell_report.texts import Said, listed, say


def commit(result: Result) -> Said:
    state = "dirty" if result.context["dirty"] else "clean"
    return say(f"commit_{state}", commit=result.context["commit"][:12])


def first_scene(result: Result) -> list[Said]:
    """Time per sphere on the first scene: ours, and each library's by ours."""
    times = front.at_largest(front.best(result))
    if times.empty:
        return []
    by_ours = front.ratios(times).iloc[0].dropna().map(words.number)
    parts = [
        say(
            "best_by_ours" if who in by_ours else "best",
            **{"who": who, "ns": words.number(ns), "ratio": by_ours.get(who)},
        )
        for who, ns in times.iloc[0].dropna().items()
    ]
    return [listed([words.place(Place(*times.index[0])), *parts], "dot")]


def counts(result: Result, verdict: Verdict) -> list[Said]:
    """Rows by what became of them, and backends that could not run at all."""
    numbers = {
        **{"exact": verdict.exact, "wrong": len(verdict.wrong), "excused": verdict.excused},
        **{"controls": verdict.controls, "skipped": verdict.skipped},
    }
    reasons = [f"{backend} ({reason})" for backend, reason in result.absent.items()]
    absent = [say("absent", backends=listed(reasons))] if reasons else []
    return [say("counts", **numbers), *absent]


def ablation(result: Result) -> list[Said]:
    """Where it comes from, how often the plan is as good as asked, and what could not be judged."""
    found, left_out = origins([result]), unjudged(result)
    for backend, rows in regrets(result).groupby("backend", sort=False):
        worst = max(rows.itertuples(), key=lambda row: row.regret.median)
        numbers = {"name": backend, "scenes": len(rows), "target": f"{TARGET:.2f}"}
        numbers |= {"worst": words.ratio(worst.regret.median), "place": worst.title}
        found.append(say("regrets", within=(rows["verdict"] == "within").sum(), **numbers))
    return found + ([say("left_out", cases=listed(left_out))] if left_out else [])


def error(study: Study) -> list[Said]:
    return [*origins(study.results), claims(study)]


def origins(results: Iterable[Result]) -> list[Said]:
    """Of rows that have files of their own, maybe of several machines: where they come from."""
    found = []
    for result in results:
        context, gpu = result.context, [result.gpu.name] if result.gpu else []
        known = {"date": context["date"][:10], "rounds": context["rounds"]}
        machine = ", ".join([*gpu, context["machine"]["cpu"]])
        found.append(say("origin", machine=machine, commit=commit(result), **known))
        found += [] if context["finished"] else [say("origin_interrupted")]
    return found


def claims(study: Study) -> Said:
    """How many rows that claim to be exact are."""
    points = study.points
    claimed = points[points["claims_exact"] & points["predicate"].notna()]
    unsteady = (points["distinct_checksums"] > 1).sum()
    exact = (claimed["errors"] == 0).sum()
    return say("claims", exact=exact, rows=len(claimed), unsteady=unsteady)
