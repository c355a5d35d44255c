# SPDX-License-Identifier: MIT
"""What was done to find a wrong answer: the files of a folder, checked, as one frame for each kind.

A file's name says its kind: near_tangent.json and near_tangent_gpu.json hold near-tangent pairs.
It lies in the folder, or in one below it that is named after the machine.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from pathlib import Path
from typing import Annotated, Any, TypeAlias

import pandas as pd
from msgspec import Meta, Struct, to_builtins

from octocell_report.fields import Name, Number, ReportError, Text, choice, convert
from octocell_report.files import read_json

ENDINGS = ("exact", "skipped", "refused", "late", "crashed", "wrong")  # of a stress case
LOSSES = ("missed", "false", "duplicates")
SIDES = ("CPU", "GPU")
# What the frame of each kind holds, beside "machine" and "source" (the file, as documents name it).
COLUMNS = {
    "near_tangent": ("where", "name", "pairs", "mismatches"),
    "stress": ("entry", "asks", "implementation", "backend", "kind", *ENDINGS, *LOSSES),
    "compilers": ("configurations", "checksums", "failures", "refused"),
    "fuzz": ("name", "runs", "seconds", "crashes"),
    "mutants": ("name", "what", "status", "killed_by", "reason"),
    "sanitizers": ("name", "tests", "reports"),
}
Verification: TypeAlias = dict[str, pd.DataFrame]  # by kind; of an absent one without a line

Count = Annotated[int, Meta(ge=0, le=2**53)]  # so that sums fit into 64 bits


class Context(Struct):
    date: Text
    commit: Text
    finished: bool = True

    def __post_init__(self) -> None:
        if not self.finished:
            raise ValueError("The run was interrupted; only whole runs count")


class File(Struct):
    context: Context

    def lines(self) -> Iterable[dict[str, Any]]:
        """Those of the frame; here the items of the one list that the file holds."""
        (items,) = (value for value in to_builtins(self).values() if isinstance(value, list))
        return items


class Family(Struct):
    """Pairs within 64 units of rounding of touching, decided and compared with integers."""

    name: Name
    pairs: Count
    mismatches: Count

    def __post_init__(self) -> None:
        if self.mismatches > self.pairs:
            raise ValueError("More mismatches than pairs")


class NearTangent(File):
    where: Annotated[str, choice(*SIDES)]
    families: Annotated[list[Family], Meta(min_length=1)]

    def lines(self) -> Iterable[dict[str, Any]]:
        return ({"where": self.where, **line} for line in super().lines())


class Entry(Struct):
    """A line of the stress catalogue."""

    id: Name
    asks: Text


class Cases(Struct):
    """How many ended in which way."""

    exact: Count
    skipped: Count
    refused: Count
    late: Count
    crashed: Count
    wrong: Count


class StressRow(Struct):
    """One entry by one implementation."""

    entry: Name
    implementation: Name
    backend: Name
    kind: Annotated[str, choice("backend", "baseline")]
    cases: Cases
    missed: Count
    false: Count
    duplicates: Count


class Stress(File):
    entries: list[Entry]
    rows: Annotated[list[StressRow], Meta(min_length=1)]

    def lines(self) -> Iterable[dict[str, Any]]:
        asks = {entry.id: entry.asks for entry in self.entries}
        for row in self.rows:
            if row.entry not in asks:
                raise ReportError(f"no entry has the id '{row.entry}'")
            yield to_builtins(row) | to_builtins(row.cases) | {"asks": asks[row.entry]}


class Compilers(File):
    configurations: Annotated[list[Name], Meta(min_length=1)]
    checksums: Count  # that each of them printed
    failures: list[Text]
    refused: list[Name]  # compilers with flags that must not compile

    def lines(self) -> Iterable[dict[str, Any]]:
        return [to_builtins(self)]


class Target(Struct):
    """What a fuzzer was let loose on."""

    name: Name
    runs: Count
    seconds: Number
    crashes: Count


class Fuzz(File):
    targets: Annotated[list[Target], Meta(min_length=1)]


class Fault(Struct):
    """One planted in the sources."""

    name: Name
    what: Text
    status: Annotated[str, choice("killed", "survived", "not_run")]
    killed_by: Text | None
    reason: Text | None = None

    def __post_init__(self) -> None:
        if self.status == "killed" and not (self.killed_by or "").strip():
            raise ValueError("Killed, but 'killed_by' does not say by what")


class Mutants(File):
    faults: Annotated[list[Fault], Meta(min_length=1)]


class Tool(Struct):
    """A sanitizer."""

    name: Name
    tests: Count
    reports: Count


class Sanitizers(File):
    tools: Annotated[list[Tool], Meta(min_length=1)]


_FILES: dict[str, type[File]] = {
    "near_tangent": NearTangent,
    "stress": Stress,
    "compilers": Compilers,
    "fuzz": Fuzz,
    "mutants": Mutants,
    "sanitizers": Sanitizers,
}


def read(folder: Path) -> Verification:
    """Everything found there. Throws ReportError on a bad file."""
    if not folder.is_dir():
        raise ReportError(f"{folder}: is not a folder of results")
    return {kind: _frame(folder, kind) for kind in _FILES}


def _frame(folder: Path, kind: str) -> pd.DataFrame:
    names = [f"{where}{kind}*.json{gz}" for where in ("", "*/") for gz in ("", ".gz")]
    paths = sorted(path for name in names for path in folder.glob(name))
    lines = [line for path in paths for line in read_json(path, partial(_lines, path, kind))]
    return pd.DataFrame(lines, columns=["machine", "source", *COLUMNS[kind]])


def _lines(path: Path, kind: str, document: Any) -> list[dict[str, Any]]:
    if isinstance(document, dict) and document.get("kind", kind) != kind:
        raise ReportError(f"its kind is '{document['kind']}', and its name says '{kind}'")
    file = convert(document, _FILES[kind])
    machine, context = path.parent.name, file.context
    source = f"`{machine}/{path.name}` ({context.commit[:12]}, {context.date[:10]})"
    return [line | {"machine": machine, "source": source} for line in file.lines()]
