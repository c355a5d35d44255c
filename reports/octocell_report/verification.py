# SPDX-License-Identifier: MIT
"""What was done to find a wrong answer, as files in the folders of results: read and checked.

A file's name says its kind: near_tangent.json and near_tangent_gpu.json hold near-tangent pairs.
It lies in the folder given, or in one below it that is named after the machine.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from octocell_report.fields import (
    Fields,
    ReportError,
    is_bool,
    is_filled,
    is_filled_texts,
    is_list,
    is_number,
    is_object,
    is_text,
    is_texts,
    is_whole,
    one_of,
    or_null,
)
from octocell_report.files import read_json

ENDINGS = ("exact", "skipped", "refused", "late", "crashed", "wrong")  # of a stress case
MUTANTS = ("killed", "survived", "not_run")
SIDES = ("CPU", "GPU")


@dataclass(frozen=True)
class Source:
    """A file, and of which machine and commit it tells."""

    path: Path
    date: str
    commit: str

    @property
    def machine(self) -> str:
        return self.path.parent.name

    @property
    def title(self) -> str:
        """'epyc/stress.json'"""
        return f"{self.machine}/{self.path.name}"


@dataclass(frozen=True)
class NearTangent:
    """Pairs within 64 units of rounding of touching, decided and held against integers."""

    source: Source
    where: str  # of SIDES
    family: str
    pairs: int
    mismatches: int


@dataclass(frozen=True)
class StressRow:
    """One entry of the catalogue by one implementation."""

    source: Source
    entry: str
    asks: str
    implementation: str
    backend: str
    kind: str
    cases: dict[str, int]  # by how they ended
    missed: int
    false: int
    duplicates: int

    @property
    def family(self) -> str:
        """'C' of 'C18'."""
        return self.entry.rstrip("0123456789")


@dataclass(frozen=True)
class Matrix:
    """Compilers and their flags."""

    source: Source
    configurations: list[str]
    checksums: int  # that each of them printed
    failures: list[str]
    refused: list[str]  # compilers with flags that must not compile


@dataclass(frozen=True)
class Target:
    """What a fuzzer was let loose on."""

    source: Source
    name: str
    runs: int
    seconds: float
    crashes: int


@dataclass(frozen=True)
class Mutant:
    """A fault planted in the sources."""

    source: Source
    name: str
    what: str
    status: str  # of MUTANTS
    killed_by: str | None
    reason: str | None


@dataclass(frozen=True)
class Tool:
    """A sanitizer."""

    source: Source
    name: str
    tests: int
    reports: int


@dataclass
class Verification:
    near_tangent: list[NearTangent] = field(default_factory=list)
    stress: list[StressRow] = field(default_factory=list)
    compilers: list[Matrix] = field(default_factory=list)
    fuzz: list[Target] = field(default_factory=list)
    mutants: list[Mutant] = field(default_factory=list)
    sanitizers: list[Tool] = field(default_factory=list)


def read(folders: Iterable[Path]) -> Verification:
    """Everything found there; an absent kind is an empty list. Throws ReportError on a bad file."""
    found = Verification()
    for folder in folders:
        if not folder.is_dir():
            raise ReportError(f"{folder}: is not a folder of results")
        for kind in _READERS:
            kinds = [f"{where}{kind}*.json{gz}" for where in ("", "*/") for gz in ("", ".gz")]
            for path in sorted(path for name in kinds for path in folder.glob(name)):
                getattr(found, kind).extend(_file(path, kind))
    return found


def _file(path: Path, kind: str) -> list[Any]:
    def parse(document: Any) -> list[Any]:
        fields = Fields(document, "result")
        if fields.optional("kind", is_text) not in (None, kind):
            raise ReportError(f"its kind is '{document['kind']}', and its name says '{kind}'")
        return _READERS[kind](fields, _source(path, fields))

    return read_json(path, parse)


def _source(path: Path, document: Fields) -> Source:
    context = Fields(document.take("context", is_object), "context")
    if context.optional("finished", is_bool) is False:
        raise ReportError("the run was interrupted; only whole runs count")
    return Source(path, context.take("date", is_text), context.take("commit", is_text))


_Item = TypeVar("_Item")


def _items(document: Fields, key: str, make: Callable[[Fields], _Item]) -> list[_Item]:
    """Each item of a list, its errors naming which."""
    items = document.take(key, is_list)
    if not items:
        raise ReportError(f"{document.title}: '{key}' is empty")
    found = []
    for index, item in enumerate(items):
        fields = Fields(item, f"{key} {index}")
        if isinstance(name := fields.value.get("name"), str):
            fields.title = f"{key} {index} ({name})"
        found.append(make(fields))
    return found


def _near_tangent(document: Fields, source: Source) -> list[NearTangent]:
    where = document.take("where", one_of(*SIDES))

    def make(item: Fields) -> NearTangent:
        pairs, wrong = item.take("pairs", is_whole), item.take("mismatches", is_whole)
        if wrong > pairs:
            raise ReportError(f"{item.title}: more mismatches than pairs")
        return NearTangent(source, where, item.take("name", is_filled), pairs, wrong)

    return _items(document, "families", make)


def _stress(document: Fields, source: Source) -> list[StressRow]:
    entries = document.take("entries", is_list)
    asks = {
        fields.take("id", is_filled): fields.take("asks", is_text)
        for fields in (Fields(item, f"entry {i}") for i, item in enumerate(entries))
    }

    def make(item: Fields) -> StressRow:
        entry = item.take("entry", is_filled)
        if entry not in asks:
            raise ReportError(f"{item.title}: no entry has the id '{entry}'")
        cases = Fields(item.take("cases", is_object), f"{item.title}: cases")
        return StressRow(
            source=source,
            entry=entry,
            asks=asks[entry],
            implementation=item.take("implementation", is_filled),
            backend=item.take("backend", is_filled),
            kind=item.take("kind", one_of("backend", "baseline")),
            cases={ending: cases.take(ending, is_whole) for ending in ENDINGS},
            missed=item.take("missed", is_whole),
            false=item.take("false", is_whole),
            duplicates=item.take("duplicates", is_whole),
        )

    return _items(document, "rows", make)


def _compilers(document: Fields, source: Source) -> list[Matrix]:
    configurations = document.take("configurations", is_filled_texts)
    if not configurations:
        raise ReportError("result: 'configurations' is empty")
    checksums = document.take("checksums", is_whole)
    failures, refused = (
        document.take("failures", is_texts),
        document.take("refused", is_filled_texts),
    )
    return [Matrix(source, configurations, checksums, failures, refused)]


def _fuzz(document: Fields, source: Source) -> list[Target]:
    def make(item: Fields) -> Target:
        name, runs = item.take("name", is_filled), item.take("runs", is_whole)
        seconds, crashes = item.take("seconds", is_number), item.take("crashes", is_whole)
        return Target(source, name, runs, float(seconds), crashes)

    return _items(document, "targets", make)


def _mutants(document: Fields, source: Source) -> list[Mutant]:
    def make(item: Fields) -> Mutant:
        status = item.take("status", one_of(*MUTANTS))
        killed_by = item.take("killed_by", is_filled if status == "killed" else or_null(is_text))
        reason = item.optional("reason", or_null(is_text))
        name, what = item.take("name", is_filled), item.take("what", is_text)
        return Mutant(source, name, what, status, killed_by, reason)

    return _items(document, "faults", make)


def _sanitizers(document: Fields, source: Source) -> list[Tool]:
    def make(item: Fields) -> Tool:
        tests, reports = item.take("tests", is_whole), item.take("reports", is_whole)
        return Tool(source, item.take("name", is_filled), tests, reports)

    return _items(document, "tools", make)


_READERS: dict[str, Callable[[Fields, Source], list[Any]]] = {
    "near_tangent": _near_tangent,
    "stress": _stress,
    "compilers": _compilers,
    "fuzz": _fuzz,
    "mutants": _mutants,
    "sanitizers": _sanitizers,
}
