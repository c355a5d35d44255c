#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Times octocell-import on a million atoms of each format, and prints the table of the how-to."""

import os
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

# In a small process, for a child's peak is at least what its parent has.
WATCH = """
import resource, subprocess, sys, time
start = time.monotonic()
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
cpu, wall = used.ru_utime + used.ru_stime, time.monotonic() - start
print(f"{cpu:.1f} {wall:.1f} {used.ru_maxrss // 1024}")
"""
ROOT = Path(__file__).resolve().parent.parent
COUNT = 1_000_000
XYZ = np.random.default_rng(1).uniform(-400, 900, (COUNT, 3)).round(3)
NAMES = ("N", "CA", "C", "O", "CB")
CIF = "group_PDB id type_symbol label_atom_id label_alt_id label_comp_id label_asym_id entity_id"
CIF += (
    " label_seq_id pdbx_PDB_ins_code Cartn_x Cartn_y Cartn_z occupancy B_iso_or_equiv auth_seq_id"
)
CIF += " auth_asym_id pdbx_PDB_model_num"
ITEMS = f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{COUNT}\nITEM: BOX BOUNDS pp pp pp\n"
ITEMS += "-400 900\n" * 3 + "ITEM: ATOMS id type x y z radius vx vy vz\n"
DATA = f"title\n\n{COUNT} atoms\n1 atom types\n\nAtoms # sphere\n\n"
VERTEX = "property float x\nproperty float y\nproperty float z\nproperty float radius\nend_header\n"
PLY = f"ply\nformat ascii 1.0\nelement vertex {COUNT}\n{VERTEX}"
VTK = f"# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS {COUNT} float\n"
RADII = f"POINT_DATA {COUNT}\nSCALARS radius float 1\nLOOKUP_TABLE default\n" + "0.5\n" * COUNT
TRR = struct.pack(">3i12s", 1993, 13, 12, b"GMX_trn_file")
TRR += struct.pack(">13i11f", 0, 0, 36, 0, 0, 0, 0, 12 * COUNT, 0, 0, COUNT, 0, 0, *[0] * 11)


def lines(form: str, *columns: object) -> str:
    """One line an atom: k, name, x, y, z can be used in `form`."""
    return "".join(
        form.format(k=k, n=NAMES[k % 5], e=NAMES[k % 5][0], r=k // 5 % 9999, x=x, y=y, z=z)
        for k, (x, y, z) in enumerate(XYZ.tolist(), 1)
    )


FILES = {
    "pdb": lambda: lines(
        "ATOM  {r:5} {n:>3}  ALA A{r:4}    {x:8.3f}{y:8.3f}{z:8.3f}  1.00  0.00          {e:>2}\n"
    ),
    "cif": lambda: "data_x\nloop_\n"
    + "".join(f"_atom_site.{tag}\n" for tag in CIF.split())
    + lines("ATOM {k} {e} {n} . ALA A 1 {r} ? {x} {y} {z} 1.00 20.00 {r} A 1\n"),
    "xyz": lambda: f"{COUNT}\nx\n" + lines("{e} {x} {y} {z}\n"),
    "gro": lambda: f"t\n{COUNT}\n"
    + lines("{r:5}ALA  {n:>5}{r:5}{x:8.3f}{y:8.3f}{z:8.3f}\n")
    + "1 1 1\n",
    "dump": lambda: ITEMS + lines("{k} 1 {x} {y} {z} 0.5 0.1 0.2 0.3\n"),
    "data": lambda: DATA + lines("{k} 1 1.0 2500 {x} {y} {z}\n"),
    "ply": lambda: PLY + lines("{x} {y} {z} 0.5\n"),
    "vtk": lambda: VTK + lines("{x} {y} {z}\n") + RADII,
    "swc": lambda: lines("{k} 1 {x} {y} {z} 0.5 -1\n"),
    "trr": lambda: TRR + XYZ.astype(">f4").tobytes(),
}


def main() -> int:
    print("| suffix | MB | CPU seconds | seconds | peak MB |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for suffix in sys.argv[1:] or FILES:
            path = Path(folder, f"a.{suffix}")
            content = FILES[suffix]()
            path.write_bytes(content if isinstance(content, bytes) else content.encode())
            del content
            print(row(path), flush=True)
            path.unlink()
    return 0


def row(path: Path) -> str:
    command = [sys.executable, "-m", "octocell_import", str(path)]
    command += ["--radius", "1"] if path.suffix == ".trr" else []
    environment = os.environ | {"PYTHONPATH": str(ROOT / "reports")}
    watched = [sys.executable, "-c", WATCH, *command]
    cpu, wall, peak = subprocess.check_output(watched, env=environment, text=True).split()
    return f"| {path.suffix} | {path.stat().st_size / 1e6:.0f} | {cpu} | {wall} | {peak} |"


if __name__ == "__main__":
    sys.exit(main())
