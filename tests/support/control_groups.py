# SPDX-License-Identifier: MIT
"""Control groups for a test: limits as a container has them; version 1 or 2, made by root."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import pytest

MOUNTS = Path("/sys/fs/cgroup")


@dataclass(frozen=True)
class ControlGroup:
    path: Path

    @staticmethod
    def make(controller: str, limits: dict[str, str]) -> Iterator[ControlGroup]:
        """The limits are files of version 1 or 2; those that this system lacks are left out."""
        first = MOUNTS / controller
        parent = first if first.is_dir() else MOUNTS
        group = ControlGroup(parent / f"octocell-test-{os.getpid()}")
        try:
            group.path.mkdir()
            written = [group._set(name, value) for name, value in limits.items()]
        except OSError as reason:
            with suppress(OSError):
                group.path.rmdir()
            pytest.skip(f"no control group can be made here: {reason}")
        if not any(written):
            group.path.rmdir()
            pytest.skip(f"control groups here do not limit {controller}")
        yield group
        group.path.rmdir()

    def _set(self, name: str, value: str) -> bool:
        file = self.path / name
        if not file.exists():
            return False
        file.write_text(value, encoding="ascii")
        return True

    def enter(self) -> None:
        """For preexec_fn: the program runs in the group."""
        (self.path / "cgroup.procs").write_text(str(os.getpid()), encoding="ascii")
