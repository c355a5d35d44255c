# SPDX-License-Identifier: MIT
"""The rows of a result as pandas frames. Get them from a Result: frame, variants_frame, stages.

Both `frame` and `variants_frame` have one line per row of the JSON (skipped rows too), in the
order of the JSON. The columns:

    name kind backend method rule predicate threads skips   as in the JSON, except that predicate
                                is None where it is `exact`
    scene n run motion          where and how it ran; motion: how spheres move, None at rest
    label                       short name of the implementation, unique among implementations
    order                       place of the implementation in tables; sort by it
    side                        backend (on the host), device, baseline
    family                      library of a baseline (fcl, bullet); else the backend
    status reason negative_control known_issues   as in the JSON;
    ran                         False: skipped, so there are no numbers
    counts                      True: exact and no negative control, so its time may stand alone
    excused                     wrong, but only by its library's known issues
    round_ms                    tuple, one time per round: the steady frame of moving scenes, else
                                total_ms; empty if skipped
    median_ms min_ms max_ms rounds                of round_ms
    ns_per_sphere               of median_ms; NaN without spheres
    pairs checksum missed false duplicates candidates uncertain_pairs distinct_checksums
    plan_ms peak_bytes device_bytes output_bytes worst_missed_depth worst_false_gap
    beyond_bytes                bytes per sphere beyond input and output; NaN on a device
    candidates_per_pair         NaN if unknown, or without true pairs
    truth_pairs truth_checksum scene_class real   of the row's group
    group                       place of the group in the JSON
    plan                        the Plan, or None

Whole numbers that may be absent are of dtype Int64 (pd.NA where absent), other numbers are floats
(NaN), texts are objects (None).

`stages` has one line per row and stage, in the order in which stages run: `row` (index of the row
in `frame`), `stage`, `round_ms` (tuple), `median_ms`, `least_bytes` and `fused_into` (the stage
whose time holds this one; it then has no time of its own).

`motion_frames` has one line per row and frame of a moving scene: `row`, `frame`, `warmup`,
`median_ms`, `min_ms`, `max_ms` over the rounds.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from statistics import median
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from msgspec.structs import asdict

from octocell_report.schema import Impl, Row

if TYPE_CHECKING:
    from octocell_report.load import Result

_TYPES = {
    **dict.fromkeys(("n", "threads", "order", "rounds", "group"), "int64"),
    **dict.fromkeys(("negative_control", "ran", "counts", "excused", "real"), "bool"),
    **dict.fromkeys(("pairs", "missed", "false", "duplicates", "candidates"), "Int64"),
    **dict.fromkeys(("uncertain_pairs", "truth_pairs", "distinct_checksums"), "Int64"),
    **dict.fromkeys(("peak_bytes", "device_bytes", "output_bytes"), "Int64"),
    **dict.fromkeys(("plan_ms", "median_ms", "min_ms", "max_ms"), "float64"),
    **dict.fromkeys(("worst_missed_depth", "worst_false_gap"), "float64"),
}
_DERIVED = (
    *("label", "order", "side", "family", "ran", "counts", "excused", "round_ms", "rounds"),
    *(
        "median_ms",
        "min_ms",
        "max_ms",
        "truth_pairs",
        "truth_checksum",
        "scene_class",
        "real",
        "group",
    ),
)


def labels(impls: Sequence[Impl]) -> dict[Impl, str]:
    """Backend, and of method, rule, predicate and threads what tells it from others."""
    methods: dict[tuple[str, str | None], set[str | None]] = defaultdict(set)
    for impl in impls:
        methods[impl.backend, impl.rule].add(impl.method)
    threads = {impl.threads for impl in impls}

    def label(impl: Impl) -> str:
        words = [impl.backend]
        if impl.rule and impl.method and len(methods[impl.backend, impl.rule]) > 1:
            words.append(f"{impl.method}/{impl.rule}")
        elif impl.rule or impl.method:
            words.append(impl.rule or impl.method or "")
        if impl.predicate:
            words.append(impl.predicate)
        if impl.threads != 1 and len(threads) > 1:
            words.append(f"({impl.threads} threads)")
        return " ".join(words)

    return {impl: label(impl) for impl in impls}


def rows_frame(result: Result, rows: Iterable[Row]) -> pd.DataFrame:
    groups = {group.place: (index, group) for index, group in enumerate(result.groups)}
    order = {impl: index for index, impl in enumerate(result.impls)}
    sides = result.sides

    def line(row: Row) -> dict[str, Any]:
        impl, times = row.impl, row.round_ms
        index, group = groups[row.place]
        return asdict(row) | {
            "predicate": impl.predicate,
            "motion": row.motion.scene if row.motion else None,
            "label": result.labels.get(impl, impl.backend),
            "order": order.get(impl, len(order)),
            "side": sides.get(impl, row.kind),
            "family": impl.backend.split("_", 1)[0] if row.kind == "baseline" else impl.backend,
            "ran": row.status != "skipped",
            **{"counts": row.counts, "excused": row.excused},
            **{"round_ms": times, "rounds": len(times), "median_ms": row.median_ms},
            **{"min_ms": min(times, default=None), "max_ms": max(times, default=None)},
            **{"truth_pairs": group.truth_pairs, "scene_class": group.scene_class},
            "truth_checksum": group.truth.checksum if group.truth else None,
            **{"real": group.real, "group": index},
        }

    columns = [*Row.__struct_fields__, *_DERIVED]
    frame = pd.DataFrame(map(line, rows), columns=columns, dtype=object).astype(_TYPES)
    n = frame["n"].where(frame["n"] > 0).astype("float64")
    truth = frame["truth_pairs"].where(frame["truth_pairs"] > 0).astype("float64")
    beyond = (frame["peak_bytes"] - frame["output_bytes"].fillna(0)).astype("float64") / n
    return frame.assign(
        ns_per_sphere=frame["median_ms"] * 1e6 / n,
        beyond_bytes=beyond.where(frame["device_bytes"].isna()),
        candidates_per_pair=frame["candidates"].astype("float64") / truth,
    )


def stages_frame(rows: Iterable[Row]) -> pd.DataFrame:
    columns = ("row", "stage", "round_ms", "median_ms", "least_bytes", "fused_into")
    lines: list[tuple[Any, ...]] = []
    for index, row in enumerate(rows):
        for stage, ms in row.stage_ms.items():
            lines.append((index, stage, ms, median(ms), row.stage_bytes.get(stage), None))
        for stage, host in row.fused.items():
            lines.append((index, stage, (), np.nan, row.stage_bytes.get(stage), host))
    return pd.DataFrame(lines, columns=columns).astype(
        {"median_ms": "float64", "least_bytes": "Int64"}
    )


def motion_frame(rows: Iterable[Row]) -> pd.DataFrame:
    return pd.DataFrame(
        [
            (index, frame, frame < row.motion.warmup, median(times), min(times), max(times))
            for index, row in enumerate(rows)
            if row.motion
            for frame, times in enumerate(zip(*row.motion.frame_ms, strict=True))
        ],
        columns=("row", "frame", "warmup", "median_ms", "min_ms", "max_ms"),
    )
