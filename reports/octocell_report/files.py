# SPDX-License-Identifier: MIT
"""Input that is named when it cannot be read; output that is there whole or not at all."""

import gzip
import json
import os
import secrets
import shutil
import stat
import tempfile
import zlib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

from octocell_report.fields import ReportError, naming, printable

_Parsed = TypeVar("_Parsed")
Bytes = bytes | memoryview
_DIRECT = ("/dev/fd/", "/dev/std", "/proc/")  # may name a file, but are an open end of it


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
            # Integers are cut short: Python refuses thousands of digits without naming the field.
            document = json.loads(
                text, parse_int=lambda digits: int(digits[:400]), object_pairs_hook=_object
            )
        except json.JSONDecodeError as error:
            raise ReportError(f"not JSON: {error}") from error
        except RecursionError as error:
            raise ReportError("not JSON: nested too deeply") from error
        return parse(document)


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Refuses repeated names. Texts get onto one line, so that they can stand in any output."""
    found = {printable(name): _printable(value) for name, value in pairs}
    if len(found) != len(pairs):
        twice, _ = Counter(printable(name) for name, _ in pairs).most_common(1)[0]
        raise ReportError(f"an object has the field '{twice}' twice")
    return found


def _printable(value: Any) -> Any:
    if isinstance(value, list):
        return [_printable(item) for item in value]
    return printable(value) if isinstance(value, str) else value


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


def _identity(path: Path) -> object:
    """What two names of one file share, even of one that does not exist; None if it is no file."""
    try:
        known = os.stat(path)
    except OSError:
        return os.path.realpath(path)
    return (known.st_dev, known.st_ino) if stat.S_ISREG(known.st_mode) else None


@contextmanager
def _writing(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise ReportError(f"{path}: cannot be written: {error.strerror}") from error


def _replaceable(path: Path) -> os.stat_result | None:
    """What is known of the file that is there; None if there is none. Throws ReportError."""
    with _writing(path):
        try:
            known = os.stat(path)
        except FileNotFoundError:
            return None
    if stat.S_ISDIR(known.st_mode):
        raise ReportError(f"{path}: cannot be written: is a folder")
    # The superuser may write to what is read-only; but it is so for a reason.
    if stat.S_ISREG(known.st_mode) and not (known.st_mode & 0o222 and os.access(path, os.W_OK)):
        raise ReportError(f"{path}: cannot be written: is read-only")
    return known


def write_text(path: Path, text: str) -> None:
    write_whole(path, text.encode())


def write_json(path: Path, document: object) -> None:
    """Its folder is made if it is not there."""
    with _writing(path):
        path.parent.mkdir(parents=True, exist_ok=True)
    write_text(path, json.dumps(document, indent=1) + "\n")


def write_whole(path: Path, *parts: Bytes) -> None:
    """Replaces a file in one step, or writes to a device. Throws ReportError; it is as it was.

    Permissions stay, and hold from the first byte on; a link goes on pointing to the file.
    """
    known = _replaceable(path)
    with _writing(path):
        if str(path).startswith(_DIRECT) or (known and not stat.S_ISREG(known.st_mode)):
            with path.open("wb") as stream:
                return stream.writelines(parts)
        target, mode = Path(os.path.realpath(path)), 0o600 if known else 0o666
        part = target.with_name(f".octocell-{secrets.token_hex(8)}")
        try:
            with open(part, "xb", opener=lambda name, how: os.open(name, how, mode)) as stream:
                stream.writelines(parts)
                _take_after(known, stream.fileno())
            os.replace(part, target)
        finally:
            part.unlink(missing_ok=True)


def _take_after(known: os.stat_result | None, file: int | Path) -> None:
    """Owner and permissions of what is replaced; fewer for a group that cannot be kept."""
    if known is None:
        return
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
    try:
        with _writing(folder):
            folder.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryDirectory(
                prefix=".octocell-", dir=folder, ignore_cleanup_errors=True
            ) as staging:
                yield Path(staging)
                _publish(Path(staging), folder, owned, inputs)
    except BaseException:
        for path in made[-1:]:
            shutil.rmtree(path, ignore_errors=True)
        raise


def _publish(staging: Path, folder: Path, owned: list[str], inputs: list[Path]) -> None:
    written = sorted(path.name for path in staging.iterdir())
    check_outputs((folder / name for name in written), inputs)
    # Links first: they may lead to another disk, which may be full.
    for name in sorted(written, key=lambda name: not (folder / name).is_symlink()):
        fresh, target = staging / name, folder / name
        if target.is_symlink() or (target.exists() and not target.is_file()):
            write_whole(target, fresh.read_bytes())
        else:
            _take_after(_replaceable(target), fresh)
            os.replace(fresh, target)
    for name in set(owned) - set(written):
        (folder / name).unlink(missing_ok=True)
