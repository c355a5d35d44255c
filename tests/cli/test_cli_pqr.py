# SPDX-License-Identifier: MIT
"""PQR by words, in any case, one model at a time; a misspelt record is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from program import Octocell, Refused
from scene_input import read

THREE = np.array([[0, 0, 0, 1.5], [1, 2, 3, 1.75], [-4, 5, -6, 1.25]], np.float32)
ATOMS = [
    "ATOM      1  N   GLY A   1       0.000   0.000   0.000  0.1 1.50",
    "ATOM      2  CA  GLY A   1       1.000   2.000   3.000 -0.2 1.75",
    "HETATM    3  O   HOH A   2      -4.000   5.000  -6.000  0.3 1.25",
]
TEXT = "\n".join(ATOMS) + "\n"
MODELS = f"MODEL 1\n{ATOMS[0]}\n{ATOMS[1]}\nENDMDL\nMODEL 2\n{ATOMS[2]}\nENDMDL\nEND\n"

READ = {  # (text, options, spheres)
    "plain": (TEXT, (), THREE),
    "mark": ("\ufeff" + TEXT, (), THREE),
    "crlf": (TEXT.replace("\n", "\r\n"), (), THREE),
    "indented": (TEXT.replace("ATOM", "  ATOM", 1).replace("HETATM", " HETATM"), (), THREE),
    "lower": (TEXT.lower(), (), THREE),
    "mixed": (TEXT.replace("HETATM", "HetAtm"), (), THREE),
    "tabs": ("\t".join(TEXT.split(" ")), (), THREE),
    "no_chain": (TEXT.replace(" A ", " "), (), THREE),
    "chain_and_number": (TEXT.replace("A   1 ", "A1000 "), (), THREE),
    "serial": (TEXT.replace("HETATM    3", "HETATM10003"), (), THREE),
    "serial_no_chain": (
        TEXT.replace("HETATM    3", "HETATM10003").replace("HOH A", "HOH"),
        (),
        THREE,
    ),
    "serial_of_atom": (TEXT.replace("ATOM      1", "ATOM100001"), (), THREE),
    "records": (
        "REMARK   1 x\nREMARK1\n# made up\nCRYST1 1 1 1\n" + TEXT + "TER\nCONECT 1 2\nEND\n",
        (),
        THREE,
    ),
    "one_model": ("MODEL 1\n" + TEXT + "ENDMDL\nEND\n", (), THREE),
    "models": (MODELS, (), THREE[:2]),
    "second_model": (MODELS, ("--frame", "1"), THREE[2:]),
    "models_without_end": (MODELS.replace("ENDMDL\n", ""), (), THREE[:2]),
    "after_end": (f"{ATOMS[0]}\n{ATOMS[1]}\nEND\n{ATOMS[2]}\n", (), THREE[:2]),
    "after_end_second": (f"{ATOMS[0]}\nEND\n{ATOMS[2]}\n", ("--frame", "1"), THREE[2:]),
    "lower_models": (MODELS.lower(), (), THREE[:2]),
    "empty_model": ("MODEL 1\nENDMDL\nMODEL 2\n" + TEXT, (), THREE[:0]),
    "after_an_empty_model": ("MODEL 1\nENDMDL\nMODEL 2\n" + TEXT, ("--frame", "1"), THREE),
}


@pytest.mark.parametrize("name", READ)
def test_pqr_is_read(octocell: Octocell, tmp_path: Path, name: str) -> None:
    text, options, expected = READ[name]
    (tmp_path / "a.pqr").write_text(text, encoding="utf-8", newline="")
    spheres, said = read(octocell, tmp_path / "a.pqr", *options)
    np.testing.assert_array_equal(spheres, expected)
    has_models = not np.array_equal(expected, THREE) or "empty" in name
    assert ("of 2" in said) == has_models, said


REFUSED = {
    "misspelt": (TEXT.replace("ATOM", "ATAM", 1), [":1:", "'ATAM' is no record of PQR"]),
    "atoms": (TEXT.replace("ATOM ", "ATOMS", 1), [":1:", "'ATOMS'"]),
    "endroot": (TEXT + "ENDROOT\n", [":4:", "'ENDROOT'"]),
    "coordinates_together": (
        "REMARK\nATOM 5346 O ASN A 664 -34.085 -67.825-100.826 -0.5819 1.6612\n",
        [":2:", "'-67.825-100.826' is not a number"],
    ),
    "no_chain_together": (
        "ATOM 5346 O ASN 664 -34.085 -67.825-100.826 -0.58 1.66\n",
        [":1:", "9 fields"],
    ),
    "charge_together": (
        "ATOM 5346 O ASN 664 -34.085 -67.825 100.826-0.58 1.66\n",
        [":1:", "9 fields"],
    ),
    "pdb": ("ATOM 5 O ASN A 6 -34.085 -67.825-100.826 1.00 69.31 O\n", [":1:", "is not a number"]),
    "pdb_apart": ("ATOM 5 O ASN A 6 -34.085 -67.825 100.826 1.00 69.31 O\n", [":1:", "12 fields"]),
    "charge": (TEXT.replace("-0.2", "none"), [":2:", "'none'"]),
    "bad_second_model": (MODELS.replace("1.25", "-1"), [":6:", "r is -1"]),
}


@pytest.mark.parametrize("name", REFUSED)
def test_pqr_is_refused(refused: Refused, tmp_path: Path, name: str) -> None:
    text, words = REFUSED[name]
    (tmp_path / "bad.pqr").write_text(text, encoding="utf-8")
    line = refused("find", "bad.pqr")
    assert all(word in line for word in ["bad.pqr", *words]), line


def test_a_frame_that_is_not_there(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "a.pqr").write_text(MODELS, encoding="utf-8")
    assert "no frame 2: it has 2" in refused("find", "a.pqr", "--frame", "2")
    assert "--frame does not go with format table" in refused(
        "find", "a.pqr", "--format", "table", "--frame", "1"
    )
    assert "--radius does not go with format pqr" in refused("find", "a.pqr", "--radius", "1")
