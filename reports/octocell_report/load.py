# SPDX-License-Identifier: MIT
"""The bench JSON, read and checked, as pandas frames: what gets past load() needs no second look.

`frame` and `variants_frame` of a Result have a line per row of the JSON (skipped rows too), in its
order, and its fields as columns, except that `predicate` is None where it is `exact`. Beside them:

    label order     of the implementation: its short name, unique, and its place in tables
    side family     backend (on the host), device or baseline; the library of a baseline (fcl)
    ran             False: skipped, so there are no numbers
    counts          exact and no negative control, so its time may stand alone
    errors          pairs missed, false and given twice together; 0 where that is not known
    excused         wrong, but only by its library's known issues
    motion          how spheres move; None at rest
    round_ms        tuple, a time per round: the steady frame of moving scenes, else total_ms
    median_ms min_ms max_ms rounds ns_per_sphere        of round_ms
    beyond_bytes    bytes per sphere beyond input and output; NaN on a device
    candidates_per_pair                                 NaN without true pairs
    group truth_pairs truth_checksum scene_class real   of the row's group; its place in `groups`

Whole numbers that may be absent are of dtype Int64 (pd.NA where absent), other numbers are floats
(NaN), texts are objects (None).
"""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
import pandas as pd
from msgspec.structs import asdict

from octocell_report.fields import Json, ReportError, convert, shown
from octocell_report.files import read_json
from octocell_report.predicates import EXACT
from octocell_report.schema import DEVICE_RUNS, RUNS, STAGES, Document, Gpu, Group, Place, Row

__all__ = ["DEVICE_RUNS", "RUNS", "STAGES", "Group", "Place", "Result", "load", "parse"]

SCHEMA = 2
_IMPLEMENTATION = ["backend", "method", "rule", "threads", "predicate"]  # what is compared
_TYPES = {
    **dict.fromkeys(("n", "threads", "rounds"), "int64"),
    **dict.fromkeys(("negative_control", "ran", "counts", "excused"), "bool"),
    **dict.fromkeys(("pairs", "missed", "false", "duplicates", "candidates"), "Int64"),
    **dict.fromkeys(("uncertain_pairs", "distinct_checksums"), "Int64"),
    **dict.fromkeys(("peak_bytes", "device_bytes", "output_bytes"), "Int64"),
    **dict.fromkeys(("plan_ms", "median_ms", "min_ms", "max_ms"), "float64"),
    **dict.fromkeys(("worst_missed_depth", "worst_false_gap"), "float64"),
}


@dataclass(frozen=True)
class Result:
    context: Json
    groups: list[Group]
    frame: pd.DataFrame  # rows as users have them
    variants_frame: pd.DataFrame  # planned rows with skips forbidden
    absent: dict[str, str]  # backends that could not run at all, and why; they have no rows here
    gpu: Gpu | None  # that the device rows ran on

    @cached_property
    def stages(self) -> pd.DataFrame:
        """A line per row (its index in `frame`) and stage, in the order of the JSON.

        A stage whose time another one holds has `fused_into`, and no time. In rows of several
        frames a stage may have both lines.
        """
        lines = [
            (row.Index, stage, ms, row.stage_bytes.get(stage), host)
            for row in self.frame.itertuples()
            for stage, ms, host in (
                *((stage, ms, None) for stage, ms in row.stage_ms.items() if ms),
                *((stage, (), host) for stage, host in row.fused.items()),
            )
        ]
        columns = ["row", "stage", "round_ms", "least_bytes", "fused_into"]
        found = pd.DataFrame(lines, columns=columns, dtype=object).astype({"least_bytes": "Int64"})
        medians = [median(ms) if ms else np.nan for ms in found["round_ms"]]
        return found.assign(median_ms=medians).infer_objects()

    @cached_property
    def motion_frames(self) -> pd.DataFrame:
        """A line per row (its index in `frame`) and frame of a moving scene: over the rounds."""
        lines = [
            (row.Index, frame, frame < row.frames.warmup, median(ms), min(ms), max(ms))
            for row in self.frame.itertuples()
            if row.frames
            for frame, ms in enumerate(zip(*row.frames.frame_ms, strict=True))
        ]
        columns = ["row", "frame", "warmup", "median_ms", "min_ms", "max_ms"]
        return pd.DataFrame(lines, columns=columns)

    @property
    def scenes(self) -> list[str]:
        return list(dict.fromkeys(group.scene for group in self.groups))


def load(path: Path) -> Result:
    """Reads and checks one result. Throws ReportError naming the file, and the row if it is one."""
    return read_json(path, parse)


def parse(document: Any) -> Result:
    """The same for a document already decoded."""
    if not isinstance(document, dict) or "schema" not in document:
        raise ReportError("not a bench result: it has no field 'schema'")
    schema = document["schema"]
    if schema != SCHEMA or isinstance(schema, bool):
        raise ReportError(f"schema {shown(schema)} is not the schema {SCHEMA} read here")
    found = convert(document, Document)
    frame = _rows(found)
    _check_together(frame)
    absent = _absent(frame)
    frame = frame[~frame["backend"].isin(absent)]
    frame = _with_implementations(frame, _implementations(frame[frame["skips"].isna()]))
    users = frame["skips"].isna()
    return Result(
        context=document["context"],
        groups=found.groups,
        frame=frame[users].reset_index(drop=True),
        variants_frame=frame[~users].reset_index(drop=True),
        absent=absent,
        gpu=found.context.gpu,
    )


