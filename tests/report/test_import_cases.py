# SPDX-License-Identifier: MIT
"""Files as people have them, odd yet right or odd and wrong: each kind that was once misread."""

from __future__ import annotations

import gzip

import pytest

from octocell_import.cli import main

from test_import_formats import DUMP, GRO, PLY, same, scene

MARK = b"\xef\xbb\xbf"
XYZ = "2\nc\nC 0 0 0\nH 1.1 0 0\n"
CH = [[0, 0, 0, 1.7], [1.1, 0, 0, 1.1]]
PLAIN_PLY = PLY.format(form="ascii", kind="float", name="radius") + "1 2 3 1\n4 5 6 1\n2 0 1\n"
RADII = DUMP.format(columns="id type x y z radius", first="1 1 2 3 .5", second="1 4 5 6 .25")


def atom(x: float, y: float = 0.0, z: float = 0.0, name: str = " N  ", tail: str = " N") -> str:
    return f"ATOM      1 {name} ALA A   1    {x:8.3f}{y:8.3f}{z:8.3f}  1.00  0.00          {tail}\n"


def refusal(tmp_path, capsys, name, content, *options):
    """The one line that is said of a file that cannot be used."""
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    assert main([str(path), *options]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and str(path) in err
    assert [p.name for p in tmp_path.iterdir()] == [name]
    return err


@pytest.mark.parametrize(
    ("name", "content"),
    [("a.xyz", XYZ), ("a.pdb", atom(1)), ("a.gro", GRO), ("a.dump", RADII), ("a.ply", PLAIN_PLY)],
)
def test_a_byte_order_mark_hides_nothing(tmp_path, name, content):
    same(scene(tmp_path, name, MARK + content.encode()), scene(tmp_path, name, content))


def test_a_packed_file_is_known_without_its_suffix(tmp_path):
    same(scene(tmp_path, "a.xyz", gzip.compress(XYZ.encode())), CH)


# PDB


def test_models_do_not_lie_on_each_other(tmp_path, capsys):
    text = "MODEL        1\n" + atom(1) + "MODEL        7\n" + atom(2) + atom(3) + "END\n"
    same(scene(tmp_path, "a.pdb", text)[:, 0], [1])
    assert "frame 0 (model 1), more follow" in capsys.readouterr().out
    same(scene(tmp_path, "a.pdb", text, "--model", "7")[:, 0], [2, 3])


def test_only_the_word_end_ends_a_frame(tmp_path):
    text = atom(1) + "ENDROOT\n" + atom(2) + "ENDBRANCH   1   2\n" + atom(3)
    same(scene(tmp_path, "a.pdb", text)[:, 0], [1, 2, 3])
    same(scene(tmp_path, "a.pdb", atom(1) + "END\n" + atom(2), "--frame", "1")[:, 0], [2])


def test_a_model_without_atoms_is_a_frame_of_no_spheres(tmp_path):
    text = "MODEL        1\nENDMDL\nMODEL        2\n" + atom(2) + "ENDMDL\n"
    assert len(scene(tmp_path, "a.pdb", text)) == 0
    assert len(scene(tmp_path, "a.pdb", text, "--frame", "1")) == 1


def test_pdb_of_before_1997_has_other_things_where_elements_are(tmp_path, capsys):
    lines = [(" CA ", "1ABC  99"), (" N  ", "1ABC 100"), (" O  ", "1ABC1001")]
    text = "".join(atom(k, name=name)[:72] + tail + "\n" for k, (name, tail) in enumerate(lines))
    same(scene(tmp_path, "a.pdb", text)[:, 3], [1.7, 1.55, 1.52])
    assert "elements   from atom and residue names" in capsys.readouterr().out


def test_elements_that_differ_from_the_names_are_told(tmp_path, capsys):
    same(scene(tmp_path, "a.pdb", atom(0, name=" CA ", tail="CA"))[:, 3], [2.31])
    assert "elements   of 1 atoms are others by their names" in capsys.readouterr().out


@pytest.mark.parametrize("serial", ["ATOM  A0000", "ATOM  *****", "ATOM 100000", "ATOM     -1"])
def test_serial_numbers_do_not_matter_where_they_fit(tmp_path, serial):
    same(scene(tmp_path, "a.pdb", serial + atom(1.458)[11:]), [[1.458, 0, 0, 1.55]])


@pytest.mark.parametrize("x", [0.0, 100.0, -999.5])
@pytest.mark.parametrize("y", [0.0, 1234.567])
def test_a_serial_number_that_moves_columns_is_named(tmp_path, capsys, x, y):
    text = "ATOM  100000" + atom(x, y, y)[11:]  # with y of eight places each field is a number
    assert "line 1: a serial number of six digits moved" in refusal(tmp_path, capsys, "a.pdb", text)


@pytest.mark.parametrize("record", ["atom  ", "ATAM  ", "HETATN", "Atom  ", " ATOM "])
def test_a_record_that_is_misspelt_is_no_comment(tmp_path, capsys, record):
    error = refusal(tmp_path, capsys, "a.pdb", atom(1) + record + atom(2)[6:])
    assert "line 2: " in error and "is no record of an atom, but has x, y and z" in error


def test_other_records_may_have_numbers_there(tmp_path):
    more = "REMARK" + atom(1)[6:] + "SIGATM" + atom(1)[6:] + "ANISOU" + atom(1)[6:] + atom(2)
    same(scene(tmp_path, "a.pdb", more)[:, 0], [2])


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ((30, 38, "********"), "x: '********' is not a number"),
        ((30, 54, " " * 24), "x: '' is not a number"),
        ((38, 46, "     nan"), "y: 'nan' is not a number"),
        ((26, 30, "\t   "), "a tab or zero byte"),
        ((53, 80, ""), "too short for x, y and z"),
    ],
)
def test_pdb_lines_that_hold_no_atom(tmp_path, capsys, change, why):
    start, stop, words = change
    line = atom(1)[:start] + words + atom(1)[stop:]
    assert f"line 2: {why}" in refusal(tmp_path, capsys, "a.pdb", atom(1) + line.rstrip() + "\n")


