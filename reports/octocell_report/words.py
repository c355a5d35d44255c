# SPDX-License-Identifier: MIT
"""Numbers and names as people read them; the same words in plots, page and README."""

import math
import textwrap
from typing import Any

import pandas as pd

from octocell_report.load import Place, Result

Row = Any  # a line of a Result's frame

THIN = "\u202f"  # narrow space between groups of digits; no line breaks there
MINUS = "\u2212"
NONE = "\u2013"  # where there is no number

_FAMILIES = {"fcl": "FCL", "bullet": "Bullet"}
_UNITS = ((10**9, "G"), (10**6, "M"), (10**3, "k"))


def grouped(value: float) -> str:
    """1234567 -> '1 234 567', with narrow spaces."""
    return f"{value:,.0f}".replace(",", THIN)


def size(n: int) -> str:
    """A number of spheres: round ones short (1k, 2.5M), others in full."""
    for unit, suffix in _UNITS:
        if n >= unit and n % (unit // 10) == 0:
            return f"{n / unit:g}{suffix}"
    return grouped(n)


def number(value: float | None) -> str:
    """Three significant digits, no exponent for what is above a millionth."""
    if value is None or math.isnan(value):
        return NONE
    if abs(value) >= 99.95:
        return grouped(value)
    for limit, digits in ((9.995, 1), (0.9995, 2), (0.09995, 3), (0.009995, 4)):
        if abs(value) >= limit:
            return f"{value:.{digits}f}"
    return f"{value:.3g}"


def count(value: int | None) -> str:
    """A count that must stay short: exact below 10 000, else three digits and a unit."""
    if value is None or pd.isna(value):
        return "?"
    return str(value) if value < 10_000 else _with_unit(value)


def rate(value: float) -> str:
    """Errors per million, short: 2.5, 38, 1.01k, 5.1M."""
    if value < 9.5:
        return f"{value:.2g}"
    return f"{value:.0f}" if value < 999.5 else _with_unit(value)


def _with_unit(value: float) -> str:
    """Three digits, and k, M or G."""
    unit, suffix = next(known for known in _UNITS if value >= 0.9995 * known[0])
    return f"{value / unit:.3g}{suffix}"


def percent(value: float) -> str:
    """Whole from 10 up, one digit below: 42, 3.1."""
    return f"{value:.0f}" if value >= 9.95 else f"{value:.1f}"


def ratio(value: float) -> str:
    """Three digits from 1 up, two below: 12.3×, 0.85×."""
    return f"{number(value)}×" if value >= 0.995 else f"{value:#.2g}×"


def times(value: float) -> str:
    """A ratio among others near 1, so with two decimals: 0.98, 1.00, 12.3."""
    return f"{value:.2f}" if value < 9.995 else number(value)


def tick(value: float, _: object = None) -> str:
    """An axis label: no trailing zeros, groups of digits apart."""
    return grouped(value) if abs(value) >= 1000 else f"{value:g}"


def losses(row: Row) -> str:
    """'-missed +false', and 'xdup' where pairs came more than once."""
    text = f"{MINUS}{count(row.missed)} +{count(row.false)}"
    return text + (f" ×{count(row.duplicates)}" if row.duplicates else "")


def verdict(row: Row) -> str:
    """What must stand next to a time that is not bare."""
    if row.status == "wrong":
        return ("negative control " if row.negative_control else "wrong ") + losses(row)
    return "negative control, exact here"


def run(name: str) -> str:
    """'first_update' -> 'first update'."""
    return name.replace("_", " ")


def place(where: Place) -> str:
    return f"{where.scene} {size(where.n)}"


def family(backend: str) -> str:
    """The library of a baseline: the first word of its name."""
    return backend.split("_", 1)[0]


def family_title(name: str) -> str:
    return _FAMILIES.get(name, name)


def short_reason(reason: str | None, width: int) -> str:
    """A skip reason in so many letters; the full one is in the table of skipped rows."""
    text = reason or "no reason given"
    if "over the limit" in text:
        return "over limit"
    return textwrap.shorten(text, width, placeholder="…")


def titles(result: Result) -> dict[str, str]:
    """By label, in table order: one that also says which implementations are negative controls."""
    rows = result.frame.sort_values("order", kind="stable")
    controls = rows.groupby("label", sort=False)["negative_control"].any()
    return {
        label: f"{label} (negative control)" if shown else label
        for label, shown in controls.items()
    }
