# SPDX-License-Identifier: MIT
"""Builds results in the bench's format, with times that follow known laws.

A row's time is factor * n ** power, the factor by implementation; round k is that times
1 + 0.02 k, for all rows alike, as a drifting clock would do it.
"""

from __future__ import annotations

from typing import Any

Json = dict[str, Any]

STAGE_SHARES = {
    "bounds": 0.03, "cell_ids": 0.15, "sort": 0.3, "cell_index": 0.07, "pair_tests": 0.4,
    "resolve": 0.05,
}  # fmt: skip
BASELINE_SHARES = {"build": 0.4, "query": 0.6}
UPDATE_SHARES = {"update": 0.3, "query": 0.7}

# name, method, rule, factor [ms], power, bytes per sphere
OURS = [
    ("impl_cpu", "home_phantom", "lowest_cell", 1.5e-4, 1.04, 96),
    ("impl_cpu", "home_phantom", "chapter32", 1.7e-4, 1.04, 104),
    ("impl_cpu", "home_phantom", "as_written", 1.6e-4, 1.03, 98),
    ("impl_cpu", "brute_force", None, 9e-7, 2.0, 0),
]
BASELINES = [
    ("fcl_dynamic_aabb_tree", 8e-4, 1.12, 310),
    ("fcl_dynamic_aabb_tree_morton", 7e-4, 1.11, 330),
    ("fcl_dynamic_aabb_tree_array", 9e-4, 1.13, 290),
    ("fcl_dynamic_aabb_tree_array_morton", 8.5e-4, 1.12, 300),
    ("bullet_dbvt_broadphase", 1.1e-3, 1.16, 520),
    ("bullet_dbvt_broadphase_deferred", 6e-4, 1.1, 510),
    ("bullet_dbvt", 4e-4, 1.08, 260),
]
RUN_FACTORS = {"cold": 1.6, "warm": 1.0, "first_update": 1.2, "update": 0.7}


def context(**changes: Any) -> Json:
    known: Json = {
        "date": "2026-01-02T03:04:05Z", "commit": "0123456789abcdef0123456789abcdef01234567",
        "dirty": False, "version": "0.1.0",
        "machine": {"name": "host", "cpu": "Example CPU 9000", "cores": 2,
                    "memory_bytes": 25_000_000_000, "os": "Debian GNU/Linux 12"},
        "compiler": "g++ 12.2.0", "flags": "-O3 -march=native -DNDEBUG",
        "instruction_set": "avx2 fma", "build_type": "Release",
        "libraries": {"fcl": "0.7.0", "bullet": "3.24", "benchmark": "1.7.1"},
        "preset": "quick", "rounds": 3, "candidate_limit": 3_000_000_000, "finished": True,
    }  # fmt: skip
    return known | changes


def group(scene: str, n: int, **changes: Any) -> Json:
    known: Json = {
        "scene": scene, "n": n, "spec": f"{scene}:n={n},seed=1", "real": False,
        "unavailable": None, "truth": {"pairs": 2 * n, "checksum": f"0x{n:016x}"},
    }  # fmt: skip
    return known | changes


def unavailable_group(scene: str = "1A2C") -> Json:
    why = f"data/{scene}.pqr is not there: fetch it first"
    return group(scene, 0, spec=f"pqr:{scene}", real=True, unavailable=why, truth=None)


def row(
    backend: str = "impl_cpu",
    method: str | None = "home_phantom",
    rule: str | None = "lowest_cell",
    scene: str = "gas",
    n: int = 1000,
    run: str = "warm",
    total_ms: list[float] | None = None,
    **changes: Any,
) -> Json:
    """An exact row; changes replace its fields."""
    ours = method is not None
    times = [1.0, 1.02, 1.04] if total_ms is None else total_ms
    shares = STAGE_SHARES if ours else UPDATE_SHARES if "update" in run else BASELINE_SHARES
    variant = f"/method:{method}/rule:{rule}" if ours else ""
    known: Json = {
        "name": f"find_pairs/backend:{backend}{variant}/scene:{scene}/n:{n}/threads:1/run:{run}",
        "backend": backend, "kind": "backend" if ours else "baseline",
        "method": method, "rule": rule, "scene": scene, "n": n, "threads": 1, "run": run,
        "negative_control": False, "status": "ok", "reason": None,
        "pairs": 2 * n, "checksum": f"0x{n:016x}", "missed": 0, "false": 0, "duplicates": 0,
        "candidates": 9 * n if ours else None, "uncertain_pairs": n // 5000 if ours else None,
        "iterations": 4, "total_ms": times,
        "stage_ms": {stage: [share * t for t in times] for stage, share in shares.items()},
        "marked_total_ms": [1.01 * t for t in times],
        "plan_ms": 0.05 if ours else None, "fused": {},
        "peak_bytes": 100 * n + 16 * n, "output_bytes": 16 * n,
    }  # fmt: skip
    return known | changes


