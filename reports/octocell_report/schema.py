# SPDX-License-Identifier: MIT
"""The JSON of `octocell bench` as types: what stands in it, and what must hold for each value."""

from statistics import median
from typing import Annotated, NamedTuple

from msgspec import Meta, Struct, field

from octocell_report.fields import Name, Number, Text, Whole, choice
from octocell_report.plan import PLANNED
from octocell_report.predicates import PREDICATES, SCENE_CLASSES

DEVICE_RUNS = ("cold_cache", "graph", "transfers")  # of backends on a device, beside cold and warm
RUNS = ("cold", "warm", *DEVICE_RUNS, "first_update", "update", "dynamic")
STATUSES = ("ok", "wrong", "skipped")
# In the order in which they run.
STAGES = (
    *("bounds", "cell_ids", "sort", "cell_index", "pair_tests", "resolve"),
    *("build", "update", "query"),
)


class Machine(Struct):
    name: Text
    cpu: Text
    os: Text
    cores: Whole
    memory_bytes: Whole


class Gpu(Struct):
    name: Text
    # 10^9 bytes a second that a copy reads and writes, measured in the same run
    copy_gbps: Annotated[float, Meta(gt=0, lt=1e100)] = field(name="copy_gigabytes_per_second")


class Context(Struct):
    """Where a result comes from."""

    date: Text
    commit: Text
    dirty: bool
    version: Text
    machine: Machine
    compiler: Text
    flags: Text
    instruction_set: Text
    build_type: Text
    libraries: dict[Text, Text]
    preset: Text
    rounds: Whole
    finished: bool
    gpu: Gpu | None = None


class Place(NamedTuple):
    """Where implementations are compared: one scene at one size."""

    scene: str
    n: int


class Truth(Struct):
    pairs: Whole
    checksum: Text


class Rounded(Struct):
    """What rounding the scene's input to float32 did to its pairs, before any of our arithmetic."""

    lost: Whole
    gained: Whole


class Group(Struct):
    """What the rows of one scene at one size share."""

    scene: Name
    n: Whole
    spec: Text
    real: bool
    unavailable: Text | None
    truth: Truth | None
    scene_class: Annotated[str, choice(*SCENE_CLASSES)] | None = None  # of the error study's scenes
    rounding: Rounded | None = field(default=None, name="input_rounding")

    @property
    def place(self) -> Place:
        return Place(self.scene, self.n)

    @property
    def truth_pairs(self) -> int | None:
        return self.truth.pairs if self.truth else None


class Plan(Struct):
    """What the planner chose."""

    method: Text
    levels: Whole
    key_bits: Whole
    sort_passes: Whole
    skips: tuple[Text, ...]  # that were taken


class Motion(Struct):
    """The times of single frames of a moving scene."""

    scene: Name  # how the spheres move: brownian, gravity, ...
    warmup: Whole = field(name="warmup_frames")  # so many frames at the start do not count
    frame_ms: tuple[tuple[Number, ...], ...]  # by round, then by frame

    def __post_init__(self) -> None:
        lengths = {len(frames) for frames in self.frame_ms}
        if len(lengths) != 1 or lengths == {0}:
            raise ValueError("'frame_ms' has no frame, or rounds of unlike length")

    @property
    def by_frame(self) -> list[float]:
        """Median over the rounds, frame by frame, warm-up included."""
        return [median(times) for times in zip(*self.frame_ms, strict=True)]

    @property
    def steady(self) -> tuple[float, ...]:
        """Median over the frames after the warm-up (of all, if there are no others), by round."""
        return tuple(median(times[self.warmup :] or times) for times in self.frame_ms)


class Row(Struct):
    """One implementation at one place in one kind of run. What was not measured is None."""

    name: Name
    backend: Name
    kind: Annotated[str, choice("backend", "baseline")]
    method: Name | None
    rule: Name | None
    scene: Name
    n: Whole
    threads: Whole
    run: Annotated[str, choice(*RUNS)]
    negative_control: bool
    status: Annotated[str, choice(*STATUSES)]
    reason: Text | None
    pairs: Whole | None
    checksum: Text | None
    missed: Whole | None
    false: Whole | None
    duplicates: Whole | None
    candidates: Whole | None
    uncertain_pairs: Whole | None
    total_ms: tuple[Number, ...]  # one per round
    stage_ms: dict[Text, tuple[Number, ...]]
    fused: dict[Text, Text]  # stage -> the stage whose time holds it
    plan_ms: Number | None
    peak_bytes: Whole | None
    output_bytes: Whole | None
    device_bytes: Whole | None = None  # the most device memory at a time; null on the host
    stage_bytes: dict[Text, Whole] = {}  # the least that a stage must read and write
    frames: Motion | None = None
    known_issues: Text | None = None  # why its library can lose pairs however it is driven
    skips: Name | None = None  # which variant of the planned row it is; null for those of users
    plan: Plan | None = None
    predicate: Annotated[str, choice(*PREDICATES)] | None = None  # null for baselines
    distinct_checksums: Whole | None = None  # above 1 it does not repeat its own answer
    # Of its worst pairs, by the sum of their radii s: (s - distance) / s, (distance - s) / s.
    worst_missed_depth: Number | None = None
    worst_false_gap: Number | None = None

    def __post_init__(self) -> None:
        if self.status == "skipped" and (self.reason is None or self.total_ms):
            raise ValueError("says skipped, but has a time, or no reason")
        measured = self.total_ms and self.pairs is not None and self.checksum is not None
        if self.status != "skipped" and not measured:
            raise ValueError(f"says {self.status}, but lacks a round, its pairs or their checksum")
        if self.predicate is not None and self.kind == "baseline":
            raise ValueError("'predicate' is set, but it is a baseline")
        if self.skips is not None and self.method != PLANNED:
            raise ValueError(f"'skips' is set, but its method is not {PLANNED}")


class Document(Struct):
    schema: int
    context: Context
    groups: list[Group]
    rows: list[Row]
