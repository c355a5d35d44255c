# SPDX-License-Identifier: MIT
"""Questions that several tables and plots ask of the frame."""

from typing import Any

import pandas as pd

from octocell_report import spread
from octocell_report.load import DEVICE_RUNS, RUNS, Place, Result
from octocell_report.plan import REBUILT

UPDATES = ("first_update", "update")
DYNAMIC = "dynamic"


def runs(result: Result) -> list[str]:
    """Which kinds of run at rest the result holds, of those that are no device's own."""
    held = set(result.frame["run"])
    return [run for run in RUNS if run in held and run not in (DYNAMIC, *DEVICE_RUNS)]


def families(result: Result) -> list[str]:
    """The libraries that the baselines come from, in table order."""
    rows = result.frame.sort_values("order")
    return list(rows.loc[rows["side"] == "baseline", "family"].unique())


def compared(result: Result, scene: str, run: str) -> Place | None:
    """The largest size at which most sides have an exact row: a device may go on alone.

    Without such rows the largest that there is; None without spheres.
    """
    rows = result.frame
    rows = rows[(rows["scene"] == scene) & (rows["run"] == run) & rows["counts"] & (rows["n"] > 0)]
    sides = rows.groupby("n")["side"].nunique()
    sizes = list(sides[sides == sides.max()].index)
    sizes = sizes or [g.n for g in result.groups if g.scene == scene and g.n > 0]
    return Place(scene, int(max(sizes))) if sizes else None


def searched_again(result: Result) -> dict[int, Any]:
    """By the index of a row: that of the same frames, each searched from nothing, where exact."""
    variants = result.variants_frame
    variants = variants[(variants["skips"] == REBUILT) & variants["counts"]]
    known = {(row.label, row.scene, row.n, row.motion): row for row in variants.itertuples()}
    keys = {
        row.Index: (row.label, row.scene, row.n, row.motion) for row in result.frame.itertuples()
    }
    return {index: known[key] for index, key in keys.items() if key in known}


def speedups(result: Result) -> pd.DataFrame:
    """Every exact row of ours against the fastest exact baseline of each library, by run.

    The columns of Result.frame for the row, the same with `_ref` for the baseline, and `ratios`,
    one per round: how many times as fast the row is. Our backends have no run of an update: they
    search again. So their warm rows, measured in the same rounds, stand beside the baselines'
    updates; `own_run` says so.
    """
    where = ["scene", "n", "run", "motion"]
    exact = result.frame[result.frame["counts"]].reset_index(names="row")
    exact["own_run"] = exact["run"]
    ours = exact[exact["kind"] == "backend"]
    again = [ours[ours["run"] == "warm"].assign(run=run) for run in UPDATES]
    theirs = exact[exact["kind"] == "baseline"].sort_values("median_ms", kind="stable")
    fastest = theirs.drop_duplicates([*where, "family"])
    found = pd.concat([ours, *again]).merge(fastest, on=where, suffixes=("", "_ref"))
    rounds = zip(found["round_ms_ref"], found["round_ms"], strict=True)
    found["ratios"] = pd.Series([spread.ratios(*pair) for pair in rounds], dtype=object)
    order = {"run": RUNS, "motion": [*found["motion"].unique()], "family_ref": families(result)}
    return found[found["ratios"].map(len) > 0].sort_values(
        ["run", "group", "motion", "family_ref", "row"],
        key=lambda keys: keys.map(order[keys.name].index) if keys.name in order else keys,
    )
