# SPDX-License-Identifier: MIT
"""Run time against error: which overlap test costs what, and which pairs it gets wrong.

A series is one of our backends with one predicate, or one broad phase of a library. Of each
backend one configuration (method, rule, threads) stands for it on a scene: that which ran with most
predicates, of several the one whose exact row is fastest; so predicates differ and nothing else.
"""

from collections.abc import Iterable, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from octocell_report import words
from octocell_report.fields import ReportError
from octocell_report.load import Result
from octocell_report.load import load as load_bench
from octocell_report.predicates import EXACT, FLOAT32, PREDICATES, SCENE_CLASSES
from octocell_report.spread import Estimate, estimate, ratios

SHARE = 95  # per cent that intervals hold here
MILLION = 1_000_000
JUDGING = ("pair_tests", "resolve")  # the stages that a predicate is part of

_PLACE, _CONFIGURATION = ["scene", "n"], ["method", "rule", "threads"]


class Study:
    """Results, maybe of several machines: of a row that two of them hold the first one's stands."""

    def __init__(self, results: Iterable[Result]) -> None:
        self.results = list(results)

    @cached_property
    def points(self) -> pd.DataFrame:
        """A line per series and scene, in the order of tables: by predicate, exact first; then the
        libraries. The columns of Result.frame, where predicate is None for libraries alone, and
            series lane   backend with predicate; what shares a line where nothing is wrong
            true_pairs    of the scene; 0 if it has none
            missed_per_million false_per_million errors_per_million   of the true pairs (as if a
                          scene without any had one); pairs given again are false
            claims_exact  it should be without an error
            judging_ms    tuple, the time of the stages that a predicate is part of, by round
        """
        every = pd.concat([_points(result) for result in self.results], ignore_index=True)
        every = every.drop_duplicates(["series", *_PLACE])
        rank = every["predicate"].map({name: at for at, name in enumerate(PREDICATES)})
        library = every["lane"].where(rank.isna(), "")
        order = every.assign(rank=rank, library=library, met=pd.factorize(every["series"])[0])
        order = order.sort_values(["rank", "library", "met"], kind="stable")
        return every.loc[order.index].reset_index(drop=True)

    @cached_property
    def fronts(self) -> pd.DataFrame:
        """Of each class of scenes the series with the least ns (median) of those without an error,
        and not by luck; place: on the CPU, on a GPU."""
        by = self.points.groupby(["scene_class", "series", "side"], sort=False)
        found = by.agg(
            ns=("ns_per_sphere", "median"),
            errors=("errors", "sum"),
            claims_exact=("claims_exact", "all"),
        ).reset_index()
        found["place"] = (found["side"] == "device").map({True: "GPU", False: "CPU"})
        exact = found[found["claims_exact"] & (found["errors"] == 0)].sort_values("ns")
        return exact.drop_duplicates(["scene_class", "place"])

    @cached_property
    def scenes(self) -> pd.DataFrame:
        """Class, name, size and true pairs of each, by class, then as in the files."""
        places: list[Any] = [group.place for result in self.results for group in result.groups]
        scenes = self.points[["scene_class", *_PLACE, "true_pairs"]].drop_duplicates(_PLACE)
        order = scenes.assign(
            rank=scenes["scene_class"].map(SCENE_CLASSES.index),
            met=[places.index((scene.scene, scene.n)) for scene in scenes.itertuples()],
        )
        return scenes.loc[order.sort_values(["rank", "met"]).index]

    @property
    def compares(self) -> bool:
        """There is a predicate beside exact, so there is an experiment to show."""
        return bool((self.points["predicate"].dropna() != EXACT).any())

    @property
    def costs(self) -> pd.DataFrame:
        """What exact decisions cost beside plain float32 ones, by backend and scene."""
        exact, plain = (self.points[self.points["predicate"] == name] for name in (EXACT, FLOAT32))
        keys = ["backend", *_PLACE, *_CONFIGURATION]
        both = exact.merge(plain, on=keys, suffixes=("", "_plain"))
        return pd.DataFrame(
            {
                **{"scene": row.scene, "n": row.n, "backend": row.backend},
                "deciding_stages": _ratio(row.judging_ms, row.judging_ms_plain),
                **{"whole": whole, "rounds": whole.rounds},
                "candidates_per_pair": row.candidates_per_pair,
            }
            for row in both.itertuples()
            if (whole := _ratio(row.round_ms, row.round_ms_plain))
        )

    @property
    def rounding(self) -> pd.DataFrame:
        """What rounding the input to float32 did to a scene's pairs."""
        shown = set(self.scenes[_PLACE].itertuples(index=False, name=None))
        groups = {group.place: group for result in self.results for group in result.groups}
        return pd.DataFrame(
            {
                **{"scene": place.scene, "n": place.n, "true_pairs": group.truth_pairs},
                **{"lost": group.rounding.lost, "gained": group.rounding.gained},
            }
            for place, group in groups.items()
            if place in shown and group.rounding
        )


