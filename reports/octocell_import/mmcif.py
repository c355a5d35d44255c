# SPDX-License-Identifier: MIT
"""mmCIF: the loop _atom_site, which gemmi parses, some thousand rows at a time to save memory.

https://mmcif.wwpdb.org/dictionaries/mmcif_pdbx_v50.dic/Categories/atom_site.html
"""

import re
from collections.abc import Iterator

import gemmi
import numpy as np

from octocell_import import InputError, quote
from octocell_import.decimals import Column
from octocell_import.elements import element_of
from octocell_import.frame import Frame
from octocell_import.pdb import molecule
from octocell_import.text import File, as_column

_PREFIX = b"_atom_site."
_END = re.compile(rb"^;.*?\n;|^\s*(_|loop_|data_|save_|global_)", re.I | re.M | re.S)
_ATOMS = (b"ATOM ", b"HETATM ")
_EMPTY = re.compile(rb"\s*(#|$)")
_CHUNK = 20_000  # lines
# Of two names the first that the file has.
_TAGS = {"x": ["Cartn_x"], "y": ["Cartn_y"], "z": ["Cartn_z"], "written": ["type_symbol"]}
_TAGS |= {"label": ["auth_atom_id", "label_atom_id"], "residue": ["auth_comp_id", "label_comp_id"]}
_TAGS |= {"chain": ["auth_asym_id", "label_asym_id"], "number": ["auth_seq_id", "label_seq_id"]}
_TAGS |= {"altloc": ["label_alt_id"], "model": ["pdbx_PDB_model_num"]}


def read(file: File) -> Iterator[Frame]:
    found, is_text, before = False, False, b""
    for line in file:
        is_text ^= line.startswith(b";")
        if not is_text and line.strip().lower().startswith(_PREFIX):
            columns, found = _read_loop(file, line, before.strip().lower() == b"loop_"), True
            for tag in file.some(1):
                if tag.strip().lower().startswith(_PREFIX):
                    file.refuse("_atom_site goes on behind its loop")
                file.give_back([tag])
            models = columns.pop("model", np.zeros(len(columns["x"]), "S1"))
            for first in sorted(np.unique(models, return_index=True)[1].tolist()):
                of_model = models == models[first]
                atoms = {name: column[of_model] for name, column in columns.items()}
                yield molecule(atoms, "type_symbol", element_of, models[first].decode())
        elif not is_text and line.startswith(_ATOMS):
            file.refuse(f"an atom outside of the loop _atom_site: {quote(line)}")
        before = before if _EMPTY.match(line) else line
    if not found:
        raise InputError(
            "no loop of _atom_site (the CIF of a crystal, _atom_site_fract_x, has none)"
        )


def _read_loop(file: File, line: bytes, is_loop: bool) -> dict[str, Column]:
    """The columns of interest; `line` is the first that names one."""
    tags, pieces, rows, size = [], [], [], _CHUNK
    while line and (line.strip().lower().startswith(_PREFIX) or _EMPTY.match(line)):
        tags.append(line)
        line = file.line()
    if is_loop and line.lstrip().startswith(b"_"):
        file.refuse(f"{quote(line.split()[0])} in the loop of _atom_site")
    file.give_back([line] * bool(line))
    head = b"data_x\n" + b"loop_\n" * is_loop + b"".join(tags)
    while more := file.some(size):
        rows += more
        text = b"".join(rows)
        may_end = not all(row.startswith(_ATOMS) for row in rows)
        ends = (m.start() for m in _END.finditer(text) if m[1]) if may_end else iter(())
        end = next((text.count(b"\n", 0, start) for start in ends), None)
        if end is not None:
            file.give_back(rows[end:])
            rows = rows[:end]
            break
        try:
            pieces.append(_parse(head, rows, file.number))
            rows, size = [], _CHUNK
        except InputError:  # they may end within a row, which may have several lines
            size *= 2
    if not all(map(_EMPTY.match, rows)) or not pieces:
        pieces.append(_parse(head, rows, file.number))
    return {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}


def _parse(head: bytes, rows: list[bytes], last: int) -> dict[str, Column]:
    """`last` is the number of the last row's line."""
    columns, before = {}, last - len(rows)
    try:
        block = gemmi.cif.read_string(head + b"".join(rows)).sole_block()
        for name, tags in _TAGS.items():
            found = [v for tag in tags if len(v := block.find_values("_atom_site." + tag))]
            if found:
                columns[name] = _column(list(found[0]))
    except (ValueError, RuntimeError) as error:
        where = re.match(r"data:(\d+)", str(error))
        row = int(where[1]) - head.count(b"\n") if where else 1
        line = before + min(max(row, 1), len(rows))
        raise InputError(f"line {line}: gemmi says: {str(error).rpartition(': ')[2]}") from error
    for name in "xyz":
        if name not in columns:
            raise InputError(f"line {before}: _atom_site has no Cartn_{name}")
    if len(set(map(len, columns.values()))) > 1:
        raise InputError(f"line {before + 1}: a value of _atom_site has several lines")
    lines: Column = before + 1 + np.arange(len(rows))
    if len(lines) != len(columns["x"]):
        lines = lines[[not _EMPTY.match(row) for row in rows]]
    if len(lines) != len(columns["x"]):  # rows may have several lines
        lines = np.full(len(columns["x"]), before + 1)
    return columns | {"line": lines}


def _column(values: list[str]) -> Column:
    if values.count(values[0]) == len(values):
        return np.full(len(values), gemmi.cif.as_string(values[0]).encode())
    text = "\n".join(values)
    if '"' in text or "'" in text or "\n;" in text:
        text = "\n".join(map(gemmi.cif.as_string, values))
    return as_column(text.encode().split(b"\n"))
