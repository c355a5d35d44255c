# SPDX-License-Identifier: MIT
"""Tables of a GPU: its runs beside other backends, its stages, its sorts."""

from statistics import median

import pandas as pd

from octocell_report import bandwidth, words
from octocell_report.fields import ReportError
from octocell_report.load import Result
from octocell_report.markdown import bold, code, table
from octocell_report.readme_bench import SCENE, Row, best, chosen, faster, shown
from octocell_report.sort import TITLES, SortResult
from octocell_report.spread import ratios
from octocell_report.texts import Said, say
from octocell_report.words import NONE, grouped, number

OURS = "impl_cuda_custom"
OTHERS = ("impl_thrust_cuda", "impl_cpu")
EXTRA_RUNS = {"graph": "graph", "transfers": "with transfers"}  # of ours, beside warm
STAGE_SIZES = (1_000_000, 10_000_000)

CUB = "cub"
SIZES = [1 << exponent for exponent in (16, 20, 24, 26)]  # how many pairs are sorted
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
        "Ratio: its time divided by ours, median over interleaved rounds; above 1 ours is faster. "
        f"{NONE}: not measured."
    )
    header = ["spheres", *(f"{name} [ms]" for name in (OURS, *EXTRA_RUNS.values(), *others))]
    header += [f"vs {name}" for name in others]
    return table(pd.DataFrame(lines, columns=header), note)


def front(result: Result) -> Said:
    """The README's number: the time of a million spheres that lie on the device."""
    row = _fastest(result, 1_000_000, OURS)
    if row is None or not row.counts or result.gpu is None:
        raise ReportError("block 'front_gpu' needs an exact warm row of a million spheres")
    commit = result.context["commit"][:8]
    return say("front_gpu", ms=shown(row), gpu=result.gpu.name, commit=commit)


def stages(result: Result) -> str:
    """Time, share and bandwidth of each stage, at two sizes side by side."""
    known = bandwidth.frame(result)
    known = chosen(known, scene=SCENE, backend=OURS, run="warm", best=True)
    sizes = sorted(known[known["gbps"].notna()]["n"].unique())
    sizes = [*STAGE_SIZES] if set(STAGE_SIZES) <= set(sizes) else sizes[-2:]
    if not sizes:
        raise ReportError(f"block 'gpu_stages' needs stages with bytes of {OURS} on {SCENE}")
    here = {n: known[known["n"] == n].set_index("stage") for n in sizes}
    names = dict.fromkeys([*(stage for n in sizes for stage in here[n].index[:-1]), bandwidth.ALL])
    lines = pd.concat([_stages(result, n, here[n]).reindex(names) for n in sizes], axis=1)
    lines.insert(0, "stage", [name if name == bandwidth.ALL else code(name) for name in names])
    labels = dict.fromkeys(code(here[n]["label"].iloc[0]) for n in sizes)
    copied = (
        f"; of copy: divided by the {grouped(result.gpu.copy_gbps)} GB/s that a copy on this "
        f"{result.gpu.name} reads and writes"
        if result.gpu
        else ""
    )
    note = [
        f"{', '.join(labels)}, scene {SCENE}, warm, runs with stage marks, median of the rounds. "
        f"GB/s: the least bytes that the stage must read and write, divided by its time{copied}."
    ]
    if any(here[n]["tiny"].any() for n in sizes):
        limit = f"{bandwidth.LAUNCH_US:g}"
        note.append(f"In brackets: so few bytes that copying them takes less than {limit} µs.")
    fused = result.stages[result.stages["row"] == here[sizes[-1]]["row"].iloc[0]]
    fused = fused.dropna(subset="fused_into")
    note += [f"{code(row.stage)} is inside {code(row.fused_into)}." for row in fused.itertuples()]
    return table(lines, " ".join(note))


def _stages(result: Result, n: int, rows: pd.DataFrame) -> pd.DataFrame:
    """The columns of one size."""
    shown = {
        f"{words.size(n)}: ms": rows["ms"].map(number),
        "share": (rows["ms"] / rows["ms"][bandwidth.ALL]).map(_percent),
        "GB/s": rows["gbps"].map(number),
    }
    if result.gpu:
        shown["of copy"] = rows["share"].map(_percent)
    found = pd.DataFrame(shown)
    rates = found.columns[2:]
    found[rates] = found[rates].mask(rows["tiny"], "(" + found[rates] + ")")
    return found


def _percent(share: float) -> str:
    return f"{words.percent(100 * share)} %" if pd.notna(share) else NONE


def sorts(result: SortResult) -> str:
    """A line per key width and sort, a column per size; behind each rate its ratio to CUB's."""
    rows = result.on("gpu").frame
    rows = rows[(rows["order"] == "random") & rows["bits"].isin(WIDTHS) & rows["n"].isin(SIZES)]
    if rows.empty:
        raise ReportError("block 'gpu_sorts' needs rows of a GPU at its sizes and key widths")
    cubs = {(r.bits, r.n): r for r in rows.itertuples() if r.algorithm == CUB}
    known = {name: place for place, name in enumerate(TITLES)}
    place = rows["algorithm"].map(known).fillna(len(known))
    cells = [_sorted(row, cubs.get((row.bits, row.n))) for row in rows.itertuples()]
    wide = rows.assign(place=place, cell=cells).pivot(
        index=["bits", "place", "title"], columns="n", values="cell"
    )
    lines = wide.rename(columns=lambda n: f"2^{n.bit_length() - 1}").reset_index()
    lines = lines.drop(columns="place").rename(columns={"title": "sort", "bits": "key bits"})
    gpu = result.context.gpu
    where = f" on {gpu.name}" if gpu else ""
    note = (
        f"10⁹ pairs a second{where} (32-bit key, 32-bit value), keys in random order, median of "
        f"the rounds; in brackets the rate divided by {TITLES[CUB]}'s, above 1 is faster."
    )
    return table(lines[["sort", "key bits", *lines.columns[2:]]], note)


def _sorted(row: Row, cub: Row | None) -> str:
    """'42.6 (1.16×)'."""
    if row.status != "ok":
        return bold("wrong") if row.status == "wrong" else "skipped"
    rate = number(median(row.rates))
    if cub is None or cub.algorithm == row.algorithm or cub.status != "ok":
        return rate
    return f"{rate} ({words.ratio(median(ratios(row.rates, cub.rates)))})"
