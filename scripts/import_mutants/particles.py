# SPDX-License-Identifier: MIT
"""Plain readers of LAMMPS, PLY, VTK and TRR."""

import re
import struct
from collections.abc import Iterator
from functools import partial

import numpy as np

from import_mutants.words import (
    Frames,
    Refused,
    Unjudged,
    filled,
    lines_of,
    need,
    number,
    rows,
    take,
    whole,
)

STYLES = {"atomic": "id type x y z", "sphere": "id type diameter density x y z"}


def lammps_data(content: bytes) -> Frames:
    """Of the styles only atomic and sphere, which the samples name."""
    lines = lines_of(content)
    take(lines)
    count, section, atoms = None, "", None
    for line in lines:
        text, _, comment = (w.strip() for w in line.decode("utf-8", "replace").partition("#"))
        words = text.split()
        if re.fullmatch(r"[A-Za-z][A-Za-z/_ ]*", text):
            section = text
            if section == "Atoms":
                need(atoms is None and count is not None)
                next(lines, None)
                names = STYLES.get(comment, "").split()
                if len(comment.split()) != 1:  # a remark is no style: then columns may tell it
                    raise Unjudged
                need(names)
                atoms = {}
                for _ in range(count):
                    row = take(lines).partition(b"#")[0]
                    need(b"\0" not in row and len(row.split()) in (len(names), len(names) + 3))
                    row = row.split()
                    id_ = whole(row[0])
                    need(id_ not in atoms)
                    at = names.index("x")
                    atoms[id_] = tuple(number(word) for word in row[at : at + 3])
        elif not section and words[1:] == ["atoms"]:
            count = whole(words[0].encode())
        elif not section and words[1:] in (["atom", "types"], ["bonds"]):
            whole(words[0].encode())
        elif section == "Atoms":
            need(not words)
    need(atoms is not None or count == 0)
    return [[atoms[k] for k in sorted(atoms or {})]]


def lammps_dump(content: bytes) -> Frames:
    lines, frames = lines_of(content), []
    said: dict[str, list[bytes]] = {}
    while line := filled(lines):
        need(line.startswith(b"ITEM: "))
        item = line[6:].decode("utf-8", "replace").strip()
        names = item.split()
        if names[:1] == ["ATOMS"]:
            frames.append(dumped(lines, said, names[1:]))
            said.clear()
            continue
        kinds = {"NUMBER OF ATOMS": 1, "BOX BOUNDS": 3, "TIMESTEP": 1, "UNITS": 1, "TIME": 1}
        kind = next((kind for kind in kinds if item.startswith(kind)), None)
        need(kind)
        if kind == "UNITS":
            raise Unjudged
        said[kind] = [take(lines) for _ in range(kinds[kind])]
        if kind == "NUMBER OF ATOMS":
            whole(said[kind][0])
    need(frames and not said)
    return frames


def dumped(lines: Iterator[bytes], said: dict[str, list[bytes]], names: list[str]) -> list:
    places = [["x", "y", "z"], ["xu", "yu", "zu"], ["xs", "ys", "zs"], ["xsu", "ysu", "zsu"]]
    place = next((place for place in places if set(place) <= set(names)), None)
    need(place and "NUMBER OF ATOMS" in said)
    found = rows(lines, whole(said["NUMBER OF ATOMS"][0]), len(names))
    for name in set(names):
        same = [k for k, other in enumerate(names) if other == name]
        need(all(row[k] == row[same[0]] for row in found for k in same))
    atoms = {}
    for k, row in enumerate(found):
        id_ = whole(row[names.index("id")]) if "id" in names else k
        need(id_ not in atoms)
        xyz = [row[names.index(name)] for name in place]
        atoms[id_] = tuple(number(word) for word in xyz)
    ordered = [atoms[k] for k in sorted(atoms)]
    return ordered if "s" not in place[0] else unscaled(ordered, said)


