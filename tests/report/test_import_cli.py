# SPDX-License-Identifier: MIT
"""What the options do, and what is written where."""

from __future__ import annotations

import numpy as np
import pytest

from octocell_import.cli import main
from octocell_import.elements import RADII, SYMBOLS, element_of, symbol_of_mass

from test_import_formats import GRO, PLY, scene

XYZ = "3\nc\nC 0 0 0\nCA 1 0 0\nXx 2 0 0\n"
FRAMES = "".join(f"1\nframe\nC {k} 0 0\n" for k in range(3))


def refusal(tmp_path, capsys, content, *options, name="a.xyz"):
    (tmp_path / name).write_text(content)
    assert main([str(tmp_path / name), *options]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1
    assert not list(tmp_path.glob("**/*.npy")) and not list(tmp_path.glob("**/.*"))
    return err


def test_radii_by_name_go_before_those_by_element(tmp_path, capsys):
    options = ["--radius", "Xx=0.5", "--radius", "Ca=2", "--radius", "CA=3", "--radius", "C=1"]
    assert list(scene(tmp_path, "a.xyz", XYZ, *options)[:, 3]) == [1, 3, 0.5]
    assert "1 Xx 0.5" in capsys.readouterr().out


def test_one_radius_for_all_may_have_exceptions(tmp_path, capsys):
    options = ["--radius", "0.1", "--radius", "Xx=0"]
    assert list(scene(tmp_path, "a.xyz", XYZ, *options)[:, 3]) == [np.float32(0.1)] * 2 + [0]
    assert "0.1 for all, as given; 1 replaced as given" in capsys.readouterr().out


def test_exceptions_hold_for_radii_of_the_file_too(tmp_path):
    text = "2\nc\nC 0 0 0 1\nD 0 0 0 2\n"
    options = ["--radius", "D=7", "--radii", "file"]
    assert list(scene(tmp_path, "a.xyz", text, *options)[:, 3]) == [1, 7]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--radius", "Xx=-1"], "'Xx=-1': is negative"),
        (["--radius", "Xx=big"], "'big' is not a number"),
        (["--radius", "=1"], "'=1': R or NAME=R"),
        (["--radius", "1", "--radius", "2"], "'2': R or NAME=R, each name once"),
        (["--radius", "1", "--radius", "XX=2"], "--radius XX=...: no atom is so called"),
        (["--radius", "Zn=1", "--radius", "1"], "--radius Zn=...: no atom is so called"),
        (["--radius", "1", "--radii", "element"], "--radii element says otherwise"),
        (["--radii", "file"], "--radii file: it has no radii"),
        (["--radius", "1", "--frame", "1"], "no frame 1: it has 1, counted from 0"),
        (["--radius", "1", "--frame", "-1"], "frames are counted from 0"),
        (["--radius", "1", "-o", "scene.csv"], "has to end in .npy"),
        (["--radius", "1", "-o", "none/scene.npy"], "cannot be written: No such file"),
        (["--radius", "1", "--atom-style", "full"], "--atom-style is for LAMMPS data"),
        (["--radius", "1", "--all-frames", "a.xyz"], "is not a folder"),
        (["--radius", "1", "--all-frames", "b", "-o", "c.npy"], "give one of them"),
        ([], "line 5: 'Xx' is of no known element"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, capsys, monkeypatch, options, message):
    monkeypatch.chdir(tmp_path)
    assert message in refusal(tmp_path, capsys, XYZ, *options)


def test_a_hint_is_given_where_an_element_is_written_in_capitals(tmp_path, capsys):
    options = ["--radius", "1", "--radius", "FE=2"]
    assert "the element is written Fe" in refusal(tmp_path, capsys, XYZ, *options)


def test_a_file_without_unit_has_no_unit_to_convert(tmp_path, capsys):
    text = PLY.format(form="ascii", kind="float", name="radius") + "1 2 3 1\n4 5 6 1\n2 0 1\n"
    error = refusal(tmp_path, capsys, text, "--length-unit", "nm", name="a.ply")
    assert "its unit is not known: it cannot be written in nm" in error


def test_the_scene_stands_beside_its_file_by_default(tmp_path):
    (tmp_path / "a.b.gro").write_text(GRO)
    assert main([str(tmp_path / "a.b.gro")]) == 0
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.b.gro", "a.b.npy"]


def test_a_refusal_leaves_the_old_scene_alone(tmp_path):
    (tmp_path / "a.npy").write_bytes(b"old")
    (tmp_path / "a.xyz").write_text(XYZ)
    assert main([str(tmp_path / "a.xyz")]) == 2
    assert (tmp_path / "a.npy").read_bytes() == b"old"


def test_all_frames_replace_those_of_an_earlier_time(tmp_path, capsys):
    folder = tmp_path / "frames"
    folder.mkdir()
    for name in ("frame_00009.npy", "other.npy"):
        (folder / name).write_bytes(b"old")
    (tmp_path / "a.xyz").write_text(FRAMES)
    assert main([str(tmp_path / "a.xyz"), "--all-frames", str(folder)]) == 0
    names = [*(f"frame_0000{k}.npy" for k in range(3)), "other.npy"]
    assert sorted(p.name for p in folder.iterdir()) == names
    assert [np.load(folder / name)[0, 0] for name in names[:3]] == [0, 1, 2]
    assert "3 frames written, 1 spheres each" in capsys.readouterr().out


def test_a_bad_last_frame_leaves_no_frame(tmp_path, capsys):
    folder = tmp_path / "frames"
    error = refusal(tmp_path, capsys, FRAMES + "1\nc\nC 1 2 x\n", "--all-frames", str(folder))
    assert "line 12: z: 'x' is not a number" in error
    assert not folder.exists()


@pytest.mark.parametrize(
    ("name", "residue", "element"),
    [
        ("CA", "ALA", "C"),
        ("CA", "CA", "Ca"),
        ("NA", "NA+", "Na"),
        ("CL", "CL-", "Cl"),
        ("SOD", "SOD", "Na"),
        ("K+", "ION", "K"),
        ("1HB2", "LEU", "H"),
        ("HG11", "VAL", "H"),
        ("MW", "SOL", None),
        ("LP1", "HOH", None),
        ("FE", "HEME", "Fe"),
        ("CL12", "LIG", "Cl"),
        ("C12", "DPPC", "C"),
        ("OP1", "DA", "O"),
        ("W", "W", "W"),
        ("GL1", "DPPC", None),
        ("", "ALA", None),
    ],
)
def test_names_mean_elements(name, residue, element):
    assert element_of(name, residue) == element


def test_masses_mean_elements_unless_they_are_of_united_atoms_or_of_nothing():
    known = [symbol_of_mass(mass) for mass in (1.00794, 12.0107, 14.0067, 15.9994, 32.065, 35.453)]
    assert known == ["H", "C", "N", "O", "S", "Cl"]
    assert [symbol_of_mass(mass) for mass in (1.0, 14.027, 13.019, 0.012, 72.0)] == [None] * 5


def test_the_table_of_radii_is_of_elements_and_of_angstrom():
    assert set(RADII) <= SYMBOLS
    assert all(1 < float(radius) < 4 for radius in RADII.values())
    assert [RADII[s] for s in ("H", "C", "N", "O", "S", "P")] == (
        ["1.10", "1.70", "1.55", "1.52", "1.80", "1.80"]
    )
