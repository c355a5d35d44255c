# SPDX-License-Identifier: MIT
"""The README's tables of a bench: what is right, how fast it is, on which machine."""

from __future__ import annotations

from statistics import median

import pandas as pd

from octocell_report import tables, words
from octocell_report.fields import ReportError
from octocell_report.load import Impl, Place, Result, Row
from octocell_report.markdown import table

SCENE = "gas"  # the plain scene: the table of speeds is about it alone
NAMED = "bullet_dbvt"  # the baseline that ratios are also given to by name
RUNS = ("cold", "warm")


def speed(result: Result) -> str:
    """Ratios first: they carry over to other machines better than times do."""
    place = tables.compared(result, SCENE, "warm") or result.largest(SCENE)
    if place is None:
        raise ReportError(f"block 'speed' needs the scene {SCENE}, which the result does not have")
    titles = words.titles(result)
    references = _references(result, place)
    header = ["implementation", *(f"vs {name}" for name in references)]
    header += [f"{run} [ms]" for run in RUNS]
    lines = []
    for impl in result.impls:
        rows = {r.run: r for run in RUNS for r in result.at(place, run) if r.impl == impl}
        if rows:
            lines.append([titles[impl], *_speeds(rows, references)])
    named = [_named(name, rows) for name, rows in references.items() if name != NAMED]
    note = (
        f"Scene {SCENE}, {words.grouped(place.n)} spheres. Ratios are cold / warm, baseline time "
        "by the row's time within interleaved rounds, median; above 1 is faster than the baseline. "
        "Times are this machine's."
    )
    return table(pd.DataFrame(lines, columns=header), " ".join([note, *named]))


def _named(name: str, rows: dict[str, Row]) -> str:
    """'The fastest FCL is `...`.', once if it is the same in all runs."""
    met = {run: f"`{row.impl.backend}`" for run, row in rows.items()}
    if len(set(met.values())) == 1:
        return f"The {name} is {next(iter(met.values()))}."
    return f"The {name} is {', '.join(f'{label} ({run})' for run, label in met.items())}."


def _references(result: Result, place: Place) -> dict[str, dict[str, Row]]:
    """By column: the row that others are held against, by run."""
    found: dict[str, dict[str, Row]] = {}
    for run in RUNS:
        rows = result.at(place, run)
        for family in tables.families(result):
            row = tables.fastest(rows, family)
            if row is not None:
                found.setdefault(f"fastest {words.family_title(family)}", {})[run] = row
    for run in RUNS:
        for row in result.at(place, run):
            if row.impl.backend == NAMED and row.kind == "baseline" and row.counts:
                found.setdefault(NAMED, {})[run] = row
    return found


def _speeds(rows: dict[str, Row], references: dict[str, dict[str, Row]]) -> list[str]:
    """The row's cells after its name; what is not exact gets its verdict and no numbers."""
    first = next(iter(rows.values()))
    bad = [row for row in rows.values() if row.status != "skipped" and not row.counts]
    if bad:
        return [words.verdict(bad[0]), *[words.NONE] * (len(references) + len(RUNS) - 1)]
    if all(row.status == "skipped" for row in rows.values()):
        why = f"skipped: {words.short_reason(first.reason, 60)}"
        return [why, *[words.NONE] * (len(references) + len(RUNS) - 1)]
    cells = [
        " / ".join(_ratio(rows.get(run), of.get(run)) for run in RUNS) for of in references.values()
    ]
    return cells + [words.number(rows[run].median_ms if run in rows else None) for run in RUNS]


def _ratio(row: Row | None, reference: Row | None) -> str:
    if row is None or reference is None or not row.counts:
        return words.NONE
    rounds = tables.round_ratios(reference, row)
    return words.ratio(median(rounds)) if rounds else words.NONE


def moving(result: Result) -> str:
    """The same for scenes that move, at the largest size of each: a frame's time, once settled."""
    ratios = tables.ratios(result, "dynamic")
    if not ratios:
        raise ReportError("block 'moving' needs a moving scene, which the result does not have")
    titles, families = words.titles(result), tables.families(result)
    largest = {scene: result.largest(scene) for scene in result.scenes}
    header = ["scene", "spheres", "implementation", "frame [ms]"]
    header += [f"vs fastest {words.family_title(family)}" for family in families]
    lines = []
    for place in dict.fromkeys(r.place for r in ratios if r.place == largest[r.place.scene]):
        for row in result.at(place, "dynamic"):
            held = {r.family: r for r in ratios if (r.impl, r.place) == (row.impl, place)}
            if held:
                cells = [words.ratio(held[f].median) if f in held else words.NONE for f in families]
                time = words.number(row.median_ms)
                size = words.grouped(place.n)
                lines.append([place.scene, size, titles[row.impl], time, *cells])
    note = (
        "Median frame after those that settle a structure. We rebuild each frame unless we can "
        "prove that nothing relevant moved; a library updates its structure. The ratio is the "
        "library's fastest frame time by the row's."
    )
    return table(pd.DataFrame(lines, columns=header), note)


def correctness(result: Result) -> str:
    """Implementations that are wrong somewhere, by scene; all others in one line."""
    titles, cells = words.titles(result), tables.correctness(result)
    lines: list[list[str]] = []
    exact: list[str] = []
    absent: list[str] = []
    for impl in result.impls:
        states = {cells[impl, group.place].state for group in result.groups}
        if states & {"wrong", "negative_control"}:
            here = [_scene_cell(result, cells, impl, scene) for scene in result.scenes]
            lines.append([titles[impl], *here])
        else:
            (exact if "exact" in states else absent).append(f"`{titles[impl]}`")
    note = (
        f"{words.MINUS} pairs missed, + pairs that are none, × pairs given more than once; at the "
        "largest size that is wrong."
    )
    said = [
        f"Exact wherever they ran, of {len(result.groups)} scenes and sizes: {', '.join(exact)}."
    ]
    said += [f"Not run here: {', '.join(absent)}."] if absent else []
    wrong = [table(pd.DataFrame(lines, columns=["wrong", *result.scenes]), note)] if lines else []
    return "\n\n".join([" ".join(said), *wrong])


def _scene_cell(
    result: Result, cells: dict[tuple[Impl, Place], tables.Cell], impl: Impl, scene: str
) -> str:
    groups = sorted((g for g in result.groups if g.scene == scene), key=lambda g: g.n)
    here = [(group.n, cells[impl, group.place]) for group in groups]
    wrong = [(n, cell) for n, cell in here if cell.state in ("wrong", "negative_control")]
    if wrong:
        n, cell = wrong[-1]
        return f"**{cell.text}** at {words.size(n)}"
    exact = sum(cell.state == "exact" for _, cell in here)
    if exact == len(here):
        return "exact"
    if exact:
        return f"exact, {exact} of {len(here)} sizes"
    return {"unavailable": "not there", "skipped": "skipped"}.get(here[-1][1].state, words.NONE)


def machine(result: Result) -> str:
    """One line: what the numbers beside it belong to."""
    context, box = result.context, result.context["machine"]
    dirty = " with uncommitted changes" if context["dirty"] else ""
    parts = [
        *([result.gpu.name] if result.gpu else []),
        f"{box['cpu']}, {box['cores']} cores, {box['memory_bytes'] / 1e9:.0f} GB, {box['os']}",
        f"{context['compiler']} ({context['build_type']}, `{context['flags']}`)",
        f"commit {context['commit'][:12]}{dirty}",
        context["date"][:10],
    ]
    if not context["finished"]:
        parts.append("run interrupted")
    return "; ".join(parts) + "."
