# SPDX-License-Identifier: MIT
"""Results of the error study: every predicate on random, structured and extreme scenes.

Losses per million true pairs are those once measured for such scenes, times are a plain law: of the
exact row of a backend the predicate's share. Round k is all that times 1 + 0.02 k.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import synthetic
from synthetic import Json

TENTHS, FAR = "lattice(spacing=0.1)", "shifted(offset=1e7)"

# scene: class, true pairs per million spheres, how much dearer than gas
SCENES: dict[str, tuple[str, int, float]] = {
    "gas": ("random", 398_123, 1.0),
    "poly": ("random", 612_004, 1.4),
    "dense": ("random", 1_650_313, 1.7),
    "fcc": ("structured", 5_850_400, 2.3),
    "lattice": ("structured", 2_970_000, 1.3),
    TENTHS: ("structured", 2_970_000, 1.3),
    FAR: ("extreme", 398_120, 1.05),
    "subnormal": ("extreme", 398_123, 1.2),
    "huge": ("extreme", 401_877, 1.1),
}
SPHERES = 1_000_000

# share of the exact time; scene: (missed, false) per million; others without error
PREDICATES: dict[str, tuple[float, dict[str, tuple[int, int]]]] = {
    "exact": (1.0, {}),
    "q16_exact": (0.94, {}),
    "f64": (1.31, {"huge": (0, 3)}),
    "f32": (0.97, {"fcc": (0, 1014), TENTHS: (2105, 940), "subnormal": (0, 5_100_000),
                   "huge": (212_000, 0)}),
    "f32_sqrt": (1.06, {"fcc": (0, 24_835), TENTHS: (2870, 1360), "subnormal": (0, 5_100_000),
                        "huge": (212_000, 0)}),
    "q16_cell": (0.86, {"gas": (0, 38), "poly": (37, 0), "dense": (0, 31), "fcc": (975_165, 0),
                        "lattice": (310_000, 0), TENTHS: (490_000, 12), FAR: (0, 38)}),
    "gram_f32": (0.91, {"fcc": (6744, 7338), TENTHS: (4100, 3900), FAR: (2, 5),
                        "subnormal": (0, 5_100_000), "huge": (212_000, 0)}),
    "f16_cell": (0.81, {"gas": (101, 126), "poly": (243, 317), "dense": (140, 155),
                        "fcc": (0, 764_318), TENTHS: (120_000, 310_000), FAR: (25, 101),
                        "subnormal": (812, 700), "huge": (95, 88)}),
    "aabb_only": (0.78, {s: (0, 910_000 + 40_000 * k) for k, s in enumerate(SCENES)}),
}  # fmt: skip
DEPTHS = {"f32": 3.1e-8, "f32_sqrt": 6.2e-8, "gram_f32": 2.4e-7, "q16_cell": 1.5e-5,
          "f16_cell": 3.2e-4, "aabb_only": 0.7, "f64": 1e-16}  # fmt: skip

# backend, method, rule, ns per sphere of its exact row on gas, predicates that it has
ALL = tuple(PREDICATES)
CPU = (("impl_cpu", "half_shell", None, 27.4, ALL),
       ("impl_thrust", "home_phantom", "lowest_cell", 115.0, ("exact", "f32", "f64",
                                                                     "aabb_only")))  # fmt: skip
GPU = (("impl_cuda_custom", "half_shell", None, 0.154, ALL),
       ("impl_thrust_cuda", "home_phantom", "lowest_cell", 0.84,
        ("exact", "f32", "f64")))  # fmt: skip
LIBRARIES = (("fcl_dynamic_aabb_tree_array_morton", 744.0, {}),
             ("bullet_dbvt", 2229.0, {}),
             ("fcl_interval_tree", 5100.0,
              {TENTHS: (446_000, 0), "lattice": (300, 0)}))  # fmt: skip


def group(scene: str, n: int = SPHERES, **changes: Any) -> Json:
    kind, pairs, _ = SCENES[scene]
    truth = {"pairs": pairs * n // SPHERES, "checksum": f"0x{n:016x}"}
    lost = {
        FAR: {"lost": 1204, "gained": 1187},
        TENTHS: {"lost": 410_000, "gained": 0},
    }
    known = {"truth": truth, "scene_class": kind, "input_rounding": lost.get(scene)}
    return synthetic.group(scene, n, **(known | changes))


def row(
    backend: str = "impl_cpu",
    method: str | None = "half_shell",
    rule: str | None = None,
    predicate: str | None = "exact",
    scene: str = "gas",
    n: int = SPHERES,
    ns: float = 27.4,
    losses: tuple[int, int] = (0, 0),
    **changes: Any,
) -> Json:
    """Losses are absolute; a row with some is wrong, and a negative control unless it claims to
    be exact."""
    times = [ns * n / 1e6 * (1 + 0.02 * k) for k in range(5)]
    known = synthetic.row(backend, method, rule, scene, n, "warm", times)
    truth = group(scene, n)["truth"]
    known |= {"predicate": predicate, "pairs": truth["pairs"], "checksum": truth["checksum"]}
    known |= {
        "negative_control": predicate not in (None, "exact", "q16_exact"),
        "distinct_checksums": 1,
    }
    known |= {"worst_missed_depth": None, "worst_false_gap": None, "skips": None}
    known["name"] = known["name"].replace("/scene:", f"/predicate:{predicate}/scene:")
    if backend in ("impl_cuda_custom", "impl_thrust_cuda"):
        known["device_bytes"] = 72 * n
    if method:
        known["candidates"] = 155 * truth["pairs"]
    if any(losses):
        known = synthetic.wrong(known, *losses)
        size = DEPTHS.get(predicate or "", 1e-3)
        known["worst_missed_depth"] = size if losses[0] else None
        known["worst_false_gap"] = size if losses[1] else None
    return known | changes


def rows(backends: Sequence[tuple[Any, ...]], n: int = SPHERES) -> list[Json]:
    """Every predicate that a backend has, on every scene."""
    found = []
    for scene, (_, pairs, dearer) in SCENES.items():
        for backend, method, rule, ns, has in backends:
            for predicate in has:
                share, errors = PREDICATES[predicate]
                lost = tuple(rate * pairs // 1_000_000 for rate in errors.get(scene, (0, 0)))
                known = row(
                    backend,
                    method,
                    rule,
                    predicate,
                    scene,
                    n,
                    ns * dearer * share,
                    (lost[0], lost[1]),
                )
                extra = (share - 1) * known["total_ms"][0] if predicate != "exact" else 0.0
                known["stage_ms"]["pair_tests"] = [
                    (0.4 * t / share + extra) for t in known["total_ms"]
                ]
                found.append(known)
    return found


def library_rows(n: int = SPHERES) -> list[Json]:
    found = []
    for scene, (_, pairs, dearer) in SCENES.items():
        for backend, ns, errors in LIBRARIES:
            missed, false = (rate * pairs // 1_000_000 for rate in errors.get(scene, (0, 0)))
            found.append(
                row(backend, None, None, None, scene, n, ns * dearer, (missed, false))
                | {"known_issues": "pairs that touch are lost" if errors else None}
            )
    return found


def document(*rows: Json, **changes: Any) -> Json:
    places = dict.fromkeys((row["scene"], row["n"]) for row in rows)
    groups = [group(scene, n) for scene, n in places]
    return synthetic.document(groups, list(rows), **({"preset": "error"} | changes))


def host() -> Json:
    return document(*rows(CPU), *library_rows())


def device() -> Json:
    """Of another machine, where the host ran, too."""
    machine = synthetic.context()["machine"] | {"cpu": "Example CPU of the GPU's machine"}
    gpu = {"name": "Example GPU 100", "copy_gigabytes_per_second": 2900.0}
    return document(*rows(GPU), *rows(CPU[:1]), machine=machine, gpu=gpu)
