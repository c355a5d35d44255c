#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Times octocell-import on a million atoms of each format, into docs/how_to/import_speed.json.

`make readme` writes the table of docs/how_to/import_files.md from that.

  scripts/time_import.py             # five minutes
"""

import json
import os
import platform
import re
import struct
import subprocess
import sys
import tempfile
from datetime import date
from importlib.metadata import version
from pathlib import Path

import numpy as np

# In a small process, for a child's peak is at least what its parent has.
WATCH = """
import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime + used.ru_stime, used.ru_maxrss << 10)
"""
ROOT = Path(__file__).resolve().parent.parent
OUTPUT = ROOT / "docs/how_to/import_speed.json"
COUNT = 1_000_000
RUNS = 3  # the least time counts, for other work slows them; and the highest peak
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
    "mmcif": lambda: "data_x\nloop_\n"
    + "".join(f"_atom_site.{tag}\n" for tag in CIF.split())
    + lines("ATOM {k} {e} {n} . ALA A 1 {r} ? {x} {y} {z} 1.00 20.00 {r} A 1\n"),
    "xyz": lambda: f"{COUNT}\nx\n" + lines("{e} {x} {y} {z}\n"),
    "gro": lambda: f"t\n{COUNT}\n"
    + lines("{r:5}ALA  {n:>5}{r:5}{x:8.3f}{y:8.3f}{z:8.3f}\n")
    + "1 1 1\n",
    "lammps-dump": lambda: ITEMS + lines("{k} 1 {x} {y} {z} 0.5 0.1 0.2 0.3\n"),
    "lammps-data": lambda: DATA + lines("{k} 1 1.0 2500 {x} {y} {z}\n"),
    "ply": lambda: PLY + lines("{x} {y} {z} 0.5\n"),
    "vtk": lambda: VTK + lines("{x} {y} {z}\n") + RADII,
    "swc": lambda: lines("{k} 1 {x} {y} {z} 0.5 -1\n"),
    "trr": lambda: TRR + XYZ.astype(">f4").tobytes(),
}


def main() -> int:
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name, content in FILES.items():
            path = Path(folder, name)
            made = content()
            path.write_bytes(made if isinstance(made, bytes) else made.encode())
            del made
            rows.append(row(name, path))
            print(rows[-1], flush=True)
            path.unlink()
    machine = {"cpu": cpu(), "cores": os.cpu_count(), "os": os_name()}
    versions = {"Python": platform.python_version(), "NumPy": version("numpy")}
    document = {"date": date.today().isoformat(), "machine": machine}
    document |= {"versions": versions | {"gemmi": version("gemmi")}, "atoms": COUNT, "rows": rows}
    OUTPUT.write_text(json.dumps(document, indent=1) + "\n")
    return 0


def row(name: str, path: Path) -> dict[str, object]:
    command = [sys.executable, "-m", "octocell_import", str(path), "--format", name]
    command += ["-o", f"{path}.npy", *["--radius", "1"] * (name == "trr")]
    environment = os.environ | {"PYTHONPATH": str(ROOT / "reports")}
    watched = [sys.executable, "-c", WATCH, *command]
    runs = [subprocess.check_output(watched, env=environment).split() for _ in range(RUNS)]
    seconds, peak = min(float(run[0]) for run in runs), max(int(run[1]) for run in runs)
    measured = {"cpu_seconds": round(seconds, 2), "peak_bytes": peak}
    return {"format": name, "file_bytes": path.stat().st_size} | measured


def cpu() -> str:
    found = re.search(r"^model name\s*: (.+)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return found[1] if found else platform.machine()


def os_name() -> str:
    return platform.freedesktop_os_release()["PRETTY_NAME"]


if __name__ == "__main__":
    sys.exit(main())
