# SPDX-License-Identifier: MIT
"""Asks `octocell judge`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from hand_ins import Pairs
from hard_scenes import Spheres
from program import Octocell


class Judge:
    """Saves scenes and lists, and asks."""

    def __init__(self, octocell: Octocell, folder: Path) -> None:
        self.octocell, self.folder = octocell, folder

    def save(self, scene: Spheres) -> Path:
        np.save(self.folder / "scene.npy", scene)
        return self.folder / "scene.npy"

    def truth(self, scene: object) -> Pairs:
        self.octocell.ok("find", scene, "-o", self.folder / "truth.npy")
        found: Pairs = np.load(self.folder / "truth.npy").astype(np.int64)
        return found

    def __call__(self, scene: object, pairs: Any) -> dict[str, Any]:
        np.save(self.folder / "list.npy", np.asarray(pairs))
        result = self.octocell.run("judge", scene, self.folder / "list.npy", "--json")
        answer: dict[str, Any] = json.loads(result.stdout)
        assert result.rc == {"exact": 0, "wrong": 1}[answer["verdict"]], result.stderr
        return answer

    def cause(self, scene: object, pairs: Any) -> str | None:
        cause = self(scene, pairs)["cause"]
        return None if cause is None else cause["name"]
