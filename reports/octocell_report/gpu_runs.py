# SPDX-License-Identifier: MIT
"""The runs of a device's backend side by side, and the device memory that they take."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import median

from octocell_report import tables
from octocell_report.load import Impl, Place, Result, Row

RUNS = ("warm", "cold_cache", "graph", "transfers", "cold")  # from the barest time to the fullest


@dataclass(frozen=True)
class Runs:
    """One implementation at one place; runs that were not made are absent."""

    impl: Impl
    place: Place
    rows: dict[str, Row]

    def to_warm(self, run: str) -> float | None:
        """Its time by that of the warm run, within rounds, median; None unless both are exact."""
        row, warm = self.rows.get(run), self.rows.get("warm")
        if row is None or warm is None or not (row.counts and warm.counts):
            return None
        rounds = tables.round_ratios(row, warm)
        return median(rounds) if rounds else None

    @property
    def bytes_per_sphere(self) -> float | None:
        """The most of the runs."""
        known = [r.device_bytes for r in self.rows.values() if r.device_bytes is not None]
        return max(known) / self.place.n if known and self.place.n else None


def all_runs(result: Result) -> list[Runs]:
    """By scene, size and implementation, where a device's row ran."""
    rows = {(r.impl, r.place, r.run): r for r in result.rows if r.status != "skipped"}
    found = []
    for scene in result.scenes:
        for place in (Place(scene, n) for n in result.sizes(scene)):
            for impl in result.impls_of("device"):
                here = {run: rows[impl, place, run] for run in RUNS if (impl, place, run) in rows}
                if here:
                    found.append(Runs(impl, place, here))
    return found
