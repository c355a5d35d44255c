# SPDX-License-Identifier: MIT
"""Captions with numbers in them; how to read a picture stands in texts.py alone."""

from __future__ import annotations

from collections.abc import Iterable

import pandas as pd

from octocell_report import front, words
from octocell_report.ablation import TARGET, regrets, unjudged
from octocell_report.check import Verdict
from octocell_report.error import Study
from octocell_report.load import Place, Result
from octocell_report.texts import Said, listed, say


def facts(result: Result) -> dict[str, Said | str]:
    """Where the numbers come from."""
    context, gpu = result.context, result.gpu
    machine = context["machine"]
    memory = f"{machine['memory_bytes'] / 1e9:.1f}"
    known = {
        "machine": say("machine", **machine | {"memory": memory}),
        "gpu": say("gpu", name=gpu.name, copied=words.grouped(gpu.copy_gbps)) if gpu else "",
        "date": context["date"],
        "commit": commit(result),
        "run": say("run", preset=context["preset"], rounds=context["rounds"]),
        "compiler": ", ".join(context[key] for key in ("compiler", "build_type", "flags")),
        "instruction_set": context["instruction_set"],
        "libraries": ", ".join(f"{name} {known}" for name, known in context["libraries"].items()),
    }
    return {name: fact for name, fact in known.items() if fact}


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
    found = [
        say(
            "counts",
            **{"exact": verdict.exact, "wrong": len(verdict.wrong)},
            **{"excused": verdict.excused, "controls": verdict.controls},
            skipped=verdict.skipped,
        )
    ]
    reasons = [f"{backend} ({reason})" for backend, reason in result.absent.items()]
    return found + ([say("absent", backends=listed(reasons))] if reasons else [])


def origins(results: Iterable[Result]) -> list[Said]:
    """Of rows that have files of their own, maybe of several machines: where they come from."""
    found = []
    for result in results:
        context = result.context
        machine = context["machine"]["cpu"]
        origin = say(
            "origin",
            machine=f"{result.gpu.name}, {machine}" if result.gpu else machine,
            **{"date": context["date"][:10], "rounds": context["rounds"]},
            commit=commit(result),
        )
        found += [origin, *([] if context["finished"] else [say("origin_interrupted")])]
    return found


def commit(result: Result) -> Said:
    state = "dirty" if result.context["dirty"] else "clean"
    return say(f"commit_{state}", commit=result.context["commit"][:12])


def ablation(result: Result) -> list[Said]:
    """Where it comes from, how often the plan is as good as asked, and what could not be judged."""
    left_out, found = unjudged(result), regrets(result)
    backends = result.variants_frame["backend"].unique()
    return [
        *origins([result]),
        *(_regret(backend, found[found["backend"] == backend]) for backend in backends),
        *([say("left_out", cases=listed(left_out))] if left_out else []),
    ]


def _regret(backend: str, found: pd.DataFrame) -> Said:
    if found.empty:
        return say("regrets_none", name=backend)
    worst = max(found.itertuples(), key=lambda row: row.regret.median)
    return say(
        "regrets",
        **{"name": backend, "scenes": len(found), "target": f"{TARGET:.2f}"},
        within=(found["verdict"] == "within").sum(),
        **{"worst": words.ratio(worst.regret.median), "place": worst.title},
    )


def claims(study: Study) -> Said:
    """How many rows that claim to be exact are."""
    points = study.points
    claimed = points[points["claims_exact"] & points["predicate"].notna()]
    unsteady = (points["distinct_checksums"] > 1).sum()
    exact = (claimed["errors"] == 0).sum()
    return say("claims", exact=exact, rows=len(claimed), unsteady=unsteady)
