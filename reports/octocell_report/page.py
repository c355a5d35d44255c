# SPDX-License-Identifier: MIT
"""One page with everything in it, in two languages: no network; images, style and script inside."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import pandas as pd
from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from octocell_report import (
    captions,
    check,
    frames,
    front,
    images,
    page_tables,
    plots,
    study_files,
    words,
)
from octocell_report.error import Study
from octocell_report.files import staged_folder
from octocell_report.images import Gallery
from octocell_report.load import Result
from octocell_report.texts import TEXTS, how, say, title

# Pictures and tables of each section: those in sight, and those that unfold when asked for.
# Correctness comes first: a time counts only after it.
SECTIONS = {
    "correctness": ("correctness unavailable", "wrong skipped"),
    "time": ("time_warm", "time_cold time_first_update time_update times"),
    "speed": ("speed_warm", "speed_cold speed_first_update speed_update speedups"),
    "moving": ("dynamic", "frames"),
    "stages": ("stages_backend stages_device", "stages_baseline stages_per_sphere"),
    "device": ("gpu bandwidth", "bandwidth_by_size"),
    "memory": ("memory", ""),
    "ablation": ("ablation_skips ablation_steps ablation_regret", "regret"),
    "error": ("error_pareto error_depth error_map", "costs rounding"),
}


class Block(NamedTuple):
    name: str  # of its title, and of how to read it, in texts.py
    shown: Markup | pd.DataFrame  # a picture or a table
    in_sight: bool


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
    notes = {
        "correctness": captions.counts(result, verdict),
        "ablation": captions.ablation(ablation) if ablation else [],
        "error": captions.error(error) if error else [],
    }
    gallery = Gallery(folder)
    shown = {**gallery.pictures, **tables}
    sections = {name: _blocks(name, shown) for name in SECTIONS}
    return environment.get_template("page.html.j2").render(
        **{"say": say, "title": title, "how": how, "texts": TEXTS, "words": words},
        **{"cells": page_tables.cells, "heading": page_tables.heading},
        **{"headline": verdict.headline, "exact": verdict.passes},
        **{"context": result.context, "gpu": result.gpu, "commit": captions.commit(result)},
        front=gallery.pictures.get("front"),
        pictures_style=gallery.style,
        run=say(f"run_{front.run_shown(result)}"),
        first_scene=captions.first_scene(result),
        best=tables.get("best"),
        sections={name: blocks for name, blocks in sections.items() if blocks or notes.get(name)},
        notes=notes,
    )


def _blocks(section: str, shown: dict[str, Markup | pd.DataFrame]) -> list[Block]:
    return [
        Block(name, shown[name], in_sight)
        for names, in_sight in zip(SECTIONS[section], (True, False), strict=True)
        for name in names.split()
        if name in shown
    ]
