# SPDX-License-Identifier: MIT
"""One page with everything in it: no network, no scripts, images inside."""

from __future__ import annotations

import base64
import io
import math
from dataclasses import dataclass
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined
from matplotlib.figure import Figure
from PIL import Image

from octocell_report import check, findings, frames, plots, style, tables, words
from octocell_report.files import staged_folder
from octocell_report.load import Impl, Place, Result, Row

# name of the plot: heading, and how to read it
_HEADINGS = {
    "time_warm": (
        "Time against size, warm",
        "Warm: the pairs are found from nothing, in memory already touched. A line is the median "
        "of the rounds, its band the fastest to the slowest round. n^b is the slope fitted on the "
        "logarithms: 1 is linear, 2 is quadratic. Hollow crossed marks are not exact and get no "
        "line; what they miss and invent stands below them.",
    ),
    "time_cold": (
        "Time against size, cold",
        "Cold: create, plan, allocate and find, all from nothing.",
    ),
    "time_first_update": (
        "Time against size, first update",
        "As update, but the first one after the structure was built: trees whose boxes grow on "
        "first contact pay for it here.",
    ),
    "time_update": (
        "Time against size, update",
        "Update: the baseline's structure stands, every sphere is announced again, then all pairs "
        "are asked for. What a simulation would pay each frame.",
    ),
    "stages_backend": (
        "Stages of ours",
        "Each bar is one implementation, warm, at the scene's largest size. A fused stage has no "
        "bar of its own; the text says which stage holds its time. Scales differ from scene to "
        "scene.",
    ),
    "stages_baseline": (
        "Stages of the baselines",
        "Build makes the structure, query asks it for all pairs.",
    ),
    "stages_per_sphere": (
        "Stages per sphere",
        "The same divided by the number of spheres, on one scale for each backend.",
    ),
    "speed_warm": (
        "Speed against the baselines, warm",
        "Rounds were interleaved, so each ratio is taken within a round: drift of the machine "
        "cancels. The reference is the library's fastest exact row of that group, named in grey.",
    ),
    "speed_cold": ("Speed against the baselines, cold", "The same, all from nothing."),
    "speed_first_update": (
        "Speed against the baselines, first update",
        "The same, for the first update after building.",
    ),
    "speed_update": ("Speed against the baselines, update", "The same, structures standing."),
    "correctness": (
        "Correctness",
        f"Every row's pairs are held against the exact answer. {words.MINUS} counts pairs missed, "
        "+ pairs that are none, × pairs given more than once.",
    ),
    "memory": (
        "Memory",
        "Growth of resident memory over the scene, less the pairs themselves, per sphere.",
    ),
}


@dataclass(frozen=True)
class Section:
    name: str
    title: str
    sentences: list[str]  # computed: what is seen
    reading: str  # how to read it
    image: str  # data URI


def owned_names() -> set[str]:
    """Every file that a build may write."""
    images = {f"{name}.png" for name in plots.NAMES}
    return {"index.html"} | images | {f"{name}.csv" for name in frames.NAMES}


def build(result: Result, folder: Path) -> list[str]:
    """Writes plots, tables and index.html; returns the names written. All or nothing."""
    with staged_folder(folder, owned_names()) as staging:
        for name, figure in plots.draw_all(result):
            _save(figure, staging / f"{name}.png")
        for name, frame in frames.all_frames(result).items():
            if not frame.empty:
                frame.convert_dtypes().to_csv(staging / f"{name}.csv", index=False)
        (staging / "index.html").write_text(render(result, staging), encoding="utf-8")
        return sorted(path.name for path in staging.iterdir())


def _save(figure: Figure, path: Path) -> None:
    """With 256 colours: a third of the size, and no difference to the eye in a plot."""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=style.DPI)
    with Image.open(buffer) as image:
        image.convert("RGB").quantize(256).save(path, optimize=True)


