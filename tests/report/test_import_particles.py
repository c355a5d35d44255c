# SPDX-License-Identifier: MIT
"""LAMMPS, VTK, PLY and SWC as people have them."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from test_import_cases import PLAIN_PLY, RADII, refusal

from test_import_formats import DATA, DUMP, same, scene


def styleless(first: str, second: str, bonds: str = "") -> str:
    return DATA.format(style="", bonds=bonds, first=first, second=second)


@pytest.mark.parametrize(
    ("first", "second", "bonds"),
    [
        ("1 1000.0 2.5 1.0 5.0 5.0 5.0", "1 1000.0 2.5 1.0 5.8 5.0 5.0", ""),  # sph
        ("1 1 1.0 2500 5.0 5.0 5.0", "1 1 1.0 2500 5.8 5.0 5.0", ""),  # bpm/sphere
        ("1 1 1 2500 5 5 5", "1 1 1 2500 6 5 5", ""),  # the same, or atomic with image flags
        ("1 1 1 1 0.5 0 0", "1 1 2 2 1.5 0 0", ""),  # template
        ("1 2.0 2500 0 0 0", "1 2.0 2500 1 0 0", "1 bonds"),  # sphere
        ("1 -0.5 0 0 0", "2 0.5 1 0 0", ""),  # charge, dpd, ...
        ("3 0 0 0", "1 0 0 0", ""),  # there is no type 3
    ],
)
def test_columns_are_not_guessed_where_they_may_mean_something_else(
    tmp_path, capsys, first, second, bonds
):
    error = refusal(tmp_path, capsys, "a.data", styleless(first, second, bonds))
    assert "columns and no atom style in the file; give --atom-style: atomic, charge" in error
    assert "line 16: " in error


@pytest.mark.parametrize(
    ("first", "second", "bonds"),
    [
        ("1 1 2 3", "2 4 5 6", ""),
        ("1 1.5 2.5 3 0 0 -1", "2 4 5 6 0 0 0", ""),
        ("9 1 1 2.5 3", "9 2 4 5 6", "1 bonds"),
        ("9 1 -0.5 1 2 3", "9 2 0.5 4 5 6", "1 bonds"),
    ],
)
def test_columns_are_guessed_where_one_style_fits(tmp_path, capsys, first, second, bonds):
    scene(tmp_path, "a.data", styleless(first, second, bonds))
    assert "no other style that is known here fits" in capsys.readouterr().out


def test_the_line_after_atoms_is_passed_over(tmp_path):
    text = styleless("1 1 2 3", "2 4 5 6").replace("Atoms \n\n", "Atoms \n# id type q x y z\n")
    same(scene(tmp_path, "a.data", text), [[1, 2, 3, 1.7], [4, 5, 6, 1.52]])


def test_a_style_of_columns_may_have_a_radius(tmp_path):
    text = styleless("1 1 2 3 .5", "2 4 5 6 .25")
    options = ["--atom-style", "id type x y z radius"]
    same(scene(tmp_path, "a.data", text, *options)[:, 3], [0.5, 0.25])


def test_columns_may_be_named_behind_the_style(tmp_path, capsys):
    text = DATA.format(
        style="# odd: id q type x y z", bonds="", first="7 1 1 2 3", second="7 2 4 5 6"
    )
    same(scene(tmp_path, "a.data", text), [[1, 2, 3, 1.7], [4, 5, 6, 1.52]])
    assert "columns    id q type x y z (as given)" in capsys.readouterr().out


def test_data_of_no_atoms_is_a_scene_of_no_spheres(tmp_path):
    assert len(scene(tmp_path, "a.data", "title\n\n0 atoms\n1 atom types\n")) == 0


def test_frames_may_be_empty_and_differ(tmp_path, capsys):
    empty = RADII[: RADII.index("2 1")].replace("\n2\nITEM", "\n0\nITEM")
    one = RADII[: RADII.index("1 1")].replace("\n2\nITEM", "\n1\nITEM")
    assert len(scene(tmp_path, "a.dump", empty + RADII)) == 0
    same(scene(tmp_path, "a.dump", empty + RADII, "--frame", "1")[:, 3], [0.5, 0.25])
    same(scene(tmp_path, "a.dump", one + empty + RADII)[:, 3], [0.25])


TILTED = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS {titles}
{box}
ITEM: ATOMS id xs ys zs radius
1 0 0 0 1
2 0.5 0.25 1 1
"""


