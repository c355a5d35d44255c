# SPDX-License-Identifier: MIT
"""NPY, tables and PQR, which octocell reads itself: the importer hands them on."""

from __future__ import annotations

import gzip

import numpy as np
import pytest
from test_import_cases import refusal

from octocell_import.cli import main

from test_import_formats import GRO, PQR, same, scene, trr_frame

ATOM = "ATOM      {k}  N   ALA A   1      {x:6.3f}   0.000   0.000  0.1414 1.8240\n"
MODELS = "MODEL 1\n" + ATOM.format(k=1, x=0) + "ENDMDL\nMODEL 2\n" + ATOM.format(k=1, x=1) * 2


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.csv", "x,y,z,r\n0,0,0,1\n1,0,0,1\n"),
        ("a.txt", "#format x_y_z_r\n0.0\t0.0\t0.0\t1.0\n1\t0\t0\t1\n"),
        ("a.xyzr.gz", gzip.compress(b"0 0 0 1\n1 0 0 1\n")),
        ("a.csv", '"id";"x";"y";"z";"radius"\n7;0;0;0;1\n9;1;0;0;1\n'),
    ],
)
def test_tables(tmp_path, name, content):
    same(scene(tmp_path, name, content), [[0, 0, 0, 1], [1, 0, 0, 1]])


def test_options_are_handed_on(tmp_path, capsys):
    same(scene(tmp_path, "a.txt", "0 0 0\n1 0 0\n", "--radius", "0.5")[:, 3], [0.5, 0.5])
    assert main([str(tmp_path / "a.txt"), "--radius", "1", "--radius", "C=2"]) == 2
    assert "--radius C=...: no atom is so called" in capsys.readouterr().err
    same(scene(tmp_path, "a.txt", "0 0 0 1\nnan 0 0 1\n", "--drop-invalid"), [[0, 0, 0, 1]])
    assert "octocell   " in capsys.readouterr().out
    np.save(tmp_path / "b.npy", np.array([[1, 2, 3, 4]], np.float32))
    assert main([str(tmp_path / "b.npy"), "-o", str(tmp_path / "out.npy")]) == 0
    same(np.load(tmp_path / "out.npy"), [[1, 2, 3, 4]])


def test_models_of_pqr_are_frames(tmp_path, capsys):
    assert scene(tmp_path, "a.pqr", MODELS)[:, 0].tolist() == [0]
    assert "frame 0, more follow" in capsys.readouterr().out
    assert scene(tmp_path, "a.pqr", MODELS, "--frame", "1")[:, 0].tolist() == [1, 1]
    assert main([str(tmp_path / "a.pqr"), "--all-frames", str(tmp_path / "frames")]) == 0
    assert "2 frames written, 1 to 2 spheres" in capsys.readouterr().out


def test_pqr_is_in_angstrom_and_its_radii_may_be_replaced(tmp_path):
    rows = [[2.6981, 5.3977, 4.0085, 0.185], [-2.6981, 5.3977, 4.0085, 0.02245]]
    np.testing.assert_allclose(scene(tmp_path, "a.pqr", PQR, "--length-unit", "nm"), rows, 1e-6)
    same(scene(tmp_path, "a.pqr", PQR, "--radius", "3")[:, 3], [3, 3])


@pytest.mark.parametrize(
    ("name", "content", "why"),
    [
        ("a.pqr", PQR.replace("ATOM", "ATAM"), ":2: "),
        ("a.csv", "x,y,z,r\n0,0,0,one\n", ":2: 'one' is not a number"),
        ("a.pqr", "REMARK\n", "no ATOM and no HETATM record"),
        ("a.npy", "x", "a.npy: "),
    ],
)
def test_refusals_are_passed_on(tmp_path, capsys, name, content, why):
    assert why in refusal(tmp_path, capsys, name, content)


def test_without_octocell_it_is_said(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("OCTOCELL_BIN", "")
    monkeypatch.setattr("octocell_import.octocell._ROOT", tmp_path)
    monkeypatch.setenv("PATH", "")
    assert "is not built here" in refusal(tmp_path, capsys, "a.pqr", PQR)


def test_a_table_may_be_a_topology(tmp_path):
    (tmp_path / "b.csv").write_text("x,y,z,r\n0,0,0,1\n1,0,0,2\n")
    (tmp_path / "a.gro").write_text(GRO)
    frames = trr_frame([(0.5, 0.25, 1), (1, 2, 3)])
    found = scene(tmp_path, "a.trr", frames, "--topology", str(tmp_path / "b.csv"))
    same(found, [[5, 2.5, 10, 1], [10, 20, 30, 2]])
