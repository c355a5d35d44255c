# SPDX-License-Identifier: MIT
from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

import synthetic
from synthetic import Json

Save = Callable[[Json], Path]


@pytest.fixture
def save(tmp_path: Path) -> Save:
    """Writes a document as result.json and says where."""

    def write(document: Json) -> Path:
        path = tmp_path / "result.json"
        path.write_text(json.dumps(document), encoding="utf-8")
        return path

    return write


@pytest.fixture
def every_case() -> Json:
    return synthetic.every_case()
