# SPDX-License-Identifier: MIT
"""One page with everything in it, in two languages: no network; images, style and script inside."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd
from jinja2 import Environment, PackageLoader, StrictUndefined

from octocell_report import (
    captions,
    check,
    frames,
    front,
    images,
    page_tables,
    plots,
    study_files,
)
from octocell_report.error import Study
from octocell_report.files import staged_folder
from octocell_report.images import Picture
from octocell_report.load import Result
from octocell_report.texts import TEXTS, Said, say

# Pictures and tables of each section, in order; correctness first: a time counts only after it.
_SECTIONS = {
    "correctness": ("correctness", "wrong", "skipped", "unavailable"),
    "time": ("time_warm", "time_cold", "time_first_update", "time_update", "times"),
    "speed": ("speed_warm", "speed_cold", "speed_first_update", "speed_update", "speedups"),
    "moving": ("dynamic", "frames"),
    "stages": ("stages_backend", "stages_device", "stages_baseline", "stages_per_sphere"),
    "device": ("gpu", "bandwidth", "bandwidth_by_size"),
    "memory": ("memory",),
    "ablation": ("ablation_skips", "ablation_steps", "ablation_regret", "regret"),
    "error": ("error_pareto", "error_depth", "error_map", "costs", "rounding"),
}
# Shown when asked for: tables behind pictures, and pictures that vary the one before.
_FOLDED = {
    *("wrong", "skipped", "times", "speedups", "frames", "regret", "costs", "rounding"),
    *("time_cold", "time_first_update", "time_update", "stages_baseline", "stages_per_sphere"),
    *("speed_cold", "speed_first_update", "speed_update", "bandwidth_by_size"),
}


@dataclass(frozen=True)
class Block:
    """A picture or a table, with the texts title_NAME and how_NAME."""

    name: str
    shown: Picture | pd.DataFrame

    @property
    def folded(self) -> bool:
        return self.name in _FOLDED


@dataclass(frozen=True)
class Section:
    name: str
    notes: list[Said]  # with numbers in them
    blocks: list[Block]


def owned_names() -> set[str]:
    """Every file that a build may write."""
    tables = {f"{name}.csv" for name in frames.NAMES}
    return {"index.html"} | images.files_of(plots.NAMES) | tables


def build(
    result: Result,
    folder: Path,
    ablation: Result | None = None,
    error: Study | None = None,
    inputs: Sequence[Path] = (),
) -> list[str]:
    """Writes plots, tables and index.html; returns the names written. All or nothing.

    Without an ablation its files, which another command may have written there, are left alone; so
    are those of run time against error.
    """
    studies = [study_files.of_ablation(ablation)] if ablation else []
    studies += [study_files.of_error(error)] if error else []
    owned = owned_names().union(*(study.owned for study in studies))
    with staged_folder(folder, owned, inputs) as staging:
        images.write(plots.draw_all(result), staging)
        for study in studies:
            study.write(staging)
        frames.write(frames.all_frames(result), staging)
        html = render(result, staging, ablation, error)
        (staging / "index.html").write_text(html, encoding="utf-8")
        return sorted(path.name for path in staging.iterdir())


def render(
    result: Result, folder: Path, ablation: Result | None = None, error: Study | None = None
) -> str:
    """The page, with those plots that lie in the folder."""
    environment = Environment(
        loader=PackageLoader("octocell_report", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    verdict, tables = check.judge(result), page_tables.all_tables(result, ablation, error)
    return environment.get_template("page.html.j2").render(
        **{"say": say, "texts": TEXTS, "cells": page_tables.cells, "heading": page_tables.heading},
        context=result.context,
        headline=verdict.headline,
        exact=verdict.passes,
        first=captions.first_scene(result),
        front=images.picture(folder / "front.png"),
        run=say(f"run_{front.run_shown(result)}"),
        best=tables.get("best"),
        facts=captions.facts(result),
        sections=_sections(folder, tables, _notes(result, ablation, error)),
    )


def _notes(result: Result, ablation: Result | None, error: Study | None) -> dict[str, list[Said]]:
    """Captions with numbers, by section."""
    notes = {"correctness": captions.counts(result, check.judge(result))}
    if ablation:
        notes["ablation"] = captions.ablation(ablation)
    if error:
        notes["error"] = [*captions.origins(error.results), captions.claims(error)]
    return notes


def _sections(
    folder: Path, tables: dict[str, pd.DataFrame], notes: dict[str, list[Said]]
) -> list[Section]:
    """Those with something in them."""
    found = []
    for section, names in _SECTIONS.items():
        blocks = [
            Block(name, shown)
            for name in names
            if (shown := tables.get(name, images.picture(folder / f"{name}.png"))) is not None
        ]
        if blocks or section in notes:
            found.append(Section(section, notes.get(section, []), blocks))
    return found
