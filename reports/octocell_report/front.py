# SPDX-License-Identifier: MIT
"""The page's first numbers: time per sphere of our planned rows and of each library's fastest."""

import pandas as pd

from octocell_report import words
from octocell_report.load import RUNS, Result
from octocell_report.plan import PLANNED

OURS = "Octocell"
_SCENE = "gas"  # the plain one: first where there is one


def run_shown(result: Result) -> str:
    """Warm, where it was run."""
    held = set(result.frame["run"])
    return next((run for run in ("warm", *RUNS) if run in held), "warm")


def best(result: Result) -> pd.DataFrame:
    """Nanoseconds per sphere of the fastest exact row: a line per scene and size, a column per
    contender, ours first (one thread, more, GPU)."""
    frame = result.frame
    exact = frame["counts"] & frame["predicate"].isna() & (frame["ns_per_sphere"] > 0)
    frame = frame[exact & (frame["run"] == run_shown(result))]
    others, planned = frame["side"] == "baseline", frame["method"] == PLANNED
    frame = frame[others | (planned if planned.any() else ~others)]
    frame = frame.sort_values(["kind", "side", "threads", "order"], kind="stable")
    who = list(map(_contender, frame["side"], frame["threads"], frame["family"]))
    wide = frame.assign(who=who).pivot_table("ns_per_sphere", ["scene", "n"], "who", "min")
    scenes = sorted(result.scenes, key=lambda scene: scene != _SCENE)
    return wide.reindex(columns=dict.fromkeys(who)).reindex(
        [place for scene in scenes for place in wide.index if place[0] == scene]
    )


def _contender(side: str, threads: int, family: str) -> str:
    if side == "baseline":
        return words.family_title(family)
    where = ", GPU" if side == "device" else f", {threads} threads" if threads != 1 else ""
    return OURS + where


def at_largest(times: pd.DataFrame) -> pd.DataFrame:
    """Each scene at the largest size at which most contenders are."""
    met = times.notna().sum(axis=1)
    largest: dict[str, tuple[str, int]] = {}
    for scene, n in sorted(times.index, key=lambda place: (met[place], place[1])):
        largest[scene] = (scene, n)
    return times.loc[[largest[scene] for scene in times.index.unique(0)]]


def ratios(times: pd.DataFrame) -> pd.DataFrame:
    """Of the libraries' columns: by the time of the first of ours."""
    ours = [who for who in times if is_ours(who)]
    return times.drop(columns=ours).div(times[ours[0]] if ours else float("nan"), axis=0)


def is_ours(who: str) -> bool:
    return who.startswith(OURS)
