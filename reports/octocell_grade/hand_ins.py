# SPDX-License-Identifier: MIT
"""The hand-ins of a folder: files, folders and archives."""

from __future__ import annotations

import hashlib
import shutil
import tarfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from octocell_report.fields import ReportError

LANGUAGES = {".cpp": "C++", ".cu": "CUDA", ".py": "Python", ".so": "library"}
ARCHIVES = (".zip", ".tar", ".tar.gz", ".tgz", ".tar.xz")
MOST_BYTES = 200 << 20  # of an unpacked archive


class NoHandIn(Exception):
    """Why there is nothing to try."""


@dataclass(frozen=True)
class HandIn:
    name: str
    path: Path

    def digest(self) -> str:
        """Changes if any byte of it does."""
        found = hashlib.sha256()
        files = [self.path] if self.path.is_file() else sorted(self.path.rglob("*"))
        for file in files:
            if file.is_file():
                found.update(f"{file.relative_to(self.path.parent)}\0".encode())
                found.update(file.read_bytes() + b"\0")
        return found.hexdigest()

    @contextmanager
    def unpacked(self) -> Iterator[Path]:
        """Its file or folder. Throws NoHandIn for an archive that cannot be unpacked."""
        if not self.path.name.endswith(ARCHIVES):
            yield self.path
            return
        with TemporaryDirectory(prefix="octocell-grade-") as folder:
            _unpack(self.path, Path(folder))
            yield Path(folder)


def hand_ins_of(folder: Path) -> list[HandIn]:
    """One for each entry that can be one, by name. Throws ReportError if there is none."""
    if not folder.is_dir():
        raise ReportError(f"{folder}: no such folder")
    found = [
        HandIn(path.name, path)
        for path in sorted(folder.iterdir())
        if not path.name.startswith(".")
        and (path.is_dir() or path.name.endswith((*LANGUAGES, *ARCHIVES)))
    ]
    if not found:
        raise ReportError(f"{folder}: holds no hand-ins ({', '.join((*LANGUAGES, *ARCHIVES))})")
    return found


def program_of(place: Path) -> Path:
    """The one file with a program. Throws NoHandIn if there is none, or are several."""
    if place.is_file():
        return place
    files = [
        path
        for path in sorted(place.rglob("*"))
        if path.suffix in LANGUAGES and path.is_file() and not path.name.startswith(".")
    ]
    named = [path for path in files if path.stem in ("find_pairs", "mine", "main")]
    chosen = named or files
    if len(chosen) != 1:
        names = ", ".join(path.name for path in chosen[:4]) or "none"
        raise NoHandIn(f"expected one program, or one named find_pairs; found {names}")
    return chosen[0]


def has_report(place: Path, names: tuple[str, ...]) -> bool:
    return place.is_dir() and any(
        path.name.lower() in names and path.stat().st_size > 0 for path in place.rglob("*.*")
    )


def _unpack(archive: Path, folder: Path) -> None:
    try:
        if _unpacked_bytes(archive) > MOST_BYTES:
            raise NoHandIn(f"unpacked, it has more than {MOST_BYTES >> 20} MiB")
        if zipfile.is_zipfile(archive):
            shutil.unpack_archive(archive, folder, "zip")
        else:
            shutil.unpack_archive(archive, folder, filter="data")
    except (OSError, EOFError, shutil.ReadError, tarfile.TarError, zipfile.BadZipFile) as error:
        raise NoHandIn(f"cannot be unpacked: {error}") from error


def _unpacked_bytes(archive: Path) -> int:
    if zipfile.is_zipfile(archive):
        with zipfile.ZipFile(archive) as file:
            return sum(entry.file_size for entry in file.infolist())
    with tarfile.open(archive) as tar:
        return sum(entry.size for entry in tar)
