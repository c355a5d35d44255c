# SPDX-License-Identifier: MIT
"""What each skip is worth, and how far the plan is from the best that could have been chosen.

A study is one backend on one scene: its planned row, the variants of that row, and the methods that
can be forced. All were measured in the same rounds, so that ratios are taken within rounds.
"""

from pathlib import Path
from typing import Any

import pandas as pd

from octocell_report import tables, words
from octocell_report.fields import ReportError
from octocell_report.load import Place, Result
from octocell_report.load import load as load_bench
from octocell_report.plan import NOTHING, PLANNED
from octocell_report.spread import Estimate, estimate, ratios

TARGET = 1.10  # planned time by the best forced choice's: what the planner is asked to stay below
WORTH_TELLING = 0.02  # a step that changes less of the time with nothing skipped is not named

_KEYS = ["backend", "threads", "scene", "n", "run", "motion"]  # of a study


def load(path: Path) -> Result:
    """Reads one result. Throws ReportError if it is no ablation."""
    result = load_bench(path)
    if result.variants_frame.empty:
        raise ReportError(
            f"{path}: has no planned row with skips forbidden; "
            "octocell bench --preset ablation makes them"
        )
    return result


def choices(result: Result) -> pd.DataFrame:
    """A line per planned row, variant and forced method, by backend; the columns of Result.frame,
    study title   its number; the scene, and of the rest what is not the rule
    planned       the study's planned row as a named tuple; None if it is not exact
    timed         exact, so that its time counts
    choice        what was forced: 'home_phantom chapter32', or a variant's name
    by_planned    Estimate: its time by the planned time; None unless both are exact
    """
    variants, rows = result.variants_frame, result.frame
    rows = rows[rows["kind"] == "backend"].merge(variants[_KEYS].drop_duplicates())
    every = pd.concat([variants, rows], ignore_index=True)
    every = every.assign(
        study=every.groupby(_KEYS, sort=False, dropna=False).ngroup(),
        backend_at=pd.factorize(every["backend"])[0],
        title=list(map(_title, every.itertuples())),
        timed=every["counts"] & (every["median_ms"] > 0) & (every["n"] > 0),
        choice=every["skips"].fillna(every["method"] + (" " + every["rule"]).fillna("")),
    ).sort_values(["backend_at", "study"], kind="stable")
    is_planned = every["skips"].isna() & (every["method"] == PLANNED) & every["timed"]
    planned = {row.study: row for row in every[is_planned].itertuples()}
    every["planned"] = [planned.get(study) for study in every["study"]]
    every["by_planned"] = [
        _ratio(row.round_ms, row.planned.round_ms) if row.planned and row.timed else None
        for row in every.itertuples()
    ]
    return every


def _title(row: Any) -> str:
    parts = [words.place(Place(row.scene, row.n))]
    parts += [words.run(row.run)] if row.run not in ("warm", tables.DYNAMIC) else []
    parts += [row.motion] if row.motion not in (None, row.scene) else []
    return ", ".join(parts) + (f" ({row.threads} threads)" if row.threads != 1 else "")


def _ratio(above: tuple[float, ...], below: tuple[float, ...]) -> Estimate | None:
    rounds = ratios(above, below)
    return estimate(rounds) if rounds else None


def unjudged(result: Result) -> list[str]:
    """Studies without an exact planned row to compare others with."""
    rows = choices(result)
    return list((rows["backend"] + " " + rows["title"])[rows["planned"].isna()].unique())


def effects(result: Result) -> pd.DataFrame:
    """The choices that forbid one skip, where they can be compared with the planned row; and
    skip          that is forbidden
    taken         by the plan; else the scene does not need it, and nothing should change
    """
    rows = choices(result).dropna(subset="planned")
    rows = rows.assign(skip=rows["skips"].str.extract(r"^no_(\w+)$", expand=False))
    rows = rows.dropna(subset="skip")
    return rows.assign(taken=[_takes(row.planned, row.skip) for row in rows.itertuples()])


def _takes(row: Any, skip: str) -> bool:
    return row.plan is not None and skip in row.plan.skips


def steps(result: Result) -> pd.DataFrame:
    """Skips allowed one after the other, where nothing skipped and the plan have times; and
    skip taken    allowed last; by the plan that this row came to
    start before after   ns per sphere with nothing skipped; of the last step that has a time;
                  of this step, NaN if it is not exact
    change        after less before, 0 without a time
    kind          saved | lost | joint (the step before has no time, so this one holds what both
                  change) | noise (the interval holds 0, or too few rounds)
    told          worth naming
    """
    rows = choices(result).dropna(subset="planned")
    rows[["step", "skip"]] = rows["skips"].str.extract(r"^first_(\d+)_(\w+)$")
    rows["step"] = rows["step"].astype(float).mask(rows["skips"] == NOTHING, 0)
    rows = rows.dropna(subset="step").sort_values(["backend_at", "study", "step"])
    after = rows["ns_per_sphere"].where(rows["timed"])
    known = pd.DataFrame({"before": after, "rounds": rows["round_ms"].where(rows["timed"])})
    study = rows["study"]
    before = known.groupby(study).ffill().groupby(study).shift()
    rows = rows.assign(
        **before,
        after=after,
        start=after.groupby(study).transform("first"),
        joint=~rows["timed"].groupby(study).shift(fill_value=True),
        change=(after - before["before"]).fillna(0.0),
    )
    starts = rows[(rows["step"] == 0) & rows["timed"]]["study"]
    rows = rows[rows["study"].isin(starts) & (rows["step"] > 0)]
    rows["kind"] = list(map(_kind, rows.itertuples()))
    told = (rows["kind"] != "noise") & (rows["change"].abs() >= WORTH_TELLING * rows["start"])
    return rows.assign(told=told, taken=[_takes(row, row.skip) for row in rows.itertuples()])


def _kind(row: Any) -> str:
    if not row.timed:
        return "noise"
    saved = estimate(tuple(a - b for a, b in zip(row.rounds, row.round_ms, strict=False)))
    if not (saved.above(0.0) or saved.below(0.0)):
        return "noise"
    if row.joint:
        return "joint"
    return "saved" if saved.median > 0 else "lost"


def regrets(result: Result) -> pd.DataFrame:
    """The fastest of the choices other than the plan, by study; the best is found after the fact.
    choices       how many there were
    planned_ms regret   the planned time; Estimate: that by its time
    same_plan     it came to the same plan: what lies between the two is chance, or a test's cost
    verdict       within | above | unclear (the interval holds the target) | unknown (too few
                  rounds)
    """
    rows = choices(result).dropna(subset="planned")
    rows = rows[rows["timed"] & (rows["skips"].notna() | (rows["method"] != PLANNED))]
    by = rows.groupby("study", sort=False)["median_ms"]
    best = rows.assign(choices=by.transform("size")).loc[by.idxmin()]
    best["regret"] = [_ratio(row.planned.round_ms, row.round_ms) for row in best.itertuples()]
    best["same_plan"] = [
        row.plan is not None and row.plan == row.planned.plan for row in best.itertuples()
    ]
    planned_ms = [row.planned.median_ms for row in best.itertuples()]
    return best.assign(planned_ms=planned_ms, verdict=best["regret"].map(_verdict))


def _verdict(ratio: Estimate) -> str:
    if not ratio.judged:
        return "unknown"
    if ratio.low > TARGET:
        return "above"
    return "within" if ratio.high <= TARGET else "unclear"
