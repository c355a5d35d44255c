# SPDX-License-Identifier: MIT
"""Tables as people write them: read right, or refused with the line and the way out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from program import Octocell, Refused
from scene_input import read

TWO = np.array([[0, 0, 0, 1], [1, 0, 0, 1]], np.float32)
ODD = np.array([[1.5, -2, 0.25, 0.5], [3, 1e-3, 7, 2]], np.float32)  # no two columns alike
ROWS = "1.5,-2,0.25,0.5\n3,1e-3,7,2\n"

READ = {  # file name: (its text, options, its spheres)
    # headers
    "header.csv": ("x,y,z,r\n" + ROWS, (), ODD),
    "none.csv": (ROWS, (), ODD),
    "capitals.csv": ("X,Y,Z,Radius\n" + ROWS, (), ODD),
    "order.csv": ("r,z,x,y\n0.5,0.25,1.5,-2\n2,7,3,1e-3\n", (), ODD),
    "comment.csv": ("# x,y,z,r\n" + ROWS, (), ODD),
    "comment_blanks.csv": ("# r z x y\n0.5,0.25,1.5,-2\n2,7,3,1e-3\n", (), ODD),
    "comment_and_header.csv": ("# x,y,z,r\nr,z,x,y\n0.5,0.25,1.5,-2\n2,7,3,1e-3\n", (), ODD),
    "comment_same_twice.csv": ("# x,y,z,r\n# x y z r\n" + ROWS, (), ODD),
    "prose.csv": ("# x and y, then z and r, in metres\n" + ROWS, (), ODD),
    "percent.txt": ("% x y z r\n1.5 -2 0.25 0.5\n3 1e-3 7 2\n", (), ODD),
    "id.csv": ("id,x,y,z,r\n7,1.5,-2,0.25,0.5\n3,3,1e-3,7,2\n", (), ODD),
    "pandas.csv": (",x,y,z,radius\n0,1.5,-2,0.25,0.5\n1,3,1e-3,7,2\n", (), ODD),
    "pandas.tsv": ("\tx\ty\tz\tr\n0\t1.5\t-2\t0.25\t0.5\n1\t3\t1e-3\t7\t2\n", (), ODD),
    "other_columns.csv": ("mass,x,y,z,r,name\n9,1.5,-2,0.25,0.5,a\n9,3,1e-3,7,2,\n", (), ODD),
    "paraview.csv": (
        '"Radius","Points:0","Points:1","Points:2"\n0.5,1.5,-2,0.25\n2,3,1e-3,7\n',
        (),
        ODD,
    ),
    # separators
    "semicolons.csv": ("x;y;z;r\n1.5;-2;0.25;0.5\n3;1e-3;7;2\n", (), ODD),
    "tabs.csv": ("x\ty\tz\tr\n1.5\t-2\t0.25\t0.5\n3\t1e-3\t7\t2\n", (), ODD),
    "blanks.csv": ("  1.5   -2 0.25\t0.5\n".replace("\t", " ") + "3 1e-3 7 2  \n", (), ODD),
    "blanks_around.csv": ("x , y,\tz, r\n 1.5 , -2,\t0.25 , 0.5 # one\n3,1e-3,7,2\n", (), ODD),
    "last_separator.csv": ("x,y,z,r\n1.5,-2,0.25,0.5,\n3,1e-3,7,2,\n", (), ODD),
    "last_separator_all.csv": ("x,y,z,r,\n1.5,-2,0.25,0.5,\n3,1e-3,7,2,\n", (), ODD),
    "last_tab.txt": ("1.5\t-2\t0.25\t0.5\t\n3\t1e-3\t7\t2\t\n", (), ODD),
    # quotes
    "quoted.csv": ('"x","y","z","r"\n"1.5","-2","0.25","0.5"\n"3","1e-3","7","2"\n', (), ODD),
    "quoted_separator.csv": ('name,x,y,z,r\n"a, #1",1.5,-2,0.25,0.5\nb,3,1e-3,7,2\n', (), ODD),
    # numbers
    "spellings.csv": ("+1.5,-2.,.25,5e-1\n3.0e0,0.001,+7.,2E0\n", (), ODD),
    "digits.csv": ("1.5" + "0" * 5000 + ",-2,0.25,0.5\n3,1e-3,7,2." + "0" * 5000, (), ODD),
    "decimal_comma.csv": ("x;y;z;r\n1,5;-2;0,25;0,5\n3;1e-3;7;2\n", ("--decimal-comma",), ODD),
    "decimal_comma.txt": ("1,5 -2 0,25 0,5\n3 1e-3 7 2\n", ("--decimal-comma",), ODD),
    # lines
    "crlf.csv": ("x,y,z,r\r\n1.5,-2,0.25,0.5\r\n3,1e-3,7,2\r\n", (), ODD),
    "mark.csv": ("\ufeffx,y,z,r\n" + ROWS, (), ODD),
    "mark_alone.csv": ("\ufeff" + ROWS, (), ODD),
    "blank_lines.csv": ("\n \nx,y,z,r\n\n" + ROWS.replace("\n", "\n\n"), (), ODD),
    "no_last_break.csv": (ROWS.strip(), (), ODD),
    # text of other programs
    "savetxt.txt": ("1.5e+00 -2.0e+00 2.5e-01 5.0e-01\n3.0e+00 1.0e-03 7.0e+00 2.0e+00\n", (), ODD),
    "yade.txt": ("#format x_y_z_r\n1.5\t-2\t0.25\t0.5\n3\t1e-3\t7\t2\n", (), ODD),
    "yade_material.txt": (
        "#format id_x_y_z_r_matId\n4\t1.5\t-2\t0.25\t0.5\t1\n5\t3\t1e-3\t7\t2\t1\n",
        (),
        ODD,
    ),
    "msms.xyzr": ("1.5 -2 0.25 0.5\n3 1e-3 7 2\n", (), ODD),
    "pack.spheres": ("#made by hand\n1.5\t-2\t0.25\t0.5\n3\t1e-3\t7\t2\n", (), ODD),
    "voro.dat": ("9 1.5 -2 0.25 0.5\n4 3 1e-3 7 2\n", (), ODD),
    "voro_whole.dat": ("1 0 0 0 1\n2 1 0 0 1\n", (), TWO),
    "ids_as_floats.txt": ("0.0e+00 1.5 -2 0.25 0.5\n1.0e+00 3 1e-3 7 2\n", (), ODD),
    # a chain along x is no column of ids
    "chain.csv": ("0 0 0 1\n1 0 0 1\n", (), TWO),
    # the caller says what it is
    "radius.csv": ("x,y,z\n0,0,0\n1,0,0\n", ("--radius", "1"), TWO),
    "radius.txt": ("0 0 0\n1 0 0\n", ("--radius", "1"), TWO),
    "columns.txt": (
        "1.5 -2 0.25 9 0.5\n3 1e-3 7 9 2\n",
        ("--columns", "x,y,z,mass,r"),
        ODD,
    ),
    "columns_ids.txt": ("7 0 0 0\n9 1 0 0\n", ("--columns", "id,x,y,z", "--radius", "1"), TWO),
    "columns_over_header.csv": (
        "a,b,c,d\n".replace("a,b,c,d", "x,y,z,r") + "0.5,0.25,1.5,-2\n2,7,3,1e-3\n",
        ("--columns", "r,z,x,y"),
        ODD,
    ),
    "suffix.unknown": (ROWS, ("--format", "table"), ODD),
    # no spheres
    "header_only.csv": ("x,y,z,r\n", (), TWO[:0]),
    "yade_none.txt": ("#format x_y_z_r\n", (), TWO[:0]),
}


@pytest.mark.parametrize("name", READ)
def test_tables_are_read(octocell: Octocell, tmp_path: Path, name: str) -> None:
    text, options, expected = READ[name]
    (tmp_path / name).write_text(text, encoding="utf-8", newline="")
    spheres, _ = read(octocell, tmp_path / name, *options)
    np.testing.assert_array_equal(spheres, expected)


SAID = {
    "other.csv": ("mass,x,y,z,r,name\n9,0,0,0,1,a\n", "columns that are not read: mass,name"),
    "voro.txt": ("1 0 0 0 1\n2 1 0 0 1\n", "taken for columns id,x,y,z,r"),
    "many.csv": (
        "x,y,z,r," + ",".join(f"c{k}" for k in range(2000)) + "\n0,0,0,1" + ",0" * 2000,
        "c0,c1,c2,c3,c4,c5,c6,c7 and 1992 more",
    ),
}


@pytest.mark.parametrize("name", SAID)
def test_what_is_not_read_is_said(octocell: Octocell, tmp_path: Path, name: str) -> None:
    text, words = SAID[name]
    (tmp_path / name).write_text(text, encoding="utf-8")
    _, said = read(octocell, tmp_path / name)
    assert said.startswith(f"octocell: {name}: ") and words in said and said.count("\n") == 1


@pytest.mark.parametrize("name", ["header.csv", "pandas.csv", "msms.xyzr", "blanks.csv"])
def test_nothing_is_said_of_a_plain_table(octocell: Octocell, tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text(READ[name][0], encoding="utf-8")
    assert read(octocell, tmp_path / name)[1] == ""


REFUSED = {  # file name: (its text, options, words of the message)
    # numbers that are none
    "hex.csv": ("0x1p0,0,0,1\n", (), [":1:", "'0x1p0' is not a number"]),
    "fortran.csv": ("0,0,0,1.0D0\n", (), [":1:", "'1.0D0' is not a number"]),
    "thousands.csv": ('"1,000.5",0,0,1\n', (), [":1:", "'1,000.5' is not a number"]),
    "unicode_minus.csv": ("0,0,0,1\n\u22121,0,0,1\n", (), [":2:", "is not a number"]),
    "no_break_space.csv": ("0,0,0,1\n1,\u00a00,0,1\n", (), [":2:", "is not a number"]),
    "null.csv": ("0,0,0,1\n1,0,0,1\0\n", (), [":2:", r"'1\x00'"]),
    "empty_field.csv": ("0,0,,1\n", (), [":1:", "'' is not a number"]),
    "exponent.csv": (f"0,0,0,1e{'9' * 5000}\n", (), [":1:", "too large for float32"]),
    "decimal_comma.csv": ("x;y;z;r\n0,5;0;0;1\n", (), [":2:", "'0,5'", "--decimal-comma"]),
    "thousands_point.csv": (
        "x;y;z;r\n1.000;0;0;1\n",
        ("--decimal-comma",),
        [":2:", "'1.000' is not a number"],
    ),
    "group_fraction.csv": ("x,y,z,r,group\n0,0,0,1,1.0\n", (), [":2:", "group is '1.0'"]),
    # headers
    "two_headers.csv": ("r,z,y,x\nx,y,z,r\n0,0,0,1\n", (), [":2:", "second header", "line 1"]),
    "two_comments.csv": ("# r,z,y,x\n# x,y,z,r\n0,0,0,1\n", (), [":2:", "another header"]),
    "x_twice.csv": ("x,x,y,z,r\n0,0,0,0,1\n", (), [":1:", "header with x, y, z and r"]),
    "two_radii.csv": ("x,y,z,r,radius\n0,0,0,1,1\n", (), [":1:", "each once"]),
    "no_radius.csv": ("x,y,z,mass\n0,0,0,1\n", (), [":2:", "no radii", "--radius"]),
    "comment_no_radius.csv": ("# id x y z\n1 0 0 0\n", (), [":2:", "no radii in columns id,x,y,z"]),
    "separators.csv": ("x y z r\n0,0,0,1\n", (), [":2:", "1 field, expected 4 with blanks"]),
    # fields
    "three.csv": ("x,y,z,r\n0,0,0\n", (), [":2:", "3 fields, expected 4 with commas"]),
    "three_no_radius.txt": ("0 0 0\n", (), [":1:", "no radii in columns x,y,z", "--radius"]),
    "one.txt": ("2\n0 0 0 1\n", (), [":1:", "1 field and no header", "--columns"]),
    "six.txt": ("0 0 0 1 1 1\n", (), [":1:", "6 fields and no header", "--columns"]),
    "doubled_tabs.txt": ("0\t\t0\t0\t1\n", (), [":1:"]),
    "radius_given_twice.csv": ("0,0,0,1\n", ("--radius", "2"), [":1:", "--radius is for files"]),
    # ids or coordinates?
    "voro_no_radii.txt": (
        "23 1.7 3.4 0.49\n9 1.5 4.5 0.498\n",
        (),
        [":1:", "--columns x,y,z,r", "--columns id,x,y,z"],
    ),
    "voro_negative.txt": ("23 1.7 3.4 -0.49\n", (), [":1:", "r is -0.49", "--columns id,x,y,z"]),
    "material_last.txt": ("0 0 0 1 0\n1 0 0 1 0\n", (), [":1:", "--columns id,x,y,z,r"]),
    "no_id.txt": ("0.5 0 0 1 0\n", (), [":1:", "5 fields and no header", "--columns"]),
    "id_twice.txt": ("1 0 0 0 0.5\n1 1 0 0 0.5\n", (), [":1:", "no ids", "--columns"]),
    # options
    "columns.csv": ("0,0,0,1\n", ("--columns", "x,y,r"), ["--columns 'x,y,r'", "x, y and z"]),
    "columns_count.csv": ("0,0,0,1\n", ("--columns", "x,y,z,r,id"), [":1:", "4 fields"]),
    # lines
    "cr.csv": ("x,y,z,r\r0,0,0,1\r", (), [":1:", "CR within a line"]),
    "only_comments.csv": ("# nothing\n\n", (), ["neither a header nor a sphere"]),
}


@pytest.mark.parametrize("name", REFUSED)
def test_tables_are_refused(refused: Refused, tmp_path: Path, name: str) -> None:
    text, options, words = REFUSED[name]
    (tmp_path / name).write_text(text, encoding="utf-8", newline="")
    line = refused("find", name, *options)
    assert all(word in line for word in [name if ":" in words[0] else "", *words]), line


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be"])
def test_utf_16_is_refused(refused: Refused, tmp_path: Path, encoding: str) -> None:
    (tmp_path / "wide.csv").write_text("\ufeffx,y,z,r\n0,0,0,1\n", encoding=encoding)
    assert "wide.csv:1: text in UTF-16" in refused("find", "wide.csv")


def test_numpy_writes_what_is_read(octocell: Octocell, tmp_path: Path) -> None:
    spheres = np.random.default_rng(1).random((50, 4), np.float32)
    np.savetxt(tmp_path / "plain.txt", spheres)
    np.savetxt(tmp_path / "header.csv", spheres, delimiter=",", header="x,y,z,r")
    for name in ("plain.txt", "header.csv"):
        np.testing.assert_array_equal(read(octocell, tmp_path / name)[0], spheres)
