# SPDX-License-Identifier: MIT
"""Every file includes the standard headers that it uses, because which header includes which other
one differs from compiler to compiler, and from release to release."""

from __future__ import annotations

from pathlib import Path

import pytest

from standard_headers import HEADER_OF, missing, names_used
from test_layout import CPP, files, name_of


@pytest.mark.parametrize("path", list(files(suffixes=CPP)), ids=name_of)
def test_standard_headers_are_included(path: Path) -> None:
    unknown = names_used(path.read_text(encoding="utf-8")) - HEADER_OF.keys()
    assert not unknown, f"to be added to tests/layout/standard_headers.py: {sorted(unknown)}"
    lacking = missing(path)
    assert not lacking, f"python tests/layout/standard_headers.py --fix {name_of(path)}: {sorted(lacking)}"


def test_a_missing_header_is_seen(tmp_path: Path) -> None:
    """The line without which g++ 14 does not compile a test of the grid."""
    source = tmp_path / "a.cpp"
    source.write_text("#include <vector>\nint a = std::clamp(1, 2, 3);  // std::map\n")
    assert missing(source) == {"algorithm"}
    (tmp_path / "a.hpp").write_text("#include <algorithm>\n")
    assert missing(source) == set()
