# SPDX-License-Identifier: MIT
"""What points are given for: a small TOML file."""

from __future__ import annotations

from pathlib import Path

import msgspec

from octocell_report.fields import ReportError
from octocell_report.files import read_text


class _Part(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    pass


class Correctness(_Part):
    """Points for each class of scenes that is exact."""

    small: float = 20
    kinds: float = 20
    stress: float = 20
    larger: float = 10


class Speed(_Part):
    """Full points at `full_at` times the reference's time, none at `none_at`; between by logarithm.

    The reference is measured in the same run, in turn with the hand-in.
    """

    points: float = 20
    scene: str = "gas"
    n: int = 10_000
    reference: str = "impl_cpu half_shell"
    full_at: float = 2
    none_at: float = 100


class Report(_Part):
    """Points for a file with one of these names beside the program."""

    points: float = 10
    names: tuple[str, ...] = ("report.pdf", "report.md")


class Rubric(_Part):
    correctness: Correctness = Correctness()
    speed: Speed = Speed()
    report: Report = Report()

    @property
    def most(self) -> float:
        points = msgspec.structs.astuple(self.correctness)
        return float(sum(points) + self.speed.points + self.report.points)


def read_rubric(path: Path | None) -> Rubric:
    if path is None:
        return Rubric()
    try:
        rubric = msgspec.toml.decode(read_text(path), type=Rubric)
    except msgspec.DecodeError as error:
        raise ReportError(f"{path}: {error}") from error
    if not 0 < rubric.speed.full_at < rubric.speed.none_at:
        raise ReportError(f"{path}: speed.full_at must be above 0 and below speed.none_at")
    return rubric
