# SPDX-License-Identifier: MIT
"""The JSON of `octocell bench-sort`: read, checked, as a frame."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, NamedTuple

import pandas as pd
from msgspec import Struct, structs

from octocell_report.fields import Name, Number, ReportError, Text, Whole, choice, convert
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


class Row(Struct):
    name: Name
    algorithm: Name
    threads: Whole  # 0 on a GPU
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


class Document(Struct):
    context: Context
    rows: list[Row]


class SortResult(NamedTuple):
    context: Context
    # The fields of the rows, and title (of the algorithm), label (with its threads, if several),
    # rates (10^9 pairs a second, one per round).
    frame: pd.DataFrame

    def on(self, device: str) -> SortResult:
        """The rows of one device."""
        return self._replace(frame=self.frame[self.frame["device"] == device])


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
    found = convert(document, Document)
    frame = pd.DataFrame(map(structs.asdict, found.rows), columns=Row.__struct_fields__)
    twice = frame["name"][frame["name"].duplicated()]
    if len(twice):
        raise ReportError(f"two rows are called {twice.iloc[0]}")
    title = frame["algorithm"].map(TITLES).fillna(frame["algorithm"])
    several = ", " + frame["threads"].astype(str) + " threads"
    times = zip(frame["n"], frame["total_ms"], strict=True)
    frame = frame.assign(
        title=title,
        label=title + several.where(frame["threads"] > 1, ""),
        rates=pd.Series([tuple(n / (t * 1e6) for t in ms) for n, ms in times], dtype=object),
    )
    return SortResult(found.context, frame)


def table(result: SortResult) -> pd.DataFrame:
    """Every row: plain numbers, nothing rounded; no time where the status is not ok."""
    times, rates = (
        result.frame[of].map(list).explode().astype(float) for of in ("total_ms", "rates")
    )
    by = times.groupby(level=0)
    spans = by.agg(["count", "median", "min", "max"])
    spans.columns = ["rounds", "median_ms", "min_ms", "max_ms"]
    spans["gitems_per_second_median"] = rates.groupby(level=0).median()
    columns = [
        *("algorithm", "device", "threads", "n", "bits", "order", "stable", "packed", "status"),
        "reason",
    ]
    return result.frame[columns].join(spans)
