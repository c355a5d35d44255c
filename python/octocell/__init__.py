# SPDX-License-Identifier: MIT
"""Finds every pair of overlapping spheres, exactly.

>>> import octocell
>>> list(octocell.pairs([[0, 0, 0], [1.5, 0, 0], [9, 9, 9]], 1))
[(0, 1)]
"""

from ._errors import InvalidSphere, LimitError, Unavailable
from ._finder import Finder
from ._native import version as __version__
from ._pairs import Pairs, Rounding
from ._search import (
    Plan,
    Verification,
    chunks,
    count,
    flags,
    pairs,
    plan,
    verify,
    why_unavailable,
)

__all__ = [
    "Finder",
    "InvalidSphere",
    "LimitError",
    "Pairs",
    "Plan",
    "Rounding",
    "Unavailable",
    "Verification",
    "__version__",
    "chunks",
    "count",
    "flags",
    "pairs",
    "plan",
    "verify",
    "why_unavailable",
]

for _public in (
    Finder,
    InvalidSphere,
    LimitError,
    Pairs,
    Plan,
    Rounding,
    Unavailable,
    Verification,
):
    _public.__module__ = "octocell"  # as users see them in messages