def _rows(found: Document) -> pd.DataFrame:
    """The rows with their groups, and what follows from a row alone."""

    def line(row: Row) -> dict[str, Any]:
        times, ran = row.frames.steady if row.frames else row.total_ms, row.status != "skipped"
        spans = {f"{of.__name__}_ms": of(times) for of in (median, min, max)} if ran else {}
        only_missed = row.false == 0 and row.duplicates == 0
        known = {
            "predicate": row.predicate if row.predicate != EXACT else None,
            "family": row.backend.split("_", 1)[0] if row.kind == "baseline" else row.backend,
            "motion": row.frames.scene if row.frames else None,
            "ran": ran,
            "counts": row.status == "ok" and not row.negative_control,
            "excused": bool(row.status == "wrong" and row.known_issues and only_missed),
            **{"round_ms": times, "rounds": len(times)},
        }
        return asdict(row) | known | spans

    columns = dict.fromkeys([*Row.__struct_fields__, "family", "motion", "round_ms", *_TYPES])
    rows = pd.DataFrame(map(line, found.rows), columns=[*columns], dtype=object).astype(_TYPES)
    groups = pd.DataFrame(
        [
            (i, g.scene, g.n, g.truth_pairs, g.truth and g.truth.checksum, g.scene_class, g.real)
            for i, g in enumerate(found.groups)
        ],
        columns=["group", "scene", "n", "truth_pairs", "truth_checksum", "scene_class", "real"],
    ).astype({"group": "Int64", "n": "int64", "truth_pairs": "Int64"})
    frame = rows.merge(
        groups.drop_duplicates(["scene", "n"], keep="last"), on=["scene", "n"], how="left"
    )
    n = frame["n"].where(frame["n"] > 0).astype("float64")
    truth = frame["truth_pairs"].where(frame["truth_pairs"] > 0).astype("float64")
    beyond = (frame["peak_bytes"] - frame["output_bytes"].fillna(0)).astype("float64") / n
    return frame.assign(
        errors=frame[["missed", "false", "duplicates"]].fillna(0).sum(axis=1).astype("int64"),
        ns_per_sphere=frame["median_ms"] * 1e6 / n,
        beyond_bytes=beyond.where(frame["device_bytes"].isna()),
        candidates_per_pair=frame["candidates"].astype("float64") / truth,
    )


def _check_together(frame: pd.DataFrame) -> None:
    """What no row shows alone: names met once, groups that exist, digests that fit the truth."""
    ok, truth = frame["status"] == "ok", frame["truth_pairs"]
    differs = (frame["pairs"] != truth) | (frame["checksum"] != frame["truth_checksum"])
    for bad, why in (
        (frame["name"].duplicated(), "an earlier row has the same name"),
        (frame["group"].isna(), "no group has its scene and n"),
        (ok & truth.isna(), "says ok, but its group has no truth to be compared with"),
        (
            ok & (differs | (frame["errors"] > 0)),
            "says ok, but its pairs differ from its group's truth",
        ),
    ):
        for index, name in frame.loc[bad, "name"].items():
            raise ReportError(f"rows[{index}] ({name}): {why}")


def _absent(frame: pd.DataFrame) -> dict[str, str]:
    """Backends whose rows were all skipped for one reason: no device, say."""
    ours = frame[frame["kind"] == "backend"].groupby("backend", sort=False)
    return {
        backend: rows["reason"].iloc[0]
        for backend, rows in ours
        if not rows["ran"].any() and rows["reason"].nunique() == 1
    }


def _implementations(frame: pd.DataFrame) -> pd.DataFrame:
    """In table order (backends before baselines, else as first met), with a label for each."""
    found = frame.drop_duplicates(_IMPLEMENTATION).sort_values("kind", kind="stable")
    methods = found.groupby(["backend", "rule"], dropna=False)["method"]
    found = found.assign(methods=methods.transform("nunique", dropna=False))
    threaded = found["threads"].nunique() > 1

    def label(row: Any) -> str:
        """As short as it can be while no two are the same."""
        both = row.rule and row.method and row.methods > 1
        how = f"{row.method}/{row.rule}" if both else row.rule or row.method
        threads = f"({row.threads} threads)" if threaded and row.threads != 1 else None
        return " ".join(filter(None, (row.backend, how, row.predicate, threads)))

    on_device = found["backend"].isin(frame.loc[frame["device_bytes"].notna(), "backend"])
    return found[_IMPLEMENTATION].assign(
        label=[label(row) for row in found.itertuples()],
        order=range(len(found)),
        side=found["kind"].mask(on_device, "device"),
    )


def _with_implementations(frame: pd.DataFrame, known: pd.DataFrame) -> pd.DataFrame:
    """An implementation that only a variant has comes last, under the name of its backend."""
    frame = frame.merge(known, on=_IMPLEMENTATION, how="left")
    last = {"label": frame["backend"], "side": frame["kind"], "order": len(known)}
    return frame.fillna(last).astype({"order": "int64"})
