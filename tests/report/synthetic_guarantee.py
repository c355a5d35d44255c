# SPDX-License-Identifier: MIT
"""Evidence as its programs write it: one document per kind."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import synthetic
from synthetic import Json

ENDINGS = ("exact", "skipped", "refused", "late", "crashed", "wrong")


def document(kind: str, **content: Any) -> Json:
    return {"schema": 2, "kind": kind, "context": synthetic.context()} | content


def near_tangent(where: str = "CPU", **pairs: tuple[int, int]) -> Json:
    """By family: (pairs, mismatches)."""
    known = pairs or {"lattice": (1_000_000_000, 0), "quadruples": (250_000_000, 0)}
    families = [{"name": n, "pairs": p, "mismatches": m} for n, (p, m) in known.items()]
    return document("near_tangent", where=where, families=families)


def stress_row(
    entry: str, implementation: str, losses: tuple[int, int, int] = (0, 0, 0), **cases: int
) -> Json:
    backend = implementation.split()[0]
    missed, false, duplicates = losses
    return {
        "entry": entry, "implementation": implementation, "backend": backend,
        "kind": "backend" if backend.startswith("impl_") else "baseline",
        "cases": dict.fromkeys(ENDINGS, 0) | cases,
        "missed": missed, "false": false, "duplicates": duplicates,
    }  # fmt: skip


def stress() -> Json:
    asks = {"A1": "pairs", "A2": "pairs", "C20": "refusal"}
    entries = [{"id": entry, "name": entry, "asks": asked} for entry, asked in asks.items()]
    rows = [
        stress_row("A1", "impl_cpu planned", exact=3),
        stress_row("A1", "impl_cpu home_phantom chapter32", exact=2, refused=1),
        stress_row("A1", "fcl_sap", (9, 0, 4), exact=2, wrong=1),
        stress_row("A1", "bullet_dbvt", exact=2, late=1),
        stress_row("A2", "impl_cpu planned", exact=1),
        stress_row("A2", "fcl_sap", exact=1),
        stress_row("C20", "impl_cpu planned", exact=27),
        stress_row("C20", "fcl_sap", skipped=27),
        stress_row("C20", "bullet_dbvt", skipped=27),
    ]
    return document("stress", entries=entries, rows=rows)


def compilers(**changes: Any) -> Json:
    names = ["g++ -O0", "g++ -O3 -mfma", "clang++ -O3"]
    known = {"configurations": names, "checksums": 84, "failures": [], "refused": ["g++ -Ofast"]}
    return document("compilers", **(known | changes))


def fuzz(crashes: int = 0) -> Json:
    targets = [
        {"name": "fuzz_scenes", "runs": 4_000_000, "seconds": 300.5, "crashes": crashes},
        {"name": "fuzz_files", "runs": 9_000_000, "seconds": 300.0, "crashes": 0},
    ]
    return document("fuzz", targets=targets)


def fault(name: str, status: str = "killed", **changes: Any) -> Json:
    known = {"name": name, "what": f"{name} is off by one", "status": status, "reason": None}
    return known | {"killed_by": "test_grid" if status == "killed" else None} | changes


def mutants(*faults: Json) -> Json:
    every = faults or (fault("floor"), fault("cuda_wrap", "not_run", reason="no device"))
    return document("mutants", faults=list(every))


def sanitizers(reports: int = 0) -> Json:
    tools = [
        {"name": "ASan + UBSan", "tests": 215, "reports": reports},
        {"name": "TSan", "tests": 198, "reports": 0},
    ]
    return document("sanitizers", tools=tools)


def save(folder: Path, **documents: Json) -> Path:
    """Each as NAME.json in a machine's folder; the folder of results."""
    machine = folder / "results" / "epyc"
    machine.mkdir(parents=True, exist_ok=True)
    for name, content in documents.items():
        (machine / f"{name}.json").write_text(json.dumps(content), encoding="utf-8")
    return machine.parent


def save_all(folder: Path) -> Path:
    return save(
        folder,
        near_tangent=near_tangent(),
        near_tangent_gpu=near_tangent("GPU", lattice=(12_000_000_000, 0)),
        stress=stress(),
        compilers=compilers(),
        fuzz=fuzz(),
        mutants=mutants(),
        sanitizers=sanitizers(),
    )
