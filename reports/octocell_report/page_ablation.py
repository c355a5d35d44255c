# SPDX-License-Identifier: MIT
"""The page's part on planned rows: their figures' sections, and the regret as a table."""

from __future__ import annotations

from octocell_report import ablation, words
from octocell_report.ablation import Regret
from octocell_report.language import Said, say
from octocell_report.load import Result
from octocell_report.page_tables import Cell, Line, Table, column

_CSS = {"above": "wrong"}


def regret(result: Result | None) -> Table | None:
    """The plan against the best forced choice; None without one."""
    found = ablation.regrets(ablation.studies(result)) if result else []
    names = ("planned", "best_time", "regret", "interval")
    columns = [
        *(column(name, "text") for name in ("scene", "backend")),
        *map(column, names),
        *(column(name, "text") for name in ("best", "verdict")),
    ]
    lines = [Line(_cells(regret), _CSS.get(regret.verdict, "")) for regret in found]
    return Table(say("regret_table"), columns, lines) if lines else None


def _cells(regret: Regret) -> list[Cell]:
    ratio, planned, best = regret.ratio, regret.study.base, regret.best
    choice: str | Said = ablation.choice(best)
    if regret.same_plan:
        choice = say("regret_same_plan", choice=choice)
    return [
        Cell(regret.study.title, css="text"),
        Cell(regret.study.key.backend, css="text"),
        Cell(words.number(planned.median_ms), value=planned.median_ms),
        Cell(words.number(best.median_ms), value=best.median_ms),
        Cell(words.times(ratio.median), css="time", value=ratio.median),
        Cell(f"{words.times(ratio.low)} .. {words.times(ratio.high)}", value=ratio.low),
        Cell(choice, css="text"),
        Cell(say(f"verdict_{regret.verdict}"), css="text"),
    ]
