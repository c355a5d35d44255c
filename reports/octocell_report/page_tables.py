# SPDX-License-Identifier: MIT
"""The page's tables: frames whose columns are named in texts.py, and how their values are shown."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from statistics import median
from typing import Any, NamedTuple

import pandas as pd

from octocell_report import ablation, front, tables, words
from octocell_report.error import MILLION, Study
from octocell_report.load import Result
from octocell_report.plan import PLANNED
from octocell_report.spread import Estimate, ratios
from octocell_report.texts import TEXTS, Said, listed, say

_KEYS = ["scene", "n", "label"]
_GPU_RUNS = ("warm", "cold_cache", "graph", "transfers", "cold")  # barest to fullest


class Cell(NamedTuple):
    text: str | Said
    value: float | None = None  # what it is sorted by, if not by its text
    small: str = ""  # below the text
    bad: bool = False


def all_tables(
    result: Result, ablated: Result | None = None, study: Study | None = None
) -> dict[str, pd.DataFrame]:
    """By name; those with a line in them."""
    every = {
        "best": best(result),
        "wrong": wrong([result, *([ablated] if ablated else [])]),
        "skipped": skipped(result),
        "unavailable": unavailable(result),
        "times": times(result),
        "speedups": speedups(result),
        "frames": steady_frames(result),
        "gpu": gpu(result),
        "regret": regret(ablated) if ablated else pd.DataFrame(),
        "costs": costs(study) if study else pd.DataFrame(),
        "rounding": rounding(study) if study else pd.DataFrame(),
    }
    return {name: table for name, table in every.items() if not table.empty}


def best(result: Result) -> pd.DataFrame:
    """Our planned rows and each library's fastest at the largest size of each scene."""
    times = front.at_largest(front.best(result))
    for who, by_ours in front.ratios(times).items():
        pairs = zip(times[who], by_ours, strict=True)
        times[who] = [
            Cell(words.number(ns), ns, words.ratio(r)) if r > 0 else ns for ns, r in pairs
        ]
    return times.reset_index()


def wrong(results: Iterable[Result]) -> pd.DataFrame:
    """What each row loses and invents, variants of the plan too: the worst of its runs."""
    frame = pd.concat([f for result in results for f in (result.frame, result.variants_frame)])
    frame = frame[frame["status"] == "wrong"]
    kinds = zip(frame["negative_control"], frame["excused"], strict=True)
    frame = frame.assign(
        share=100 * (frame["missed"] / frame["truth_pairs"]).astype(float),
        kind=[
            "control" if control else "excused" if known else "wrong" for control, known in kinds
        ],
        label=[f"{r.label}, {r.skips}" if r.skips else r.label for r in frame.itertuples()],
    )
    worst = frame.sort_values("errors", ascending=False).drop_duplicates(_KEYS)
    found = worst.sort_index().sort_values("order", kind="stable")
    return found[["label", "kind", "scene", "n", "missed", "share", "false", "duplicates"]]


def skipped(result: Result) -> pd.DataFrame:
    """Rows that were skipped alike share a line."""
    frame = result.frame[~result.frame["ran"]]
    frame = frame.assign(where=list(map(words.place, frame.itertuples())))
    alike = frame.groupby(["label", "reason"], sort=False)
    found = alike.agg(where=("where", lambda where: ", ".join(where.unique())), runs=("run", _runs))
    return found.reset_index()[["label", "where", "runs", "reason"]]


def _runs(runs: pd.Series[str]) -> Said:
    return listed(say(f"run_{run}") for run in runs.unique())


def unavailable(result: Result) -> pd.DataFrame:
    """Scenes that could not be loaded."""
    absent = [group for group in result.groups if group.unavailable is not None]
    return pd.DataFrame({"scene": g.scene, "spec": g.spec, "reason": g.unavailable} for g in absent)


def times(result: Result) -> pd.DataFrame:
    """All rows at rest: a line per implementation, scene and size."""
    runs = tables.runs(result)
    frame = _in_order(result, result.frame["run"].isin(runs))
    frame = frame.assign(time=list(map(_time, frame.itertuples())))
    more = ["ns_per_sphere", "candidates_per_pair", "uncertain_pairs"]
    warm = frame[frame["run"] == "warm"].drop_duplicates(_KEYS).set_index(_KEYS)
    return _by_run(frame, runs).join(warm[more]).reset_index()


def gpu(result: Result) -> pd.DataFrame:
    """A device's runs side by side, each with its ratio to the warm one, and its memory."""
    frame = _in_order(result, (result.frame["side"] == "device") & result.frame["ran"])
    warm = frame[(frame["run"] == "warm") & frame["counts"]].set_index(_KEYS)["round_ms"].to_dict()

    def cell(row: Any) -> Cell:
        rounds = ratios(row.round_ms, warm.get((row.scene, row.n, row.label), ()))
        shown = row.run != "warm" and row.counts and rounds
        return _time(row)._replace(small=words.ratio(median(rounds))) if shown else _time(row)

    frame = frame.assign(
        time=list(map(cell, frame.itertuples())),
        device_bytes=frame["device_bytes"].astype(float) / frame["n"],
    )
    return _by_run(frame, _GPU_RUNS).join(frame.groupby(_KEYS)["device_bytes"].max()).reset_index()


def _in_order(result: Result, which: pd.Series[bool]) -> pd.DataFrame:
    """Those rows by scene, size and implementation."""
    rank = result.frame["scene"].map(result.scenes.index)
    return result.frame.assign(rank=rank)[which].sort_values(["rank", "n", "order"], kind="stable")