@pytest.mark.parametrize(
    ("titles", "box", "corner", "inside"),
    [
        ("pp pp pp", "0 10\n-10 10\n0 1", [0, -10, 0], [5, -5, 1]),
        ("xy xz yz pp pp pp", "0 10 0\n0 10 0\n0 10 0", [0, 0, 0], [5, 2.5, 10]),
        # Edges (10, 0, 0), (2, 10, 0) and (-1, 0.5, 10): bounds are from -1 to 12 and to 10.5.
        ("xy xz yz pp pp pp", "-1 12 2\n0 10.5 -1\n0 10 .5", [0, 0, 0], [4.5, 3, 10]),
        ("abc origin pp pp pp", "10 0 0 1\n2 10 0 2\n-1 .5 10 3", [1, 2, 3], [5.5, 5, 13]),
    ],
)
def test_scaled_coordinates_follow_the_edges_of_the_box(tmp_path, titles, box, corner, inside):
    text = TILTED.format(titles=titles, box=box)
    same(scene(tmp_path, "a.dump", text)[:, :3], [corner, inside])


def test_columns_may_stand_twice_if_they_agree(tmp_path):
    twice = DUMP.format(
        columns="id type type x y z radius", first="1 1 1 2 3 4", second="2 2 1 2 3 4"
    )
    assert len(scene(tmp_path, "a.dump", twice)) == 2


def test_columns_that_stand_twice_and_differ_are_refused(tmp_path, capsys):
    twice = DUMP.format(columns="id x y z x radius", first="1 2 3 1 4", second="1 2 3 2 4")
    error = refusal(tmp_path, capsys, "a.dump", twice)
    assert "line 9: two columns are called 'x', and differ" in error


# PLY


@pytest.mark.parametrize("name", ["scalar_radius", "Radius", "scalar_Radius"])
def test_ply_radii_by_other_names(tmp_path, name):
    same(scene(tmp_path, "a.ply", PLAIN_PLY.replace("radius", name))[:, 3], [1, 1])


def test_ply_decimals_are_rounded_once(tmp_path):
    word = "1.00000017881393432617187499"  # float64 rounds it up to a tie
    found = scene(tmp_path, "a.ply", PLAIN_PLY.replace("1 2 3", f"{word} 2 3"))
    assert found[0, 0] == np.float32("1.0000001192092896")


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("2 0 1\n", "2 0 1\n2 0 1\n", "line 14: more follows than the header says"),
        ("property float y", "property float x", "two properties are called 'x'"),
        ("property float y", "property float X", "two columns are called x, one of them 'X'"),
        ("2 0 1\n", "3 0 1\n", "row 1 of 1 of element 'face' has too few numbers"),
        ("2 0 1\n", "1 0 1\n", "row 1 of 1 of element 'face' has too many numbers"),
        ("2 0 1\n", f"{'9' * 5000} 0\n", "has too few numbers"),
        ("vertex 2", f"vertex {'9' * 5000}", "is no number of rows"),
        ("float x", "half x", "line 4: no sound PLY"),
        ("ascii", "text", "line 2: no sound PLY"),
    ],
)
def test_ply_that_cannot_be_meant(tmp_path, capsys, old, new, why):
    assert why in refusal(tmp_path, capsys, "a.ply", PLAIN_PLY.replace(old, new), "--radius", "1")


LISTS = """ply
format binary_little_endian 1.0
element camera 1
property double fov
property list uchar short more
element vertex 2
property list uchar int neighbours
property float x
property float y
property float z
end_header
"""


def test_ply_lists_may_stand_before_and_among_the_coordinates(tmp_path, capsys):
    camera = struct.pack("<dBhh", 1.5, 2, 7, 8)
    rows = struct.pack("<Bfff", 0, 1, 2, 3) + struct.pack("<Bifff", 1, 9, 4, 5, 6)
    whole = LISTS.encode() + camera + rows
    same(scene(tmp_path, "a.ply", whole, "--radius", "1")[:, :3], [[1, 2, 3], [4, 5, 6]])
    (tmp_path / "out.npy").unlink()
    capsys.readouterr()
    error = refusal(tmp_path, capsys, "a.ply", whole[:-1])
    assert f"byte {len(whole) - 1}: the file ends within element 'vertex'" in error
    assert "more follows" in refusal(tmp_path, capsys, "a.ply", whole + b"x")


