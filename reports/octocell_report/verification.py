# SPDX-License-Identifier: MIT
"""What was done to find a wrong answer: the files of a folder, checked, as one frame for each kind.

A file's name says its kind: near_tangent.json and near_tangent_gpu.json hold near-tangent pairs.
It lies in the folder, or in one below it that is named after the machine.
"""

from functools import partial
from pathlib import Path
from typing import Annotated, Any, TypeAlias, TypeVar

import pandas as pd
from msgspec import Meta, Struct, defstruct, to_builtins

from octocell_report.fields import Name, Number, ReportError, Text, choice, convert
from octocell_report.files import read_json

ENDINGS = ("exact", "skipped", "refused", "late", "crashed", "wrong")  # of a stress case
LOSSES = ("missed", "false", "duplicates")
SIDES = ("CPU", "GPU")
STATUSES = ("killed", "survived", "not_run")  # of a planted fault
# What the frame of each kind holds, beside "machine" and "source" (the file, as documents name it).
COLUMNS = {
    "near_tangent": ("name", "where", "pairs", "mismatches"),
    "stress": ("entry", "asks", "implementation", "backend", "kind", *ENDINGS, *LOSSES),
    "compilers": ("configurations", "checksums", "failures", "refused"),
    "fuzz": ("name", "runs", "seconds", "crashes"),
    "mutants": ("name", "what", "status", "killed_by", "reason"),
    "sanitizers": ("name", "tests", "reports"),
}
Verification: TypeAlias = dict[str, pd.DataFrame]  # by kind; of an absent one without a line

Count = Annotated[int, Meta(ge=0, le=2**53)]  # so that sums fit into 64 bits
_Item = TypeVar("_Item")
Some = Annotated[list[_Item], Meta(min_length=1)]


class Context(Struct):
    date: Text
    commit: Text
    finished: bool = True

    def __post_init__(self) -> None:
        if not self.finished:
            raise ValueError("the run was interrupted; only whole runs count")


class Family(Struct):
    """Pairs within 64 units of rounding of touching, decided and compared with integers."""

    name: Name
    pairs: Count
    mismatches: Count

    def __post_init__(self) -> None:
        if self.mismatches > self.pairs:
            raise ValueError("more mismatches than pairs")


class Entry(Struct):
    """A line of the stress catalogue."""

    id: Name
    asks: Text


class StressRow(Struct):
    """One entry by one implementation."""

    entry: Name
    implementation: Name
    backend: Name
    kind: Annotated[str, choice("backend", "baseline")]
    cases: dict[str, Count]  # how many ended in which way
    missed: Count
    false: Count
    duplicates: Count

    def __post_init__(self) -> None:
        if set(self.cases) != set(ENDINGS):
            raise ValueError(f"'cases' must count {', '.join(ENDINGS)}")


class Target(Struct):
    """What a fuzzer was let loose on."""

    name: Name
    runs: Count
    seconds: Number
    crashes: Count


class Fault(Struct):
    """One planted in the sources."""

    name: Name
    what: Text
    status: Annotated[str, choice(*STATUSES)]
    killed_by: Name | None
    reason: Text | None = None

    def __post_init__(self) -> None:
        if self.status == "killed" and self.killed_by is None:
            raise ValueError("says killed, but 'killed_by' is null")


class Tool(Struct):
    """A sanitizer."""

    name: Name
    tests: Count
    reports: Count


# What a file of each kind holds, beside its context; its list of items gives the frame's lines.
_FIELDS: dict[str, dict[str, Any]] = {
    "near_tangent": {"where": Annotated[str, choice(*SIDES)], "families": Some[Family]},
    "stress": {"entries": list[Entry], "rows": Some[StressRow]},
    # Compilers with flags; checksums that each of them printed; what must not compile.
    "compilers": {
        **{"configurations": Some[Name], "checksums": Count},
        **{"failures": list[Text], "refused": list[Name]},
    },
    "fuzz": {"targets": Some[Target]},
    "mutants": {"faults": Some[Fault]},
    "sanitizers": {"tools": Some[Tool]},
}


def read(folder: Path) -> Verification:
    """Everything found there. Throws ReportError on a bad file."""
    if not folder.is_dir():
        raise ReportError(f"{folder}: is not a folder of results")
    return {kind: _frame(folder, kind) for kind in COLUMNS}


def _frame(folder: Path, kind: str) -> pd.DataFrame:
    names = [f"{where}{kind}*.json{gz}" for where in ("", "*/") for gz in ("", ".gz")]
    paths = sorted(path for name in names for path in folder.glob(name))
    lines = [line for path in paths for line in read_json(path, partial(_lines, path, kind))]
    return pd.DataFrame(lines, columns=[*COLUMNS[kind], "machine", "source"])


def _lines(path: Path, kind: str, document: Any) -> list[dict[str, Any]]:
    if isinstance(document, dict) and document.get("kind", kind) != kind:
        raise ReportError(f"its kind is '{document['kind']}', and its name says '{kind}'")
    fields = [("context", Context), *_FIELDS[kind].items()]
    file = to_builtins(convert(document, defstruct(kind, fields)))
    machine, context = path.parent.name, file["context"]
    source = f"`{machine}/{path.name}` ({context['commit'][:12]}, {context['date'][:10]})"
    asks = {entry["id"]: {"asks": entry["asks"]} for entry in file.get("entries", ())}
    lines = []
    for item in [{}] if kind == "compilers" else file[fields[-1][0]]:
        if kind == "stress" and item["entry"] not in asks:
            raise ReportError(f"no entry has the id '{item['entry']}'")
        known = item | item.get("cases", {}) | asks.get(item.get("entry"), {})
        lines.append(file | known | {"machine": machine, "source": source})
    return lines
