# SPDX-License-Identifier: MIT
"""Where a result comes from, checked: commit, machine, compiler, and the GPU if there was one."""

from __future__ import annotations

from dataclasses import dataclass

from octocell_report.fields import (
    Fields,
    Json,
    is_bool,
    is_object,
    is_positive,
    is_text,
    is_whole,
    or_null,
)


@dataclass(frozen=True)
class Gpu:
    name: str
    copy_gbps: float  # 10^9 bytes a second that a copy reads and writes, measured in the same run


def gpu_of(context: Json) -> Gpu | None:
    """None without a device, and of files written before it was named."""
    known = Fields(context, "context").optional("gpu", or_null(is_object))
    if known is None:
        return None
    fields = Fields(known, "context.gpu")
    copied = fields.take("copy_gigabytes_per_second", is_positive)
    return Gpu(fields.take("name", is_text), float(copied))


_CONTEXT_TEXTS = (
    "date",
    "commit",
    "version",
    "compiler",
    "flags",
    "instruction_set",
    "build_type",
    "preset",
)


def check_context(context: Json) -> None:
    fields = Fields(context, "context")
    for key in _CONTEXT_TEXTS:
        fields.take(key, is_text)
    for key in ("dirty", "finished"):
        fields.take(key, is_bool)
    fields.take("rounds", is_whole)
    fields.take("libraries", is_object)
    machine = Fields(fields.take("machine", is_object), "context.machine")
    for key in ("name", "cpu", "os"):
        machine.take(key, is_text)
    for key in ("cores", "memory_bytes"):
        machine.take(key, is_whole)
