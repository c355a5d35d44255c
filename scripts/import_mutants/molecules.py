# SPDX-License-Identifier: MIT
"""Plain readers of PDB, GRO, XYZ, mmCIF and SWC."""

import re

import gemmi

from import_mutants.words import (
    Frames,
    Refused,
    filled,
    lines_of,
    need,
    number,
    rows,
    take,
    whole,
)


def pdb(content: bytes) -> Frames:
    frames, atoms, is_model = [], [], False
    for line in [*lines_of(content), b"END"]:
        record = line[:6].strip()
        if line.startswith((b"ATOM", b"HETATM")):
            card = line.rstrip()
            need(len(card) >= 54 and b"\t" not in card and b"\0" not in card)
            need(not (card[11:12].isdigit() and card[35:36] == b"."))
            atoms.append(tuple(number(card[k : k + 8]) for k in (30, 38, 46)))
        elif record in (b"MODEL", b"ENDMDL", b"END"):
            if atoms or is_model:
                frames.append(atoms)
            atoms, is_model = [], record == b"MODEL"
        else:
            points = line[34:35] + line[42:43] + line[50:51]
            need(
                points != b"..." or record in (b"REMARK", b"USER", b"SIGATM", b"ANISOU", b"SIGUIJ")
            )
    need(frames)
    return frames


def gro(content: bytes) -> Frames:
    lines, frames = lines_of(content), []
    title = take(lines)
    while True:
        counted = next(lines, None)
        while counted is not None and not title.strip() and not counted.strip():
            title, counted = counted, next(lines, None)
        if counted is None:
            need(not title.strip())
            return frames
        atoms, width, offsets = [], 0, []
        for _ in range(whole(counted)):
            line = take(lines)
            if not width:
                points = [k for k in range(20, len(line)) if line[k : k + 1] == b"."][:3]
                need(len(points) == 3 and points[2] - points[1] == points[1] - points[0])
                width = points[1] - points[0]
            card = line.rstrip()
            need(len(card) >= 20 + 3 * width and b"\t" not in card and b"\0" not in card)
            words = [card[k : k + width] for k in range(20, 20 + 3 * width, width)]
            offsets = offsets or [word.find(b".") for word in words]
            need(offsets == [word.find(b".") for word in words])
            atoms.append(tuple(number(word, 10.0) for word in words))
        touching = re.fullmatch(rb"(\s*-?\d+\.\d{5}){3}\s*", box := take(lines))
        plain = all(re.fullmatch(rb"[-+]?\d+(\.\d*)?", word) for word in box.split())
        need(touching or (plain and len(box.split()) in (3, 9)))
        frames.append(atoms)
        title = next(lines, None)
        if title is None:
            return frames


def xyz(content: bytes) -> Frames:
    lines, frames = lines_of(content), []
    counted = take(lines) + b"\n"
    while counted:
        count, comment = whole(counted), take(lines)
        pair = rb"""([\w-]+)\s*=\s*("(?:[^"\\]|\\.)*"|'[^']*'|\{[^}]*\}|\[[^]]*\]|\S+)"""
        comment = comment.decode("utf-8", "replace")
        pairs = re.findall(pair.decode(), comment)
        said = [value for key, value in pairs if key.lower() == "properties"]
        first, width = 1, 0
        if said and said[0].strip("\"'"):
            words = said[0].strip("\"'").lower().split(":")
            need(len(words) % 3 == 0)
            names: list[str] = []
            for name, size in zip(words[::3], words[2::3], strict=True):
                need(re.fullmatch(r"[0-9]{1,18}", size) and int(size) < 10_000)
                names += [name] * int(size)
                need(len(names) < 10_000)
            need(
                names.count("pos") == 3 and names.count("radius") < 2 and names.count("species") < 2
            )
            first, width = names.index("pos"), len(names)
            need(names[first : first + 3] == ["pos"] * 3)
        decimal = re.compile(rb"\*\^|[dD]")
        atoms = []
        for row in rows(lines, count, width):
            words = [decimal.sub(b"e", word) for word in row[first : first + 3]]
            atoms.append(tuple(number(word) for word in words))
        frames.append(atoms)
        counted = b"" if comment.startswith("gdb ") else filled(lines)
    return frames


def mmcif(content: bytes) -> Frames:
    """gemmi reads the whole document; the importer gives it the atoms alone, in pieces."""
    try:
        document = gemmi.cif.read_string(content.removeprefix(b"\xef\xbb\xbf"))
    except (ValueError, RuntimeError):
        document = mmcif_atoms(content)
    frames: dict[tuple[str, bytes], list] = {}
    for block in document:
        tags = ("Cartn_x", "Cartn_y", "Cartn_z", "pdbx_PDB_model_num")
        try:
            columns = [list(block.find_values(f"_atom_site.{tag}")) for tag in tags]
        except UnicodeDecodeError as error:
            raise Refused from error
        columns = [[gemmi.cif.as_string(w).encode() for w in column] for column in columns]
        count = max(map(len, columns))
        columns[3] = columns[3] or [b""] * count
        need(all(len(column) == count for column in columns))
        for *words, model in zip(*columns, strict=True):
            frames.setdefault((block.name, model), []).append(tuple(map(number, words)))
    need(frames)
    return list(frames.values())


def mmcif_atoms(content: bytes) -> gemmi.cif.Document:
    """The atoms of a document that has faults elsewhere, but no atoms."""
    start = rb"loop_\s*\n(\s*#[^\n]*\n|\s*\n)*\s*_atom_site"
    loop = re.search(start + rb".*?(?=\n\s*(_(?!atom_site\.)|data_|loop_)|\Z)", content, re.DOTALL)
    need(loop and content.lower().count(b"_atom_site.group") < 2)
    need(not re.search(rb"\n(ATOM|HETATM) ", content[: loop.start()] + content[loop.end() :]))
    try:
        tags = loop[0].index(b"_atom_site")  # before them blanks that gemmi does not take for such
        return gemmi.cif.read_string(b"data_x\nloop_\n" + loop[0][tags:])
    except (ValueError, RuntimeError) as error:
        raise Refused from error


def swc(content: bytes) -> Frames:
    atoms = []
    for line in lines_of(content):
        words = line.partition(b"#")[0].split()
        if words:
            need(len(words) == 7)
            atoms.append(tuple(number(word) for word in words[2:5]))
    need(atoms)
    return [atoms]
