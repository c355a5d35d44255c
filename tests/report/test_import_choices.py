# SPDX-License-Identifier: MIT
"""mmCIF, and what may be chosen of it and of others: chain, residue, altloc, model, frame."""

from __future__ import annotations

import gzip
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from test_import_cases import XYZ, atom, refusal
from test_import_particles import RADII

from octocell_import.cli import main

from test_import_formats import same, scene

TAGS = """data_x
#
_cell.length_a 1
loop_
_atom_site.group_PDB
_atom_site.type_symbol
_atom_site.label_atom_id
_atom_site.label_alt_id
_atom_site.auth_comp_id
_atom_site.auth_asym_id
_atom_site.auth_seq_id
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
_atom_site.pdbx_PDB_model_num
"""
ROWS = """ATOM N N . ALA A 1 1.000 2 3 1
ATOM C CA A ALA A 1 2.000 2 3 1
ATOM C CA B ALA A 1 3.000 2 3 1
ATOM O "O5'" . DA B -7 4.000 2 3 1
HETATM Zn ZN . ZN B 12 5.000 2 3 1
ATOM N N . ALA A 1 6.000 2 3 2
"""
ENVIRONMENT = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2] / "reports")}
CIF = TAGS + ROWS + "#\n"


def xs(found):
    return found[:, 0].tolist()


def test_mmcif(tmp_path, capsys):
    radii = [1.55, 1.7, 1.7, 1.52, 1.39]
    same(scene(tmp_path, "a.cif", CIF), [[k + 1, 2, 3, r] for k, r in enumerate(radii)])
    said = capsys.readouterr().out
    assert "frame 0 (model 1), more follow" in said and "elements   from type_symbol\n" in said
    assert "alternate  locations are kept: 2 atoms have them" in said
    assert xs(scene(tmp_path, "a.cif", CIF, "--model", "2")) == [6]
    assert xs(scene(tmp_path, "a.cif.gz", gzip.compress(CIF.encode()), "--frame", "1")) == [6]


def test_mmcif_rows_may_be_written_in_any_way(tmp_path):
    text = CIF.replace("ALA A 1 1.000", "ALA\n'A' 1\n;1.000\n;\n").replace(
        "2 3 1\nATOM C CA A", "2\n3 1 ATOM C CA A"
    )
    assert xs(scene(tmp_path, "a.cif", text)) == [1, 2, 3, 4, 5]


def test_mmcif_is_read_in_pieces(tmp_path, monkeypatch):
    for lines in (1, 2, 3, 4, 6):
        monkeypatch.setattr("octocell_import.mmcif._CHUNK", lines)
        assert xs(scene(tmp_path, "a.cif", CIF)) == [1, 2, 3, 4, 5]
        two_lines = CIF.replace(" 2 3 1\n", "\n2 3 1\n")
        assert xs(scene(tmp_path, "a.cif", two_lines)) == [1, 2, 3, 4, 5]


def test_mmcif_of_one_atom_needs_no_loop(tmp_path):
    values = "ATOM N N . ALA A 1 1.5 2 3 1".split()
    tags = TAGS[TAGS.index("_atom") :].split()
    text = "data_x\n" + "".join(f"{tag} {value}\n" for tag, value in zip(tags, values, strict=True))
    same(scene(tmp_path, "a.cif", text), [[1.5, 2, 3, 1.55]])


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("1.000", "1.0.0", "line 16: x: '1.0.0' is not a number"),
        ("4.000", "?", "line 19: x: '?' is not a number"),
        ("5.000", "", "gemmi says: Wrong number of values in loop _atom_site.*"),
        ('"O5\'"', "\"O5'", "line 19: gemmi says: unterminated"),
        ("Cartn_y", "fract_y", "has no Cartn_y"),
        ("Cartn_y", "Cartn_x", "gemmi says: duplicate tag"),
        ("_atom_site", "_atom_type", "an atom outside of the loop _atom_site"),
        ("ATOM C", "#\nloop_\nATOM C", "line 19: an atom outside of the loop"),
        ("site.Cartn_x", "ste.Cartn_x", "line 12: '_atom_ste.Cartn_x' in the loop of _atom_site"),
        ("Zn ZN", "? QQ", "'QQ' is of no known element"),
    ],
)
def test_mmcif_that_cannot_be_meant(tmp_path, capsys, old, new, why):
    assert why in refusal(tmp_path, capsys, "a.cif", CIF.replace(old, new))


@pytest.mark.parametrize(
    ("options", "kept"),
    [
        (["--chain", "B"], [4, 5]),
        (["--chain", "A,B"], [1, 2, 3, 4, 5]),
        (["--altloc", "A"], [1, 2, 4, 5]),
        (["--altloc", "B", "--chain", "A"], [1, 3]),
        (["--residue", "ZN,DA"], [4, 5]),
        (["--residue", "1"], [1, 2, 3]),
        (["--residue=-10-0,12"], [4, 5]),
        (["--residue", "1-12"], [1, 2, 3, 5]),
    ],
)
def test_choices(tmp_path, capsys, options, kept):
    assert xs(scene(tmp_path, "a.cif", CIF, *options)) == kept
    assert f"chosen     {len(kept)} of 5 atoms" in capsys.readouterr().out


