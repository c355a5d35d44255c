# SPDX-License-Identifier: MIT
"""The program under test: OCTOCELL_BIN, or build/octocell."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import pytest

from program import ROOT, Octocell, Refused

# Tests share the cores; a thread of OpenMP's that waits must not spin.
os.environ.setdefault("OMP_WAIT_POLICY", "passive")


@pytest.fixture(scope="session")
def octocell() -> Octocell:
    path = Path(os.environ.get("OCTOCELL_BIN", ROOT / "build" / "octocell")).resolve()
    if not os.access(path, os.X_OK):
        pytest.fail(f"no program {path}: build it, or set OCTOCELL_BIN", pytrace=False)
    return Octocell(path)


@pytest.fixture
def refused(octocell: Octocell, tmp_path: Path) -> Refused:
    """Runs the program in tmp_path, checks that it refuses as it should, returns its one line."""

    def check(*args: object, **options: Any) -> str:
        before = _contents(tmp_path)
        result = octocell.run(*args, cwd=tmp_path, **options)
        assert result.rc == 2, f"exit {result.rc}, expected 2: {result.stderr}"
        assert result.stdout == ""
        assert result.stderr.endswith("\n"), repr(result.stderr)
        lines = result.stderr.splitlines()
        assert len(lines) == 1, result.stderr
        assert re.match(r"octocell: .{10}", lines[0]), lines[0]
        assert _contents(tmp_path) == before, "files were left or changed"
        return lines[0]

    return check


def _contents(folder: Path) -> dict[str, bytes | None]:
    """Every path below, with the bytes of the regular files."""
    return {
        str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None
        for path in folder.rglob("*")
    }
