# SPDX-License-Identifier: MIT
"""Tables of a GPU: its runs beside other backends, its stages, its sorts."""

from __future__ import annotations

from statistics import median

import pandas as pd

from octocell_report import bandwidth, words
from octocell_report.bandwidth import Rate
from octocell_report.fields import ReportError
from octocell_report.language import tell
from octocell_report.load import Place, Result
from octocell_report.load import Row as BenchRow
from octocell_report.markdown import bold, code, table
from octocell_report.readme_bench import SCENE, Row, best, chosen, faster, shown
from octocell_report.sort import TITLES, SortResult, SortRow
from octocell_report.spread import ratios
from octocell_report.words import NONE, grouped, number

OURS = "impl_cuda_custom"
OTHERS = ("impl_thrust_cuda", "impl_cpu")
EXTRA_RUNS = {"graph": "graph", "transfers": "with transfers"}  # of ours, beside warm
STAGE_SIZES = (1_000_000, 10_000_000)

CUB = "cub"
EXPONENTS = (16, 20, 24, 26)  # of 2: how many pairs are sorted
WIDTHS = (20, 32)  # of keys, in bits


def _fastest(result: Result, n: int, backend: str) -> Row | None:
    return best(result.frame, scene=SCENE, n=n, run="warm", backend=backend)


def speed(result: Result) -> str:
    """By size: ours warm, as a graph, with transfers; beside Thrust and our own CPU backend."""
    sizes = sorted(set(chosen(result.frame, scene=SCENE, run="warm", backend=OURS)["n"]) - {0})
    if not sizes:
        raise ReportError(f"block 'gpu_speed' needs warm rows of {OURS} on {SCENE}")
    ours = {n: _fastest(result, n, OURS) for n in sizes}
    others = {name: {n: _fastest(result, n, name) for n in sizes} for name in OTHERS}
    others = {name: rows for name, rows in others.items() if any(rows.values())}
    lines = []
    for n, row in ours.items():
        extra = (best(result.frame, scene=SCENE, n=n, run=run, label=row and row.label)
                 for run in EXTRA_RUNS)  # fmt: skip
        beside = [rows[n] for rows in others.values()]
        times = [shown(known) for known in (row, *extra, *beside)]
        lines.append([grouped(n), *times, *(faster(row, other) for other in beside)])
    taken = [row for n in sizes for rows in (ours, *others.values()) if (row := rows[n])]
    note = (
        f"Scene {SCENE}, warm, median of the rounds; of each backend the fastest exact variant at "
        f"that size ({', '.join(dict.fromkeys(code(row.label) for row in taken if row.counts))}). "
        "Ratios are its time by ours, warm, within interleaved rounds, "
        f"median; above 1 ours is faster. {NONE}: not measured."
    )
    header = ["spheres", *(f"{name} [ms]" for name in (OURS, *EXTRA_RUNS.values(), *others))]
    header += [f"vs {name}" for name in others]
    return table(pd.DataFrame(lines, columns=header), note)


def front(result: Result, language: str = "en") -> str:
    """The README's number: the time of a million spheres that lie on the device."""
    row = _fastest(result, 1_000_000, OURS)
    if row is None or not row.counts or result.gpu is None:
        raise ReportError("block 'front_gpu' needs an exact warm row of a million spheres")
    known = {"ms": shown(row), "gpu": result.gpu.name, "commit": result.context["commit"][:8]}
    return tell(language, "front_gpu", **known)


