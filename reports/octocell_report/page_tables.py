# SPDX-License-Identifier: MIT
"""The page's tables: frames whose columns are named in texts.py, of values or Cells."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from statistics import median
from typing import Any

import pandas as pd

from octocell_report import ablation, front, tables, words
from octocell_report.error import MILLION, Study
from octocell_report.load import Result
from octocell_report.plan import PLANNED, REBUILT
from octocell_report.spread import Estimate, ratios
from octocell_report.texts import TEXTS, Said, listed, say

_KEYS = ["scene", "n", "label"]
_GPU_RUNS = ("warm", "cold_cache", "graph", "transfers", "cold")  # barest to fullest


@dataclass(frozen=True)
class Cell:
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
    below = front.ratios(times).map(lambda ratio: words.ratio(ratio) if ratio > 0 else "")
    shown = {
        who: [
            Cell(words.number(ns), ns, below.loc[place, who] if who in below else "")
            for place, ns in column.items()
        ]
        for who, column in times.items()
    }
    return pd.DataFrame(shown, index=times.index).reset_index()


def wrong(results: Iterable[Result]) -> pd.DataFrame:
    """What each row loses and invents, variants of the plan too: the worst of its runs."""
    frame = pd.concat([f for result in results for f in (result.frame, result.variants_frame)])
    frame = frame[frame["status"] == "wrong"]
    lost = frame[["missed", "false", "duplicates"]].fillna(0).sum(axis=1)
    kind = frame["negative_control"].map({True: "control", False: "wrong"})
    frame = frame.assign(
        lost=lost,
        share=100 * (frame["missed"] / frame["truth_pairs"]).astype(float),
        kind=kind.mask(frame["excused"].astype(bool), "excused"),
        label=[f"{r.label}, {r.skips}" if r.skips else r.label for r in frame.itertuples()],
    )
    worst = frame.sort_values("lost", ascending=False).drop_duplicates(_KEYS)
    found = worst.sort_index().sort_values("order", kind="stable")
    return found[["label", "kind", "scene", "n", "missed", "share", "false", "duplicates"]]


def skipped(result: Result) -> pd.DataFrame:
    """Rows that were skipped alike share a line."""
    frame = result.frame[result.frame["status"] == "skipped"]
    found = [
        {
            "label": label,
            "where": ", ".join(dict.fromkeys(map(words.place, rows[["scene", "n"]].itertuples()))),
            "runs": listed(say(f"run_{run}") for run in rows["run"].unique()),
            "why": reason,
        }
        for (label, reason), rows in frame.groupby(["label", "reason"], sort=False)
    ]
    return pd.DataFrame(found)


def unavailable(result: Result) -> pd.DataFrame:
    """Scenes that could not be loaded."""
    absent = [group for group in result.groups if group.unavailable is not None]
    return pd.DataFrame([{"scene": g.scene, "spec": g.spec, "why": g.unavailable} for g in absent])


def times(result: Result) -> pd.DataFrame:
    """All rows at rest: a line per implementation, scene and size."""
    frame = _in_order(result, result.frame["run"].isin(tables.runs(result)))
    if frame.empty:
        return frame
    more = ["ns_per_sphere", "candidates_per_pair", "uncertain_pairs"]
    warm = frame[frame["run"] == "warm"].drop_duplicates(_KEYS).set_index(_KEYS)
    return _by_run(frame, tables.runs(result), _time).join(warm[more]).reset_index()


def _in_order(result: Result, which: pd.Series[bool]) -> pd.DataFrame:
    """Those rows by scene, size and implementation."""
    scenes = {scene: place for place, scene in enumerate(result.scenes)}
    frame = result.frame.assign(rank=result.frame["scene"].map(scenes))
    return frame[which].sort_values(["rank", "n", "order"], kind="stable")


def _by_run(frame: pd.DataFrame, runs: Iterable[str], cell: Callable[[Any], Cell]) -> pd.DataFrame:
    """A column per run, filled by cell() of each row."""
    frame = frame.drop_duplicates([*_KEYS, "run"])
    shown = pd.Series(
        map(cell, frame.itertuples()), pd.MultiIndex.from_frame(frame[[*_KEYS, "run"]])
    )
    wide = shown.unstack("run").reindex(pd.MultiIndex.from_frame(frame[_KEYS].drop_duplicates()))
    return wide[[run for run in runs if run in wide]].rename(columns="run:{}".format)


def _time(row: Any) -> Cell:
    """A time that is not bare stands below its verdict."""
    if not row.ran:
        return Cell(say("skipped"))
    ms = words.number(row.median_ms)
    if row.counts:
        return Cell(ms, row.median_ms, words.spread(row.round_ms))
    lost = words.losses(row) if row.status == "wrong" else say("kind_control")
    return Cell(lost, small=f"({ms} ms)", bad=True)


def speedups(result: Result) -> pd.DataFrame:
    """Our planned rows (all of ours, if none is planned) against each library's fastest."""
    found = tables.speedups(result)
    planned = found["method"] == PLANNED
    found = found[planned] if planned.any() else found
    return _telling(
        found.assign(
            against=found["label_ref"],
            ratio=[Cell(words.ratio(median(r)), median(r), _range(r)) for r in found["ratios"]],
            rounds=found["ratios"].map(len),
        )[["scene", "n", "motion", "run", "label", "against", "ratio", "rounds"]]
    )


