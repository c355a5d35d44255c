# SPDX-License-Identifier: MIT
from msgspec import Struct

from octocell_report.fields import Json, convert
from octocell_report.schema import Gpu as Gpu


class HasGpu(Struct):
    gpu: Gpu | None = None


def gpu_of(context: Json) -> Gpu | None:
    return convert(context, HasGpu).gpu