# GRO


def test_gro_titles_may_be_blank(tmp_path):
    blank = GRO[GRO.index("\n") :]
    same(scene(tmp_path, "a.gro", blank + blank + "\n\n", "--frame", "1")[:, 0], [1.26, 1.9])
    assert len(scene(tmp_path, "a.gro", "t\n    0\n   1.0 1.0 1.0\n")) == 0


def test_gro_columns_that_moved_are_refused_though_they_are_numbers(tmp_path, capsys):
    lines = GRO.splitlines(keepends=True)
    moved = "100000SOL    HW1    21000.1901000.6611000.747\n"
    error = refusal(tmp_path, capsys, "a.gro", "".join([*lines[:3], moved, lines[4]]))
    assert "line 4: x: '21000.19' is not a number with its point as above" in error


# XYZ


@pytest.mark.parametrize(
    ("comment", "radii"),
    [
        ("Properties = species:S:1:pos:R:3:charge:R:1", [1.1]),
        ("properties=species:S:1:pos:R:3:charge:R:1", [1.1]),
        ("properties=species:S:1:pos:R:3:radius:R:1", [0.43]),
        ("nothing is said", [1.1]),
        (
            'x="Properties=a" Properties="species:S:1:pos:R:3:radius:R:1"',
            [0.43],
        ),
    ],
)
def test_a_fifth_column_is_a_radius_only_if_it_is_said(tmp_path, comment, radii):
    same(scene(tmp_path, "a.xyz", f"1\n{comment}\nH 0 0 0 0.43\n")[:, 3], radii)


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        ("2\n\n6 0 0 0\n1 1.1 0 0\n", CH),
        ("2\n\nC 0.0D0 0 0\nH 1.1D+00 0d0 0\n", CH),
        ("2\nProperties=Z:I:1:pos:R:3\n6 0 0 0\n1 1.1 0 0\n", CH),
        ("2\nProperties=pos:R:3:radius:R:1\n0 0 0 1.7\n1.1 0 0 1.1\n", CH),
        (
            "2\ngdb 1\t9\nC 0 0 0 -.1\nH 11*^-1 0 0 .1\n1 2\nC C\nInChI=1\n",
            CH,
        ),
    ],
)
def test_xyz_as_other_programs_write_it(tmp_path, text, rows):
    same(scene(tmp_path, "a.xyz", text), rows)


def test_types_of_lammps_are_no_atomic_numbers(tmp_path, capsys):
    text = "1\nAtoms. Timestep: 0\n1 0 0 0\n"
    assert "line 3: '1' is of no known element" in refusal(tmp_path, capsys, "a.xyz", text)
    same(scene(tmp_path, "a.xyz", text, "--radius", "1=0.5")[:, 3], [0.5])


def test_numbers_of_thousands_of_digits(tmp_path, capsys):
    many = "9" * 5000
    assert "line 1: '999" in refusal(tmp_path, capsys, "a.xyz", XYZ.replace("2", many, 1))
    assert "is no number of atoms" in refusal(tmp_path, capsys, "a.gro".replace("gro", "xyz"), many)
    text = XYZ.replace("0 0 0", f"0.{many} 0 0")
    assert "it has 5002 characters, of 1000 at most" in refusal(tmp_path, capsys, "a.xyz", text)
    same(scene(tmp_path, "a.xyz", XYZ.replace("0 0 0", f"0.{'0' * 990}1 0 0")), CH)


def test_counts_that_no_file_can_hold(tmp_path, capsys):
    error = refusal(tmp_path, capsys, "a.xyz", XYZ.replace("2", "9" * 18, 1))
    assert "ends after line 4, before atom 3 of 99999" in error
