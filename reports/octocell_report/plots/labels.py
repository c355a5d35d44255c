# SPDX-License-Identifier: MIT
"""Labels beside their marks, each where it hides least: greedy, in pixels, always the same."""

from __future__ import annotations

from typing import Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

# Where a label may stand beside its mark: by how many points it is moved, and its alignment.
_NEAR, _FAR, _FARTHEST = 8, 17, 28
_SIDES = (
    (_NEAR, 0, "left", "center"),
    (-_NEAR, 0, "right", "center"),
    (0, _NEAR, "center", "bottom"),
    (0, -_NEAR, "center", "top"),
    *(
        (sign * _NEAR * 0.8, height * step, side, base)
        for step in (_NEAR, _FAR, _FARTHEST)
        for sign, side in ((1, "left"), (-1, "right"))
        for height, base in ((1, "bottom"), (-1, "top"))
    ),
)
_STRAY = 40.0  # what a label may hide, in square pixels, rather than move one step on
_OUTSIDE = 1e9


class Box(NamedTuple):
    left: float
    bottom: float
    right: float
    top: float

    def shared(self, other: Box) -> float:
        """Area of what both cover."""
        wide = min(self.right, other.right) - max(self.left, other.left)
        high = min(self.top, other.top) - max(self.bottom, other.bottom)
        return wide * high if wide > 0 and high > 0 else 0.0

    def within(self, other: Box) -> bool:
        return (
            self.left >= other.left
            and self.right <= other.right
            and self.bottom >= other.bottom
            and self.top <= other.top
        )


class Placer:
    """For one pair of axes, whose limits must not change any more; marks first, then labels."""

    def __init__(self, figure: Figure, ax: Axes) -> None:
        self._ax = ax
        self._renderer: Any = figure.canvas.get_renderer()  # type: ignore[attr-defined]
        self._taken: list[tuple[Box, float]] = []
        self._frame = Box(*ax.get_window_extent(self._renderer).extents)

    def mark(self, x: float, y: float, size: float, weight: float) -> None:
        """Something that labels should not hide; size is in points."""
        across, up = self._pixels(x, y)
        half = 0.5 * size * self._ax.figure.dpi / 72
        self._taken.append((Box(across - half, up - half, across + half, up + half), weight))

    def text(self, box: Any) -> None:
        """A text that stands there already."""
        self._taken.append((Box(*box.get_window_extent(self._renderer).extents), 10.0))

    def label(self, text: str, anchors: list[tuple[float, float]], **look: Any) -> None:
        """Beside one of these marks; the first is liked best."""
        best: tuple[float, tuple[float, ...], tuple[Any, ...]] | None = None
        for number, anchor in enumerate(anchors):
            for step, side in enumerate(_SIDES):
                note = self._note(text, anchor, side, look)
                cost = self._cost(note) + _STRAY * (step + 0.5 * number)
                note.remove()
                if best is None or cost < best[0]:
                    best = cost, anchor, side
        if best is not None:
            self.text(self._note(text, best[1], best[2], look))

    def _cost(self, note: Any) -> float:
        box = Box(*note.get_window_extent(self._renderer).extents)
        hidden = sum(weight * box.shared(other) for other, weight in self._taken)
        return hidden if box.within(self._frame) else hidden + _OUTSIDE

    def _note(
        self, text: str, anchor: tuple[float, ...], side: tuple[Any, ...], look: dict[str, Any]
    ) -> Any:
        across, up, ha, va = side
        where = {"xytext": (across, up), "textcoords": "offset points", "ha": ha, "va": va}
        return self._ax.annotate(text, (anchor[0], anchor[1]), **where, **look)

    def _pixels(self, x: float, y: float) -> tuple[float, float]:
        across, up = self._ax.transData.transform((x, y))
        return float(across), float(up)
