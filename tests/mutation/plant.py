#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Copies the sources to a folder and plants every fault of faults.toml in the copy
(docs/how_to/mutants.md). CMake calls it for a build with OCTOCELL_FAULTS=ON."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import tomllib

ROOT = Path(__file__).resolve().parents[2]
TABLE = Path(__file__).with_name("faults.toml")
MARKS = "«»"
MACRO = '#include "tests/mutation/faults.hpp"\n'


class CannotPlant(Exception):
    """The text of a fault is not in its file, or is there twice."""


@dataclass(frozen=True)
class PlantedFault:
    name: str
    what: str
    file: str
    sound: str  # text of the file; what the fault replaces is between «», or is all of it
    faulty: str

    def place_in(self, text: str) -> tuple[int, int]:
        """The part that it replaces. White space does not count, so lines may break elsewhere."""
        before, _, rest = self.sound.rpartition(MARKS[0])
        marked, _, after = rest.partition(MARKS[1])
        places = [k for k, c in enumerate(text) if not c.isspace()]
        packed = "".join(text[k] for k in places)
        before, marked, after = ("".join(part.split()) for part in (before, marked, after))
        count = packed.count(before + marked + after)
        if count != 1:
            raise CannotPlant(f"{self.name}: its text is in {self.file} {count} times, not once")
        begin = packed.index(before + marked + after) + len(before)
        return places[begin], places[begin + len(marked) - 1] + 1


def faults() -> list[PlantedFault]:
    table = tomllib.loads(TABLE.read_text(encoding="utf-8"))
    return [PlantedFault(name, **row) for name, row in table.items()]


def planted(text: str, here: list[PlantedFault]) -> str:
    """The text of a file with these faults, which are all that it gets."""
    places = sorted(((*fault.place_in(text), fault.name, fault) for fault in here), reverse=True)
    after = len(text)
    for begin, end, name, fault in places:
        if end > after:
            raise CannotPlant(f"{name}: overlaps another fault in {fault.file}")
        use = f"OCTOCELL_FAULT({name}, {fault.faulty}, {text[begin:end]})"
        text = text[:begin] + use + text[end:]
        after = begin
    first = text.index("#include")
    return text[:first] + MACRO + text[first:]


def table_of(all_faults: list[PlantedFault]) -> str:
    """tests/mutation/fault_table.hpp, which faults.hpp and chosen_fault.cpp include."""
    rows = (f'  fault({fault.name}, "{fault.what}")' for fault in all_faults)
    return "#pragma once\n#define OCTOCELL_FAULT_TABLE(fault) \\\n" + " \\\n".join(rows) + "\n"


def sources() -> Iterator[Path]:
    """All files of the folders that CMake builds, and headers for users, relative to the root."""
    for folder in sorted(
        {path.parent for path in ROOT.glob("*/CMakeLists.txt")} | {ROOT / "include"}
    ):
        for path in sorted(folder.rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                yield path.relative_to(ROOT)


def write_if_changed(path: Path, data: bytes) -> None:
    """What did not change keeps its time, so it is not compiled again."""
    if path.is_file() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def plant_all(target: Path) -> None:
    all_faults = faults()
    written = {target / "tests/mutation/fault_table.hpp"}
    write_if_changed(*written, table_of(all_faults).encode())
    for source in sources():
        here = [fault for fault in all_faults if fault.file == source.as_posix()]
        path = ROOT / source
        text = planted(path.read_text(encoding="utf-8"), here).encode() if here else None
        write_if_changed(target / source, text or path.read_bytes())
        written.add(target / source)
    for path in target.rglob("*"):
        if path.is_file() and path not in written:
            path.unlink()


def main() -> int:
    if len(sys.argv) != 2:
        print("plant: needs one argument, the folder to write", file=sys.stderr)
        return 2
    try:
        plant_all(Path(sys.argv[1]))
    except CannotPlant as problem:
        print(f"plant: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