def _by_run(frame: pd.DataFrame, runs: Iterable[str]) -> pd.DataFrame:
    """A column of times per run."""
    frame = frame.drop_duplicates([*_KEYS, "run"])
    lines = pd.MultiIndex.from_frame(frame[_KEYS].drop_duplicates())
    wide = frame.pivot(index=_KEYS, columns="run", values="time").reindex(lines)
    return wide[[run for run in runs if run in wide]].rename(columns="run:{}".format)


def _telling(table: pd.DataFrame) -> pd.DataFrame:
    """Without empty columns, nor that of motions where every scene is called as its own."""
    if "motion" in table:
        table = table.assign(motion=table["motion"].mask(table["motion"] == table["scene"]))
    return table.dropna(axis="columns", how="all")


def _time(row: Any) -> Cell:
    """A time that is not bare stands below its verdict."""
    if not row.ran:
        return Cell(say("skipped"))
    if row.counts:
        return _over_rounds(row.round_ms, words.number)
    lost = words.losses(row) if row.status == "wrong" else say("kind_control")
    return Cell(lost, small=f"({words.number(row.median_ms)} ms)", bad=True)


def _over_rounds(values: tuple[float, ...], show: Callable[[float], str]) -> Cell:
    middle, low, high = median(values), show(min(values)), show(max(values))
    return Cell(show(middle), middle, f"{low}{words.NONE}{high}")


def speedups(result: Result) -> pd.DataFrame:
    """Our planned rows (all of ours, if none is planned) against each library's fastest."""
    found = tables.speedups(result)
    planned = found["method"] == PLANNED
    found = found[planned] if planned.any() else found
    found = found.assign(rounds=found["ratios"].map(len))
    return _telling(
        found[["scene", "n", "motion", "run", "label", "label_ref", "ratios", "rounds"]]
    )


def steady_frames(result: Result) -> pd.DataFrame:
    """Rows with moving spheres, beside the same frames each searched from nothing."""
    again = tables.searched_again(result)
    frame = _in_order(result, result.frame["motion"].notna())
    by_row = result.motion_frames.groupby("row")

    def by_again(row: Any) -> float | None:
        rounds = ratios(row.round_ms, again[row.Index].round_ms) if row.Index in again else ()
        return median(rounds) if rounds else None

    frame = frame.assign(
        steady=list(map(_time, frame.itertuples())),
        first=by_row["median_ms"].first(),
        again=list(map(by_again, frame.itertuples())),
        **{"frames": by_row.size(), "warmup": by_row["warmup"].sum()},
    )
    frame[["first", "again"]] = frame[["first", "again"]].where(frame["counts"])
    shown = ["scene", "n", "motion", "label", "steady", "first", "again", "frames", "warmup"]
    return _telling(frame[shown])


def regret(result: Result) -> pd.DataFrame:
    """The plan against the best forced choice."""
    found = ablation.regrets(result)
    found["choice"] = [
        say("same_plan", choice=row.choice) if row.same_plan else row.choice
        for row in found.itertuples()
    ]
    return found[["title", "backend", "planned_ms", "median_ms", "regret", "choice", "verdict"]]


def costs(study: Study) -> pd.DataFrame:
    """Exact by float32, scene by scene."""
    return _with_place(study.costs)


def rounding(study: Study) -> pd.DataFrame:
    """Pairs that the input's rounding to float32 changed."""
    found = _with_place(study.rounding)
    if not found.empty:
        changed = MILLION * (found["lost"] + found["gained"])
        found["changed"] = changed / found["true_pairs"].clip(1)
    return found


def _with_place(table: pd.DataFrame) -> pd.DataFrame:
    """Scene and size in one column."""
    return table.assign(scene=list(map(words.place, table.itertuples()))).drop(
        columns="n", errors="ignore"
    )


_FORMATS: dict[str, Callable[[Any], str | Said]] = {
    "n": words.size,
    "again": words.times,
    "changed": words.rate,
    "run": lambda run: say(f"run_{run}"),
    "kind": lambda kind: say(f"kind_{kind}"),
    "verdict": lambda verdict: say(f"verdict_{verdict}"),
}


def heading(column: str) -> Said:
    """Of a text, of a run, or the column's name itself: that of a contender."""
    if column.startswith("run:"):
        return say("column_ms", run=say(f"run_{column[4:]}"))
    return say(f"column_{column}") if f"column_{column}" in TEXTS else Said(column, column)


def cells(table: pd.DataFrame) -> list[list[Cell]]:
    """What is shown of a frame, line by line."""
    lines = table.astype(object).itertuples(index=False, name=None)
    return [list(map(_cell, table.columns, line)) for line in lines]


def _cell(column: str, value: Any) -> Cell:
    match value:
        case Cell():
            return value
        case Said():
            return Cell(value)
        case Estimate():
            low, high = words.times(value.low), words.times(value.high)
            return Cell(words.times(value.median), value.median, f"{low}{words.NONE}{high}")
        case tuple():
            return _over_rounds(value, words.ratio)
        case str():
            return Cell(_FORMATS[column](value) if column in _FORMATS else value)
    if pd.isna(value):
        return Cell(words.NONE)
    show = _FORMATS.get(column, words.grouped if isinstance(value, int) else words.number)
    return Cell(show(value), float(value))


def english(table: pd.DataFrame) -> pd.DataFrame:
    """Its texts in one language alone; what stands below a text comes behind it, in brackets."""
    names = [heading(name).en for name in table.columns]
    return pd.DataFrame([list(map(_english, line)) for line in cells(table)], columns=names)


def _english(cell: Cell) -> str:
    text = cell.text.en if isinstance(cell.text, Said) else cell.text
    return f"{text} ({cell.small})" if cell.small else text
