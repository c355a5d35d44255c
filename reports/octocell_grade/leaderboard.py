# SPDX-License-Identifier: MIT
"""A page with all hand-ins, the best first."""

from __future__ import annotations

import os
import platform
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader

from octocell_grade.grade import Settings, times_of

Json = dict[str, Any]


def leaderboard(grades: list[Json], settings: Settings) -> str:
    environment = Environment(loader=PackageLoader("octocell_grade", ""), autoescape=True)
    rows = [_row(found, settings) for found in grades]
    rows.sort(key=lambda row: (-row["total"], row["ms"] if row["ms"] is not None else 1e300))
    template = environment.get_template("leaderboard.html.j2")
    return template.render(rows=rows, rubric=settings.rubric, machine=_machine())


def _row(found: Json, settings: Settings) -> Json:
    trial = found["trial"]
    mine, reference = times_of(trial, settings.rubric.speed)
    judgement = trial.get("judgement") or {}
    wrong = sum(judgement.get(kind, 0) for kind in ("missed", "false", "duplicates"))
    cause = trial.get("cause") or {}
    return {
        "name": found["name"],
        "language": found["language"],
        "verdict": found["verdict"],
        "total": found["total"],
        "ms": mine,
        "times": mine / reference if mine and reference else None,
        "wrong": f"{wrong} of {judgement['pairs']} pairs" if judgement else "",
        "why": cause.get("name") or trial.get("kind") or "",
        "at": trial.get("at") or "",
    }


def _machine() -> str:
    """The processor, its threads and the system."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    processor = names[0] if names else platform.processor() or platform.machine()
    return f"{processor}, {os.cpu_count()} threads, {platform.system()} {platform.release()}"
