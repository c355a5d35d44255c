# SPDX-License-Identifier: MIT
"""SWC, a neuron: one node a line, id type x y z radius parent, between comments with #.

http://www.neuronland.org/NLMorphologyConverter/MorphologyFormats/SWC/Spec.html
"""

from array import array
from collections.abc import Iterator

import numpy as np

from octocell_import import InputError
from octocell_import.frame import Frame, kinds_of
from octocell_import.text import File, as_column, as_columns

_NAMES = ("id", "label", "x", "y", "z", "radius", "parent")
_CHUNK = 50_000  # words, which are turned into a column to save memory


def read(file: File) -> Iterator[Frame]:
    parts, words, lines = [], [], array("q")
    for line in file:
        row = file.split(line.partition(b"#")[0])
        if len(row) not in (0, len(_NAMES)):
            file.refuse(f"{len(row)} words, expected {len(_NAMES)}: {' '.join(_NAMES)}")
        words += row
        lines.extend([file.number] * bool(row))
        if len(words) > _CHUNK:
            parts.append(as_column(words))
            words = []
    if not lines:
        raise InputError("no node")
    table = np.concatenate([*parts, as_column(words)]).reshape(-1, len(_NAMES))
    columns = as_columns(table, _NAMES)
    columns["kind"], kinds = kinds_of(lambda kind: None, columns["label"])
    yield Frame(columns | {"line": np.array(lines)}, kinds=kinds)
