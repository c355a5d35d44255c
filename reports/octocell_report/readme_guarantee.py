# SPDX-License-Identifier: MIT
"""The guarantee as tables: what was tried to break it, how much of it, and what broke."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from pandas import DataFrame

from octocell_report.language import listed, tell
from octocell_report.markdown import code, table
from octocell_report.verification import ENDINGS, LOSSES, SIDES, Verification
from octocell_report.words import NONE, family, family_title, grouped

NOT_RUN = "not run"
OWNERS = ("Octocell", "FCL", "Bullet")  # columns


def guarantee(found: Verification) -> str:
    """The one table: ours beside the libraries, where the same was asked of them."""
    stress = found["stress"]
    bad = stress["asks"] == "refusal"
    lines = [line for side in SIDES for line in _near_tangent(found["near_tangent"], side)]
    lines += [
        [_catalogue(stress), *_by_owner(stress[~bad], _answers)],
        ["– wrong answers", *_by_owner(stress[~bad], lambda rows: _bold(rows["wrong"].sum()))],
        ["– pairs missed, false, given again", *_by_owner(stress[~bad], _losses)],
        [
            "– crashed or too late",
            *_by_owner(stress[~bad], lambda rows: _bold(rows[["crashed", "late"]].sum().sum())),
        ],
        ["bad inputs tried, rejected by name", *_by_owner(stress[bad], _rejected)],
        ["inputs made by fuzzers", _told(found["fuzz"], _fuzzed)],
        ["faults planted in the sources and found", _told(_best(found["mutants"]), _killed)],
        ["compilers and flags with one checksum", _told(found["compilers"], _configurations)],
        ["reports of sanitizers", _told(found["sanitizers"], _reports)],
    ]
    note = (
        "A near-tangent pair is one with |D − R| ≤ 64 u R: its squared distance is so near to the "
        "square of the sum of radii that float32 may fail to tell; each was decided and compared "
        "with integers. Where nothing was wrong, 3/N bounds the rate with 95 %. "
        f"{NONE}: not asked of a library. Libraries run with our exact test of a pair, so "
        "that what they miss their broad phases lost."
    )
    told = table(DataFrame(lines, columns=["", *OWNERS]), note)
    return f"{told}\n\n{_sources(*found.values())}"


def _told(rows: DataFrame, show: Callable[[DataFrame], str]) -> str:
    return NOT_RUN if rows.empty else show(rows)


def _bold(count: int) -> str:
    return f"**{grouped(count)}**" if count else "0"


def _near_tangent(ties: DataFrame, side: str) -> list[list[str]]:
    here = ties[ties["where"] == side]
    families = here["name"].nunique()
    return [
        [
            f"near-tangent pairs decided, {side}",
            _told(here, lambda rows: f"{grouped(rows['pairs'].sum())} in {families} families"),
        ],
        ["– of these wrong", _told(here[here["pairs"] > 0], _mismatches)],
    ]


def _mismatches(ties: DataFrame) -> str:
    wrong = ties["mismatches"].sum()
    return _bold(wrong) if wrong else f"0 (rate below {bound(ties['pairs'].sum())})"


def bound(trials: int) -> str:
    """3/N, which a rate stays below with 95 % where none of N failed: '2.5 · 10⁻⁹'."""
    mantissa, exponent = f"{3 / trials:.1e}".split("e")
    superscripts = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{mantissa} · 10{superscripts}"


def _catalogue(stress: DataFrame) -> str:
    entries = stress["entry"].nunique()
    families = stress["entry"].str.rstrip("0123456789").nunique()  # 'C' of 'C18'
    return f"stress catalogue ({families} families, {entries} entries): answers"


def owners(rows: DataFrame) -> dict[str, DataFrame]:
    """Rows of the stress catalogue: ours, then library by library."""
    families = rows["backend"].map(family).map(family_title)
    found = families.where(rows["kind"] == "baseline", OWNERS[0])
    return {owner: rows[found == owner] for owner in OWNERS}


def _by_owner(rows: DataFrame, show: Callable[[DataFrame], str]) -> list[str]:
    return [_told(own, show) for own in owners(rows).values()]


def answered(rows: DataFrame) -> int:
    return int(rows[["exact", "late", "crashed", "wrong"]].sum().sum())


def _answers(rows: DataFrame) -> str:
    """Questions, not scenes: each scene is asked of every implementation."""
    return f"{grouped(answered(rows))} by {rows['implementation'].nunique()} implementations"


def _losses(rows: DataFrame) -> str:
    counts = rows[[*LOSSES]].sum()
    text = ", ".join(map(grouped, counts))
    return f"**{text}**" if counts.any() else text


def _rejected(rows: DataFrame) -> str:
    """An answer to a bad input is exact if it is the error that names the sphere."""
    tried = answered(rows)
    return f"{rows['exact'].sum()} of {tried}" if tried else NONE


def _fuzzed(targets: DataFrame) -> str:
    return f"{grouped(targets['runs'].sum())}, failures: {_bold(targets['crashes'].sum())}"


def _best(faults: DataFrame) -> DataFrame:
    """A fault not run on one machine may have run on another; a survival counts first."""
    order = {"survived": 0, "killed": 1, "not_run": 2}
    ranked = faults.sort_values("status", key=lambda status: status.map(order), kind="stable")
    best = ranked.drop_duplicates("name").set_index("name")
    return best.loc[faults["name"].unique()].reset_index()


def _killed(faults: DataFrame) -> str:
    counts = (
        faults["status"].value_counts().reindex(["killed", "survived", "not_run"], fill_value=0)
    )
    tried = counts["killed"] + counts["survived"]
    if not tried:
        return NOT_RUN
    text = f"{counts['killed']} of {tried}"
    text = f"**{text}**" if counts["survived"] else text
    return f"{text} ({counts['not_run']} not run)" if counts["not_run"] else text


def _configurations(files: DataFrame) -> str:
    total, failures = (int(files[of].map(len).sum()) for of in ("configurations", "failures"))
    return f"**{failures} failures in {total}**" if failures else str(total)


def _reports(tools: DataFrame) -> str:
    # "memcheck, frames": what was run under it is for the table of the details.
    names = ", ".join(tools["name"].str.split(",").str[0].unique())
    tests = grouped(tools["tests"].sum())
    return f"{_bold(tools['reports'].sum())} in {tests} tests ({names})"


def _sources(*frames: DataFrame) -> str:
    """Which files this was written from."""
    names = dict.fromkeys(name for frame in frames for name in frame["source"])
    return f"From {', '.join(names)}." if names else "From no file yet."


def _detailed(rows: DataFrame, lines: DataFrame, note: str = "") -> str:
    """A table with its sources; of a kind without a file, that it was not run."""
    return table(lines, f"{note} {_sources(rows)}".strip()) if len(rows) else "Not run yet."


# Of the kinds whose table has a line for each line of the frame: titles, columns, how they read.
_COLUMNS: dict[str, dict[str, tuple[str, Callable[[Any], str]]]] = {
    "near_tangent": {
        **{"family": ("name", str), "where": ("where", str), "machine": ("machine", str)},
        **{"near-tangent pairs": ("pairs", grouped), "wrong": ("mismatches", _bold)},
    },
    "mutants": {
        **{"fault": ("name", code), "what is wrong": ("what", str)},
        **{"": ("status", str), "found by": ("killed_by", str)},
    },
    "fuzz": {
        **{"target": ("name", code), "machine": ("machine", str), "inputs": ("runs", grouped)},
        **{"seconds": ("seconds", grouped), "failures": ("crashes", _bold)},
    },
    "sanitizers": {
        **{"tool": ("name", str), "machine": ("machine", str)},
        **{"tests": ("tests", grouped), "reports": ("reports", _bold)},
    },
}


def _lines(kind: str, rows: DataFrame) -> DataFrame:
    shown = {title: rows[of].map(show, "ignore") for title, (of, show) in _COLUMNS[kind].items()}
    return DataFrame(shown)


def near_tangent(found: Verification) -> str:
    """By family, and where it ran."""
    ties = found["near_tangent"]
    lines = _lines("near_tangent", ties)
    wrong = _told(ties[ties["pairs"] > 0], _mismatches)
    lines.loc[len(lines)] = ["all", "", "", grouped(ties["pairs"].sum()), wrong]
    return _detailed(ties, lines)


def mutants(found: Verification) -> str:
    faults = _best(found["mutants"])
    reasons = "not run: " + faults["reason"].fillna("no reason given")
    status = faults["status"].replace("survived", "**survived**")
    told = faults.assign(status=status.mask(status == "not_run", reasons))
    return _detailed(found["mutants"], _lines("mutants", told))


def fuzz(found: Verification) -> str:
    return _detailed(found["fuzz"], _lines("fuzz", found["fuzz"]))


def sanitizers(found: Verification) -> str:
    return _detailed(found["sanitizers"], _lines("sanitizers", found["sanitizers"]))


def stress(found: Verification) -> str:
    """By implementation, backends first: how its cases ended."""
    rows = found["stress"].sort_values("kind", kind="stable")
    by = rows.groupby("implementation", sort=False)
    lines = by[[*ENDINGS]].sum().map(grouped)
    lines[[*ENDINGS[3:]]] = by[[*ENDINGS[3:]]].sum().map(_bold)
    lines["missed, false, given again"] = [_losses(own) for _, own in by]
    return _detailed(found["stress"], lines.reset_index())


def compilers(found: Verification) -> str:
    files = found["compilers"]
    every = files.explode("configurations", ignore_index=True)
    every[["compiler", "flags"]] = every["configurations"].str.extract(r"(\S+)\s*(.*)")
    by = every.groupby(["compiler", "machine"], sort=False)["flags"]
    lines = by.agg(configurations="size", flags=lambda flags: ", ".join(map(code, flags)))
    refused = sorted({name.split()[-1] for name in files["refused"].sum() or ()})
    failures = files["failures"].map(len).sum()
    note = f"{files['checksums'].max()} checksums each; failures: {_bold(failures)}."
    if refused:
        note += f" Refused at compile time: {', '.join(map(code, refused))}."
    return _detailed(files, lines.reset_index(), note)


def front(found: Verification, language: str = "en") -> str:
    """The README's number: wrong answers to the stress catalogue, ours, then each library's."""
    rows = found["stress"]
    parts = [
        tell(
            language,
            "front_owner",
            owner=owner,
            wrong=grouped(own["wrong"].sum()),
            answers=grouped(answered(own)),
        )
        for owner, own in owners(rows[rows["asks"] != "refusal"]).items()
    ]
    return tell(language, "front_wrong", owners=listed(parts, language))
