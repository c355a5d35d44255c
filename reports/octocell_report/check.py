# SPDX-License-Identifier: MIT
"""The verdict: which rows are wrong that should not be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from octocell_report import words
from octocell_report.load import Result
from octocell_report.texts import Said, listed, say


@dataclass(frozen=True)
class Verdict:
    """Counts of rows, and rows as named tuples of the frame's columns."""

    exact: int  # default rows that ran and are exact
    wrong: list[Any]  # default rows that ran and are not
    excused: list[Any]  # wrong by a known issue of their library; reported, not counted
    skipped: int
    negative_controls: int  # rows kept because their rule is wrong; they do not count
    unavailable: list[str]  # real scenes that could not be fetched
    finished: bool
    variants: int  # planned rows with skips forbidden that ran: asked to be exact, not default
    wrong_variants: list[Any]

    @property
    def checked(self) -> int:
        return self.exact + len(self.wrong)

    @property
    def passes(self) -> bool:
        """Every default row and every variant that ran is exact, and at least one default did."""
        return not self.wrong and not self.wrong_variants and self.exact > 0


def judge(result: Result) -> Verdict:
    rows, variants = result.frame, result.variants_frame
    default = rows[~rows["negative_control"]]
    wrong = default[default["status"] == "wrong"]
    return Verdict(
        exact=int((default["status"] == "ok").sum()),
        wrong=[*wrong[~wrong["excused"]].itertuples()],
        excused=[*wrong[wrong["excused"]].itertuples()],
        skipped=int((~rows["ran"]).sum()),
        negative_controls=int((rows["negative_control"] & rows["ran"]).sum()),
        unavailable=[g.scene for g in result.groups if g.unavailable is not None],
        finished=bool(result.context["finished"]),
        variants=int(variants["ran"].sum()),
        wrong_variants=[*variants[variants["status"] == "wrong"].itertuples()],
    )


def headline(verdict: Verdict) -> Said:
    """Exact or not. A 'default' row ran, and is neither a variant nor a negative control."""
    key = "none" if not verdict.checked else "wrong" if verdict.wrong else "all"
    parts = [say(f"headline_{key}", wrong=len(verdict.wrong), checked=verdict.checked)]
    if wrong := len(verdict.wrong_variants):
        parts.append(say("headline_variants", wrong=wrong, variants=verdict.variants))
    return listed(parts, "space")


def summary(verdict: Verdict) -> str:
    """The headline and what it does not count, in one line."""
    parts = [
        headline(verdict).en,
        f"{verdict.skipped} skipped, {verdict.negative_controls} negative controls.",
    ]
    if verdict.variants:
        parts.append(f"Beside them {verdict.variants} variants with skips forbidden ran.")
    if verdict.excused:
        parts.append(f"{len(verdict.excused)} miss pairs by known issues of their libraries.")
    if verdict.unavailable:
        parts.append(f"Unavailable: {', '.join(verdict.unavailable)}.")
    if not verdict.finished:
        parts.append("The run was interrupted; what is there is sound.")
    return " ".join(parts)


def complaints(verdict: Verdict) -> list[str]:
    """One line on each wrong row."""
    return [
        f"wrong: {row.name}: {row.pairs} pairs, {words.losses(row)}"
        for row in [*verdict.wrong, *verdict.wrong_variants]
    ]
