# SPDX-License-Identifier: MIT
"""One page with everything in it, in two languages: no network; images, style and script inside."""

from __future__ import annotations

import base64
import io
from dataclasses import dataclass
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined
from matplotlib.figure import Figure
from PIL import Image

from octocell_report import (
    check,
    findings,
    findings_gpu,
    frames,
    language,
    page_tables,
    plots,
    style,
    words,
)
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
    images = {f"{name}.{ending}" for name in plots.NAMES for ending in ("png", "svg")}
    return {"index.html"} | images | {f"{name}.csv" for name in frames.NAMES}


def build(result: Result, folder: Path) -> list[str]:
    """Writes plots, tables and index.html; returns the names written. All or nothing."""
    with staged_folder(folder, owned_names()) as staging:
        for name, figure in plots.draw_all(result):
            _save(figure, staging / f"{name}.png")
            # No date and no random ids in it: the same result gives the same file.
            figure.savefig(staging / f"{name}.svg", metadata={"Date": None})
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
        say=say,
        texts=language.TEXTS,
        context=result.context,
        verdict=verdict,
        headline=both(lambda spoken: check.headline(verdict, spoken)),
        overview=all_of(lambda spoken: findings.overview(result, spoken)),
        memory_gb=f"{result.context['machine']['memory_bytes'] / 1e9:.1f}",
        sections=sections(result, images),
        times=page_tables.times(result),
        speedups=page_tables.speedups(result),
        gpu=page_tables.gpu(result),
        gpu_seen=all_of(lambda spoken: findings_gpu.runs(result, spoken)),
        device=_device(result),
        frames=page_tables.frames(result),
        skipped=page_tables.skipped(result),
        unavailable=page_tables.unavailable(result),
    )


def _device(result: Result) -> Said | None:
    """The GPU in words; None without one."""
    if result.gpu is None:
        return None
    copied = words.grouped(result.gpu.copy_gbps)
    return say("gpu_text", name=result.gpu.name, copied=copied)


def sections(result: Result, images: Path) -> list[Section]:
    found = []
    for name in _ORDER:
        path = images / f"{name}.png"
        if path.exists():
            data = base64.b64encode(path.read_bytes()).decode("ascii")
            sentences = all_of(lambda spoken, name=name: _sentences(result, name, spoken))  # type: ignore[misc]
            image = f"data:image/png;base64,{data}"
            title, how = say(f"title_{name}"), say(f"how_{name}")
            found.append(Section(name, title, sentences, how, image))
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
