# SPDX-License-Identifier: MIT
"""Input that is named when it cannot be read; output that is there whole or not at all."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

from octocell_report.fields import ReportError, naming

_Parsed = TypeVar("_Parsed")


def read_text(path: Path) -> str:
    """With the ends of lines as they are. Throws ReportError naming the file."""
    try:
        with path.open(encoding="utf-8", newline="") as stream:
            return stream.read()
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "not UTF-8 text"
        raise ReportError(f"{path}: cannot be read: {why}") from error


def read_json(path: Path, parse: Callable[[Any], _Parsed]) -> _Parsed:
    """What parse makes of the document; its errors name the file, too."""
    text = read_text(path)
    with naming(path):
        try:
            document = json.loads(text)
        except (json.JSONDecodeError, RecursionError) as error:
            raise ReportError(f"not JSON: {error}") from error
        return parse(document)


@contextmanager
def staged_folder(folder: Path, owned: set[str]) -> Iterator[Path]:
    """A hidden folder to write into; on success its files replace the owned ones in `folder`.

    Owned names that were not written anew are removed, so that no old plot stays beside new ones;
    other files are left alone. On any error `folder` is as it was.
    """
    if folder.exists() and not folder.is_dir():
        raise ReportError(f"{folder}: is not a folder")
    fresh = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        staging = Path(tempfile.mkdtemp(prefix=".octocell-", dir=folder))
    except OSError as error:
        raise ReportError(f"{folder}: cannot be written: {error.strerror}") from error
    done = False
    try:
        yield staging
        for path in sorted(staging.iterdir()):
            os.replace(path, folder / path.name)
            owned = owned - {path.name}
        for name in owned:
            (folder / name).unlink(missing_ok=True)
        done = True
    except OSError as error:
        raise ReportError(f"{folder}: cannot be written: {error.strerror}") from error
    finally:
        shutil.rmtree(staging, ignore_errors=True)
        if fresh and not done:
            shutil.rmtree(folder, ignore_errors=True)


def replace_text(path: Path, text: str) -> None:
    """Replaces a file in one step; its permissions stay, and a link goes on pointing to it."""
    target = path.resolve()
    try:
        handle, name = tempfile.mkstemp(prefix=".octocell-", dir=target.parent)
        try:
            with os.fdopen(handle, "w", encoding="utf-8", newline="") as stream:
                stream.write(text)
            shutil.copymode(target, name)
            os.replace(name, target)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise ReportError(f"{path}: cannot be written: {error.strerror}") from error
