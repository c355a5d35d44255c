# SPDX-License-Identifier: MIT
"""One page with everything in it, in two languages: no network; images, style and script inside."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined

from octocell_report import (
    ablation_files,
    check,
    error_files,
    findings,
    findings_ablation,
    findings_error,
    findings_gpu,
    frames,
    images,
    language,
    page_ablation,
    page_error,
    page_tables,
    plots,
    words,
)
from octocell_report.error import Study
from octocell_report.files import staged_folder
from octocell_report.language import Said, all_of, both, say
from octocell_report.load import Result

# Correctness first: a time counts only after it.
_ORDER = (
    "correctness",
    *(f"time_{run}" for run in ("warm", "cold", "first_update", "update")),
    "dynamic",
    "stages_backend",
    "stages_device",
    "bandwidth",
    "bandwidth_by_size",
    "stages_baseline",
    "stages_per_sphere",
    *(f"speed_{run}" for run in ("warm", "cold", "first_update", "update")),
    "memory",
)


@dataclass(frozen=True)
class Section:
    name: str
    title: Said
    sentences: list[Said]  # computed: what is seen
    reading: Said  # how to read it
    image: str  # data URI


def owned_names() -> set[str]:
    """Every file that a build may write."""
    tables = {f"{name}.csv" for name in frames.NAMES}
    return {"index.html"} | images.files_of(plots.NAMES) | tables


def build(
    result: Result,
    folder: Path,
    ablation: Result | None = None,
    error: Study | None = None,
    inputs: Sequence[Path] = (),
) -> list[str]:
    """Writes plots, tables and index.html; returns the names written. All or nothing.

    Without an ablation its files, which another command may have written there, are left alone; so
    are those of run time against error.
    """
    owned = owned_names() | (ablation_files.owned_names() if ablation else set())
    owned |= error_files.owned_names() if error else set()
    with staged_folder(folder, owned, inputs) as staging:
        images.write(plots.draw_all(result), staging)
        if ablation:
            ablation_files.write(ablation, staging)
        if error:
            error_files.write(error, staging)
        frames.write(frames.all_frames(result), staging)
        html = render(result, staging, ablation, error)
        (staging / "index.html").write_text(html, encoding="utf-8")
        return sorted(path.name for path in staging.iterdir())


def render(
    result: Result, folder: Path, ablation: Result | None = None, error: Study | None = None
) -> str:
    """The page, with those plots that lie in the folder."""
    environment = Environment(
        loader=PackageLoader("octocell_report", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    verdict = check.judge(result)
    return environment.get_template("page.html.j2").render(
        say=say,
        texts=language.TEXTS,
        context=result.context,
        verdict=verdict,
        headline=both(lambda spoken: check.headline(verdict, spoken)),
        overview=all_of(lambda spoken: findings.overview(result, spoken)),
        memory_gb=f"{result.context['machine']['memory_bytes'] / 1e9:.1f}",
        sections=[
            *sections(result, folder),
            *_error_sections(error, folder),
            *_ablation_sections(ablation, folder),
        ],
        times=page_tables.times(result),
        speedups=page_tables.speedups(result),
        gpu=page_tables.gpu(result),
        gpu_seen=all_of(lambda spoken: findings_gpu.runs(result, spoken)),
        device=_device(result),
        frames=page_tables.frames(result),
        costs=page_error.costs(error),
        costs_seen=all_of(lambda spoken: findings_error.prices(error, spoken) if error else []),
        rounding=page_error.rounding(error),
        regret=page_ablation.regret(ablation),
        skipped=page_tables.skipped(result),
        unavailable=page_tables.unavailable(result),
    )


def _device(result: Result) -> Said | None:
    """The GPU in words; None without one."""
    if result.gpu is None:
        return None
    copied = words.grouped(result.gpu.copy_gbps)
    return say("gpu_text", name=result.gpu.name, copied=copied)


def sections(result: Result, folder: Path) -> list[Section]:
    return _sections(folder, _ORDER, lambda name, spoken: _sentences(result, name, spoken))


def _ablation_sections(ablation: Result | None, folder: Path) -> list[Section]:
    if ablation is None:
        return []
    told = partial(findings_ablation.sentences, ablation)
    return _sections(folder, plots.ABLATION_NAMES, told, [ablation])


def _error_sections(error: Study | None, folder: Path) -> list[Section]:
    if error is None:
        return []
    told = partial(findings_error.sentences, error)
    return _sections(folder, plots.ERROR_NAMES, told, error.results)


def _sections(
    folder: Path,
    names: tuple[str, ...],
    told: Callable[[str, str], list[str]],
    others: Sequence[Result] = (),
) -> list[Section]:
    """Of those plots that lie in the folder; the first tells of other results that they show."""

    def seen(name: str, spoken: str) -> list[str]:
        origins = findings.origins(others, spoken) if name == names[0] else []
        return origins + told(name, spoken)

    found = []
    for name in images.drawn(names, folder):
        sentences, image = all_of(partial(seen, name)), images.data_uri(folder / f"{name}.png")
        found.append(Section(name, say(f"title_{name}"), sentences, say(f"how_{name}"), image))
    return found


def _sentences(result: Result, name: str, spoken: str) -> list[str]:
    subject, _, variant = name.partition("_")
    if subject == "time":
        return findings.time(result, variant, spoken)
    if subject == "speed":
        return findings.speed(result, variant, spoken)
    if name == "stages_per_sphere":
        return findings.per_sphere(result, spoken)
    if subject == "stages":
        return findings.stages(result, variant, spoken)
    simple = {
        "correctness": findings.correctness,
        "bandwidth": findings_gpu.bandwidths,
        "bandwidth_by_size": findings_gpu.by_size,
        "dynamic": findings.moving,
        "memory": findings.memory,
    }
    return simple[name](result, spoken)
