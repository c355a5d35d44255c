# SPDX-License-Identifier: MIT
"""Bad files: exit code 2, one line that names file and place, and nothing written."""

from __future__ import annotations

import gzip

import pytest

from octocell_import.cli import main

from test_import_formats import DATA, DUMP, GRO, PDB, PLY, PQR, trr_frame

ATOMIC = DATA.format(style="# atomic", bonds="", first="1 1 2 3", second="2 4 5 6")
STYLELESS = DATA.format(style="", bonds="", first="1 1 0 1 2 3", second="1 1 0 1 2 3")
PLAIN_DUMP = DUMP.format(columns="id element x y z", first="C 1 2 3", second="O 4 5 6")
SCALED = PLAIN_DUMP.replace("x y z\n", "xs ys zs\n")
UNBOXED = SCALED[: SCALED.index("ITEM: BOX")] + SCALED[SCALED.index("ITEM: ATOMS") :]
PLAIN_PLY = PLY.format(form="ascii", kind="float", name="radius") + "1 2 3 1\n4 5 6 1\n2 0 1\n"
LINES = GRO.splitlines(keepends=True)

CASES = {
    "gro, no number": (
        "a.gro",
        GRO.replace("1.624", "1.6x4"),
        "line 3: y: '1.6x4' is not a number",
    ),
    "gro, cut": ("a.gro", "".join(LINES[:3]), "ends after line 3, before atom 2 of 2"),
    "gro, no box": ("a.gro", "".join(LINES[:4]), "before the box that follows 2 atoms"),
    "gro, too few counted": (
        "a.gro",
        GRO.replace("2\n", "1\n", 1),
        "line 4: after 1 atoms the box",
    ),
    "gro, too many counted": (
        "a.gro",
        GRO.replace("2\n", "3\n", 1),
        "line 5: too short for x, y and z",
    ),
    "gro, no count": ("a.gro", GRO.replace("2\n", "x\n", 1), "line 2: 'x' is no number of atoms"),
    "gro, bad second frame": ("a.gro", GRO + "t\nx\n", "line 7: 'x' is no number of atoms"),
    "gro, empty": ("a.gro", "", "before the title"),
    "gro, too large": ("a.gro", GRO.replace("-1.679", "-9.e38"), "too large for float32"),
    "gro, nan": ("a.gro", GRO.replace("1.747", "  nan"), "line 4: z: 'nan' is not a number"),
    "gro, cut gzip": ("a.gro.gz", gzip.compress(GRO.encode())[:-9], "cannot be read: "),
    "gro, no gzip": ("a.gro.gz", GRO, "cannot be read: "),
    "pdb, no number": ("a.pdb", PDB.replace("11.104", "11.1x4"), "line 3: x: '11.1x4' is not a"),
    "pdb, cut line": ("a.pdb", PDB[:130], "line 4: too short for x, y and z"),
    "pdb, none": ("a.pdb", "HEADER\nEND\n", "no ATOM and no HETATM record"),
    "pdb, unknown": (
        "a.pdb",
        PDB.replace("ZN2+", " X  "),
        "line 6: the table has no radius for",
    ),
    "pqr, two less": ("a.pqr", PQR.replace(" O   HOH", ""), ":3: 8 fields, expected 10 or"),
    "pqr, radius": ("a.pqr", PQR.replace("1.8500", "-1.85"), ":2: r is -1.85"),
    "pqr, charge": ("a.pqr", PQR.replace("-0.3000", "A"), ":2: 'A' is not a number"),
    "xyz, cut": ("a.xyz", "2\nc\nC 1 2 3\n", "ends after line 3, before atom 2 of 2"),
    "xyz, too few counted": (
        "a.xyz",
        "1\nc\nC 1 2 3\nC 1 2 3\n",
        "line 4: 'C 1 2 3' is no number of",
    ),
    "xyz, ragged": (
        "a.xyz",
        "2\nc\nC 1 2 3 1\nC 1 2 3\n",
        "line 4: atom 2 of 2: 4 words, expected 5",
    ),
    "xyz, short": ("a.xyz", "1\nc\nC 1 2\n", "line 3: atom 1 of 1: 3 words, expected 4"),
    "xyz, radius": (
        "a.xyz",
        "1\nProperties=species:S:1:pos:R:3:radius:R:1\nC 1 2 3 r\n",
        "line 3: radius: 'r' is not a number",
    ),
    "xyz, unknown": ("a.xyz", "1\nc\nQq 1 2 3\n", "give its radius, --radius Qq=1.5"),
    "xyz, no radius known": ("a.xyz", "1\nc\nW 1 2 3\n", "no radius for element W: give its"),
    "xyz, Properties": (
        "a.xyz",
        "1\nProperties=pos:R:2\n1 2\n",
        "line 2: Properties wants pos:R:3",
    ),
    "data, cut": (
        "a.data",
        ATOMIC[: ATOMIC.index("1 1 1 2 3")],
        "after line 16, before atom 2",
    ),
    "data, more": (
        "a.data",
        ATOMIC.replace("2 atoms", "1 atoms"),
        "more atoms than the header's 1",
    ),
    "data, no Atoms": ("a.data", ATOMIC.replace("Atoms #", "Others #"), "no section Atoms"),
    "data, twice": (
        "a.data",
        ATOMIC.replace("1 1 1 2 3", "2 1 1 2 3"),
        "line 17: id 2 is line 16's",
    ),
    "data, words": (
        "a.data",
        ATOMIC.replace("1 1 1 2 3", "1 1 1 2"),
        "line 17: atom 2 of 2: 4 words",
    ),
    "data, style": (
        "a.data",
        ATOMIC.replace("# atomic", "# wavepacket"),
        "'wavepacket' is not known",
    ),
    "data, no style": ("a.data", STYLELESS, "7 columns and no atom style"),
    "data, mass of nothing": (
        "a.data",
        ATOMIC.replace("12.011", "1.0"),
        "line 17: '1' is of no known element",
    ),
    "dump, cut": (
        "a.dump",
        PLAIN_DUMP[: PLAIN_DUMP.index("1 C")],
        "ends after line 10, before atom 2 of 2",
    ),
    "dump, no atoms": ("a.dump", "ITEM: TIMESTEP\n0\n", "before ITEM: ATOMS"),
    "dump, no dump": ("a.dump", "hello\n", "line 1: 'ITEM: ' expected: 'hello'"),
    "dump, columns": (
        "a.dump",
        PLAIN_DUMP.replace("x y z", "x y q"),
        "line 9: ITEM: ATOMS has neither x y z",
    ),
    "dump, word": (
        "a.dump",
        PLAIN_DUMP.replace("C 1 2 3", "C 1 2 b"),
        "line 11: z: 'b' is not a number",
    ),
    "dump, scaled, no box": ("a.dump", UNBOXED, "line 5: scaled coordinates without ITEM: BOX"),
    "dump, scaled, bad box": ("a.dump", SCALED.replace("0 10", "0 ten"), "line 9: box bounds are"),
    "dump, scaled, odd blank": (
        "a.dump",
        SCALED.replace("0 10", "\x1c0 10"),
        "line 9: box bounds are not numbers: ",
    ),
    "dump, lj": ("a.dump", "ITEM: UNITS\nlj\n" + PLAIN_DUMP, "its unit of length is not known"),
    "ply, cut": ("a.ply", PLAIN_PLY[:-15], "ends after line 11, before atom 2 of 2"),
    "ply, word": ("a.ply", PLAIN_PLY.replace("4 5", "4 q"), "line 12: y: 'q' is not a number"),
    "ply, no ply": ("a.ply", "hello", "no sound PLY: "),
    "ply, no z": (
        "a.ply",
        PLAIN_PLY.replace("float z", "float depth"),
        "the vertices have no number z",
    ),
    "ply, no vertices": (
        "a.ply",
        PLAIN_PLY.replace("element vertex", "element corner"),
        "no vertices",
    ),
    "ply, no radius": ("a.ply", PLAIN_PLY.replace("radius", "quality"), "give --radius R"),
    "ply, radius": (
        "a.ply",
        PLAIN_PLY.replace("3 1\n", "3 -1\n"),
        "line 11: radius -1 is negative",
    ),
    "ply, long name": (
        "a.ply",
        PLAIN_PLY.replace("face", "9" * 5000).replace("2 0 1\n", "2 0\n"),
        "line 13: row 1 of 1 of element '9999",
    ),
    "ply, no properties": (
        "a.ply",
        PLAIN_PLY.replace("element face", "element empty 3\nelement face"),
        "line 11: no sound PLY: element 'empty' has no properties",
    ),
    "xyz, zero byte": ("a.xyz", "1\nc\nC 1 2 3\0\n", "line 3: atom 1 of 1: a zero byte"),
    "swc, zero byte": ("a.swc", "# x\n1 1 0 0 0 1\0 -1\n", "line 2: a zero byte"),
    "vtk, zero byte": (
        "a.vtk",
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n1 2\0 3\n",
        "line 6: a zero byte",
    ),
    "trr, no names": ("a.trr", trr_frame([(1, 2, 3)]), "give --radius R, or --topology FILE"),
    "trr, cut": ("a.trr", trr_frame([(1, 2, 3)])[:-1], "byte 131: the file ends within the coor"),
    "trr, cut later": (
        "a.trr",
        trr_frame([(1, 2, 3)]) + b"\0",
        "byte 133: the file ends within the next frame",
    ),
    "trr, no trr": ("a.trr", b"hello" * 9, "byte 12: no TRR frame starts here"),
    "trr, empty": ("a.trr", b"", "no frame with coordinates"),
    "no suffix": ("a.abc", GRO, "no format is known by the suffix '.abc'; give --format"),
    "xtc": ("a.xtc", b"", "gmx trjconv"),
}


@pytest.mark.parametrize(("name", "content", "message"), CASES.values(), ids=CASES.keys())
def test_bad_files_are_named_in_one_line(tmp_path, capsys, name, content, message):
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    assert main([str(path)]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and err.startswith("octocell-import: ")
    assert message in err and str(path) in err and len(err) < 1000
    assert [p.name for p in tmp_path.iterdir()] == [name]


def test_a_missing_file_is_named(tmp_path, capsys):
    assert main([str(tmp_path / "none.gro")]) == 2
    assert "none.gro: cannot be read: No such file" in capsys.readouterr().err


def test_a_topology_of_another_size_is_refused(tmp_path, capsys):
    (tmp_path / "a.trr").write_bytes(trr_frame([(1, 2, 3)]))
    (tmp_path / "b.gro").write_text(GRO)
    assert main([str(tmp_path / "a.trr"), "--topology", str(tmp_path / "b.gro")]) == 2
    assert "a.trr: 1 atoms, but" in capsys.readouterr().err
    assert not (tmp_path / "a.npy").exists()
