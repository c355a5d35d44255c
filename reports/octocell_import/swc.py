# SPDX-License-Identifier: MIT
"""SWC, a neuron: one node a line, id type x y z radius parent, between comments with #.

http://www.neuronland.org/NLMorphologyConverter/MorphologyFormats/SWC/Spec.html
"""

from collections.abc import Iterator

import numpy as np

from octocell_import import InputError
from octocell_import.frame import Frame, kinds_of
from octocell_import.text import File, as_column

_NAMES = ("id", "label", "x", "y", "z", "radius", "parent")


def read(file: File) -> Iterator[Frame]:
    rows, lines = [], []
    for line in file:
        words = file.split(line.partition(b"#")[0])
        if len(words) == len(_NAMES):
            rows.append(words)
            lines.append(file.number)
        elif words:
            file.refuse(f"{len(words)} words, expected {len(_NAMES)}: {' '.join(_NAMES)}")
    if not rows:
        raise InputError("no node")
    columns = {n: as_column(list(c)) for n, c in zip(_NAMES, zip(*rows, strict=True), strict=True)}
    columns["kind"], kinds = kinds_of(lambda kind: None, columns["label"])
    yield Frame(columns | {"line": np.array(lines)}, kinds=kinds)
