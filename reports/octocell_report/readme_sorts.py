# SPDX-License-Identifier: MIT
"""The README's table of the radix sorts on a device: the ladder's variants against CUB."""

from __future__ import annotations

from statistics import median

import pandas as pd

from octocell_report import words
from octocell_report.fields import ReportError
from octocell_report.markdown import table
from octocell_report.sort import TITLES, SortResult, SortRow

REFERENCE = "cub"
EXPONENTS = (16, 20, 24, 26)
WIDTHS = (20, 32)
ORDER = "random"


def sorts(result: SortResult) -> str:
    """A line per key width and variant, a column per size; behind each rate its ratio to CUB's."""
    found = {
        (row.bits, row.sort.algorithm, row.n): row
        for row in result.on("gpu").rows
        if row.order == ORDER and row.bits in WIDTHS and row.n in {1 << e for e in EXPONENTS}
    }
    if not found:
        raise ReportError("block 'gpu_sorts' needs rows of a GPU at its sizes and key widths")
    sizes = sorted({n for _, _, n in found})
    variants = [name for name in TITLES if any(name == known for _, known, _ in found)]
    variants += sorted({name for _, name, _ in found} - set(variants))
    header = ["sort", "key bits", *(f"2^{n.bit_length() - 1}" for n in sizes)]
    lines = []
    for bits in WIDTHS:
        for name in variants:
            if any((bits, name, n) in found for n in sizes):
                cells = [
                    _cell(found.get((bits, name, n)), found.get((bits, REFERENCE, n)))
                    for n in sizes
                ]
                lines.append([TITLES.get(name, name), str(bits), *cells])
    gpu = result.context.get("gpu") or {}
    where = f" on {gpu['name']}" if "name" in gpu else ""
    note = (
        f"10⁹ pairs a second{where} (32-bit key, 32-bit value), keys in {ORDER} order, median of "
        f"the rounds; in brackets the rate by {TITLES[REFERENCE]}'s, above 1 is faster."
    )
    return table(pd.DataFrame(lines, columns=header), note)


def _cell(row: SortRow | None, reference: SortRow | None) -> str:
    if row is None:
        return words.NONE
    if row.status != "ok":
        return "**wrong**" if row.status == "wrong" else "skipped"
    rate = words.number(median(row.rates))
    if reference is None or reference is row or reference.status != "ok":
        return rate
    rounds = [ours / cubs for ours, cubs in zip(row.rates, reference.rates, strict=False)]
    return f"{rate} ({words.ratio(median(rounds))})"
