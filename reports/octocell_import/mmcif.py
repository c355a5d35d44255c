# SPDX-License-Identifier: MIT
"""mmCIF: the loop _atom_site, which gemmi parses, some thousand rows at a time to save memory.

https://mmcif.wwpdb.org/dictionaries/mmcif_pdbx_v50.dic/Categories/atom_site.html
"""

import re
from collections.abc import Iterator

import gemmi
import numpy as np

from octocell_import import InputError
from octocell_import.decimals import Column
from octocell_import.elements import element_of
from octocell_import.frame import Frame
from octocell_import.pdb import molecule
from octocell_import.text import File, as_column

_PREFIX = "_atom_site."
_END = re.compile(rb"\s*(#|_|loop_|data_|save_|global_)", re.IGNORECASE)
_CHUNK = 20_000  # lines
# Of two names the first that the file has.
_TAGS = {"x": ["Cartn_x"], "y": ["Cartn_y"], "z": ["Cartn_z"], "written": ["type_symbol"]}
_TAGS |= {"label": ["auth_atom_id", "label_atom_id"], "residue": ["auth_comp_id", "label_comp_id"]}
_TAGS |= {"chain": ["auth_asym_id", "label_asym_id"], "number": ["auth_seq_id", "label_seq_id"]}
_TAGS |= {"altloc": ["label_alt_id"], "model": ["pdbx_PDB_model_num"]}


def read(file: File) -> Iterator[Frame]:
    found = False
    for line in file:
        if line.strip().lower().startswith(_PREFIX.encode()):
            columns, found = _read_loop(file, line), True
            models = columns.pop("model", np.zeros(len(columns["x"]), "S1"))
            for first in sorted(np.unique(models, return_index=True)[1].tolist()):
                of_model = models == models[first]
                atoms = {name: column[of_model] for name, column in columns.items()}
                yield molecule(atoms, "type_symbol", element_of, models[first].decode())
    if not found:
        raise InputError("no loop of _atom_site")


def _read_loop(file: File, line: bytes) -> dict[str, Column]:
    """The columns of interest; `line` is the first that names one."""
    names, rows, pieces, limit, is_text = [], [], [], _CHUNK, False
    while line.strip().lower().startswith(_PREFIX.encode()):
        names.append(line)
        line = file.line()
    head = [b"data_x\n", b"loop_\n" * (len(names[0].split()) == 1), *names]  # one atom: no loop
    while line and (is_text or line[:1] in b"AH" or not _END.match(line)):
        is_text ^= line.startswith(b";")
        rows.append(line)
        if len(rows) >= limit:
            try:
                pieces.append(_parse(head, rows, file.number - len(rows)))
                rows, limit = [], _CHUNK
            except InputError:  # it may end within a row, which may have several lines
                limit *= 2
        line = file.line()
    if rows or not pieces:
        pieces.append(_parse(head, rows, file.number - len(rows) - bool(line)))
    return {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}


def _parse(head: list[bytes], rows: list[bytes], before: int) -> dict[str, Column]:
    """`before` is the number of the line before the rows."""
    try:
        block = gemmi.cif.read_string(b"".join(head + rows)).sole_block()
    except (ValueError, RuntimeError) as error:
        where = re.match(r"data:(\d+)", str(error))
        line = before + int(where[1] if where else 0) - b"".join(head).count(b"\n")
        why = str(error).rpartition(": ")[2]
        raise InputError(f"line {line}: gemmi says: {why}") from error
    columns = {}
    for name, tags in _TAGS.items():
        found = [values for tag in tags if len(values := block.find_values(_PREFIX + tag))]
        if found:
            columns[name] = _column(list(found[0]))
        elif name in "xyz":
            raise InputError(f"line {before}: _atom_site has no Cartn_{name}")
    if len(set(map(len, columns.values()))) > 1:
        raise InputError(f"line {before + 1}: a value of _atom_site has several lines")
    if len(rows) == len(columns["x"]):
        columns["line"] = np.arange(len(rows)) + before + 1
    return columns


def _column(values: list[str]) -> Column:
    if values.count(values[0]) == len(values):
        return np.full(len(values), gemmi.cif.as_string(values[0]).encode())
    text = "\n".join(values)
    if '"' in text or "'" in text or "\n;" in text:
        text = "\n".join(map(gemmi.cif.as_string, values))
    return as_column(text.encode().split(b"\n"))