def test_residues_by_number_need_numbers(tmp_path, capsys):
    text = CIF.replace("_atom_site.auth_seq_id", "_atom_site.other")
    assert xs(scene(tmp_path, "a.cif", text, "--residue", "ZN")) == [5]
    (tmp_path / "out.npy").unlink()
    capsys.readouterr()
    assert "no atom has --residue 12" in refusal(tmp_path, capsys, "a.cif", text, "--residue", "12")


def test_long_words_may_be_chosen_among(tmp_path):
    text = CIF.replace("ATOM N N . ALA A 1 1.000", f"ATOM N N . {'A' * 100} A 1 1.000")
    assert xs(scene(tmp_path, "a.cif", text, "--residue", "A" * 100)) == [1]


def test_choices_of_pdb(tmp_path):
    text = atom(1) + atom(2)[:21] + "B  15" + atom(2)[26:] + atom(3)[:16] + "A" + atom(3)[17:]
    assert xs(scene(tmp_path, "a.pdb", text, "--chain", "B")) == [2]
    assert xs(scene(tmp_path, "a.pdb", text, "--residue", "15")) == [2]
    assert xs(scene(tmp_path, "a.pdb", text, "--altloc", "B")) == [1, 2]


@pytest.mark.parametrize(
    ("options", "why"),
    [
        (["--chain", "Z"], "no atom has --chain Z"),
        (["--chain", "A", "--residue", "ZN"], "no atom has --chain A --residue ZN"),
        (["--model", "3"], "no model 3: it has 2"),
        (["--frame", "2"], "no frame 2: it has 2, counted from 0"),
    ],
)
def test_choices_of_nothing(tmp_path, capsys, options, why):
    assert why in refusal(tmp_path, capsys, "a.cif", CIF, *options)


def test_what_the_file_does_not_tell_cannot_be_chosen(tmp_path, capsys):
    assert "--chain: the file has none" in refusal(tmp_path, capsys, "a.xyz", XYZ, "--chain", "A")


def test_invalid_spheres_may_be_dropped(tmp_path, capsys):
    text = RADII.replace(" 4 5 6 .25", " nan 5 6 .25")
    same(scene(tmp_path, "a.dump", text, "--drop-invalid"), [[1, 2, 3, 0.5]])
    assert "dropped    1 spheres that are invalid, the first in line 10" in capsys.readouterr().out
    text = RADII.replace(".5", "-.5").replace(" 4 5 6", " 4 5e99 ***")
    assert len(scene(tmp_path, "a.dump", text, "--drop-invalid")) == 0
    assert "dropped    2 spheres" in capsys.readouterr().out
    same(scene(tmp_path, "a.dump", RADII, "--drop-invalid"), scene(tmp_path, "a.dump", RADII))
    assert "dropped" not in capsys.readouterr().out


def test_files_are_frames_in_the_order_of_their_numbers(tmp_path, capsys):
    names = ["dump9.xyz", "dump10.xyz", "dump100.xyz"]
    for k, name in enumerate(names):
        (tmp_path / name).write_text(f"{k + 1}\nc\n" + f"C {k} 0 0\n" * (k + 1))
    files = [str(tmp_path / name) for name in sorted(names)]
    assert main([*files, "--all-frames", str(tmp_path / "frames")]) == 0
    found = [np.load(tmp_path / "frames" / f"frame_0000{k}.npy") for k in range(3)]
    assert [(len(frame), frame[0, 0]) for frame in found] == [(1, 0), (2, 1), (3, 2)]
    said = capsys.readouterr().out
    assert "3 frames written, 1 to 3 spheres" in said
    assert "sizes      2 spheres in frames 1 to 1" in said
    assert main([*files, "--list"]) == 0
    said = [line.partition(", ")[2] for line in capsys.readouterr().out.splitlines()]
    assert said == [f"frame {k}: {k + 1} atoms" for k in range(3)]


def test_standard_input(tmp_path):
    command = [sys.executable, "-m", "octocell_import", "-", "--format", "xyz", "-o", "out.npy"]
    for content in (XYZ.encode(), gzip.compress(XYZ.encode())):
        subprocess.run(command, input=content, cwd=tmp_path, check=True, env=ENVIRONMENT)
        assert len(np.load(tmp_path / "out.npy")) == 2
    done = subprocess.run(command[:-2], input=content, cwd=tmp_path, env=ENVIRONMENT)
    assert done.returncode == 2  # for want of an output's name


def test_only_what_is_needed_is_loaded(tmp_path):
    (tmp_path / "a.pdb").write_text(atom(1))
    code = "import sys; from octocell_import.cli import main; main(['a.pdb']); print(*sys.modules)"
    command = [sys.executable, "-c", code]
    loaded = set(subprocess.check_output(command, cwd=tmp_path, env=ENVIRONMENT, text=True).split())
    assert "numpy" in loaded and "octocell_import.pdb" in loaded
    assert not loaded & {"MDAnalysis", "ase", "meshio", "pandas", "scipy", "octocell_import.mmcif"}
