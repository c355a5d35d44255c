# SPDX-License-Identifier: MIT
"""When and from which commit a script's JSON was made."""

from __future__ import annotations

import subprocess
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]


def context() -> dict[str, Any]:
    """Empty commit where there is no repository, as in an unpacked archive."""
    changes = _git("status", "--porcelain", "--untracked-files=no")
    return {
        "date": datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "commit": _git("rev-parse", "HEAD"),
        "dirty": bool(changes),
    }


def _git(*what: str) -> str:
    command = ["git", "-C", str(ROOT), *what]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()
