# SPDX-License-Identifier: MIT
"""Every format once, from files small enough to read here, to the very float32s."""

from __future__ import annotations

import bz2
import gzip
import struct

import numpy as np
import pytest

from octocell_import.cli import main

GRO = """two waters of one site
2
    1SOL     OW    1   0.126   1.624  -1.679  0.1227 -0.0580  0.0434
    2CA+     CA    2   0.190   1.661   1.747
   1.86206   1.86206   1.86206
"""
# Twelve columns each; the first two numbers touch.
PRECISE_GRO = """more digits
1
    1MET     CA    1   0.1234567-123.4567890 999.0000001
 1 1 1 0 0 0 0 0 0
"""
PDB = """HEADER    TINY
MODEL        1
ATOM      1  CA  ALA A   1      11.104   6.134  -6.504  1.00  0.00           C
ATOM      2 HG11 VAL A   2     -11.104-100.134   6.504  1.00  0.00
HETATM    3 CA    CA A   3       1.000   2.000   3.000  1.00  0.00
HETATM    4 FE   HEM A   4       1.000   2.000   3.500  1.00  0.00          ZN2+
ENDMDL
MODEL        2
ATOM      1  CA  ALA A   1      12.104   6.134  -6.504  1.00  0.00           C
ATOM      2  CA  ALA A   1      13.104   6.134  -6.504  1.00  0.00           C
ENDMDL
END
"""
PQR = """REMARK a chain, then none
ATOM      1  N   MET A   1      26.981  53.977  40.085 -0.3000  1.8500
HETATM    2  O   HOH     2     -26.981  53.977  40.085  0.0000  0.2245
END
"""
DUMP = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp pp
0 10
-10 10
0 1
ITEM: ATOMS {columns}
2 {second}
1 {first}
"""
DATA = """two types
# a comment

2 atoms
2 atom types
{bonds}
0 10 xlo xhi

Masses

1 12.011
2 15.9994 # anything

Atoms {style}

2 {second}
1 {first}

Velocities

