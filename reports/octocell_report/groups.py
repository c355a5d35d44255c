# SPDX-License-Identifier: MIT
"""What the rows of one scene at one size share: the scene, and what is true of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from octocell_report.fields import Fields, is_bool, is_filled, is_object, is_text, is_whole, or_null
from octocell_report.predicates import Rounded, class_of, rounding_of


class Place(NamedTuple):
    """Where it is compared: one scene at one size."""

    scene: str
    n: int


@dataclass(frozen=True)
class Group:
    scene: str
    n: int
    spec: str
    real: bool
    unavailable: str | None
    truth_pairs: int | None
    truth_checksum: str | None
    scene_class: str | None  # of the error study's scenes
    rounding: Rounded | None

    @property
    def place(self) -> Place:
        return Place(self.scene, self.n)


def group_of(item: Any, index: int) -> Group:
    fields = Fields(item, f"group {index}")
    scene, n = fields.take("scene", is_filled), fields.take("n", is_whole)
    fields.title = f"group {index} (scene {scene}, n {n})"
    truth = fields.take("truth", or_null(is_object))
    pairs = checksum = None
    if truth is not None:
        known = Fields(truth, f"{fields.title}: truth")
        pairs, checksum = known.take("pairs", is_whole), known.take("checksum", is_text)
    return Group(
        scene=scene,
        n=n,
        spec=fields.take("spec", is_text),
        real=fields.take("real", is_bool),
        unavailable=fields.take("unavailable", or_null(is_text)),
        truth_pairs=pairs,
        truth_checksum=checksum,
        scene_class=class_of(fields),
        rounding=rounding_of(fields),
    )
