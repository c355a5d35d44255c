# SPDX-License-Identifier: MIT
"""The command line. Exit code 0: written; 2: not, and one line says why."""

import argparse
import io
import re
from collections.abc import Iterator, Sequence
from itertools import chain, count, groupby
from pathlib import Path

import numpy as np

from octocell_import import InputError, __version__
from octocell_import.decimals import Floats
from octocell_import.formats import FORMATS, format_of, frames, unpacked
from octocell_import.frame import EXPONENTS, Frame
from octocell_import.scene import CHOICES, Converter
from octocell_report.console import Parser, run, say
from octocell_report.files import check_outputs, staged_folder, write_whole

_FRAME_NAME = re.compile(r"frame_\d{5,}\.npy")
_Found = Iterator[tuple[int, Path, Frame]]  # a frame, its number and its file


def main(arguments: Sequence[str] | None = None) -> int:
    return run("octocell-import", lambda: _command(_parser().parse_args(arguments)))


def _parser() -> Parser:
    about = "Turns atoms, particles or points into a scene of spheres, NPY (N, 4) float32."
    parser = Parser(prog="octocell-import", description=about)
    add = parser.add_argument
    add("--version", action="version", version=f"%(prog)s {__version__}")
    add("inputs", type=Path, nargs="+", metavar="FILE", help="- is standard input")
    add("-o", "--output", type=Path, metavar="SCENE.npy", help="default: FILE's name with .npy")
    add("--format", choices=FORMATS, help="default: by the suffix")
    about = "one for all; or for an element (Fe) or a name or type as in the file (MW, 3)"
    add("--radius", action="append", default=[], metavar="R | NAME=R", help=about)
    about = "default: the file's own if it has them, else by element"
    add("--radii", choices=("file", "element"), help=about)
    about = "what to write and what --radius is in; default angstrom"
    add("--length-unit", choices=EXPONENTS, help=about)
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--frame", type=int, default=0, metavar="K", help="from 0; default 0")
    which.add_argument("--model", metavar="N", help="the frame with this number in the file")
    about = "write frame_00000.npy and so on"
    which.add_argument("--all-frames", type=Path, metavar="FOLDER", help=about)
    about = "write nothing, but say how many atoms each frame has"
    which.add_argument("--list", action="store_true", help=about)
    for name in CHOICES:
        more = ", or numbers: 7,10-20" * (name == "residue")
        add(f"--{name}", metavar="NAME,NAME", help=f"keep atoms with one of these{more}")
    add("--drop-invalid", action="store_true", help="leave out what is no sphere, and say which")
    about = "take names and radii from its first frame"
    add("--topology", type=Path, metavar="FILE", help=about)
    about = "of a LAMMPS data file: its name, or its columns' names in quotes"
    add("--atom-style", metavar="STYLE", help=about)
    return parser


def _command(options: argparse.Namespace) -> int:
    found, converter = _frames(options), Converter(options)
    if options.topology is not None:
        name = format_of(options.topology)
        converter.take_names(options.topology, next(frames(options.topology, name)))
    if options.list:
        lines = [f"{path}, {_which(k, frame)}: {len(frame)} atoms" for k, path, frame in found]
    elif options.all_frames is not None:
        lines = _write_all(options, found, converter)
    else:
        lines = _write_one(options, found, converter)
    say(*lines)
    return 0


def _frames(options: argparse.Namespace) -> _Found:
    """All frames of all files, which are taken in the order of the numbers in their names."""
    style = {} if options.atom_style is None else {"atom_style": options.atom_style}
    number = count()
    for path in sorted(options.inputs, key=_natural):
        name = options.format or format_of(path)
        if style and name != "lammps-data":
            raise InputError(f"{path}: --atom-style is for LAMMPS data files, this is {name}")
        yield from ((next(number), path, frame) for frame in frames(path, name, **style))


def _natural(path: Path) -> list[tuple[str, int]]:
    """Digits count by their value: dump.9 goes before dump.10."""
    return [(text, int(digits or -1)) for text, digits in re.findall(r"(\D*)(\d{0,99})", str(path))]


def _which(number: int, frame: Frame) -> str:
    return f"frame {number}" + f" (model {frame.model})" * bool(frame.model)


def _write_one(options: argparse.Namespace, found: _Found, converter: Converter) -> list[str]:
    if options.frame < 0:
        raise InputError(f"--frame {options.frame}: frames are counted from 0")
    number = -1
    for item in found:
        number, path, frame = item
        if frame.model == options.model if options.model else number == options.frame:
            break
    else:
        asked = f"model {options.model}" if options.model else f"frame {options.frame}"
        raise InputError(f"{_names(options)}: no {asked}: it has {number + 1}, counted from 0")
    more = next(found, None) is not None  # a wrong number of atoms shows only there
    if options.output is None and str(path) == "-":
        raise InputError("-: say with --output where to write")
    target = options.output or unpacked(path).with_suffix(".npy")
    if target.suffix.lower() != ".npy":
        raise InputError(f"{target}: the output's name has to end in .npy")
    check_outputs([target], _inputs(options))
    scene, about = converter.spheres(path, frame)
    converter.check_names(path)
    _write(target, scene)
    alone = "the only one" if number == 0 else "the last one"
    title = f"{path}, {options.format or format_of(path)}, {_which(number, frame)}"
    lines = [f"read       {title}, {'more follow' if more else alone}", *about]
    return [f"{target}: {len(scene)} spheres written", *_indented(lines)]


def _write_all(options: argparse.Namespace, found: _Found, converter: Converter) -> list[str]:
    folder: Path = options.all_frames
    if options.output is not None:
        raise InputError("--output names one scene, --all-frames a folder: give one of them")
    first = next(found, None)  # before the folder is made
    if first is None:
        raise InputError(f"{_names(options)}: no frames")
    old = {p.name for p in folder.glob("frame_*.npy") if _FRAME_NAME.fullmatch(p.name)}
    sizes: list[int] = []
    said: list[str] = []
    with staged_folder(folder, old, _inputs(options)) as staging:
        for number, path, frame in chain([first], found):
            scene, about = converter.spheres(path, frame)
            _write(staging / f"frame_{number:05d}.npy", scene)
            said = said or about
            sizes.append(len(scene))
        converter.check_names(path)
    runs, start = [], 0
    for size, same in groupby(sizes):
        end = start + len(list(same))
        runs.append(f"{size} spheres in frames {start} to {end - 1}")
        start = end
    each = f"{sizes[0]} spheres each" if len(runs) == 1 else f"{min(sizes)} to {max(sizes)} spheres"
    title = f"read       {_names(options)}; of frame 0:"
    lines = [title, *said, *(f"sizes      {run}" for run in runs if len(runs) > 1)]
    return [f"{folder}: {len(sizes)} frames written, {each}", *_indented(lines)]


def _names(options: argparse.Namespace) -> str:
    return ", ".join(map(str, options.inputs))


def _indented(lines: list[str]) -> list[str]:
    return [f"  {line}" for line in lines]


def _inputs(options: argparse.Namespace) -> list[Path]:
    return [path for path in (*options.inputs, options.topology) if path not in (None, Path("-"))]


def _write(path: Path, scene: Floats) -> None:
    """Little-endian float32, (N, 4), there whole or not at all. Throws ReportError."""
    content = io.BytesIO()
    np.save(content, np.ascontiguousarray(scene, "<f4"))
    write_whole(path, content.getbuffer())
