# SPDX-License-Identifier: MIT
"""One hand-in: tried by octocell, and given its points."""

from __future__ import annotations

import json
import math
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec

from octocell_grade.hand_ins import LANGUAGES, HandIn, NoHandIn, has_report, program_of
from octocell_grade.rubric import Rubric, Speed

Json = dict[str, Any]
CLASSES = ("small", "kinds", "stress", "larger")


@dataclass(frozen=True)
class Settings:
    octocell: Path
    python: str
    seed: int
    budget: float
    timeout: float
    rubric: Rubric

    def key(self, hand_in: HandIn) -> Json:
        """A grade with the same key need not be found again."""
        return {
            "hand_in": hand_in.digest(),
            "seed": self.seed,
            "budget": self.budget,
            "timeout": self.timeout,
            "rubric": json.loads(msgspec.json.encode(self.rubric)),  # as it is read again
        }


def grade(hand_in: HandIn, settings: Settings) -> Json:
    """Never throws for what the hand-in is or does."""
    trial: Json = {"verdict": "cannot be judged", "kind": "no hand-in", "scenes": []}
    language, report = "", False
    try:
        with hand_in.unpacked() as place:
            program = program_of(place)
            language = LANGUAGES[program.suffix]
            report = has_report(place, settings.rubric.report.names)
            trial = _tried(program, settings)
    except (NoHandIn, OSError) as error:
        trial["reason"] = str(error)
    points = {**_correctness(trial, settings.rubric), **_speed(trial, settings.rubric.speed)}
    points["report"] = settings.rubric.report.points if report else 0.0
    return {
        "name": hand_in.name,
        "language": language,
        "verdict": trial["verdict"],
        "points": points,
        "total": round(sum(points.values()), 2),
        "trial": trial,
    }


def _tried(program: Path, settings: Settings) -> Json:
    options = ["--json", "--bench", "--python", settings.python, "--seed", settings.seed]
    limits = ["--budget", settings.budget, "--timeout", settings.timeout]
    command = [settings.octocell, "try", program.resolve(), *options, *limits]
    done = subprocess.run(
        [str(word) for word in command],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )
    try:
        trial: Json = json.loads(done.stdout)
    except ValueError:
        said = done.stderr.strip().splitlines() or [f"octocell ended with code {done.returncode}"]
        return {"verdict": "cannot be judged", "kind": "error", "reason": said[-1], "scenes": []}
    return trial


def _correctness(trial: Json, rubric: Rubric) -> dict[str, float]:
    """A class counts if none of its scenes was wrong and the trial went through all of it."""
    reached = [scene["class"] for scene in trial["scenes"]]
    ended_in = trial.get("class") if trial["verdict"] != "exact" else None
    points = {}
    for name in CLASSES:
        all_exact = trial["verdict"] == "exact" or (
            ended_in in CLASSES and CLASSES.index(name) < CLASSES.index(ended_in)
        )
        has_it = all_exact and (name in reached or name == "larger")
        points[name] = float(getattr(rubric.correctness, name)) if has_it else 0.0
    return points


def times_of(trial: Json, speed: Speed) -> tuple[float | None, float | None]:
    """The medians of the hand-in and of the reference, in milliseconds."""
    for scene in trial.get("bench") or []:
        if (scene["scene"], scene["n"]) == (speed.scene, speed.n):
            medians = {row["name"]: row["median"] for row in scene["rows"]}
            return medians.get("mine"), medians.get(speed.reference)
    return None, None


def _speed(trial: Json, speed: Speed) -> dict[str, float]:
    mine, reference = times_of(trial, speed)
    if trial["verdict"] != "exact" or not mine or not reference:
        return {"speed": 0.0}
    part = math.log(mine / reference / speed.none_at) / math.log(speed.full_at / speed.none_at)
    return {"speed": round(speed.points * min(1.0, max(0.0, part)), 2)}