def _range(values: Sequence[float]) -> str:
    return f"{words.ratio(min(values))}{words.NONE}{words.ratio(max(values))}"


def steady_frames(result: Result) -> pd.DataFrame:
    """Rows with moving spheres, beside the same frames each searched from nothing."""
    frame, variants = result.frame, result.variants_frame
    frame = _in_order(result, (frame["run"] == tables.DYNAMIC) & frame["motion"].notna())
    first = result.motion_frames.query("frame == 0").set_index("row")["median_ms"]
    warmups = result.motion_frames.groupby("row")["warmup"].agg(["size", "sum"])
    again = {
        (row.label, row.scene, row.n, row.motion): row.round_ms
        for row in variants[variants["skips"] == REBUILT].itertuples()
        if row.counts
    }
    found = []
    for row in frame.itertuples():
        rounds = ratios(row.round_ms, again.get((row.label, row.scene, row.n, row.motion), ()))
        frames, warmup = warmups.loc[row.Index]
        found.append(
            {
                **{"scene": row.scene, "n": row.n, "motion": row.motion, "label": row.label},
                "steady": _time(row),
                "first": first[row.Index] if row.counts else None,
                "again": median(rounds) if rounds and row.counts else None,
                **{"frames": frames, "warmup": warmup},
            }
        )
    return _telling(pd.DataFrame(found))


def _telling(table: pd.DataFrame) -> pd.DataFrame:
    """Without empty columns, nor that of motions where every scene is called as its own."""
    if "motion" in table:
        table = table.assign(motion=table["motion"].mask(table["motion"] == table["scene"]))
    return table.dropna(axis="columns", how="all")


def gpu(result: Result) -> pd.DataFrame:
    """A device's runs side by side, each with its ratio to the warm one, and its memory."""
    frame = _in_order(result, (result.frame["side"] == "device") & result.frame["ran"])
    if frame.empty:
        return frame
    warm = {
        _key(row): row.round_ms for row in frame.itertuples() if row.run == "warm" and row.counts
    }

    def cell(row: Any) -> Cell:
        rounds = ratios(row.round_ms, warm.get(_key(row), ()))
        shown = row.run != "warm" and row.counts and rounds
        return replace(_time(row), small=words.ratio(median(rounds))) if shown else _time(row)

    needs = (frame["device_bytes"] / frame["n"]).groupby([frame[key] for key in _KEYS]).max()
    wide = _by_run(frame, _GPU_RUNS, cell)
    return wide.join(needs.astype(float).rename("device_bytes")).reset_index()


def _key(row: Any) -> tuple[str, int, str]:
    return row.scene, row.n, row.label


def regret(result: Result) -> pd.DataFrame:
    """The plan against the best forced choice."""
    found = ablation.regrets(result)
    found["choice"] = [
        say("same_plan", choice=row.choice) if row.same_plan else row.choice
        for row in found.itertuples()
    ]
    names = {"title": "scene", "planned_ms": "planned", "median_ms": "best"}
    shown = ["title", "backend", "planned_ms", "median_ms", "regret", "choice", "verdict"]
    return found[shown].rename(columns=names)


def costs(study: Study) -> pd.DataFrame:
    """Exact by float32, scene by scene."""
    return _with_place(study.costs).rename(columns={"deciding_stages": "deciding"})


def rounding(study: Study) -> pd.DataFrame:
    """Pairs that the input's rounding to float32 changed."""
    found = _with_place(study.rounding).rename(columns={"true_pairs": "pairs"})
    if not found.empty:
        found["changed"] = MILLION * (found["lost"] + found["gained"]) / found["pairs"].clip(1)
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


def english(table: pd.DataFrame) -> pd.DataFrame:
    """Its texts in one language alone; what stands below a text comes behind it, in brackets."""
    names = [heading(name).en for name in table.columns]
    return pd.DataFrame([list(map(_english, line)) for line in cells(table)], columns=names)


def _english(cell: Cell) -> str:
    text = cell.text.en if isinstance(cell.text, Said) else cell.text
    return f"{text} ({cell.small})" if cell.small else text


def cells(table: pd.DataFrame) -> list[list[Cell]]:
    """What is shown of a frame, line by line."""
    lines = table.astype(object).itertuples(index=False, name=None)
    return [list(map(_cell, table.columns, line)) for line in lines]


def _cell(column: str, value: Any) -> Cell:
    if isinstance(value, Cell):
        return value
    if isinstance(value, Estimate):
        low, high = words.times(value.low), words.times(value.high)
        return Cell(words.times(value.median), value.median, f"{low}{words.NONE}{high}")
    if isinstance(value, str | Said):
        return Cell(_FORMATS[column](value) if column in _FORMATS else value)
    if value is None or pd.isna(value):
        return Cell(words.NONE)
    show = _FORMATS.get(column, words.grouped if isinstance(value, int) else words.number)
    return Cell(show(value), float(value))