# VTK and SWC

VTK = """# vtk DataFile Version 3.0
Generated by LIGGGHTS
ASCII
DATASET POLYDATA
POINTS 2 float
1 2 3 4 5
6
VERTICES 2 4
1 0
1 1
POINT_DATA 2
VECTORS v float
0 0 0
0 0 0
SCALARS {name} float 1
LOOKUP_TABLE default
0.5
0.25
"""
FIELDS = """# vtk DataFile Version 5.1
fields
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 2 double
1 2 3 4 5 6
METADATA
INFORMATION 0

CELLS 2 1
OFFSETS vtktypeint64
0 1
CONNECTIVITY vtktypeint64
0
CELL_TYPES 1
1
CELL_DATA 1
FIELD FieldData 1
radius 1 1 float
9
POINT_DATA 2
FIELD FieldData 2
id 1 2 int
7 8
Radius 1 2 double
0.5 0.25
"""


@pytest.mark.parametrize("text", [VTK.format(name="radius"), FIELDS])
def test_vtk_text(tmp_path, text):
    same(scene(tmp_path, "a.vtk", text), [[1, 2, 3, 0.5], [4, 5, 6, 0.25]])


def test_vtk_diameters_are_halved(tmp_path):
    same(scene(tmp_path, "a.vtk", VTK.format(name="diameter"))[:, 3], [0.25, 0.125])


def test_vtk_binary(tmp_path):
    head = b"# vtk DataFile Version 3.0\nx\nBINARY\nDATASET POLYDATA\nPOINTS 2 float\n"
    cells = b"\nVERTICES 2 4\n" + struct.pack(">4i", 1, 0, 1, 1)
    radii = b"\nPOINT_DATA 2\nSCALARS radius double 1\nLOOKUP_TABLE default\n"
    text = (
        head + struct.pack(">6f", 1, 2, 3, 4, 5, 6) + cells + radii + struct.pack(">2d", 0.5, 0.1)
    )
    same(scene(tmp_path, "a.vtk", text), [[1, 2, 3, 0.5], [4, 5, 6, 0.1]])


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("POINTS 2", "POINTS 3", "line 9: '1 0' is nothing that is known"),
        ("POINTS 2", f"POINTS {'9' * 5000}", "is no count"),
        ("POINT_DATA 2", "POINT_DATA 1", "line 14: '0 0 0' is nothing that is known"),
        ("POLYDATA", "STRUCTURED_POINTS", "line 4: 'DATASET STRUCTURED_POINTS' is nothing"),
        ("VECTORS v float", "VECTORS v string", "is no type of numbers"),
        ("0.25\n", "0.25\n0.1\n", "line 19: '0.1' is nothing that is known"),
        ("0.25\n", "0.25\nmass 1 2 float\n1\n2\n", "'mass 1 2 float' is nothing that is known"),
        ("0.25\n", "0.25\nFIELD f 1\n", "ends after line 19, before an array"),
        (VTK[VTK.index("POINTS") :].format(name="radius"), "", "line 4, before POINTS"),
        ("\n6\n", "\nsix\n", "atom 2: z: 'six' is not a number"),
    ],
)
def test_vtk_that_cannot_be_meant(tmp_path, capsys, old, new, why):
    text = VTK.format(name="radius").replace(old, new)
    assert why in refusal(tmp_path, capsys, "a.vtk", text)


def test_swc(tmp_path, capsys):
    text = "# a neuron\n1 1 0.5 0 0 10.25 -1\n 2 3 1 2 3 .5 1 # a dendrite\n\n"
    same(scene(tmp_path, "a.swc", text), [[0.5, 0, 0, 10.25], [1, 2, 3, 0.5]])


def test_swc_lines_of_other_widths_are_refused(tmp_path, capsys):
    text = "1 1 0.5 0 0 10.25 -1\n2 3 1 2 3 .5\n"
    assert "line 2: 6 words, expected 7" in refusal(tmp_path, capsys, "a.swc", text)
