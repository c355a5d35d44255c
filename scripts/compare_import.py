#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads real files with octocell-import and with a second, independent reader, and compares.

The files are those with a known suffix in packages that ship many: they are downloaded and unpacked
into a folder, and never committed, for some are under the GPL. The second readers are no part of
`make setup`: pip install ase MDAnalysis meshio plyfile gemmi biopython

  scripts/compare_import.py /tmp/real            # 600 MB, some minutes

It prints what is not equal, and writes how often into docs/how_to/import_compared.json, of which
`make readme` makes a table. Look at the refusals; the exit code is 1 if a file is misread.
"""

import contextlib
import io
import json
import re
import signal
import subprocess
import sys
import tarfile
import tempfile
import warnings
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from datetime import date
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "reports"))

from octocell_import.cli import main as import_file  # noqa: E402
from octocell_import.formats import FORMATS, format_of  # noqa: E402

PYPI = (
    "MDAnalysisTests==2.11.0 biopython==1.88 parmed==4.3.1 ase==3.29.0 gemmi==0.7.5 meshio==5.3.5"
    " trimesh==5.2.0 navis==1.12.0 packing3d==0.1.7"
).split()
DEBIAN = "lammps-examples apbs-data pymol-data assimp-testmodels".split()
OUTPUT = ROOT / "docs/how_to/import_compared.json"
SECONDS = 60  # for one file
Positions = NDArray[np.floating]


def main() -> int:
    folder = Path(sys.argv[1])
    fetch(folder)
    found: dict[str, list[str]] = defaultdict(list)
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        name = known_format(path)
        if name:
            verdict, detail = compare(path, name)
            counts[name][verdict] += 1
            found[verdict].append(f"{name:12} {path.relative_to(folder)}: {detail}")
    for verdict in sorted(found):
        print(f"## {verdict}")
        print(*found[verdict] if verdict != "equal" else [], sep="\n")
    for name in sorted(counts):
        print(f"{name:12}", ", ".join(f"{n} {v}" for v, n in sorted(counts[name].items())))
    document = {"date": date.today().isoformat(), "packages": PYPI + DEBIAN, "files": counts}
    OUTPUT.write_text(json.dumps(document, indent=1, sort_keys=True) + "\n")
    return 1 if found["misread"] else 0


def fetch(folder: Path) -> None:
    """Downloads and unpacks what is not there yet."""
    for package in PYPI:
        target = folder / package.partition("==")[0]
        if not target.exists():
            with tempfile.TemporaryDirectory() as downloads:
                command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps"]
                command += ["--dest", downloads, "--no-binary", ":all:", package]
                subprocess.run(command, check=True)
                with tarfile.open(next(Path(downloads).iterdir())) as archive:
                    archive.extractall(target, filter="data")
    for package in DEBIAN:
        target = folder / package
        if not target.exists():
            with tempfile.TemporaryDirectory() as downloads:
                subprocess.run(["apt-get", "download", package], cwd=downloads, check=True)
                archive = next(Path(downloads).iterdir())
                subprocess.run(["dpkg", "-x", str(archive), str(target)], check=True)


def known_format(path: Path) -> str:
    """LAMMPS' own examples call their data files data.NAME."""
    if re.match(r"data\.\w", path.name) and not path.name.endswith((".py", ".png")):
        return "lammps-data"
    with contextlib.suppress(Exception):
        return format_of(path).replace("table", "").replace("npy", "")  # most .txt are no tables
    return ""


def compare(path: Path, name: str) -> tuple[str, str]:
    """A file is read equally if one of the other readers agrees: each has its own mistakes."""
    ours, said = read_ours(path, name)
    others, why = read_theirs(path, name)
    if ours is None:
        return ("refused, read by others" if others else "refused by all"), said
    if not others:
        return "read by us alone", why
    differences = [difference(ours, theirs) for theirs in others]
    return ("equal", "") if "" in differences else ("misread", "; ".join(differences))


def difference(ours: Positions, theirs: Positions) -> str:
    near = {"rtol": 1e-5, "atol": 2e-4}  # most readers have float32 or three decimals
    if len(ours) != len(theirs):
        return f"{len(ours)} atoms, the other has {len(theirs)}"
    in_order = [a[np.lexsort(np.round(a, 2).T)] for a in (ours, theirs)]  # gemmi groups residues
    if np.allclose(ours, theirs, **near) or np.allclose(*in_order, **near):
        return ""
    first = int(np.argmax(~np.isclose(ours, theirs, **near).all(axis=1)))
    return f"atom {first + 1} is {ours[first]}, the other has {theirs[first]}"


def read_ours(path: Path, name: str) -> tuple[Positions | None, str]:
    """The command itself, in this process; every atom gets radius 1."""
    out, err = io.StringIO(), io.StringIO()
    with tempfile.TemporaryDirectory() as folder:
        scene = f"{folder}/scene.npy"
        with limited(), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = import_file([str(path), "--format", name, "--radius", "1", "-o", scene])
        if code:
            return None, err.getvalue().strip().replace(f"{path}: ", "")
        return np.load(scene)[:, :3], ""


