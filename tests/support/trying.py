# SPDX-License-Identifier: MIT
"""Asks `octocell try`."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from program import Octocell, Result


class Try:
    """Saves hand-ins, and asks."""

    def __init__(self, octocell: Octocell, folder: Path) -> None:
        self.octocell, self.folder = octocell, folder

    def run(self, text: str, *options: str, name: str = "mine.cpp") -> Result:
        (self.folder / name).write_text(text, encoding="utf-8")
        if "--budget" not in options:
            options = ("--budget", "0.01", *options)
        options = ("--python", sys.executable, *options)
        return self.octocell.run("try", self.folder / name, *options, timeout=300)

    def __call__(self, text: str, *options: str, name: str = "mine.cpp") -> dict[str, Any]:
        result = self.run(text, "--json", *options, name=name)
        assert result.stderr == ""
        answer: dict[str, Any] = json.loads(result.stdout)
        expected = {"exact": 0, "wrong": 1, "cannot be judged": 2}[answer["verdict"]]
        assert result.rc == expected
        return answer

    def ending(self, text: str, *options: str, name: str = "mine.cpp") -> str:
        """Why it cannot be judged."""
        answer = self(text, *options, name=name)
        assert answer["verdict"] == "cannot be judged", answer
        return f"{answer['kind']}: {answer['reason']}"