def load(paths: Sequence[Path]) -> Study:
    """Reads results. Throws ReportError if they have no row to show."""
    study = Study(map(load_bench, paths))
    if study.points.empty:
        names = ", ".join(map(str, paths))
        raise ReportError(f"{names}: no warm row that ran is on a scene with a scene_class")
    return study


def _points(result: Result) -> pd.DataFrame:
    """One result's, each scene at the size at which most series ran."""
    frame = result.frame
    rows = frame[
        (frame["run"] == "warm")
        & frame["scene_class"].notna()
        & frame["missed"].notna()  # so its errors are known
        & ~(frame["negative_control"] & frame["predicate"].isna())  # they are not a wrong rule's
        & (frame["ns_per_sphere"] > 0)
    ]
    exact = rows.assign(ms=rows["median_ms"].where(rows["predicate"].isna()))
    by = exact.groupby([*_PLACE, "backend", *_CONFIGURATION], dropna=False)
    fastest = by["ms"].transform("min").fillna(by["median_ms"].transform("min"))
    known = {"configuration": by.ngroup(), "met": by["ms"].transform("size"), "speed": 1 / fastest}
    rows = _best(rows.assign(**known), [*_PLACE, "backend"], "configuration", ["met", "speed"])
    met = rows.groupby(_PLACE)["backend"].transform("size")
    rows = _best(rows.assign(met=met), ["scene"], "n", ["met", "n"])
    rows = rows.sort_values(
        "scene", key=lambda names: names.map(result.scenes.index), kind="stable"
    )
    return _measured(rows).join(_judging(result)[["judging_ms"]])


def _best(rows: pd.DataFrame, of: list[str], column: str, rank: list[str]) -> pd.DataFrame:
    """Of each group those lines whose column holds what that of the highest rank holds."""
    ranked = rows.sort_values(rank, kind="stable").groupby(of)[column].transform("last")
    return rows[rows[column] == ranked.reindex(rows.index)]


def _measured(rows: pd.DataFrame) -> pd.DataFrame:
    predicate = rows["predicate"].fillna(EXACT).where(rows["kind"] == "backend", None)
    library = rows["family"].map(words.family_title)
    true_pairs = rows["truth_pairs"].fillna(0).astype(int)
    false = rows["errors"] - rows["missed"].astype(int)
    counts = {"missed": rows["missed"].astype(int), "false": false, "errors": rows["errors"]}
    rates = {f"{of}_per_million": MILLION * n / true_pairs.clip(1) for of, n in counts.items()}
    return rows.assign(
        predicate=predicate,
        series=rows["backend"].str.cat(" " + predicate, na_rep=""),
        lane=predicate.fillna(library),
        true_pairs=true_pairs,
        claims_exact=~rows["negative_control"] & rows["known_issues"].fillna("").eq(""),
        **rates,
    )


def _judging(result: Result) -> pd.DataFrame:
    """A fused stage's time is its host's, met once."""
    stages = result.stages[result.stages["stage"].isin(JUDGING)]
    stages = stages[stages["round_ms"].map(len) > 0]
    sums = stages.groupby("row")["round_ms"].agg(
        lambda all: tuple(map(sum, zip(*all, strict=False)))
    )
    return sums.to_frame("judging_ms")


def _ratio(above: Any, below: Any) -> Estimate | None:
    rounds = ratios(above, below) if isinstance(above, tuple) and isinstance(below, tuple) else ()
    return estimate(rounds, SHARE) if rounds else None
