# SPDX-License-Identifier: MIT
"""The Python module of the build that is under test: python/ beside OCTOCELL_BIN."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
from program import ROOT

PACKAGE = Path(os.environ.get("OCTOCELL_BIN", ROOT / "build" / "octocell")).parent / "python"
IS_BUILT = any((PACKAGE / "octocell").glob("_native*.so"))
collect_ignore_glob = [] if IS_BUILT or os.environ.get("CI") else ["test_python_*.py"]
if IS_BUILT:
    sys.path.insert(0, str(PACKAGE.resolve()))
    # Programs that tests start find it, too.
    os.environ["PYTHONPATH"] = os.pathsep.join(
        [str(PACKAGE.resolve()), *filter(None, [os.environ.get("PYTHONPATH")])]
    )


def pytest_report_header() -> str | None:
    if IS_BUILT:
        return None
    return f"tests/python is left out: no Python module in {PACKAGE} (needs python3-dev, nanobind)"


@pytest.fixture(scope="session")
def package() -> Path:
    """The folder that holds the package octocell."""
    return PACKAGE.resolve()
