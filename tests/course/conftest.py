# SPDX-License-Identifier: MIT
"""The step page as `make steps` writes it, and a browser to look at it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from program import ROOT, Octocell


@pytest.fixture(scope="session")
def page(octocell: Octocell, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "steps.html"
    scenes = sorted((ROOT / "course/scenes").glob("*.csv"), key=lambda path: path.stem != "eight")
    octocell.ok("trace", *scenes, "--rule", "as_written", "--html", path)
    return path


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    from step_page import open_browser

    driver = open_browser()
    yield driver
    driver.quit()
