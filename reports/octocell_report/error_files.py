# SPDX-License-Identifier: MIT
"""Run time against error as files: three figures, tables as CSV, and all of it as Markdown."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from octocell_report import captions, frames, images, markdown, page_tables, plots
from octocell_report.error import MILLION, Study
from octocell_report.files import staged_folder
from octocell_report.texts import say

TABLES = ("error.csv", "error_costs.csv", "error_rounding.csv", "error.md")


def owned_names() -> set[str]:
    """Every file that write() may write."""
    return images.files_of(plots.ERROR_NAMES) | set(TABLES)


def build(study: Study, folder: Path, inputs: Sequence[Path] = ()) -> list[str]:
    """Writes everything; returns the names. All or nothing."""
    with staged_folder(folder, owned_names(), inputs) as staging:
        write(study, staging)
        return sorted(path.name for path in staging.iterdir())


def write(study: Study, folder: Path) -> None:
    images.write(plots.draw_error(study), folder)
    made = {"error": points_frame, "error_costs": costs_frame, "error_rounding": rounding_frame}
    frames.write({name: make(study) for name, make in made.items()}, folder)
    (folder / "error.md").write_text(markdown.plain(text(study, folder)), encoding="utf-8")


def points_frame(study: Study) -> pd.DataFrame:
    """Every mark of the figures: one series on one scene."""
    return pd.DataFrame(
        {
            **{"scene_class": point.group.scene_class, "scene": point.group.scene},
            **{"n": point.group.n, "true_pairs": point.group.truth_pairs},
            **{"backend": point.series.backend, "predicate": point.series.predicate},
            **{"method": point.row.impl.method, "rule": point.row.impl.rule},
            **{"threads": point.row.impl.threads, "claims_exact": point.claimed},
            "ns_per_sphere": point.ns,
            **{"missed": point.row.missed, "false": point.row.false},
            "duplicates": point.row.duplicates,
            "missed_per_million": point.rate(point.missed),
            "false_per_million": point.rate(point.false),
            "bound_per_million": 3 * MILLION / point.pairs if point.pairs else None,
            **{"worst_missed_depth": point.depth, "worst_false_gap": point.gap},
            "candidates": point.row.candidates,
            "distinct_checksums": point.row.distinct_checksums,
        }
        for point in study.points
    )


def costs_frame(study: Study) -> pd.DataFrame:
    return pd.DataFrame(
        {
            **{"scene": cost.place.scene, "n": cost.place.n, "backend": cost.backend},
            **frames.estimate("deciding_stages", cost.stages),
            **frames.estimate("whole", cost.whole),
            "rounds": cost.whole.rounds,
            "candidates_per_pair": cost.candidates,
        }
        for cost in study.costs
    )


def rounding_frame(study: Study) -> pd.DataFrame:
    return pd.DataFrame(
        {
            **{"scene": group.scene, "n": group.n, "true_pairs": group.truth_pairs},
            **{"lost": group.rounding.lost, "gained": group.rounding.gained},
        }
        for group in study.groups
        if group.rounding
    )


def text(study: Study, folder: Path) -> str:
    """Figures that lie in the folder, and the numbers as tables."""
    notes = [*captions.origins(study.results), captions.claims(study)]
    parts = [f"# {say('section_error').en}", markdown.english(notes)]
    for name in images.drawn(plots.ERROR_NAMES, folder):
        parts += markdown.chapter(name, markdown.picture(name))
    for name, table in {
        "costs": page_tables.costs(study),
        "rounding": page_tables.rounding(study),
    }.items():
        if not table.empty:
            parts += markdown.chapter(name, markdown.table(page_tables.english(table)))
    return "\n\n".join(parts) + "\n"
