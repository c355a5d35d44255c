# SPDX-License-Identifier: MIT
"""The command line. Exit code 0: written; 2: not, and one line says why."""

import io
import re
from argparse import Namespace
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
    which = parser.add_mutually_exclusive_group()
    add, one = parser.add_argument, which.add_argument
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
    one("--frame", type=int, default=0, metavar="K", help="from 0; default 0")
    one("--model", metavar="N", help="the frame with this number in the file")
    one("--all-frames", type=Path, metavar="FOLDER", help="write frame_00000.npy and so on")
    one("--list", action="store_true", help="write nothing, say how many atoms each frame has")
    for name in CHOICES:
        more = ", or numbers: 7,10-20" * (name == "residue")
        add(f"--{name}", metavar="NAME,NAME", help=f"keep atoms with one of these{more}")
    add("--drop-invalid", action="store_true", help="leave out what is no sphere, and say which")
    add(
        "--topology", type=Path, metavar="FILE", help="names and radii are those of its first frame"
    )
    about = "of a LAMMPS data file: its name, or its columns' names in quotes"
    add("--atom-style", metavar="STYLE", help=about)
    return parser


def _command(options: Namespace) -> int:
    found, converter = _frames(options), Converter(options)
    if options.topology is not None:
        own = Namespace(**vars(options) | {"format": None, "atom_style": None})
        converter.take_names(options.topology, next(frames(options.topology, own)))
    if options.list:
        say(*(f"{path}, {_title(k, frame)}: {len(frame)} atoms" for k, path, frame in found))
    else:
        write = _write_one if options.all_frames is None else _write_all
        inputs = [path for path in (*options.inputs, options.topology) if path and str(path) != "-"]
        headline, *lines = write(options, inputs, found, converter)
        say(headline, *(f"  {line}" for line in lines))
    return 0


def _frames(options: Namespace) -> _Found:
    """All frames of all files, which are taken in the order of the numbers in their names."""
    number = count()
    for path in sorted(options.inputs, key=_natural):
        yield from ((next(number), path, frame) for frame in frames(path, options))


def _natural(path: Path) -> list[tuple[str, int]]:
    """Digits count by their value: dump.9 goes before dump.10."""
    return [(text, int(digits or -1)) for text, digits in re.findall(r"(\D*)(\d{0,99})", str(path))]


def _title(number: int, frame: Frame) -> str:
    return f"frame {number}" + f" (model {frame.model})" * bool(frame.model)


def _write_one(
    options: Namespace, inputs: list[Path], found: _Found, converter: Converter
) -> list[str]:
    if options.frame < 0:
        raise InputError(f"--frame {options.frame}: frames are counted from 0")
    number = -1
    for item in found:
        number, path, frame = item
        if frame.model == options.model if options.model else number == options.frame:
            break
    else:
        asked = f"model {options.model}" if options.model else f"frame {options.frame}"
        files = ", ".join(map(str, options.inputs))
        raise InputError(f"{files}: no {asked}: it has {number + 1}, counted from 0")
    alone = "the last one" if number else "the only one"
    more = "more follow" if next(found, None) else alone  # a wrong count shows only there
    if options.output is None and str(path) == "-":
        raise InputError("-: say with --output where to write")
    target = options.output or unpacked(path).with_suffix(".npy")
    if target.suffix.lower() != ".npy":
        raise InputError(f"{target}: the output's name has to end in .npy")
    check_outputs([target], inputs)
    scene, about = converter.spheres(path, frame)
    converter.check_names(path)
    _write(target, scene)
    title = f"{path}, {options.format or format_of(path)}, {_title(number, frame)}, {more}"
    return [f"{target}: {len(scene)} spheres written", f"read       {title}", *about]


def _write_all(
    options: Namespace, inputs: list[Path], found: _Found, converter: Converter
) -> list[str]:
    folder: Path = options.all_frames
    if options.output is not None:
        raise InputError("--output names one scene, --all-frames a folder: give one of them")
    first = next(found, None)  # before the folder is made
    files = ", ".join(map(str, options.inputs))
    if first is None:
        raise InputError(f"{files}: no frames")
    old = {p.name for p in folder.glob("frame_*.npy") if _FRAME_NAME.fullmatch(p.name)}
    sizes: list[int] = []
    said: list[str] = []
    with staged_folder(folder, old, inputs) as staging:
        for number, path, frame in chain([first], found):
            scene, about = converter.spheres(path, frame)
            _write(staging / f"frame_{number:05d}.npy", scene)
            said = said or about
            sizes.append(len(scene))
        converter.check_names(path)
    each = f"{sizes[0]} spheres each"
    lines = [f"read       {files}; of frame 0:", *said]
    if len(set(sizes)) > 1:
        each = f"{min(sizes)} to {max(sizes)} spheres"
        for size, same in groupby(range(len(sizes)), key=lambda k: sizes[k]):
            of_size = list(same)
            lines.append(f"sizes      {size} spheres in frames {of_size[0]} to {of_size[-1]}")
    return [f"{folder}: {len(sizes)} frames written, {each}", *lines]


def _write(path: Path, scene: Floats) -> None:
    """Little-endian float32, (N, 4), there whole or not at all. Throws ReportError."""
    content = io.BytesIO()
    np.save(content, np.ascontiguousarray(scene, "<f4"))
    write_whole(path, content.getbuffer())