def render(result: Result, images: Path) -> str:
    """The page, with those plots that lie in `images`."""
    environment = Environment(
        loader=PackageLoader("octocell_report", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    verdict = check.judge(result)
    return environment.get_template("page.html.j2").render(
        context=result.context,
        verdict=verdict,
        headline=check.headline(verdict),
        overview=findings.overview(result),
        memory_gb=f"{result.context['machine']['memory_bytes'] / 1e9:.1f}",
        sections=sections(result, images),
        times=[(scene, time_rows(result, scene)) for scene in result.scenes if result.sizes(scene)],
        runs=tables.runs(result),
        skipped=skipped_rows(result),
        unavailable=[group for group in result.groups if group.unavailable is not None],
    )


def sections(result: Result, images: Path) -> list[Section]:
    """In the order of _HEADINGS, correctness first: a time counts only after it."""
    found = []
    for name in ["correctness", *(name for name in _HEADINGS if name != "correctness")]:
        path = images / f"{name}.png"
        if path.exists():
            data = base64.b64encode(path.read_bytes()).decode("ascii")
            title, reading = _HEADINGS[name]
            image = f"data:image/png;base64,{data}"
            found.append(Section(name, title, _sentences(result, name), reading, image))
    return found


def _sentences(result: Result, name: str) -> list[str]:
    subject, _, variant = name.partition("_")
    if subject == "time":
        return findings.time(result, variant)
    if subject == "speed":
        return findings.speed(result, variant)
    if name == "stages_per_sphere":
        return findings.per_sphere(result)
    if subject == "stages":
        return findings.stages(result, variant)
    return findings.correctness(result) if name == "correctness" else findings.memory(result)


@dataclass(frozen=True)
class TimeRow:
    """One line of a scene's table: an implementation at one size, all its runs."""

    size: str
    first: bool  # of its size
    label: str
    state: str  # of the matrix
    times: list[tuple[str, str, str]]  # by run: median or verdict, spread, class
    ns_per_sphere: str
    candidates: str
    doubts: str


def time_rows(result: Result, scene: str) -> list[TimeRow]:
    labels, cells = words.labels(result), tables.correctness(result)
    found = []
    for n in result.sizes(scene):
        place, first = Place(scene, n), True
        for impl in result.impls:
            rows = {r.run: r for r in result.rows if r.impl == impl and r.place == place}
            if not rows:
                continue
            state = cells[impl, place].state
            found.append(_time_row(result, rows, (labels[impl], place, first, state)))
            first = False
    return found


def _time_row(result: Result, rows: dict[str, Row], head: tuple[str, Place, bool, str]) -> TimeRow:
    label, place, first, state = head
    warm = rows.get("warm") or next(iter(rows.values()))
    per_pair = tables.candidates_per_pair(result, warm)
    return TimeRow(
        size=words.size(place.n),
        first=first,
        label=label,
        state=state,
        times=[_time_cell(rows.get(run)) for run in tables.runs(result)],
        ns_per_sphere=words.number(tables.ns_per_sphere(warm)) if warm.counts else words.NONE,
        candidates=words.NONE if math.isnan(per_pair) else words.number(per_pair),
        doubts=words.NONE if warm.doubts is None else words.grouped(warm.doubts),
    )


def _time_cell(row: Row | None) -> tuple[str, str, str]:
    """A time that is not bare stands behind its verdict, in brackets."""
    if row is None:
        return words.NONE, "", "none"
    if row.status == "skipped":
        return "skipped", "", "none"
    if row.counts:
        return words.number(row.median_ms), words.spread(row.total_ms), "time"
    return words.verdict(row), f"({words.number(row.median_ms)} ms)", "bad"


def skipped_rows(result: Result) -> list[tuple[str, str, str, str]]:
    """(implementation, reason, places, runs): rows that were skipped alike share a line."""
    labels = words.labels(result)
    places: dict[tuple[Impl, str], dict[str, None]] = {}
    runs: dict[tuple[Impl, str], dict[str, None]] = {}
    for row in result.rows:
        if row.status == "skipped":
            key = row.impl, row.reason or ""
            places.setdefault(key, {})[words.place(row.place)] = None
            runs.setdefault(key, {})[row.run] = None
    return [
        (labels[impl], reason, ", ".join(places[impl, reason]), ", ".join(runs[impl, reason]))
        for impl, reason in places
    ]