def wrong(known: Json, missed: int, false: int = 0, duplicates: int = 0, **changes: Any) -> Json:
    losses = {"missed": missed, "false": false, "duplicates": duplicates}
    pairs = {"pairs": max(0, known["pairs"] - missed) + false + duplicates, "checksum": "0xbad"}
    return known | {"status": "wrong"} | losses | pairs | changes


def skipped(known: Json, reason: str) -> Json:
    nothing = dict.fromkeys(
        ("pairs", "checksum", "missed", "false", "duplicates", "candidates", "uncertain_pairs",
         "plan_ms", "peak_bytes", "output_bytes")
    )  # fmt: skip
    empty = {"total_ms": [], "stage_ms": {}, "marked_total_ms": []}
    return known | nothing | empty | {"status": "skipped", "reason": reason}


def document(groups: list[Json], rows: list[Json], **changes: Any) -> Json:
    return {"schema": 2, "context": context(**changes), "groups": groups, "rows": rows}


def times(factor: float, power: float, n: int, rounds: int = 3) -> list[float]:
    return [factor * n**power * (1 + 0.02 * k) for k in range(rounds)]


def whole_run(sizes: dict[str, list[int]], **changes: Any) -> Json:
    """Every implementation on every scene, with as_written losing pairs and brute force limited."""
    groups, rows = [], []
    for cost, (scene, ns) in enumerate(sizes.items()):
        for n in ns:
            groups.append(group(scene, n))
            rows += _ours(scene, n, 1 + 0.4 * cost) + _baselines(scene, n, 1 + 0.6 * cost)
    groups.append(unavailable_group())
    return document(groups, rows, **changes)


def _ours(scene: str, n: int, cost: float) -> list[Json]:
    found = []
    for name, method, rule, factor, power, need in OURS:
        for run in ("cold", "warm"):
            ms = times(factor * cost * RUN_FACTORS[run], power, n)
            known = row(name, method, rule, scene, n, run, ms)
            known["peak_bytes"] = need * n + known["output_bytes"]
            candidates = n * (n - 1) // 2
            if rule is None and candidates > context()["candidate_limit"]:
                known = skipped(known, f"{candidates} candidates, over the limit of 3000000000")
            elif rule is None:
                known["candidates"] = candidates
                known["stage_ms"] = {"pair_tests": ms}
                known["fused"] = {"resolve": "pair_tests"}
            elif rule == "as_written":
                known = wrong(known | {"negative_control": True}, missed=n // 3 + 1)
            found.append(known)
    return found


def _baselines(scene: str, n: int, cost: float) -> list[Json]:
    found = []
    for name, factor, power, need in BASELINES:
        for run, times_run in RUN_FACTORS.items():
            ms = times(factor * cost * times_run, power, n)
            known = row(name, None, None, scene, n, run, ms)
            known["peak_bytes"] = need * n + known["output_bytes"]
            found.append(known)
    return found


def every_case() -> Json:
    """Ok, wrong, a negative control, skipped, unavailable, interrupted, fused, one size, none."""
    document = whole_run(
        {"gas": [1000, 10_000, 100_000], "poly": [1000, 10_000], "giant": [5000]}, finished=False
    )
    rows = document["rows"]
    for index, known in enumerate(rows):
        if known["rule"] == "chapter32" and known["scene"] == "poly":
            rows[index] = skipped(known, "chapter32 needs radii within a factor of 2")
        if known["backend"] == "bullet_dbvt" and known["scene"] == "poly" and known["n"] == 10_000:
            rows[index] = wrong(known, missed=3, false=20, duplicates=2)
    document["groups"].insert(0, group("gas", 0))
    for run in ("cold", "warm"):
        rows.append(row(n=0, run=run, total_ms=[0.0, 0.001, 0.001]))
    return document
