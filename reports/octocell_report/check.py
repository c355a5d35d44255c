# SPDX-License-Identifier: MIT
"""The verdict: which rows are wrong that should not be."""

from typing import Any, NamedTuple

from octocell_report import words
from octocell_report.load import Result
from octocell_report.texts import Said, listed, say


class Verdict(NamedTuple):
    """Numbers of rows, and rows. A default row is neither a variant nor a negative control."""

    exact: int  # default rows that ran and are exact
    wrong: list[Any]  # default rows that ran and are not
    excused: int  # wrong by a known issue of their library; reported, not counted
    skipped: int
    controls: int  # negative controls that ran; right or wrong, they do not count
    variants: int  # planned rows with skips forbidden that ran: asked to be exact, too
    wrong_variants: list[Any]

    @property
    def passes(self) -> bool:
        """Every default row and every variant that ran is exact, and at least one default did."""
        return not self.wrong and not self.wrong_variants and self.exact > 0

    @property
    def headline(self) -> Said:
        wrong, checked = len(self.wrong), self.exact + len(self.wrong)
        key = "none" if not checked else "wrong" if wrong else "all"
        parts = [say(f"headline_{key}", wrong=wrong, checked=checked)]
        if wrong := len(self.wrong_variants):
            parts.append(say("headline_variants", wrong=wrong, variants=self.variants))
        return listed(parts, "space")

    @property
    def complaints(self) -> list[str]:
        """One line on each wrong row."""
        rows = [*self.wrong, *self.wrong_variants]
        return [f"wrong: {row.name}: {row.pairs} pairs, {words.losses(row)}" for row in rows]


def judge(result: Result) -> Verdict:
    rows, variants = result.frame, result.variants_frame
    wrong = rows[(rows["status"] == "wrong") & ~rows["negative_control"]]
    return Verdict(
        exact=int(rows["counts"].sum()),
        wrong=[*wrong[~wrong["excused"]].itertuples()],
        excused=int(wrong["excused"].sum()),
        skipped=int((~rows["ran"]).sum()),
        controls=int((rows["negative_control"] & rows["ran"]).sum()),
        variants=int(variants["ran"].sum()),
        wrong_variants=[*variants[variants["status"] == "wrong"].itertuples()],
    )


def summary(result: Result) -> str:
    """The headline and what it does not count, in one line."""
    verdict = judge(result)
    missing = ", ".join(g.scene for g in result.groups if g.unavailable is not None)
    parts = {
        verdict.headline.en: True,
        f"{verdict.skipped} skipped, {verdict.controls} negative controls.": True,
        f"Beside them {verdict.variants} variants with skips forbidden ran.": verdict.variants,
        f"{verdict.excused} miss pairs by known issues of their libraries.": verdict.excused,
        f"Unavailable: {missing}.": missing,
        "The run was interrupted; what is there is sound.": not result.context["finished"],
    }
    return " ".join(text for text, shown in parts.items() if shown)
