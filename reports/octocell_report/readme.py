# SPDX-License-Identifier: MIT
"""Text between markers in a Markdown file, written from results so that it cannot go stale.

<!-- octocell:speed results/quick.json -->
(what stands here is replaced)
<!-- /octocell:speed -->

The first marker names what is read, by its path from the file's folder: a result, or a folder.
"""

import re
from collections.abc import Callable, Iterator
from functools import cache, partial
from itertools import zip_longest
from pathlib import Path
from typing import Any

from octocell_report import (
    markdown,
    readme_bench,
    readme_gpu,
    readme_guarantee,
    readme_import,
    sort,
    verification,
)
from octocell_report.fields import ReportError, naming
from octocell_report.files import read_text, write_text
from octocell_report.load import load
from octocell_report.texts import Said

_MARKER = re.compile(
    r"<!--\s*(?P<closes>/?)octocell:(?P<name>[^\s>]*)(?:\s+(?P<source>[^\s>]+))?\s*-->"
)

# By the name of the block: what reads its source, and what writes it from that; of what is said in
# two languages a name that ends in _zh takes the Chinese.
BLOCKS: dict[str, tuple[Callable[[Path], Any], Callable[[Any], str | Said]]] = {
    "machine": (load, readme_bench.machine),
    "correctness": (load, readme_bench.correctness),
    "speed": (load, readme_bench.speed),
    "moving": (load, readme_bench.moving),
    "against": (load, readme_bench.against),
    "kinds_cold": (load, partial(readme_bench.kinds, run="cold")),
    "kinds_warm": (load, partial(readme_bench.kinds, run="warm")),
    "frames": (load, readme_bench.frames),
    "gpu_speed": (load, readme_gpu.speed),
    "gpu_stages": (load, readme_gpu.stages),
    "gpu_sorts": (sort.load, readme_gpu.sorts),
    "front_libraries": (load, readme_bench.front),
    "front_gpu": (load, readme_gpu.front),
    "front_wrong": (verification.read, readme_guarantee.front),
    "import_readers": (readme_import.read_requirements, readme_import.readers),
    "import_speed": (readme_import.read_speed, readme_import.speed),
    "import_comparison": (readme_import.read_comparison, readme_import.comparison),
    "guarantee": (verification.read, readme_guarantee.guarantee),
    **{
        f"guarantee_{kind}": (verification.read, partial(readme_guarantee.details, kind=kind))
        for kind in verification.COLUMNS
    },
}
BLOCKS |= {f"{name}_zh": BLOCKS[name] for name in BLOCKS if name.startswith("front_")}


def rewrite(path: Path, check_only: bool) -> list[str]:
    """Names of the blocks that differed; unless check_only, the file has them all now."""
    text = read_text(path)
    with naming(path):
        fresh, differing = filled(text, path.parent)
    if differing and not check_only:
        write_text(path, fresh)
    return differing


def filled(text: str, folder: Path) -> tuple[str, list[str]]:
    """The text with its blocks rewritten, and the names of those that differed."""
    newline = "\r\n" if "\r\n" in text else "\n"
    known = cache(lambda read, path: read(path))
    parts, differing, end = [], [], 0
    for name, source, start, stop in _blocks(text):
        read, write = BLOCKS[name]
        told = write(known(read, folder / source))
        block = told if isinstance(told, str) else told.zh if name.endswith("_zh") else told.en
        if _MARKER.search(block):
            raise ReportError(f"block '{name}' would hold a marker: a name in the result looks so")
        block = f"\n{markdown.plain(block)}\n".replace("\n", newline)
        parts += [text[end:start], block]
        if text[start:stop] != block:
            differing.append(f"{name} {source}")
        end = stop
    return "".join(parts) + text[end:], differing


def _blocks(text: str) -> Iterator[tuple[str, str, int, int]]:
    """(name, source, start, stop) of what stands between markers, checked to pair up."""
    markers = list(_MARKER.finditer(text))
    if not markers:
        raise ReportError("has no octocell markers")
    for first, last in zip_longest(markers[::2], markers[1::2]):
        name, marker = first["name"], f"marker '{first['closes']}octocell:{first['name']}'"
        with naming(f"line {text.count(chr(10), 0, first.start()) + 1}"):
            if name not in BLOCKS:
                raise ReportError(f"unknown {marker}; known: {', '.join(BLOCKS)}")
            if first["closes"]:
                raise ReportError(f"{marker} closes what is not open")
            if not first["source"]:
                raise ReportError(f"{marker} must name what it is written from")
            if not last or last.groups() != ("/", name, None):
                raise ReportError(f"{marker} is not closed by '/octocell:{name}'")
        yield name, first["source"], first.end(), last.start()
