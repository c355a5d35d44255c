# SPDX-License-Identifier: MIT
"""The JSON of `octocell bench-sort`: read and checked; the same as a table."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

import pandas as pd

from octocell_report.context import gpu_of
from octocell_report.fields import (
    Fields,
    Json,
    ReportError,
    is_bool,
    is_filled,
    is_list,
    is_object,
    is_text,
    is_times,
    is_whole,
    one_of,
    or_null,
)
from octocell_report.files import read_json

SCHEMA, KIND = 2, "sort"
STATUSES = ("ok", "wrong", "skipped")
DEVICES = ("cpu", "gpu")
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


@dataclass(frozen=True)
class SortRow:
    name: str
    sort: Sort
    device: str
    n: int
    bits: int
    order: str
    stable: bool
    packed: bool
    status: str
    reason: str | None
    total_ms: tuple[float, ...]  # one per round; none unless the status is ok

    @property
    def rates(self) -> tuple[float, ...]:
        """10^9 pairs a second, one per round."""
        return tuple(self.n / (ms * 1e6) for ms in self.total_ms)


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
        rows = [r for r in self.rows if r.status == "ok"]
        rows = [r for r in rows if all(getattr(r, key) == want for key, want in fixed.items())]
        return sorted(rows, key=lambda r: r.n)


def load(path: Path) -> SortResult:
    """Reads and checks one result. Throws ReportError naming the file, and the row if it is one."""
    return read_json(path, parse)


def parse(document: Any) -> SortResult:
    """The same for a document already decoded."""
    result = Fields(document, "result")
    if document.get("kind") != KIND or document.get("schema") != SCHEMA:
        raise ReportError(
            f"not a result of bench-sort: kind '{KIND}', schema {SCHEMA} is read here"
        )
    context = Fields(result.take("context", is_object), "context")
    for key in ("date", "commit", "compiler", "preset"):
        context.take(key, is_text)
    for key in ("dirty", "finished"):
        context.take(key, is_bool)
    machine = Fields(context.take("machine", is_object), "context.machine")
    machine.take("cpu", is_text)
    machine.take("cores", is_whole)
    rows = [_row(item, i) for i, item in enumerate(result.take("rows", is_list))]
    gpu_of(context.value)
    for name, times in Counter(row.name for row in rows).items():
        if times > 1:
            raise ReportError(f"{times} rows are called {name}")
    return SortResult(context.value, rows)


def _row(item: Any, index: int) -> SortRow:
    fields = Fields(item, f"row {index}")
    name = fields.take("name", is_filled)
    fields.title = f"row {index} ({name})"
    status = fields.take("status", one_of(*STATUSES))
    times = tuple(fields.take("total_ms", is_times))
    if status == "ok" and (not times or min(times) <= 0.0):
        raise ReportError(f"{fields.title}: says ok, but has a round without a time, or no round")
    if status != "ok" and times:
        raise ReportError(f"{fields.title}: says {status}, but has a time")
    return SortRow(
        name=name,
        sort=Sort(fields.take("algorithm", is_filled), fields.take("threads", is_whole)),
        device=fields.take("device", one_of(*DEVICES)),
        n=fields.take("n", is_whole),
        bits=fields.take("bits", is_whole),
        order=fields.take("order", is_text),
        stable=fields.take("stable", is_bool),
        packed=fields.take("packed", is_bool),
        status=status,
        reason=fields.take("reason", or_null(is_text) if status == "ok" else is_text),
        total_ms=times,
    )


def frame(result: SortResult) -> pd.DataFrame:
    """Every row: plain numbers, nothing rounded; no time where the status is not ok."""
    return pd.DataFrame(
        {
            **{"algorithm": row.sort.algorithm, "device": row.device},
            **{"threads": row.sort.threads},
            **{"n": row.n, "bits": row.bits, "order": row.order},
            **{"stable": row.stable, "packed": row.packed},
            **{"status": row.status, "reason": row.reason, "rounds": len(row.total_ms)},
            "median_ms": median(row.total_ms) if row.total_ms else None,
            "min_ms": min(row.total_ms, default=None),
            "max_ms": max(row.total_ms, default=None),
            "gitems_per_second_median": median(row.rates) if row.rates else None,
        }
        for row in result.rows
    )
