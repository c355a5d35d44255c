# SPDX-License-Identifier: MIT
"""Two results side by side: which rows became faster or slower, beyond what the rounds scatter.

Rounds of two files have nothing to do with each other, so times are compared, not ratios: the new
median by the old one. How far that may be off is told by bootstrap: rounds are drawn again, with
replacement, from each file by itself, and the middle 99 % of the ratios so found are the interval.
A row is slower if the whole interval lies above 1 + threshold, faster if below its inverse.
With five rounds or fewer the interval is all but the range of the rounds, and with fewer than three
there is none: such rows are never called faster or slower.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from octocell_report import words
from octocell_report.load import Result
from octocell_report.spread import LEAST_ROUNDS, SHARE, drawn_medians, middle

# What the rows of both files may be called, and how the summary counts them.
TIMED = {
    "slower": "slower",
    "faster": "faster",
    "same": "within the noise",
    "unknown": "not judged",
}


def compare(old: Result, new: Result, threshold: float) -> pd.DataFrame:
    """A line per row that both have, by name: the columns of both frames (_old, _new), `verdict`,
    and ratio, low, high of those timed: new median / old median, above 1 is slower.

    Other verdicts: 'other scene' (the true pairs differ), 'changed' (one of them has no bare time,
    and they differ), 'alike'.
    """
    both = old.frame.merge(new.frame, on="name", suffixes=("_old", "_new"))

    def alike(column: str) -> pd.Series:
        return both[f"{column}_old"].astype(str) == both[f"{column}_new"].astype(str)

    scene = alike("truth_pairs") & alike("truth_checksum")
    times = both[["median_ms_old", "median_ms_new"]]
    timed = scene & both["counts_old"] & both["counts_new"] & (times > 0).all(axis=1)
    rounds = zip(timed, both["round_ms_old"], both["round_ms_new"], strict=True)
    spans = [interval(*pair) if fits else (np.nan, np.nan) for fits, *pair in rounds]
    both = both.join(pd.DataFrame(spans, both.index, ["low", "high"], "float64"))
    both["ratio"] = (times["median_ms_new"] / times["median_ms_old"]).where(timed)
    few = both[["rounds_old", "rounds_new"]].min(axis=1) < LEAST_ROUNDS
    both["verdict"] = np.select(
        [
            *(~scene, ~timed & alike("status") & alike("negative_control"), ~timed, few),
            *(both["low"] > 1 + threshold, both["high"] < 1 / (1 + threshold)),
        ],
        ["other scene", "alike", "changed", "unknown", "slower", "faster"],
        "same",
    )
    return both


def interval(old: tuple[float, ...], new: tuple[float, ...]) -> tuple[float, float]:
    """Of new median / old median; the same for the same times, as its random numbers are fixed."""
    random = np.random.default_rng(1)
    below, above = (drawn_medians(times, random) for times in (old, new))
    # A round of no time at all may be drawn; the ratio is then beyond all bounds, as it should be.
    with np.errstate(divide="ignore", invalid="ignore"):
        return middle(above / below)


_MACHINE = ("cpu", "cores", "memory_bytes", "os", "name")
_BUILD = ("compiler", "flags", "instruction_set", "build_type", "libraries", "gpu")


def warnings(old: Result, new: Result) -> list[str]:
    """Why a difference may not be the code's."""
    known = [result.context | result.context["machine"] for result in (old, new)]
    found = [
        f"other {key}: {' / '.join(_shown(context.get(key)) for context in known)}"
        for key in (*_MACHINE, *_BUILD)
        if known[0].get(key) != known[1].get(key)
    ]
    for name, context in zip(("old", "new"), known, strict=True):
        if context["dirty"]:
            found.append(f"the {name} result was built from changed sources")
        if not context["finished"]:
            found.append(f"the {name} run was interrupted")
    return found


def _shown(known: Any) -> str:
    if isinstance(known, dict):
        return ", ".join(f"{name} {value}" for name, value in known.items())
    return "none" if known is None else str(known)


def report(old: Result, new: Result, threshold: float) -> tuple[list[str], bool]:
    """Lines of text, and whether a row became slower."""
    both = compare(old, new, threshold)
    origins = (f"{r.context['commit'][:12]} ({r.context['date'][:10]})" for r in (old, new))
    lines = [f"warning: {text}" for text in warnings(old, new)]
    lines += [
        "old {}, new {}; ratio: new median / old median".format(*origins),
        f"slower: the {SHARE} % interval (bootstrap over rounds) lies above {1 + threshold:.3g}; "
        f"faster: below {1 / (1 + threshold):.3g}; "
        f"rows with fewer than {LEAST_ROUNDS} rounds are not judged",
    ]
    for verdict in ("slower", "faster"):
        rows = both[both["verdict"] == verdict]
        lines += ["", f"{verdict}: {len(rows) or 'none'}", *_table(rows)]
    rows_of = [{r.name: r for r in result.frame.itertuples()} for result in (old, new)]
    changed = both.loc[both["verdict"] == "changed", "name"]
    told = [f"{name}: {' -> '.join(_word(rows[name]) for rows in rows_of)}" for name in changed]
    other = both.loc[both["verdict"] == "other scene", "name"]
    lines += _listed("changed verdict", told)
    lines += _listed("other scene (true pairs differ, not compared)", other)
    for age, here in zip(("old", "new"), rows_of, strict=True):
        lines += _listed(f"only in the {age} file", [n for n in here if n not in set(both["name"])])
    return [*lines, "", *_summary(both)], bool((both["verdict"] == "slower").any())


def _listed(title: str, lines: Sequence[str]) -> list[str]:
    return ["", f"{title}: {len(lines)}", *(f"  {line}" for line in lines)] if len(lines) else []


def _word(row: Any) -> str:
    """Its status, and what there is to say of it."""
    if row.status == "skipped":
        return f"skipped ({words.short_reason(row.reason, 40)})"
    return words.verdict(row) if row.status == "wrong" or row.negative_control else "exact"


def _table(rows: pd.DataFrame) -> list[str]:
    """The largest change first."""
    if rows.empty:
        return []
    rows = rows.loc[np.log(rows["ratio"]).abs().sort_values(ascending=False, kind="stable").index]
    spans = rows["low"].map("{:.3f} .. ".format) + rows["high"].map("{:.3f}".format)
    numbers = {"ratio": rows["ratio"].map("{:.3f}".format), " interval": spans}
    for age in ("old", "new"):
        numbers[f" {age} ms"] = rows[f"median_ms_{age}"].map(words.number)
    lines = pd.DataFrame(numbers).to_string(index=False).splitlines()
    names = ["row", *rows["name"].str.removeprefix("find_pairs/")]
    return [f"  {line}  {name}" for line, name in zip(lines, names, strict=True)]


def _summary(both: pd.DataFrame) -> list[str]:
    """Counts, and how the baselines moved: their code is not ours, so it is the machine's drift."""
    counts = [f"{(both['verdict'] == verdict).sum()} {word}" for verdict, word in TIMED.items()]
    lines = [f"{both['ratio'].count()} rows compared: {', '.join(counts)}"]
    for kind, title in (("backend", "ours"), ("baseline", "baselines, as a measure of drift")):
        ratios = both.loc[both["kind_new"] == kind, "ratio"].dropna()
        if len(ratios):
            lines.append(f"{title}: median ratio {ratios.median():.3f} of {len(ratios)} rows")
    return lines
