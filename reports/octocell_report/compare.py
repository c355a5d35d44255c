# SPDX-License-Identifier: MIT
"""Two results side by side: which rows became faster or slower, beyond what the rounds scatter.

Rounds of two files have nothing to do with each other, so times are compared, not ratios: the new
median by the old one. How far that may be off is told by bootstrap: rounds are drawn again, with
replacement, from each file by itself, and the middle 99 % of the ratios so found are the interval.
A row is slower if the whole interval lies above 1 + threshold, faster if below its inverse.
With five rounds or fewer the interval is all but the range of the rounds, and with fewer than three
there is none: such rows are never called faster or slower.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from octocell_report import words
from octocell_report.load import Result
from octocell_report.spread import LEAST_ROUNDS, SHARE, drawn_medians, middle

TIMED = ("slower", "faster", "within the noise", "not judged")  # verdicts; too few rounds: the last


def compare(old: Result, new: Result, threshold: float) -> pd.DataFrame:
    """A line per row that both have, by name: the columns of both frames (_old, _new), `verdict`,
    and of those timed ratio (new median / old median), low, high.

    Verdicts without a time: other scene (the true pairs differ), changed (in what they are), alike.
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
        ["other scene", "alike", "changed", "not judged", "slower", "faster"],
        "within the noise",
    )
    return both


def interval(old: tuple[float, ...], new: tuple[float, ...]) -> tuple[float, float]:
    """Of new median / old median; the same for the same times, as its random numbers are fixed."""
    random = np.random.default_rng(1)
    below, above = (drawn_medians(times, random) for times in (old, new))
    # A round of no time at all may be drawn; the ratio is then beyond all bounds, as it should be.
    with np.errstate(divide="ignore", invalid="ignore"):
        return middle(above / below)


_SAME = ("machine.", "libraries.", "gpu.name", "compiler", "flags", "instruction_set", "build_type")


def _flat(value: Any, name: str = "") -> dict[str, Any]:
    """Nested objects as one, by names joined with dots; values, huge integers too, as they are."""
    if not isinstance(value, dict):
        return {name: value}
    return {
        path: leaf
        for key, inner in value.items()
        for path, leaf in _flat(inner, f"{name}.{key}" if name else key).items()
    }


def warnings(old: Result, new: Result) -> list[str]:
    """Why a difference may not be the code's."""
    before, after = (_flat(result.context) for result in (old, new))
    found = [
        f"other {key.replace('.', ' ')}: {before.get(key)} / {after.get(key)}"
        for key in sorted(dict.fromkeys([*before, *after]), key=lambda key: key.count("."))
        if key.startswith(_SAME) and before.get(key) != after.get(key)
    ]
    for age, context in (("old", before), ("new", after)):
        if context["dirty"]:
            found.append(f"the {age} result was built from changed sources")
        if not context["finished"]:
            found.append(f"the {age} run was interrupted")
    return found


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
    by = {
        verdict: both[both["verdict"] == verdict] for verdict in (*TIMED, "changed", "other scene")
    }
    for verdict in TIMED[:2]:
        lines += ["", f"{verdict}: {len(by[verdict]) or 'none'}", *_table(by[verdict])]
    rows = [{row.name: row for row in result.frame.itertuples()} for result in (old, new)]
    told = [
        f"{name}: {_word(rows[0][name])} -> {_word(rows[1][name])}"
        for name in by["changed"]["name"]
    ]
    lines += _listed("changed verdict", told)
    lines += _listed("other scene (true pairs differ, not compared)", by["other scene"]["name"])
    for age, here, there in (("old", *rows), ("new", *reversed(rows))):
        lines += _listed(f"only in the {age} file", [name for name in here if name not in there])
    counts = ", ".join(f"{len(by[verdict])} {verdict}" for verdict in TIMED)
    lines += ["", f"{both['ratio'].count()} rows compared: {counts}", *_drift(both)]
    return lines, len(by["slower"]) > 0


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


def _drift(both: pd.DataFrame) -> list[str]:
    """How the rows of each kind moved: baselines' code is not ours, so theirs is the machine's."""
    kinds = {"backend": "ours", "baseline": "baselines, as a measure of drift"}
    return [
        f"{kinds[kind]}: median ratio {ratios.median():.3f} of {len(ratios)} rows"
        for kind, ratios in both.dropna(subset="ratio").groupby("kind_new")["ratio"]
    ]