1 0 0 0
2 0 0 0
"""


def scene(tmp_path, name, content, *options):
    """The spheres made of a file with this content."""
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    assert main([str(path), "-o", str(tmp_path / "out.npy"), *options]) == 0
    found = np.load(tmp_path / "out.npy")
    assert found.dtype == np.dtype("<f4") and found.flags.c_contiguous
    return found


def same(found, rows):
    np.testing.assert_array_equal(found, np.array(rows, np.float32))


def test_gro_is_nm_and_becomes_angstrom(tmp_path, capsys):
    rows = [[1.26, 16.24, -16.79, 1.52], [1.90, 16.61, 17.47, 2.31]]
    same(scene(tmp_path, "a.gro", GRO), rows)
    said = capsys.readouterr().out
    assert "2 spheres written" in said and "frame 0, the only one" in said
    assert "nm in the file, times 10: Angstrom" in said
    assert "1 O 1.52" in said and "1 Ca 2.31" in said
    assert "elements   from atom and residue names" in said


def test_gro_may_stay_in_nm_with_radii_in_nm(tmp_path):
    rows = [[0.126, 1.624, -1.679, 0.152], [0.190, 1.661, 1.747, 0.231]]
    same(scene(tmp_path, "a.gro", GRO, "--length-unit", "nm"), rows)


def test_gro_columns_are_as_wide_as_its_points_are_apart(tmp_path):
    rows = [[1.234567, -1234.56789, 9990.000001, 1.7]]
    same(scene(tmp_path, "a.gro", PRECISE_GRO), rows)


def test_gro_frames_follow_each_other(tmp_path, capsys):
    two = GRO + GRO.replace("0.126", "0.226")
    assert scene(tmp_path, "a.gro", two, "--frame", "1")[0, 0] == np.float32(2.26)
    assert "frame 1, the last one" in capsys.readouterr().out
    assert scene(tmp_path, "a.gro", two)[0, 0] == np.float32(1.26)
    assert "frame 0, more follow" in capsys.readouterr().out


def test_gro_box_numbers_may_touch(tmp_path):
    touching = GRO.replace("   1.86206   1.86206   1.86206", "40000.0000040000.0000040000.00000")
    assert len(scene(tmp_path, "a.gro", touching)) == 2


@pytest.mark.parametrize(("suffix", "pack"), [(".gz", gzip.compress), (".bz2", bz2.compress)])
def test_compressed_files_are_read_as_they_are(tmp_path, suffix, pack):
    same(
        scene(tmp_path, f"a.gro{suffix}", pack(GRO.encode())),
        [[1.26, 16.24, -16.79, 1.52], [1.90, 16.61, 17.47, 2.31]],
    )


def test_pdb_takes_fixed_columns_and_knows_carbon_from_calcium(tmp_path, capsys):
    rows = [
        [11.104, 6.134, -6.504, 1.7],
        [-11.104, -100.134, 6.504, 1.1],  # HG11 is a hydrogen
        [1, 2, 3, 2.31],
        [1, 2, 3.5, 1.39],  # columns 77 and 78 go before the name
    ]
    same(scene(tmp_path, "a.pdb", PDB), rows)
    said = capsys.readouterr().out
    assert "from columns 77 and 78, and names" in said and "more follow" in said
    assert len(scene(tmp_path, "a.pdb", PDB, "--frame", "1")) == 2


def test_pdb_alternate_locations_are_kept_and_told(tmp_path, capsys):
    two = PDB.replace(" CA  ALA", " CA BALA", 1)
    assert len(scene(tmp_path, "a.pdb", two)) == 4
    assert "alternate  locations are kept: 1 atoms" in capsys.readouterr().out


def test_pqr_has_its_own_radii(tmp_path, capsys):
    rows = [[26.981, 53.977, 40.085, 1.85], [-26.981, 53.977, 40.085, 0.2245]]
    same(scene(tmp_path, "a.pqr", PQR), rows)
    assert "from the file, 0.2245 to 1.85" in capsys.readouterr().out


def test_xyz_by_element(tmp_path, capsys):
    same(
        scene(tmp_path, "a.xyz", "2\n\nC 0.1 0 0\ncl 1e-1 2 -3\n"),
        [[0.1, 0, 0, 1.7], [0.1, 2, -3, 1.75]],
    )
    assert "taken as Angstrom" in capsys.readouterr().out


def test_xyz_with_one_number_more_may_have_radii(tmp_path, capsys):
    text = "2\nc\nC 1 2 3 0.3\nH 4 5 6 0\n"
    same(scene(tmp_path, "a.xyz", text), [[1, 2, 3, 1.7], [4, 5, 6, 1.1]])
    assert "after z are not used: 1 of them (--radii file takes" in capsys.readouterr().out
    same(scene(tmp_path, "a.xyz", text, "--radii", "file"), [[1, 2, 3, 0.3], [4, 5, 6, 0]])


def test_xyz_with_more_numbers_says_that_it_leaves_them(tmp_path, capsys):
    same(scene(tmp_path, "a.xyz", "1\nvelocities\nO 1 2 3 7 8 9\n"), [[1, 2, 3, 1.52]])
    assert "after z are not used: 3" in capsys.readouterr().out


def test_extended_xyz_says_which_columns_it_has(tmp_path):
    text = '1\nLattice="1 0 0 0 1 0 0 0 1" Properties=id:I:1:species:S:1:radius:R:1:pos:R:3\n'
    same(scene(tmp_path, "a.xyz", text + "7 C 0.25 1 2 3\n"), [[1, 2, 3, 0.25]])


@pytest.mark.parametrize(
    ("style", "bonds", "first", "second", "options"),
    [
        ("# atomic", "", "1 1 2 3", "2 4 5 6 0 0 -1", []),
        ("", "", "1 1 2 3", "2 4 5 6", []),
        ("", "1 bonds", "9 1 0.5 1 2 3", "9 2 -0.5 4 5 6", []),
        ("# charge", "", "1 0.5 1 2 3", "2 0.5 4 5 6", []),
        ("", "", "1 1 2 3 0.5", "2 4 5 6 0.5", ["--atom-style", "id type x y z q"]),
    ],
)
def test_lammps_data_by_mass_in_order_of_id(tmp_path, style, bonds, first, second, options):
    text = DATA.format(style=style, bonds=bonds, first=first, second=second)
    same(scene(tmp_path, "a.data", text, *options), [[1, 2, 3, 1.7], [4, 5, 6, 1.52]])


def test_lammps_data_of_style_sphere_has_diameters(tmp_path, capsys):
    text = DATA.format(style="# sphere", bonds="", first="1 0.3 1 1 2 3", second="2 1 1 4 5 6")
    same(scene(tmp_path, "a.data", text), [[1, 2, 3, 0.15], [4, 5, 6, 0.5]])
    assert "atom style sphere" in capsys.readouterr().out


def test_lammps_data_with_type_labels(tmp_path):
    labels = "Atom Type Labels\n\n1 N\n2 H\n\nMasses"
    text = DATA.format(style="# atomic", bonds="", first="N 1 2 3", second="H 4 5 6")
    same(scene(tmp_path, "a.data", text.replace("Masses", labels))[:, 3], [1.55, 1.1])


@pytest.mark.parametrize(
    ("columns", "first", "second", "rows"),
    [
        ("id element x y z", "C 1 2 3", "O 4 5 6", [[1, 2, 3, 1.7], [4, 5, 6, 1.52]]),
        ("id type xu yu zu radius", "1 1 2 3 .3", "1 4 5 6 .4", [[1, 2, 3, 0.3], [4, 5, 6, 0.4]]),
        ("id x y z diameter", "1 2 3 .3", "4 5 6 .4", [[1, 2, 3, 0.15], [4, 5, 6, 0.2]]),
        ("id xs ys zs radius", "0 0.5 1 1", ".5 1 .25 1", [[0, 0, 1, 1], [5, 10, 0.25, 1]]),
    ],
)
def test_lammps_dump_in_order_of_id(tmp_path, columns, first, second, rows):
    text = DUMP.format(columns=columns, first=first, second=second)
    same(scene(tmp_path, "a.dump", text), rows)
    same(scene(tmp_path, "dump.0", text + text, "--format", "lammps-dump", "--frame", "1"), rows)


def test_lammps_dump_in_nano_units_is_converted(tmp_path):
    text = "ITEM: UNITS\nnano\n" + DUMP.format(
        columns="id x y z radius", first="1 2 3 .3", second="4 5 6 .4"
    )
    same(scene(tmp_path, "a.dump", text), [[10, 20, 30, 3], [40, 50, 60, 4]])


PLY = """ply
format {form} 1.0
element vertex 2
property float x
property float y
property {kind} z
property float {name}
element face 1
property list uchar int vertex_indices
end_header
"""


def test_ply_text_with_radii(tmp_path, capsys):
    text = PLY.format(form="ascii", kind="double", name="radius")
    text += "1.1 2 3 0.3\n4 5 6 0.4\n2 0 1\n"
    same(scene(tmp_path, "a.ply", text), [[1.1, 2, 3, 0.3], [4, 5, 6, 0.4]])
    assert "in its own unit" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("form", "order"), [("binary_little_endian", "<"), ("binary_big_endian", ">")]
)
def test_ply_binary_with_one_radius_for_all(tmp_path, form, order):
    head = PLY.format(form=form, kind="double", name="quality").encode()
    vertices = struct.pack(f"{order}ffdfffdf", 1.5, 2, 0.1, 9, 4, 5, 6, 9)
    face = struct.pack(f"{order}Bii", 2, 0, 1)
    found = scene(tmp_path, "a.ply", head + vertices + face, "--radius", "0.5")
    same(found, [[1.5, 2, 0.1, 0.5], [4, 5, 6, 0.5]])


def trr_frame(points, real="f", step=0, velocities=False):
    """One frame as GROMACS writes it."""
    width = struct.calcsize(f">{real}")
    size = 3 * len(points) * width
    sizes = [0, 0, 9 * width, 0, 0, 0, 0, size, size if velocities else 0, 0]
    head = struct.pack(">iiI12s", 1993, 13, 12, b"GMX_trn_file")
    head += struct.pack(f">13i2{real}", *sizes, len(points), step, 0, 2.5, 0)
    numbers = [number for point in points for number in point]
    body = struct.pack(f">9{real}", *range(9)) + struct.pack(f">{len(numbers)}{real}", *numbers)
    return head + body + (bytes(size) if velocities else b"")


@pytest.mark.parametrize("real", ["f", "d"])
def test_trr_frames_with_names_from_a_topology(tmp_path, capsys, real):
    (tmp_path / "names.gro").write_text(GRO)
    frames = trr_frame([(0.1, 0.2, 0.3), (1, 2, 3)], real, velocities=True)
    frames += trr_frame([(0.5, 0.2, 0.3), (1, 2, 3)], real, step=7)
    options = ["--topology", str(tmp_path / "names.gro"), "--frame"]
    once = np.float32(0.1).astype(float) * 10 if real == "f" else 1.0
    found = scene(tmp_path, "a.trr", frames, *options, "0")
    same(found[:, [0, 3]], [[once, 1.52], [10, 2.31]])
    assert "time       2.5 ps, step 0" in capsys.readouterr().out
    same(scene(tmp_path, "a.trr", frames, *options, "1")[:, 0], [5, 10])
    assert "step 7" in capsys.readouterr().out


def test_a_topology_gives_its_own_radii_in_its_own_unit(tmp_path):
    (tmp_path / "names.pqr").write_text(PQR)
    frames = trr_frame([(0.5, 0.25, 1), (1, 2, 3)])
    found = scene(tmp_path, "a.trr", frames, "--topology", str(tmp_path / "names.pqr"))
    same(found, [[5, 2.5, 10, 1.85], [10, 20, 30, 0.2245]])
