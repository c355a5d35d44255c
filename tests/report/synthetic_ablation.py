# SPDX-License-Identifier: MIT
"""Builds results of the preset ablation: planned rows, their variants, and forced methods.

A step of the ladder takes FACTORS[skip] of the time before it where the scene needs no such work;
forbidding the skip alone gives that back. Round k is all that times 1 + 0.02 k, as in synthetic.
"""

from __future__ import annotations

from collections.abc import Sequence

import synthetic
from synthetic import Json

STEPS = ("key_bits", "safe_band", "phantoms", "layers", "wide_cells", "passes", "sort", "grid")
MOVING = (*STEPS, "unchanged", "few_movers", "skin")
FACTORS = {"key_bits": 0.9, "safe_band": 0.95, "phantoms": 0.5, "sort": 0.8, "skin": 0.25}
START = 100.0  # ns per sphere, nothing skipped
DRIFT = (1.0, 1.02, 1.04)


def plan(method: str = "half_shell", skips: Sequence[str] = ()) -> Json:
    return {
        "method": method, "levels": 1, "key_bits": 20, "sort_passes": 3, "skips": list(skips),
    }  # fmt: skip


def planned(
    ns: float, skips: str | None = None, taken: Sequence[str] = (), **where: object
) -> Json:
    """The planned row, or the variant of it that is named."""
    known = _timed("planned", None, ns, **where)
    known["plan"] = plan(skips=taken)
    if skips is not None:
        name = known["name"].replace("/scene:", f"/skips:{skips}/scene:")
        known |= {"skips": skips, "name": name}
    return known


def forced(method: str, rule: str | None, ns: float, **where: object) -> Json:
    return _timed(method, rule, ns, **where) | {"plan": plan(method)}


def _timed(method: str, rule: str | None, ns: float, **where: object) -> Json:
    n = int(str(where.get("n", 1000)))
    known = synthetic.row("impl_cpu", method, rule, **where)
    known["total_ms"] = [ns * n / 1e6 * drift for drift in DRIFT]
    return known | {"skips": None}


def group_rows(
    scene: str = "gas", n: int = 1000, backend: str = "impl_cpu", **changes: float
) -> list[Json]:
    """Every row of one group; `half_shell` and `home_phantom` are their times by the planned."""
    taken = [skip for skip in STEPS if skip in FACTORS]
    return _rows(STEPS, taken, changes, {"scene": scene, "n": n, "backend": backend})


def moving_rows(scene: str = "gas_brownian", n: int = 1000) -> list[Json]:
    """The same for a scene that moves, frames and all; the first frame does not count."""
    rows = _rows(MOVING, list(FACTORS), {}, {"scene": scene, "n": n, "run": "dynamic"})
    for row in rows:
        frames = [[9 * ms, ms, ms, ms] for ms in row["total_ms"]]
        row["frames"] = {"scene": scene, "warmup_frames": 1, "frame_ms": frames}
    return rows


def _rows(
    steps: Sequence[str], taken: list[str], changes: dict[str, float], where: Json
) -> list[Json]:
    end = START
    for skip in taken:
        end *= FACTORS[skip]
    where = dict(where)
    backend = where.pop("backend", "impl_cpu")
    rows = [planned(end, None, taken, **where), planned(START, "none", (), **where)]
    ns, allowed = START, []
    for number, skip in enumerate(steps, start=1):
        ns *= FACTORS.get(skip, 1.0)
        allowed += [skip] * (skip in taken)
        rows.append(planned(ns, f"first_{number}_{skip}", allowed, **where))
    for skip in steps:
        rest = [other for other in taken if other != skip]
        rows.append(planned(end / FACTORS.get(skip, 1.0), f"no_{skip}", rest, **where))
    for method, rule in (("home_phantom", "lowest_cell"), ("half_shell", None)):
        rows.append(forced(method, rule, end * changes.get(method, 1.5), **where))
    for row in rows:
        row["name"] = row["name"].replace("backend:impl_cpu", f"backend:{backend}")
        row["backend"] = backend
    return rows


def document(*rows: Json, **changes: object) -> Json:
    places = dict.fromkeys((row["scene"], row["n"]) for row in rows)
    groups = [synthetic.group(scene, n) for scene, n in places]
    return synthetic.document(groups, list(rows), **({"preset": "ablation"} | changes))


def every_case() -> Json:
    """Two backends; a wrong variant and a skipped one; a scene without an exact plan; one that
    moves; a better choice that the planner missed."""
    rows = group_rows("gas", half_shell=0.6) + group_rows("dense", 5000)
    rows += group_rows("gas", backend="impl_thrust", half_shell=0.97) + moving_rows()
    lost = group_rows("poly", 2000)
    lost[0] = synthetic.wrong(lost[0], missed=4)
    for index, row in enumerate(rows):
        if row["scene"] != "dense":
            continue
        if row["skips"] in ("no_sort", "first_3_phantoms"):
            rows[index] = synthetic.wrong(row, missed=3, false=1)
        elif row["skips"] == "no_grid":
            rows[index] = synthetic.skipped(row, "4999950000 candidates, over the limit") | {
                "plan": None
            }
    return document(*rows, *lost)
