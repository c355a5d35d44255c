# SPDX-License-Identifier: MIT
"""No output overwrites an input or another output, however the paths are written."""

from __future__ import annotations

import os
import stat
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from hard_scenes import SCENES
from program import Octocell, Refused

Spelling = Callable[[Path], str]


def _dotted(path: Path) -> str:
    return f"./{path.name}"


def _absolute(path: Path) -> str:
    return str(path)


def _link(path: Path) -> str:
    link = path.with_name(f"link_to_{path.name}")
    link.symlink_to(path.name)
    return link.name


def _hard_link(path: Path) -> str:
    if not path.exists():
        return path.name
    link = path.with_name(f"hard_{path.name}")
    link.hardlink_to(path)
    return link.name


def _linked_folder(path: Path) -> str:
    folder = path.parent / "folder"
    folder.symlink_to(".")
    return f"folder/{path.name}"


SPELLINGS: list[Spelling] = [
    lambda path: path.name,
    _dotted,
    _absolute,
    _link,
    _hard_link,
    _linked_folder,
    lambda path: f"../{path.parent.name}/{path.name}",
]


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "s.npy"
    np.save(path, SCENES["gas"])
    np.save(tmp_path / "f.npy", np.zeros(len(SCENES["gas"]), bool))
    return path


@pytest.mark.parametrize("spelling", SPELLINGS)
@pytest.mark.parametrize(
    "arguments",
    [
        ["find", "s.npy", "-o"],
        ["find", "s.npy", "--depth"],
        ["find", "./s.npy", "-o", "p.npy", "--depth"],
        ["generate", "s.npy", "-o"],
        ["generate", "s.npy", "-o", "t.npy", "--flags-output"],
        ["bench", "./s.npy", "--rounds", "1", "-o"],
    ],
)
def test_a_scene_is_not_overwritten(
    refused: Refused, scene: Path, arguments: list[str], spelling: Spelling
) -> None:
    before = scene.read_bytes()
    line = refused(*arguments, spelling(scene))
    assert "cannot write" in line and "s.npy" in line
    assert scene.read_bytes() == before


@pytest.mark.parametrize("command", [["find", "s.npy"], ["generate", "s.npy"], ["bench", "s.npy"]])
def test_flags_are_not_overwritten(refused: Refused, scene: Path, command: list[str]) -> None:
    flags = scene.with_name("f.npy")
    before = flags.read_bytes()
    assert "--flags" in refused(*command, "--flags", "f.npy", "-o", _dotted(flags))
    assert flags.read_bytes() == before


def test_frames_are_not_overwritten(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "frames").mkdir()
    for k in range(2):
        np.save(tmp_path / f"frames/f{k}.npy", SCENES["gas"])
    line = refused("bench", "--trajectory", "frames", "-o", "./frames/../frames/f1.npy")
    assert "cannot write" in line and "f1.npy" in line


@pytest.mark.parametrize("exists", [False, True])
@pytest.mark.parametrize("spelling", SPELLINGS)
@pytest.mark.parametrize(
    ("command", "other"),
    [
        (["find", "gas:n=300"], "--depth"),
        (["generate", "gas:n=300,static=0.5"], "--flags-output"),
    ],
)
def test_two_outputs_need_a_file_each(
    refused: Refused,
    tmp_path: Path,
    command: list[str],
    other: str,
    spelling: Spelling,
    exists: bool,
) -> None:
    path = tmp_path / "a.npy"
    if exists:
        path.write_bytes(b"what was there")
    spelt = spelling(path)
    assert "a file each" in refused(*command, "-o", "a.npy", other, spelt)
    assert not exists or path.read_bytes() == b"what was there"


def test_devices_may_be_named_twice(octocell: Octocell) -> None:
    octocell.ok("find", "gas:n=300", "-o", "/dev/null", "--depth", "/dev/null")


def test_a_link_to_nothing_is_followed(octocell: Octocell, tmp_path: Path) -> None:
    (tmp_path / "link.npy").symlink_to("there.npy")
    octocell.ok("find", "gas:n=300", "-o", "link.npy", cwd=tmp_path)
    assert (tmp_path / "link.npy").is_symlink() and (tmp_path / "there.npy").is_file()


def _permissions(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o400, 0o604])
def test_permissions_stay(octocell: Octocell, tmp_path: Path, mode: int) -> None:
    path = tmp_path / "a.npy"
    path.write_bytes(b"what was there")
    path.chmod(mode)
    result = octocell.run("find", "gas:n=300", "-o", "a.npy", cwd=tmp_path)
    assert _permissions(path) == mode
    if result.rc != 0:  # root may write what is read-only
        assert mode == 0o400 and path.read_bytes() == b"what was there"


def test_a_private_output_is_private_before_it_is_complete(
    octocell: Octocell, tmp_path: Path
) -> None:
    path = tmp_path / "a.csv"
    path.touch(mode=0o600)
    modes: set[int] = set()
    for _ in range(10):
        with subprocess.Popen(
            [octocell.path, "generate", "gas:n=200000", "-o", path], stdout=subprocess.DEVNULL
        ) as running:
            while running.poll() is None:
                for temporary in tmp_path.glob(".octocell-*.tmp"):
                    try:
                        modes.add(_permissions(temporary))
                    except FileNotFoundError:
                        continue
                time.sleep(0.0005)
        if modes:
            break
    assert modes and not any(mode & 0o077 for mode in modes), [oct(mode) for mode in modes]


@pytest.mark.skipif(os.geteuid() != 0, reason="only root gives files away")
def test_the_owner_stays(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "a.npy"
    path.touch()
    os.chown(path, 12345, 54321)
    octocell.ok("find", "gas:n=300", "-o", path)
    assert (path.stat().st_uid, path.stat().st_gid) == (12345, 54321)
