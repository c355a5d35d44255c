# SPDX-License-Identifier: MIT
"""Moving scenes: the times of single frames, as a dynamic row holds them in its field 'frames'."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import median

from octocell_report.fields import Fields, ReportError, is_filled, is_frames, is_object, is_whole


@dataclass(frozen=True)
class Motion:
    scene: str  # how the spheres move: brownian, gravity, ...
    frame_ms: tuple[tuple[float, ...], ...]  # by round, then by frame; all rounds alike in length
    warmup: int  # so many frames at the start do not count

    @property
    def by_frame(self) -> list[float]:
        """Median over the rounds, frame by frame, warm-up included."""
        return [median(times) for times in zip(*self.frame_ms, strict=True)]

    @property
    def steady(self) -> tuple[float, ...]:
        """Median over the frames after the warm-up (of all, if there are no others), by round."""
        return tuple(median(times[self.warmup :] or times) for times in self.frame_ms)


def motion_of(row: Fields) -> Motion | None:
    """The row's frames, checked; None where it has none."""
    if row.value.get("frames") is None:
        return None
    fields = Fields(row.take("frames", is_object), f"{row.title}: frames")
    times = fields.take("frame_ms", is_frames)
    found = Motion(
        scene=fields.take("scene", is_filled),
        frame_ms=tuple(tuple(frames) for frames in times),
        warmup=fields.take("warmup_frames", is_whole),
    )
    lengths = {len(frames) for frames in found.frame_ms}
    if len(lengths) != 1:
        raise ReportError(f"{fields.title}: field 'frame_ms' has rounds of unlike length")
    if lengths == {0}:
        raise ReportError(f"{fields.title}: field 'frame_ms' has no frame")
    return found
