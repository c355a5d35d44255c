# SPDX-License-Identifier: MIT
"""One file, one answer: octocell's commands and octocell-import agree on each kind of odd file."""

from __future__ import annotations

import gzip
import json
from itertools import combinations
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from program import Octocell

from octocell_import.cli import main
from octocell_import.formats import FORMATS, OCTOCELL

COMMANDS = ("find", "check", "explain", "bench")
# Three spheres with two pairs; no two numbers of a sphere are alike.
ROWS = [[1.5, -2, 0.25, 0.5], [3, 1e-3, 7, 9], [-7, 4, 2, 3]]
TEXT = "1.5 -2 0.25 0.5\n3 1e-3 7 9\n-7 4 2 3\n"
CSV = TEXT.replace(" ", ",")
MARK = b"\xef\xbb\xbf"
ATOM = "ATOM {k} C{k} LIG A {k} {x} {y} {z} -0.5 {r}\n"
PQR = "".join(ATOM.format(k=k, x=x, y=y, z=z, r=r) for k, (x, y, z, r) in enumerate(ROWS, 1))
CHAINLESS = PQR.replace("LIG A", "LIG")

READ: dict[str, str | bytes] = {
    "mark.csv": MARK + CSV.encode(),
    "header.csv": "r,z,y,x\n" + "".join(f"{r},{z},{y},{x}\n" for x, y, z, r in ROWS),
    "pandas.csv": ",x,y,z,radius\n" + "".join(f"{k},{x}" for k, x in enumerate(CSV.splitlines(1))),
    "quoted.csv": '"x";"y";"z";"Radius"\n' + CSV.replace(",", ";"),
    "crlf.tsv": TEXT.replace(" ", "\t").replace("\n", "\r\n"),
    "plain.txt": TEXT,
    "yade.txt": "#format x_y_z_r\n" + TEXT.replace(" ", "\t"),
    "voro.txt": "".join(f"{k} {row}" for k, row in enumerate(TEXT.splitlines(keepends=True))),
    "packed.xyzr.gz": gzip.compress(TEXT.encode()),
    "no_end.dat": TEXT.rstrip(),
    "mark.pqr": MARK + PQR.encode(),
    "lower.pqr": PQR.lower(),
    "indented.pqr": "  " + PQR.replace("\nATOM", "\n\thetatm"),
    "no_chain.pqr": CHAINLESS,
    "glued_name.pqr": CHAINLESS.replace("ATOM 1", "ATOM1"),
    "models.pqr": "MODEL 1\n" + PQR + "ENDMDL\nMODEL 2\n" + PQR + "ENDMDL\n",
    "model_goes_on.pqr": "MODEL 1\n" + PQR + "MODEL 2\n" + PQR,
    "after_end.pqr": PQR + "END\n" + PQR,
}
REFUSED: dict[str, tuple[str | bytes, str]] = {
    "merged.pqr": (PQR.replace("1.5 -2", "1.5-2"), ":1: "),
    "misspelt.pqr": (PQR.replace("ATOM 2", "ATAM 2"), ":2: "),
    "short.pqr": (PQR.replace("LIG A 3", "LIG"), ":3: "),
    "radius.pqr": (PQR.replace("-0.5 9", "-0.5 -9"), ":2: "),
    "nan.csv": (CSV.replace("1.5", "nan"), ":1: x is nan"),
    "empty_field.csv": (CSV.replace("1e-3", ""), ":2: "),
    "unicode_minus.csv": (CSV.replace("-7", "\u22127"), ":3: "),
    "comma.csv": ("x;y;z;r\n" + TEXT.replace(" ", ";").replace(".", ","), "--decimal-comma"),
    "cr.csv": (CSV.replace("\n", "\r"), ":1: CR within a line"),
    "zero_byte.csv": (CSV.replace("4", "4\0"), ":3: "),
    "utf16.csv": (CSV.encode("utf-16"), ":1: text in UTF-16"),
    "two_headers.csv": ("x,y,z,r\nr,x,y,z\n" + CSV, ":2: a second header"),
    "no_radii.txt": ("1 2 3\n4 5 6\n", "--radius"),
    "no_npy.npy": ("x", "no_npy.npy: "),
    "cut.csv.gz": (gzip.compress(CSV.encode())[:-9], "cut.csv.gz"),
}


def write(path: Path, content: str | bytes) -> None:
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def imported(path: Path) -> npt.NDArray[np.float32]:
    scene = path.parent / "imported.npy"
    assert main([str(path), "-o", str(scene)]) == 0
    spheres: npt.NDArray[np.float32] = np.load(scene)
    return spheres


def overlaps(rows: list[list[float]]) -> int:
    return sum(
        sum((a - b) ** 2 for a, b in zip(p[:3], q[:3], strict=True)) <= (p[3] + q[3]) ** 2
        for p, q in combinations(rows, 2)
    )


def command_line(command: str, name: str, folder: Path) -> list[str]:
    quickly = [
        "--backend",
        "impl_cpu",
        "--rounds",
        "1",
        "--no-memory",
        "-o",
        f"{folder}/bench.json",
    ]
    return [command, name, *(quickly if command == "bench" else [])]


@pytest.mark.parametrize("name", READ)
def test_both_programs_read_the_same_spheres(octocell: Octocell, tmp_path: Path, name: str) -> None:
    write(tmp_path / name, READ[name])
    np.testing.assert_array_equal(imported(tmp_path / name), np.array(ROWS, np.float32))
    pairs, said = overlaps(ROWS), {}
    assert pairs == 2
    for command in COMMANDS:
        said[command] = octocell.ok(*command_line(command, name, tmp_path), cwd=tmp_path).stdout
    assert octocell.find(tmp_path / name)["pairs"] == pairs
    assert f"{name} (3 spheres, {pairs} pairs)" in said["check"] and ", 0 wrong" in said["check"]
    assert "3 spheres, radii 0.5 to 9" in said["explain"]
    (group,) = json.loads((tmp_path / "bench.json").read_text())["groups"]
    assert (group["n"], group["truth"]["pairs"]) == (3, pairs)


@pytest.mark.parametrize("name", REFUSED)
def test_both_programs_refuse_for_the_same_reason(
    octocell: Octocell, tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    content, why = REFUSED[name]
    write(tmp_path / name, content)
    assert main([str(tmp_path / name)]) == 2
    reason = capsys.readouterr().err.removeprefix("octocell-import: ")
    assert why in reason and str(tmp_path / name) in reason and reason.count("\n") == 1
    for command in COMMANDS:
        result = octocell.run(*command_line(command, str(tmp_path / name), tmp_path))
        assert (result.rc, result.stderr) == (2, f"octocell: {reason}"), command
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("suffix", [s[0] for k, s in FORMATS.items() if k not in OCTOCELL])
def test_each_command_names_the_importers(
    octocell: Octocell, tmp_path: Path, command: str, suffix: str
) -> None:
    write(tmp_path / f"a{suffix}", "any")
    result = octocell.run(*command_line(command, f"a{suffix}", tmp_path), cwd=tmp_path)
    assert result.rc == 2 and f"octocell-import a{suffix} -o a.npy" in result.stderr
