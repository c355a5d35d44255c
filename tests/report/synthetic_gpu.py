# SPDX-License-Identifier: MIT
"""Results of a GPU as the bench writes them: the device goes on where host and baselines end.

A stage on the device takes a launch, and then its least bytes at a share of the copy bandwidth.
"""

from __future__ import annotations

from typing import Any

import synthetic
from synthetic import Json

COPY = 2900.0  # GB/s
LAUNCH_MS = 0.004
SIZES = (10_000, 100_000, 1_000_000, 10_000_000, 30_000_000)
HOST_LIMIT = 1_000_000

# stage: bytes per sphere, and the share of the copy bandwidth that it reaches
STAGES = {
    "bounds": (16.0, 0.9), "cell_ids": (24.0, 0.8), "sort": (64.0, 0.6),
    "cell_index": (0.5, 0.3), "pair_tests": (40.0, 0.08),
}  # fmt: skip

# name, rule, how many times as long as the fastest, device bytes per sphere
OURS = (
    ("impl_cuda_custom", "lowest_cell", 1.0, 72),
    ("impl_cuda_custom", "chapter32", 1.3, 80),
    ("impl_cuda_custom", "as_written", 1.2, 76),
    ("impl_thrust_cuda", "lowest_cell", 2.5, 140),
    ("impl_thrust_cuda", "chapter32", 3.1, 150),
)
HOST = (("impl_cpu", "lowest_cell", 1), ("impl_cpu", "lowest_cell", 16),
        ("impl_cpu", "chapter32", 1), ("impl_thrust", "lowest_cell", 1))  # fmt: skip


def gpu(**changes: Any) -> Json:
    return {"name": "Example GPU 100", "copy_gigabytes_per_second": COPY} | changes


def stage_times(n: int, cost: float, cached: bool) -> dict[str, float]:
    """Milliseconds; what fits a cache is read twice as fast."""
    faster = 2.0 if cached and n <= 100_000 else 1.0
    return {
        stage: cost * (LAUNCH_MS + need * n / (share * COPY * faster * 1e6))
        for stage, (need, share) in STAGES.items()
    }


def device_row(
    backend: str = "impl_cuda_custom",
    rule: str = "lowest_cell",
    scene: str = "gas",
    n: int = 1_000_000,
    run: str = "warm",
    cost: float = 1.0,
    need: int = 72,
    **changes: Any,
) -> Json:
    stages = stage_times(n, cost, cached=run != "cold_cache")
    bare = sum(stages.values())
    whole = {
        "cold": 3.0 + 5 * bare, "warm": bare, "cold_cache": bare, "graph": 0.9 * bare,
        "transfers": bare + 16 * n / 25e6,
    }[run]  # fmt: skip
    rounds = [1 + 0.02 * k for k in range(3)]
    marked = run in ("cold", "warm", "cold_cache")
    known = {
        "stage_ms": {s: [t * r for r in rounds] for s, t in stages.items()} if marked else {},
        "stage_bytes": {s: int(each * n) for s, (each, _) in STAGES.items()} if marked else {},
        "fused": {"resolve": "pair_tests"}, "device_bytes": need * n,
    }  # fmt: skip
    times = [whole * r for r in rounds]
    row = synthetic.row(backend, "home_phantom", rule, scene, n, run, times)
    return row | known | changes


def _device(scene: str, n: int, scale: float) -> list[Json]:
    found = []
    for backend, rule, cost, need in OURS:
        custom = backend == "impl_cuda_custom"
        for run in ("cold", "warm", *(("cold_cache", "graph", "transfers") if custom else ())):
            row = device_row(backend, rule, scene, n, run, cost * scale, need)
            if rule == "as_written":
                row = synthetic.wrong(row | {"negative_control": True}, missed=n // 3 + 1)
            found.append(row)
    return found


def _host(scene: str, n: int, scale: float) -> list[Json]:
    found = []
    for backend, rule, threads in HOST:
        for run, factor in (("cold", 1.3), ("warm", 1.0)):
            slower = 1.5 if backend == "impl_thrust" or rule == "chapter32" else 1.0
            times = synthetic.times(7e-5 * factor * scale * slower / threads**0.8, 1.0, n)
            row = synthetic.row(backend, "home_phantom", rule, scene, n, run, times)
            name = row["name"].replace("threads:1", f"threads:{threads}")
            found.append(row | {"threads": threads, "name": name, "device_bytes": None})
    for backend, factor, power, need in synthetic.BASELINES:
        for run in synthetic.RUN_FACTORS:
            times = synthetic.times(factor * scale, power, n)
            row = synthetic.row(backend, None, None, scene, n, run, times)
            found.append(row | {"peak_bytes": need * n + row["output_bytes"]})
    return found


def whole_run(scenes: tuple[str, ...] = ("gas", "poly"), **changes: Any) -> Json:
    """Every backend on every scene; host and baselines up to HOST_LIMIT."""
    groups, rows = [], []
    for index, scene in enumerate(scenes):
        for n in SIZES if scene == "gas" else SIZES[:-1]:
            groups.append(synthetic.group(scene, n))
            scale = 1 + 0.4 * index
            rows += _device(scene, n, scale)
            rows += _host(scene, n, scale) if n <= HOST_LIMIT else []
    return synthetic.document(groups, rows, **({"gpu": gpu()} | changes))
