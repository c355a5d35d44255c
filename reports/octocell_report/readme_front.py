# SPDX-License-Identifier: MIT
"""The README's three numbers, a sentence each in both languages."""

from __future__ import annotations

from octocell_report import readme_gpu, readme_kinds, tables, words
from octocell_report.fields import ReportError
from octocell_report.language import listed, tell
from octocell_report.load import Place, Result


def libraries(result: Result, language: str = "en") -> str:
    """How many times as fast as each library's fastest our plan is, at the first scene, cold."""
    place = result.groups[0].place
    rows = result.at(place, "cold")
    ours = [row for row in rows if row.impl.method == readme_kinds.PLANNED and row.counts]
    if not ours:
        raise ReportError("block 'front_libraries' needs an exact cold row of a plan")
    best = min(ours, key=lambda row: row.median_ms)
    parts = []
    for family in tables.families(result):
        row = tables.fastest(rows, family)
        if row is not None:
            times = readme_kinds.ratio(row.round_ms, best.round_ms).median
            values = {"times": f"{times:.0f}", "family": words.family_title(family)}
            parts.append(tell(language, "front_library", **values))
    return tell(
        language,
        "front_libraries",
        libraries=listed(parts, language),
        n=words.grouped(place.n),
        ms=words.number(best.median_ms),
        machine=result.context["machine"]["cpu"],
        commit=result.context["commit"][:8],
    )


def gpu(result: Result, language: str = "en") -> str:
    """The time of a million spheres that lie on the device."""
    row = readme_gpu.fastest(result, Place(readme_gpu.SCENE, 1_000_000), readme_gpu.OURS)
    if row is None or result.gpu is None:
        raise ReportError("block 'front_gpu' needs an exact warm row of a million spheres")
    known = {"ms": words.number(row.median_ms), "gpu": result.gpu.name}
    return tell(language, "front_gpu", **known, commit=result.context["commit"][:8])