def stages(result: Result) -> str:
    """Time, share and bandwidth of each stage, at two sizes side by side."""
    rows = _staged(result)
    if not rows:
        raise ReportError(f"block 'gpu_stages' needs stages with bytes of {OURS} on {SCENE}")
    names = [*dict.fromkeys(stage for row in rows for stage in row.stage_ms), bandwidth.ALL]
    columns = ["ms", "share", "GB/s", *(["of copy"] if result.gpu else [])]
    header = [title for row in rows for title in (f"{words.size(row.n)}: ms", *columns[1:])]
    lines = [[cell for row in rows for cell in _stage(result, row, name)] for name in names]
    titles = [name if name == bandwidth.ALL else code(name) for name in names]
    told = pd.DataFrame(lines, columns=header)
    told.insert(0, "stage", titles)
    variants = dict.fromkeys(code(result.labels[row.impl]) for row in rows)
    copied = (
        f"; of copy: by the {grouped(result.gpu.copy_gbps)} GB/s that a copy on this "
        f"{result.gpu.name} reads and writes"
        if result.gpu
        else ""
    )
    note = [
        f"{', '.join(variants)}, scene {SCENE}, warm, runs with stage marks, median of the rounds. "
        f"GB/s: the least bytes that the stage must read and write, by its time{copied}."
    ]
    if any(rate.tiny for row in rows for rate in bandwidth.rates(result, row)):
        limit = f"{bandwidth.LAUNCH_US:g}"
        note.append(f"In brackets: so few bytes that copying them takes less than {limit} µs.")
    note += [f"{code(stage)} is inside {code(host)}." for stage, host in rows[-1].fused.items()]
    return table(told, " ".join(note))


def _staged(result: Result) -> list[BenchRow]:
    """The fastest at each of the two sizes, or at the two largest that there are."""
    every = [row for n in result.sizes(SCENE) for row in bandwidth.best(result, Place(SCENE, n))]
    found = {row.n: row for row in every if row.backend == OURS}
    sizes = STAGE_SIZES if set(STAGE_SIZES) <= set(found) else list(found)[-2:]
    return [found[n] for n in sizes]


def _stage(result: Result, row: BenchRow, stage: str) -> list[str]:
    """A stage's cells at one size."""
    times = {name: median(ms) for name, ms in row.stage_ms.items()}
    times[bandwidth.ALL] = sum(times.values())
    rates = {rate.stage: rate for rate in bandwidth.rates(result, row)}
    whole, time = times[bandwidth.ALL], times.get(stage)
    rate = bandwidth.whole(result, row) if stage == bandwidth.ALL else rates.get(stage)
    return [number(time), _percent(time / whole if time else None), *_rate(result, rate)]


def _rate(result: Result, rate: Rate | None) -> list[str]:
    cells = [number(rate.gbps if rate else None)]
    cells += [_percent(rate.share if rate else None)] if result.gpu else []
    return [f"({cell})" for cell in cells] if rate and rate.tiny else cells


def _percent(share: float | None) -> str:
    return NONE if share is None else f"{words.percent(100 * share)} %"


def sorts(result: SortResult) -> str:
    """A line per key width and sort, a column per size; behind each rate its ratio to CUB's."""
    found = {
        (row.bits, row.algorithm, row.n): row
        for row in result.on("gpu").rows
        if row.order == "random" and row.bits in WIDTHS and row.n in {1 << e for e in EXPONENTS}
    }
    if not found:
        raise ReportError("block 'gpu_sorts' needs rows of a GPU at its sizes and key widths")
    sizes = sorted({n for _, _, n in found})
    met = {name for _, name, _ in found}
    names = [*(name for name in TITLES if name in met), *sorted(met - set(TITLES))]
    lines = []
    for bits, name in ((bits, name) for bits in WIDTHS for name in names):
        rows = [(found.get((bits, name, n)), found.get((bits, CUB, n))) for n in sizes]
        if any(row for row, _ in rows):
            lines.append([TITLES.get(name, name), bits, *(_sorted(*both) for both in rows)])
    gpu = result.context.get("gpu") or {}
    where = f" on {gpu['name']}" if gpu else ""
    note = (
        f"10⁹ pairs a second{where} (32-bit key, 32-bit value), keys in random order, median of "
        f"the rounds; in brackets the rate by {TITLES[CUB]}'s, above 1 is faster."
    )
    header = ["sort", "key bits", *(f"2^{n.bit_length() - 1}" for n in sizes)]
    return table(pd.DataFrame(lines, columns=header), note)


def _sorted(row: SortRow | None, reference: SortRow | None) -> str:
    """'42.6 (1.16×)'."""
    if row is None:
        return NONE
    if row.status != "ok":
        return bold("wrong") if row.status == "wrong" else "skipped"
    rate = number(median(row.rates))
    if reference is None or reference is row or reference.status != "ok":
        return rate
    return f"{rate} ({words.ratio(median(ratios(row.rates, reference.rates)))})"
