# SPDX-License-Identifier: MIT
"""The fetching of large real scenes, from packages made here instead of downloads."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from program import ROOT, module_of

ROW = re.compile(r'\{"(\w+)",\s*"data/real/(\w+)\.npy",\s*([\d\']+),')


@pytest.fixture
def script(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(ROOT / "scripts"))
    return module_of(ROOT / "scripts/fetch_real_scenes.py")


def points(files: list[Path], target: Path) -> None:
    np.save(target, np.loadtxt(files[0], dtype="f4"))


@pytest.fixture
def packages(script: ModuleType, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Two small scenes; returns the list of downloads."""
    good, gone = script.Package("PyPI", "good==1"), script.Package("Debian", "gone")
    scenes = [
        script.Scene("one", good, ("a/one.txt",), points, 2),
        script.Scene("two", good, ("a/one.txt",), points, 2),
        script.Scene("absent", gone, ("b.txt",), points, 1),
    ]
    monkeypatch.setattr(script, "SCENES", scenes)
    downloads: list[str] = []

    def unpack(folder: Path, package: object) -> Path:
        downloads.append(str(package))
        if package == gone:
            raise script.Unavailable("no network")
        (folder / "a").mkdir()
        (folder / "a/one.txt").write_text("0 0 0 1\n1 0 0 1\n")
        return folder

    monkeypatch.setattr(script, "_unpack", unpack)
    return downloads


def test_a_package_is_downloaded_once_and_only_if_needed(
    script: ModuleType, packages: list[str], tmp_path: Path
) -> None:
    failures = script.fetch(tmp_path, script.SCENES)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.npy", "two.npy"]
    assert np.load(tmp_path / "one.npy").shape == (2, 4)
    assert packages == ["PyPI's good==1", "Debian's gone"]
    assert failures == [f"{tmp_path}/absent.npy could not be had from Debian's gone: no network"]
    script.fetch(tmp_path, script.SCENES)
    assert packages[2:] == ["Debian's gone"]


@pytest.mark.parametrize(
    ("change", "why"),
    [({"spheres": 3}, "2 spheres, expected 3"), ({"members": ("a/x.txt",)}, "holds no a/x.txt")],
)
def test_a_scene_that_is_not_the_expected_one_is_not_kept(
    script: ModuleType, packages: list[str], tmp_path: Path, change: dict[str, object], why: str
) -> None:
    (failure,) = script.fetch(tmp_path, [script.SCENES[0]._replace(**change)])
    assert why in failure and not list(tmp_path.iterdir())


@pytest.mark.parametrize(("arguments", "code"), [([], 0), (["--strict"], 1)])
def test_what_cannot_be_had_is_named(
    script: ModuleType,
    packages: list[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    code: int,
) -> None:
    monkeypatch.setattr(script, "FOLDER", tmp_path)
    monkeypatch.setattr(sys, "argv", ["fetch_real_scenes.py", *arguments])
    assert script.main() == code
    assert capsys.readouterr().err.count("absent.npy could not be had") == 1


def test_the_program_knows_the_same_scenes(script: ModuleType) -> None:
    table = (ROOT / "harness/files/real_scenes.cpp").read_text(encoding="utf-8")
    known = {name: (stem, int(n.replace("'", ""))) for name, stem, n in ROW.findall(table)}
    assert known == {scene.name: (scene.name, scene.spheres) for scene in script.SCENES}


def test_a_robot_stands_with_its_links_in_place(script: ModuleType, tmp_path: Path) -> None:
    """An arm of two links, the second turned by 90 degrees about z and shifted by (1, 0, 0)."""
    pytest.importorskip("yaml")
    (tmp_path / "arm.urdf").write_text(
        '<robot><joint name="j"><parent link="base"/><child link="hand"/>'
        '<origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/></joint></robot>'
    )
    (tmp_path / "arm.yml").write_text(
        "kinematics:\n  collision_spheres:\n"
        "    base:\n    - {center: [0, 0, 0], radius: 0.5}\n"
        "    hand:\n    - {center: [2, 0, 0], radius: 0.25}\n"
    )
    robot = script._robot(tmp_path / "arm.yml", tmp_path / "arm.urdf")
    np.testing.assert_allclose(robot, [[0, 0, 0, 0.5], [1, 2, 0, 0.25]], atol=1e-15)


def test_stars_are_where_their_parallax_says(script: ModuleType, tmp_path: Path) -> None:
    half_turn = np.pi / 2
    rows = [f"1 0 0 0 {half_turn} 0 100 0", "2 0 0 0 0 0 0.05 0", f"3 0 0 0 0 {half_turn} 50 0"]
    (tmp_path / "hip2.dat").write_text("\n".join(rows))
    script.stars([tmp_path / "hip2.dat"], tmp_path / "stars.npy")
    stars = np.load(tmp_path / "stars.npy")
    np.testing.assert_allclose(stars, [[0, 10, 0, 2.5], [0, 0, 20, 2.5]], atol=1e-5)
