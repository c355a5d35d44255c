# SPDX-License-Identifier: MIT
"""What every reader gives: the atoms of one frame, still as the file has them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

# Decimals stay text until they are rounded, once; binary formats give arrays.
Column = Sequence[str] | NDArray[np.floating[Any]]


@dataclass
class Frame:
    xyz: tuple[Column, Column, Column]  # [count] each, in `unit`
    unit: str | None  # "angstrom", "nm", or None: the file has a unit of its own
    labels: list[str]  # [count] atom name or type as in the file; empty: all alike
    elements: list[str | None]  # [count] symbol, None: unknown; empty: no atoms, points
    radii: Column | None = None  # [count] in `unit`
    lines: Sequence[int] = ()  # [count] from 1; empty: the file has no lines
    elements_from: str = ""  # where the reader found them
    remarks: list[str] = field(default_factory=list)  # what the reader assumed

    @property
    def count(self) -> int:
        return len(self.xyz[0])

    def place(self, atom: int) -> str:
        """Where in the file: people look for lines, else they count atoms from 1."""
        return f"line {self.lines[atom]}" if len(self.lines) else f"atom {atom + 1}"
