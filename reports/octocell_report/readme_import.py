# SPDX-License-Identifier: MIT
"""The tables of docs/how_to/import_files.md: readers, how long they take, and second opinions."""

import re
from pathlib import Path

from msgspec import Struct
from pandas import DataFrame

from octocell_import.formats import FORMATS, OCTOCELL
from octocell_report.fields import Name, Number, ReportError, Text, Whole, convert
from octocell_report.files import read_json, read_text
from octocell_report.markdown import code, table
from octocell_report.words import NONE, grouped

_LIBRARIES = {"mmcif": "gemmi"}  # the other formats are read by the importer's own modules
VERDICTS = ("equal", "misread", "refused by all", "refused, read by others", "read by us alone")


class Machine(Struct):
    cpu: Name
    cores: Whole
    os: Text


class Timing(Struct):
    format: Name
    file_bytes: Whole
    cpu_seconds: Number
    peak_bytes: Whole


class Speed(Struct):
    """What scripts/time_import.py writes."""

    date: Text
    machine: Machine
    versions: dict[str, Text]
    atoms: Whole
    rows: list[Timing]


class Comparison(Struct):
    """What scripts/compare_import.py writes."""

    date: Text
    packages: list[Name]
    files: dict[str, dict[str, Whole]]  # of each format how many came to which verdict

    def __post_init__(self) -> None:
        if unknown := {name for counts in self.files.values() for name in counts} - {*VERDICTS}:
            raise ValueError(f"no verdict is called {', '.join(sorted(unknown))}")


def read_speed(path: Path) -> Speed:
    return read_json(path, lambda document: convert(document, Speed))


def read_comparison(path: Path) -> Comparison:
    return read_json(path, lambda document: convert(document, Comparison))


def read_requirements(path: Path) -> dict[str, str]:
    """Versions that are pinned, by package."""
    pins = dict(re.findall(r"^([\w-]+)==([\w.]+)", read_text(path), re.MULTILINE))
    if missing := {*_LIBRARIES.values()} - {*pins}:
        raise ReportError(f"pins no {', '.join(missing)}")
    return pins


def readers(pins: dict[str, str]) -> str:
    """Which program and reader serve which format; the version is that of `make setup`."""
    lines = []
    for name, suffixes in FORMATS.items():
        library = _LIBRARIES.get(name)
        own = f"own, {code(name.partition('-')[0] + '.py')}"
        reader = f"{library} {pins[library]}" if library else own
        is_ours = name in OCTOCELL
        lines.append(
            {
                "format": code(name),
                "suffixes": " ".join(suffixes),
                "`octocell` reads": "itself" if is_ours else "names the importer",
                "`octocell-import` reads": "through `octocell`" if is_ours else reader,
            }
        )
    return table(DataFrame(lines)).replace("---:", "---")  # words, to the left


def speed(found: Speed) -> str:
    lines = [
        {
            "format": code(row.format),
            "file, MB": grouped(row.file_bytes / 1e6),
            "CPU seconds": f"{row.cpu_seconds:.1f}",
            "peak, MB": grouped(row.peak_bytes / 1e6),
        }
        for row in found.rows
    ]
    box = found.machine
    versions = ", ".join(f"{name} {version}" for name, version in found.versions.items())
    where = f"{box.cpu}, {box.cores} cores, {box.os}; {versions}; {found.date}"
    return table(DataFrame(lines), f"{grouped(found.atoms)} atoms, one core in use; {where}.")


def comparison(found: Comparison) -> str:
    lines = [
        {"format": code(name)} | {verdict: str(counts.get(verdict, NONE)) for verdict in VERDICTS}
        for name, counts in sorted(found.files.items())
    ]
    files = sum(sum(counts.values()) for counts in found.files.values())
    note = f"{files} files of {', '.join(found.packages)}; {found.date}."
    return table(DataFrame(lines), note)