def read_theirs(path: Path, name: str) -> tuple[list[Positions], str]:
    others, why = [], []
    for reader in SECOND_READERS[name]:
        try:
            sink = io.StringIO()
            with warnings.catch_warnings(), limited():
                warnings.simplefilter("ignore")
                with contextlib.redirect_stdout(sink), contextlib.redirect_stderr(sink):
                    found = np.asarray(reader(str(path)), float).reshape(-1, 3)
            if len(found):
                others.append(found)
        except (Exception, SystemExit) as error:
            why.append(f"{reader.__name__}: {type(error).__name__}: {str(error)[:100]}")
    return others, "; ".join(why).replace("\n", " ")


@contextlib.contextmanager
def limited() -> Iterator[None]:
    def stop(*_: object) -> None:
        raise TimeoutError(f"more than {SECONDS} s")

    signal.signal(signal.SIGALRM, stop)
    signal.alarm(SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)


def mdanalysis(kind: str) -> Callable[[str], Positions]:
    def mdanalysis(path: str) -> Positions:
        import MDAnalysis

        own = "PDBQT" if ".pdbqt" in path else kind  # its PDB ends at ENDROOT
        return MDAnalysis.Universe(path, format=own, topology_format=own).atoms.positions

    return mdanalysis


def ase(kind: str) -> Callable[[str], Positions]:
    def ase(path: str) -> Positions:
        import ase.io

        options = {"read_image_flags": False} if kind == "lammps-data" else {}
        return ase.io.read(path, index=0, format=kind, **options).positions

    return ase


def ase_dump(path: str) -> Positions:
    """Scaled coordinates as ASE has them start at the box, wherever that is."""
    import ase.io

    atoms = ase.io.read(path, index=0, format="lammps-dump-text")
    return atoms.positions + atoms.get_celldisp().T


def numpy_named_columns(path: str) -> Positions:
    """LAMMPS data whose columns are named behind the style; the other readers guess them."""
    words = r"(\d+) atoms\n.*^Atoms # \w+:([^\n]*)\n(.*)"
    count, names, rows = re.search(words, Path(path).read_text(), re.S | re.M).groups()
    found = np.loadtxt(io.StringIO(rows), max_rows=int(count), ndmin=2)
    columns = dict(zip(names.split(), found[np.argsort(found[:, 0])].T, strict=True))
    return np.array([columns[name] for name in "xyz"]).T


def gemmi_pdb(path: str) -> Positions:
    import gemmi

    structure = gemmi.read_structure(path)
    del structure[1:]
    return gemmi.FlatStructure(structure).pos


def biopython_mmcif(path: str) -> Positions:
    from Bio.PDB.MMCIF2Dict import MMCIF2Dict

    columns = MMCIF2Dict(open_text(path))
    xyz = np.array([columns[f"_atom_site.Cartn_{name}"] for name in "xyz"], float).T
    models = np.array(columns.get("_atom_site.pdbx_PDB_model_num", ["1"] * len(xyz)))
    return xyz[models == models[0]]


def open_text(path: str) -> io.TextIOBase:
    import bz2
    import gzip

    opener = {".gz": gzip.open, ".bz2": bz2.open}.get(Path(path).suffix, open)
    return io.StringIO(opener(path, "rt", encoding="utf-8").read())


def plyfile_ply(path: str) -> Positions:
    from plyfile import PlyData

    vertices = PlyData.read(path)["vertex"]
    return np.array([vertices[name] for name in "xyz"], float).T


def meshio_any(path: str) -> Positions:
    import meshio

    return meshio.read(path).points


def points_of_text_vtk(path: str) -> Positions:
    text = Path(path).read_text()
    count, numbers = re.search(r"POINTS (\d+) \w+\s([-+.\deE\s]+)", text).groups()
    return np.array(numbers.split()[: 3 * int(count)], float)


def numpy_swc(path: str) -> Positions:
    return np.loadtxt(path, usecols=(2, 3, 4), ndmin=2)


def mdanalysis_trr(path: str) -> Positions:
    from MDAnalysis.lib.formats.libmdaxdr import TRRFile

    with TRRFile(path) as file:
        return next(iter(file)).x.astype(float) * 10


SECOND_READERS = {
    "pqr": [mdanalysis("PQR")],
    "gro": [mdanalysis("GRO"), ase("gromacs")],
    "lammps-data": [mdanalysis("DATA"), ase("lammps-data"), numpy_named_columns],
    "lammps-dump": [ase("lammps-dump-text"), ase_dump],
    "mmcif": [biopython_mmcif, gemmi_pdb],
    "pdb": [mdanalysis("PDB"), gemmi_pdb, ase("proteindatabank")],
    "ply": [plyfile_ply, meshio_any],
    "swc": [numpy_swc],
    "trr": [mdanalysis_trr],
    "vtk": [meshio_any, points_of_text_vtk],
    "xyz": [ase("extxyz"), mdanalysis("XYZ"), ase("xyz")],
}
assert set(SECOND_READERS) == set(FORMATS) - {"npy", "table"}

if __name__ == "__main__":
    sys.exit(main())