def unscaled(atoms: list, said: dict[str, list[bytes]]) -> list:
    need("BOX BOUNDS" in said)
    box = [[number(word) for word in line.split()] for line in said["BOX BOUNDS"]]
    need({len(line) for line in box} in ({2}, {3}))
    xy, xz, yz = (line[2] if len(line) == 3 else 0.0 for line in box)
    low = [box[0][0] - min(0, xy, xz, xy + xz), box[1][0] - min(0, yz), box[2][0]]
    high = [box[0][1] - max(0, xy, xz, xy + xz), box[1][1] - max(0, yz), box[2][1]]
    edges = [[high[0] - low[0], 0, 0], [xy, high[1] - low[1], 0], [xz, yz, high[2] - low[2]]]
    moved = [
        tuple(low[k] + sum(s[i] * edges[i][k] for i in range(3)) for k in range(3)) for s in atoms
    ]
    need(all(abs(value) < 3.4028235677973366e38 for atom in moved for value in atom))
    return moved


_ORDERS = {b"binary_little_endian": "<", b"binary_big_endian": ">"}
_CODES = {b"char": "b", b"uchar": "B", b"short": "h", b"ushort": "H", b"int": "i", b"uint": "I"}
_CODES |= {b"float": "f", b"double": "d", b"int8": "b", b"uint8": "B", b"int16": "h"}
_CODES |= {b"uint16": "H", b"int32": "i", b"uint32": "I", b"float32": "f", b"float64": "d"}


def ply(content: bytes) -> Frames:
    content = content.removeprefix(b"\xef\xbb\xbf")
    found = re.search(rb"\n\s*end_header", content)
    need(found)
    head, body = content[: found.start() + 1], content[found.end() :]
    rest, _, body = body.partition(b"\n")
    header = [line.split() for line in head.split(b"\n")]
    need(header[0] == [b"ply"] and not rest.strip())
    need(b"\n\r" not in content[: found.end()])
    form, elements = b"", []
    for words in header[1:]:
        if words[:1] in ([], [b"comment"], [b"obj_info"]):
            continue
        if words[0] == b"format" and len(words) == 3:
            form = words[1]
            need(form in (b"ascii", *_ORDERS) and words[2] == b"1.0")
        elif words[0] == b"element" and len(words) == 3:
            need(words[1] not in [name for name, _, _ in elements])
            elements.append((words[1], whole(words[2]), []))
        elif words[0] == b"property" and elements and len(words) in (3, 5):
            need(len(words) == 3 or words[1] == b"list")
            need(all(kind in _CODES for kind in words[2 if len(words) == 5 else 1 : -1]))
            need(words[-1] not in [own[-1] for own in elements[-1][2]])
            elements[-1][2].append(words[1:])
        else:
            raise Refused
    need(form)
    points: list[list[bytes]] = []
    names: list[str] = []
    for name, count, properties in elements:
        need(properties or not count)
        read = text_rows if form == b"ascii" else partial(binary_rows, order=_ORDERS[form])
        found_rows, body = read(body, count, properties)
        if name == b"vertex":
            points = found_rows
            names = [own[-1].decode("ascii", "replace") for own in properties if len(own) == 2]
    names = [name.lower().removeprefix("scalar_") for name in names]
    need(not body.strip() and all(names.count(name) == 1 for name in "xyz"))
    need(names.count("radius") < 2 and names.count("diameter") < 2)
    at = [names.index(name) for name in "xyz"]
    return [[tuple(number(row[k]) for k in at) for row in points]]


def text_rows(body: bytes, count: int, properties: list) -> tuple[list, bytes]:
    """Rows without their lists, and what follows them."""
    found = []
    for _ in range(count):
        need(body)
        line, _, body = body.partition(b"\n")
        need(b"\0" not in line)
        words, row = line.split(), []
        for own in properties:
            need(words)
            if own[0] == b"list":
                many = words.pop(0)
                need(re.fullmatch(rb"[-+]?\d{1,1000}", many) and len(words) >= int(many))
                words = words[max(0, int(many)) :]
            else:
                row.append(words.pop(0))
        need(not words)
        found.append(row)
    return found, body


