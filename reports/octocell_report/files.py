# SPDX-License-Identifier: MIT
"""Output that is there whole or not at all."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from octocell_report.fields import ReportError


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
