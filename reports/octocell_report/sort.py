# SPDX-License-Identifier: MIT
"""The JSON of `octocell bench-sort`: read and checked; the same as a table."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Annotated, Any, NamedTuple

import pandas as pd
from msgspec import Struct

from octocell_report.fields import Json, Name, Number, ReportError, Text, Whole, choice, convert
from octocell_report.files import read_json
from octocell_report.schema import STATUSES, Context

SCHEMA, KIND = 2, "sort"
ORDERS = ("random", "sorted", "reversed", "constant", "few_distinct")

TITLES = {
    "impl_cpu": "Octocell radix sort",
    "std_sort": "std::sort",
    "std_stable_sort": "std::stable_sort",
    "tbb_parallel_sort": "TBB parallel_sort",
    "highway_vqsort": "Highway vqsort",
    "boost_spreadsort": "Boost spreadsort",
    "cuda_one_bit_split": "1 one-bit split",
    "cuda_digit_passes": "2 digit passes",
    "cuda_reduce_then_scan": "3 reduce then scan",
    "cuda_onesweep": "4 onesweep",
    "cub": "CUB",
}


class Sort(NamedTuple):
    """What is compared: an algorithm and its number of threads (0 on a GPU)."""

    algorithm: str
    threads: int


class SortRow(Struct):
    name: Name
    algorithm: Name
    threads: Whole
    device: Annotated[str, choice("cpu", "gpu")]
    n: Whole
    bits: Whole
    order: Text
    stable: bool
    packed: bool
    status: Annotated[str, choice(*STATUSES)]
    reason: Text | None
    total_ms: tuple[Number, ...]  # one per round; none unless the status is ok

    def __post_init__(self) -> None:
        if (self.status == "ok") != bool(self.total_ms) or 0 in self.total_ms:
            raise ValueError(f"says {self.status}, but 'total_ms' is {list(self.total_ms)}")
        if self.status != "ok" and self.reason is None:
            raise ValueError(f"says {self.status}, but 'reason' is null")

    @property
    def sort(self) -> Sort:
        return Sort(self.algorithm, self.threads)

    @property
    def rates(self) -> tuple[float, ...]:
        """10^9 pairs a second, one per round."""
        return tuple(self.n / (ms * 1e6) for ms in self.total_ms)


class Document(Struct):
    context: Context
    rows: list[SortRow]


@dataclass(frozen=True)
class SortResult:
    context: Json
    rows: list[SortRow]

    @property
    def sorts(self) -> list[Sort]:
        return list(dict.fromkeys(row.sort for row in self.rows))

    def on(self, device: str) -> SortResult:
        """The rows of one device."""
        return SortResult(self.context, [row for row in self.rows if row.device == device])

    @property
    def wrong(self) -> list[SortRow]:
        return [row for row in self.rows if row.status == "wrong"]

    def timed(self, **fixed: Any) -> list[SortRow]:
        """Rows with a time whose fields are these, ascending by size."""
        fixed["status"] = "ok"
        rows = [r for r in self.rows if all(getattr(r, key) == v for key, v in fixed.items())]
        return sorted(rows, key=lambda r: r.n)


def load(path: Path) -> SortResult:
    """Reads and checks one result. Throws ReportError naming the file, and the row if it is one."""
    return read_json(path, parse)


def parse(document: Any) -> SortResult:
    """The same for a document already decoded."""
    known = (document.get("kind"), document.get("schema")) if isinstance(document, dict) else None
    if known != (KIND, SCHEMA):
        raise ReportError(
            f"not a result of bench-sort: kind '{KIND}', schema {SCHEMA} is read here"
        )
    rows = convert(document, Document).rows
    names: set[str] = set()
    for row in rows:
        if row.name in names:
            raise ReportError(f"two rows are called {row.name}")
        names.add(row.name)
    return SortResult(document["context"], rows)


_COLUMNS = ("algorithm", "device", "threads", "n", "bits", "order", "stable", "packed", "status")


def frame(result: SortResult) -> pd.DataFrame:
    """Every row: plain numbers, nothing rounded; no time where the status is not ok."""
    return pd.DataFrame(
        {
            **{column: getattr(row, column) for column in (*_COLUMNS, "reason")},
            "rounds": len(row.total_ms),
            "median_ms": median(row.total_ms) if row.total_ms else None,
            "min_ms": min(row.total_ms, default=None),
            "max_ms": max(row.total_ms, default=None),
            "gitems_per_second_median": median(row.rates) if row.rates else None,
        }
        for row in result.rows
    )
