# SPDX-License-Identifier: MIT
"""An ablation, and run time against error, as files: figures, tables as CSV, all as Markdown."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd
from matplotlib.figure import Figure
from msgspec.structs import asdict

from octocell_report import ablation, captions, frames, images, markdown, page_tables, plots, words
from octocell_report.error import MILLION, Study
from octocell_report.files import staged_folder
from octocell_report.load import Result
from octocell_report.texts import Said, how, say, title


@dataclass(frozen=True)
class Files:
    name: str  # of the Markdown file, and of the section of texts
    figures: tuple[str, ...]  # that may be drawn
    drawn: Iterator[tuple[str, Figure]]
    notes: list[Said]
    tables: dict[str, pd.DataFrame]  # by name of the CSV file
    shown: dict[str, pd.DataFrame]  # in the Markdown file: below the figure of that name, or alone

    def write(self, folder: Path) -> None:
        images.write(self.drawn, folder)
        frames.write(self.tables, folder)
        parts = [f"# {say(f'section_{self.name}').en}", " ".join(note.en for note in self.notes)]
        tables = {name: markdown.table(table) for name, table in self.shown.items() if len(table)}
        for name in images.drawn(self.figures, folder):
            parts += [f"## {title(name).en}", f"![{how(name).en}]({name}.png)"]
            parts += [tables.pop(name)] if name in tables else []
        for name, table in tables.items():
            parts += [f"## {title(name).en}", how(name).en] if name not in self.figures else []
            parts += [table]
        text = markdown.plain("\n\n".join(parts) + "\n")
        (folder / f"{self.name}.md").write_text(text, encoding="utf-8")

    @property
    def owned(self) -> set[str]:
        """Every file that write() may write."""
        tables = {f"{name}.csv" for name in self.tables}
        return images.files_of(self.figures) | tables | {f"{self.name}.md"}

    def build(self, folder: Path, inputs: Sequence[Path] = ()) -> list[str]:
        """Writes everything; returns the names. All or nothing."""
        with staged_folder(folder, self.owned, inputs) as staging:
            self.write(staging)
            return sorted(path.name for path in staging.iterdir())


def of_ablation(result: Result) -> Files:
    rows, regrets = ablation.choices(result), ablation.regrets(result)
    plans = pd.DataFrame([asdict(plan) if plan else {} for plan in rows["plan"]], rows.index)
    plans = plans.assign(skips=plans["skips"].str.join(" ")).add_prefix("plan_")
    where = ["backend", "scene", "n", "motion", "run", "threads"]
    times = [
        *("method", "rule", "skips", "status", "reason", "missed", "false", "duplicates"),
        *("median_ms", "min_ms", "max_ms", "ns_per_sphere", "rounds", "by_planned"),
    ]
    best = ["planned_ms", "best", "best_ms", "choices", "same_plan", "regret", "rounds", "verdict"]
    return Files(
        "ablation",
        plots.ABLATION_NAMES,
        plots.draw_ablation(result),
        captions.ablation(result),
        {
            "ablation": rows[[*where, *times]].join(plans),
            "regret": regrets.rename(columns={"choice": "best", "median_ms": "best_ms"})[
                where + best
            ],
        },
        {
            "ablation_skips": _skips(result),
            "ablation_regret": page_tables.english(page_tables.regret(result)),
        },
    )


def _skips(result: Result) -> pd.DataFrame:
    """Scenes down, skips across; bold where the plan takes the skip."""
    effects = ablation.effects(result)
    keys = ["backend_at", "study", "title", "backend"]
    cells = effects[[*keys, "skip"]].assign(cell=list(map(_effect, effects.itertuples())))
    wide = cells.pivot(index=keys, columns="skip", values="cell")[effects["skip"].unique()]
    return wide.reset_index(keys[2:]).rename(columns={"title": "scene"})


def _effect(row: Any) -> str:
    if row.by_planned is None:
        return f"wrong {words.losses(row)}" if row.status == "wrong" else "skipped"
    ratio = words.times(row.by_planned.median)
    return markdown.bold(ratio) if row.taken else ratio


_POINTS = [
    *("scene_class", "scene", "n", "true_pairs", "backend", "predicate", "method", "rule"),
    *("threads", "claims_exact", "ns_per_sphere", "missed", "false", "duplicates"),
    *("missed_per_million", "false_per_million", "bound_per_million", "worst_missed_depth"),
    *("worst_false_gap", "candidates", "distinct_checksums"),
]


def of_error(study: Study) -> Files:
    pairs = study.points["true_pairs"]
    points = study.points.assign(bound_per_million=3 * MILLION / pairs.where(pairs > 0))
    return Files(
        "error",
        plots.ERROR_NAMES,
        plots.draw_error(study),
        captions.error(study),
        {"error": points[_POINTS], "error_costs": study.costs, "error_rounding": study.rounding},
        {
            "costs": page_tables.english(page_tables.costs(study)),
            "rounding": page_tables.english(page_tables.rounding(study)),
        },
    )
