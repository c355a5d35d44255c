# SPDX-License-Identifier: MIT
"""Input that is named when it cannot be read; output that is there whole or not at all."""

from __future__ import annotations

import gzip
import json
import os
import secrets
import shutil
import stat
import tempfile
import zlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

from octocell_report.fields import ReportError, naming, printable

_Parsed = TypeVar("_Parsed")
Bytes = bytes | memoryview
_DIRECT = ("/dev/fd/", "/dev/std", "/proc/")  # may name a file, but are an open end of it
_LONGEST_INTEGER = 400  # digits, of which all but the first few are of no use


def read_text(path: Path) -> str:
    """With the ends of lines as they are; a .gz is unpacked. Throws ReportError naming the file."""
    opens = gzip.open if path.suffix == ".gz" else open
    try:
        with opens(path, "rt", encoding="utf-8", newline="") as stream:
            return str(stream.read())
    except UnicodeDecodeError as error:
        raise ReportError(f"{path}: cannot be read: not UTF-8 text") from error
    except (gzip.BadGzipFile, zlib.error, EOFError) as error:
        raise ReportError(f"{path}: cannot be read: not a whole gzip file") from error
    except OSError as error:
        raise ReportError(f"{path}: cannot be read: {error.strerror}") from error


def read_json(path: Path, parse: Callable[[Any], _Parsed]) -> _Parsed:
    """What parse makes of the document, its texts printable; its errors name the file, too."""
    text = read_text(path)
    with naming(path):
        try:
            document = _printable(
                json.loads(text, parse_int=_integer, object_pairs_hook=_without_repeats)
            )
        except json.JSONDecodeError as error:
            raise ReportError(f"not JSON: {error}") from error
        except RecursionError as error:
            raise ReportError("not JSON: nested too deeply") from error
        return parse(document)


def _integer(digits: str) -> int:
    """Python refuses very long ones without a place; cut short, they are refused by their field."""
    return int(digits[:_LONGEST_INTEGER])


def _without_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) != len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ReportError(f"an object has the field '{twice}' twice")
    return found


def _printable(value: Any) -> Any:
    """The same with every text on one line, so that names can stand in any output."""
    if isinstance(value, str):
        return printable(value)
    if isinstance(value, list):
        return [_printable(item) for item in value]
    if isinstance(value, dict):
        return {printable(key): _printable(item) for key, item in value.items()}
    return value


def check_outputs(outputs: Iterable[Path], inputs: Iterable[Path] = ()) -> None:
    """Throws ReportError if one cannot be replaced, is an input too, or is another under two names.

    Files are compared, not spellings; devices and pipes may be given more than once.
    """
    met = {identity: f"the input {path}" for path in inputs if (identity := _identity(path))}
    for path in outputs:
        _replaceable(path)
        identity = _identity(path)
        if identity in met:
            raise ReportError(f"{path}: cannot be written: is the same file as {met[identity]}")
        if identity:
            met[identity] = f"the output {path}"


def _identity(path: Path) -> tuple[int, int, str] | None:
    """Of a file, even one that does not exist yet: by its folder; None if it is no regular file."""
    try:
        known = os.stat(path)
    except OSError:
        real = Path(os.path.realpath(path))
        for folder in real.parents:
            if folder.exists():
                known = folder.stat()
                return known.st_dev, known.st_ino, str(real.relative_to(folder))
        return None
    return (known.st_dev, known.st_ino, "") if stat.S_ISREG(known.st_mode) else None


def _replaceable(path: Path) -> os.stat_result | None:
    """What is known of the file that is there; None if there is none. Throws ReportError."""
    try:
        known = os.stat(path)
    except FileNotFoundError:
        return None
    except OSError as error:
        raise _unwritten(path, error) from error
    if stat.S_ISDIR(known.st_mode):
        raise ReportError(f"{path}: cannot be written: is a folder")
    # Who may do anything, may write what is read-only; but it is so for a reason.
    if stat.S_ISREG(known.st_mode) and not (known.st_mode & 0o222 and os.access(path, os.W_OK)):
        raise ReportError(f"{path}: cannot be written: is read-only")
    return known


def _unwritten(path: Path, error: OSError) -> ReportError:
    return ReportError(f"{path}: cannot be written: {error.strerror}")


def write_text(path: Path, text: str) -> None:
    write_whole(path, text.encode())


def write_json(path: Path, document: object) -> None:
    """Its folder is made if it is not there."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise _unwritten(path, error) from error
    write_text(path, json.dumps(document, indent=1) + "\n")


def write_whole(path: Path, *parts: Bytes) -> None:
    """Replaces a file in one step, or writes to a device. Throws ReportError; it is as it was.

    Permissions stay, and hold from the first byte on; a link goes on pointing to the file.
    """
    known = _replaceable(path)
    try:
        if str(path).startswith(_DIRECT) or (known and not stat.S_ISREG(known.st_mode)):
            with path.open("wb") as stream:
                stream.writelines(parts)
            return
        target = Path(os.path.realpath(path))
        part = target.with_name(f".octocell-{secrets.token_hex(8)}")
        mode = 0o600 if known else 0o666
        handle = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, mode)
        try:
            with os.fdopen(handle, "wb") as stream:
                stream.writelines(parts)
                if known:
                    _take_after(known, handle)
            os.replace(part, target)
        except BaseException:
            part.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise _unwritten(path, error) from error


def _take_after(known: os.stat_result, file: int | Path) -> None:
    """Owner and permissions; fewer for a group that cannot be kept."""
    mode = stat.S_IMODE(known.st_mode)
    try:
        os.chown(file, known.st_uid, known.st_gid)
    except OSError:
        if os.stat(file).st_gid != known.st_gid:
            mode &= ~0o070
    os.chmod(file, mode)


@contextmanager
def staged_folder(
    folder: Path, owned: Iterable[str], inputs: Iterable[Path] = ()
) -> Iterator[Path]:
    """A hidden folder to write into; on success its files replace the owned ones in `folder`.

    Owned names that were not written this time are removed, so that no old plot stays beside new
    ones; other files are left alone. On any error `folder` is as it was. No input is written to.
    """
    if folder.exists() and not folder.is_dir():
        raise ReportError(f"{folder}: is not a folder")
    owned, inputs = sorted(owned), list(inputs)
    check_outputs((folder / name for name in owned), inputs)
    made = [path for path in (folder, *folder.parents) if not path.exists()]
    staging, done = None, False
    try:
        folder.mkdir(parents=True, exist_ok=True)
        staging = Path(tempfile.mkdtemp(prefix=".octocell-", dir=folder))
        yield staging
        _publish(staging, folder, owned, inputs)
        done = True
    except OSError as error:
        raise _unwritten(folder, error) from error
    finally:
        if staging:
            shutil.rmtree(staging, ignore_errors=True)
        if made and not done:
            shutil.rmtree(made[-1], ignore_errors=True)


def _publish(staging: Path, folder: Path, owned: list[str], inputs: list[Path]) -> None:
    written = sorted(path.name for path in staging.iterdir())
    check_outputs((folder / name for name in written), inputs)
    # Links first: they may lead to another disk, which may be full.
    for name in sorted(written, key=lambda name: not (folder / name).is_symlink()):
        fresh, target = staging / name, folder / name
        if target.is_symlink() or (target.exists() and not target.is_file()):
            write_whole(target, fresh.read_bytes())
            continue
        known = _replaceable(target)
        if known:
            _take_after(known, fresh)
        os.replace(fresh, target)
    for name in set(owned) - set(written):
        (folder / name).unlink(missing_ok=True)