def binary_rows(body: bytes, count: int, properties: list, order: str) -> tuple[list, bytes]:
    found, at = [], 0

    def next_value(code: str) -> float:
        nonlocal at
        need(at + struct.calcsize(code) <= len(body))
        (value,) = struct.unpack_from(order + code, body, at)
        at += struct.calcsize(code)
        return value

    for _ in range(count):
        row = []
        for own in properties:
            if own[0] == b"list":
                many = next_value(_CODES[own[1]])
                need(0 <= many < 2**32)
                at += int(many) * struct.calcsize(_CODES[own[2]])
                need(at <= len(body))
            else:
                row.append(repr(next_value(_CODES[own[0]])).encode())
        found.append(row)
    return found, body[at:]


def vtk(content: bytes) -> Frames:
    """Text as LIGGGHTS writes it: vertices, vectors and scalars of points."""
    lines = lines_of(content)
    version = take(lines).lower().partition(b"# vtk datafile version ")[2].strip()
    need(version)
    if version[:1] not in b"1234":
        raise Unjudged
    take(lines)
    need(filled(lines).strip().upper() == b"ASCII")
    xyz, rows_of_data = None, b"0"

    def numbers(count: int) -> list[bytes]:
        words: list[bytes] = []
        while len(words) < count:
            words += take(lines).split()
        need(len(words) == count)
        return words

    while words := filled(lines).split():
        key = words[0].upper()
        if key == b"DATASET":
            need(len(words) == 2 and words[1].upper() == b"POLYDATA")
        elif key == b"POINTS":
            need(len(words) == 3 and words[2].lower() in (b"float", b"double"))
            flat = numbers(3 * whole(words[1]))
            xyz = [flat[k : k + 3] for k in range(0, len(flat), 3)]
        elif key == b"VERTICES":
            need(len(words) == 3)
            numbers(whole(words[2]))
        elif key == b"POINT_DATA":
            need(len(words) == 2)
            rows_of_data = words[1]
        elif key == b"VECTORS":
            need(len(words) == 3 and words[2].lower() == b"float")
            numbers(3 * whole(rows_of_data))
        elif key == b"SCALARS":
            need(len(words) in (3, 4) and words[2].lower() == b"float")
            need(take(lines).upper().startswith(b"LOOKUP_TABLE"))
            many = whole(words[3]) if len(words) == 4 else 1
            found = numbers(whole(rows_of_data) * many)
            need(words[1].lower() != b"radius" or len(found) == len(xyz or []))
        else:
            raise Unjudged
    need(xyz is not None)
    return [[tuple(map(number, words)) for words in xyz]]


def trr(content: bytes) -> Frames:
    frames, at = [], 0
    while at < len(content):
        head = content[at : at + 76]
        need(len(head) == 76 and head[:24] == struct.pack(">3i", 1993, 13, 12) + b"GMX_trn_file")
        *sizes, count, _, _ = struct.unpack(">13i", head[24:])
        need(count >= 0 and min(sizes) >= 0)
        widths = {sizes[k] / 9 for k in (2, 3, 4) if sizes[k]}
        widths |= {sizes[k] / max(3 * count, 1e-9) for k in (7, 8, 9) if sizes[k]}
        need(len(widths) == 1 and widths <= {4, 8})
        width = int(widths.pop())
        start = at + 76 + 2 * width + sum(sizes[:7])
        at = at + 76 + 2 * width + sum(sizes)
        need(at <= len(content))
        with np.errstate(all="ignore"):
            real = np.frombuffer(content[start : start + sizes[7]], f">f{width}").astype(float)
            need(np.isfinite((real * 10).astype(np.float32)).all())
        if sizes[7]:
            frames.append((real.reshape(-1, 3) * 10).tolist())
    need(frames)
    return frames
