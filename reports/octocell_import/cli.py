# SPDX-License-Identifier: MIT
"""The command line. Exit code 0: written; 2: not, and one line says why."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path

from octocell_import import __version__
from octocell_import.errors import InputError
from octocell_import.formats import FORMATS, frames, stem
from octocell_import.frame import Frame
from octocell_import.lammps_data import STYLES
from octocell_import.output import write_npy
from octocell_import.radii import given
from octocell_import.scene import POWERS, Options, Source, spheres
from octocell_report.console import Parser, run, say
from octocell_report.files import check_outputs, staged_folder

_FRAME_NAME = re.compile(r"frame_\d{5,}\.npy")


def main(arguments: Sequence[str] | None = None) -> int:
    return run("octocell-import", lambda: _command(arguments))


def _command(arguments: Sequence[str] | None) -> int:
    say(*_import(_parser().parse_args(arguments)))
    return 0


def _parser() -> Parser:
    parser = Parser(
        prog="octocell-import",
        description="Turns atoms, particles or points into a scene of spheres, NPY (N, 4) float32.",
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    parser.add_argument("input", type=Path, metavar="FILE", help="may end in .gz, .bz2 or .xz too")
    parser.add_argument(
        "-o", "--output", type=Path, metavar="SCENE.npy", help="default: FILE's name with .npy"
    )
    parser.add_argument("--format", choices=FORMATS, help="default: by the suffix")
    parser.add_argument(
        "--radius",
        action="append",
        default=[],
        metavar="R | NAME=R",
        help="one for all; or for an element (Fe) or a name or type as in the file (MW, 3)",
    )
    parser.add_argument(
        "--radii",
        choices=("file", "element"),
        help="default: the file's own if it has them, else by element",
    )
    parser.add_argument(
        "--length-unit",
        choices=POWERS,
        help="what to write and what --radius is in; default angstrom",
    )
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--frame", type=int, default=0, metavar="K", help="from 0; default 0")
    which.add_argument(
        "--all-frames", type=Path, metavar="FOLDER", help="write frame_00000.npy and so on"
    )
    parser.add_argument(
        "--topology", type=Path, metavar="FILE", help="take names and radii from its first frame"
    )
    parser.add_argument(
        "--atom-style",
        metavar="STYLE",
        help=f"of a LAMMPS data file: {', '.join(STYLES)}, or its columns' names in quotes",
    )
    return parser


def _import(options: argparse.Namespace) -> list[str]:
    """Does it, and returns what to say."""
    wanted = Options(options.length_unit, given(options.radius, options.radii))
    name, found = frames(options.input, options.format, options.atom_style)
    topology = _topology(options.topology)
    title = f"read       {options.input}, {name}"
    if options.all_frames is not None:
        return _all_frames(options, wanted, topology, found, title)
    target = options.output or options.input.with_name(stem(options.input) + ".npy")
    if target.suffix.lower() != ".npy":
        raise InputError(f"{target}: the output's name has to end in .npy")
    check_outputs([target], _inputs(options))
    frame, which = _one(found, options.frame, options.input)
    scene, about = spheres(Source(options.input, frame), topology, wanted)
    write_npy(target, scene)
    return [f"{target}: {len(scene)} spheres written", *_indented(f"{title}, {which}", *about)]


def _inputs(options: argparse.Namespace) -> list[Path]:
    return [path for path in (options.input, options.topology) if path is not None]


def _topology(path: Path | None) -> Source | None:
    if path is None:
        return None
    frame, _ = _one(frames(path, None, None)[1], 0, path)
    if not frame.labels and frame.radii is None:
        raise InputError(f"{path}: has neither names nor radii")
    return Source(path, frame)


def _one(found: Iterator[Frame], wanted: int, path: Path) -> tuple[Frame, str]:
    """The frame, and which one it is. The one after it is read too: a wrong number of atoms shows
    only there."""
    if wanted < 0:
        raise InputError(f"--frame {wanted}: frames are counted from 0")
    number = -1
    for number, frame in enumerate(found):
        if number == wanted:
            more = next(found, None) is not None
            alone = "the only one" if number == 0 else "the last one"
            return frame, f"frame {number}, {'more follow' if more else alone}"
    raise InputError(f"{path}: no frame {wanted}: it has {number + 1}, counted from 0")


def _all_frames(
    options: argparse.Namespace,
    wanted: Options,
    topology: Source | None,
    found: Iterator[Frame],
    title: str,
) -> list[str]:
    folder: Path = options.all_frames
    if options.output is not None:
        raise InputError("--output names one scene, --all-frames a folder: give one of them")
    first = next(found)  # before the folder is made; readers refuse files without frames
    old = {p.name for p in folder.glob("frame_*.npy") if _FRAME_NAME.fullmatch(p.name)}
    counts: list[int] = []
    said: list[str] = []
    with staged_folder(folder, old, _inputs(options)) as staging:
        for number, frame in enumerate(chain([first], found)):
            scene, about = spheres(Source(options.input, frame), topology, wanted)
            write_npy(staging / f"frame_{number:05d}.npy", scene)
            counts.append(len(scene))
            said = about if number == 0 else said
    sizes = f"{counts[0]} spheres each"
    if len(set(counts)) > 1:
        sizes = f"{min(counts)} to {max(counts)} spheres"
    return [
        f"{folder}: {len(counts)} frames written, {sizes}",
        *_indented(f"{title}; of frame 0:", *said),
    ]


def _indented(*lines: str) -> list[str]:
    return [f"  {line}" for line in lines]
