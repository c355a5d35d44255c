# SPDX-License-Identifier: MIT
"""An ablation as files: three figures, two tables as CSV, and all of it as Markdown."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import Any

import pandas as pd

from octocell_report import (
    ablation,
    captions,
    frames,
    images,
    markdown,
    plots,
    tables,
    words,
)
from octocell_report.ablation import Regret, Study
from octocell_report.files import staged_folder
from octocell_report.load import Result, Row
from octocell_report.texts import say

TABLES = ("ablation.csv", "regret.csv", "ablation.md")


def owned_names() -> set[str]:
    """Every file that write() may write."""
    return images.files_of(plots.ABLATION_NAMES) | set(TABLES)


def build(result: Result, folder: Path, inputs: Sequence[Path] = ()) -> list[str]:
    """Writes everything; returns the names. All or nothing."""
    with staged_folder(folder, owned_names(), inputs) as staging:
        write(result, staging)
        return sorted(path.name for path in staging.iterdir())


def write(result: Result, folder: Path) -> None:
    images.write(plots.draw_ablation(result), folder)
    frames.save(rows_frame(result), folder / "ablation.csv")
    frames.save(regret_frame(result), folder / "regret.csv")
    (folder / "ablation.md").write_text(markdown.plain(text(result, folder)), encoding="utf-8")


def rows_frame(result: Result) -> pd.DataFrame:
    """Every planned row, variant and forced method; what is not exact has no ratio."""
    found = []
    for study in [*ablation.studies(result), *ablation.unjudged(result)]:
        rows = [study.planned] if study.planned else []
        found += [_row(study, row) for row in [*rows, *study.variants, *study.forced]]
    return pd.DataFrame(found)


def _row(study: Study, row: Row) -> dict[str, Any]:
    ran, plan = bool(row.round_ms), row.plan
    return {
        **_head(study),
        **{"method": row.impl.method, "rule": row.impl.rule, "skips": row.skips},
        **{"status": row.status, "reason": row.reason},
        **{"missed": row.missed, "false": row.false, "duplicates": row.duplicates},
        "median_ms": row.median_ms if ran else None,
        "min_ms": min(row.round_ms, default=None),
        "max_ms": max(row.round_ms, default=None),
        "ns_per_sphere": tables.ns_per_sphere(row) if ran else None,
        "rounds": len(row.round_ms),
        **frames.estimate("by_planned", ablation.by_planned(study, row)),
        "plan_method": plan.method if plan else None,
        "plan_levels": plan.levels if plan else None,
        "plan_key_bits": plan.key_bits if plan else None,
        "plan_sort_passes": plan.sort_passes if plan else None,
        "plan_skips": " ".join(plan.skips) if plan else None,
    }


def _head(study: Study) -> dict[str, Any]:
    key = study.key
    return {
        **{"backend": key.backend, "scene": key.place.scene, "n": key.place.n},
        **{"motion": key.motion, "run": key.run, "threads": key.threads},
    }


def regret_frame(result: Result) -> pd.DataFrame:
    return pd.DataFrame(
        {
            **_head(found.study),
            "planned_ms": found.study.base.median_ms,
            "best": ablation.choice(found.best),
            "best_ms": median(found.best.round_ms),
            "choices": found.choices,
            "same_plan": found.same_plan,
            **frames.estimate("regret", found.ratio),
            "rounds": found.ratio.rounds,
            "verdict": found.verdict,
        }
        for found in ablation.regrets(ablation.studies(result))
    )


def text(result: Result, folder: Path) -> str:
    """Figures that lie in the folder, and the numbers as tables."""
    parts = [f"# {say('section_ablation').en}", markdown.english(captions.ablation(result))]
    numbers = {"ablation_skips": _skips_table, "ablation_regret": _regret_table}
    for name in images.drawn(plots.ABLATION_NAMES, folder):
        parts += markdown.chapter(name, markdown.picture(name))
        if name in numbers:
            parts.append(numbers[name](result))
    return "\n\n".join(parts) + "\n"


def _skips_table(result: Result) -> str:
    studies = ablation.studies(result)
    skips = ablation.skips_of(studies)
    lines = []
    for study in studies:
        cells = {effect.skip: _skip_cell(effect) for effect in ablation.effects(study)}
        row = [cells.get(skip, words.NONE) for skip in skips]
        lines.append([study.title, study.key.backend, *row])
    return markdown.table(pd.DataFrame(lines, columns=["scene", "backend", *skips]))


def _skip_cell(effect: ablation.Effect) -> str:
    if effect.ratio is None:
        return f"wrong {words.losses(effect.row)}" if effect.row.status == "wrong" else "skipped"
    ratio = words.times(effect.ratio.median)
    return f"**{ratio}**" if effect.taken else ratio


def _regret_table(result: Result) -> str:
    header = ["scene", "backend", "planned [ms]", "best [ms]", "best"]
    header += ["regret", "interval", "verdict"]
    every = ablation.regrets(ablation.studies(result))
    return markdown.table(pd.DataFrame(map(_regret_cells, every), columns=header))


def _regret_cells(regret: Regret) -> list[str]:
    ratio, times = regret.ratio, words.times
    return [
        *(regret.study.title, regret.study.key.backend),
        *(words.number(regret.study.base.median_ms), words.number(regret.best.median_ms)),
        ablation.choice(regret.best) + (", same plan" if regret.same_plan else ""),
        *(times(ratio.median), f"{times(ratio.low)} .. {times(ratio.high)}", regret.verdict),
    ]
