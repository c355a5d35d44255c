# SPDX-License-Identifier: MIT
"""Outputs: no input, nor each other, under two names; whole or not at all; as private as before."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from octocell_import import cli as importer
from octocell_report import cli, files, images
from octocell_report.fields import ReportError

import synthetic_ablation
import synthetic_error
from test_sort import gpu_cases

XYZ = "1\nc\nC 0 0 0\n"
FRAMES = XYZ * 2
REPORTS = Path(__file__).resolve().parents[2] / "reports"


@pytest.fixture(autouse=True)
def no_plots(monkeypatch):
    monkeypatch.setattr(images, "write", lambda figures, folder: None)


def contents(folder):
    return {str(p): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def refuses(main, capsys, folder, *arguments):
    """One line, exit code 2, and every file as it was."""
    before = contents(folder)
    assert main(list(map(str, arguments))) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1
    assert contents(folder) == before
    return err


def linked(kind, path, target):
    path.parent.mkdir(exist_ok=True)
    os.link(target, path) if kind == "hard" else path.symlink_to(target)


@pytest.mark.parametrize("kind", ["hard", "symbolic"])
@pytest.mark.parametrize(
    ("command", "name"),
    [("build", "times.csv"), ("ablation", "ablation.csv"), ("error", "error.md")],
)
def test_no_report_is_written_over_its_input(tmp_path, save, capsys, kind, command, name):
    document = synthetic_error.host() if command == "error" else synthetic_ablation.every_case()
    path = save(document)
    linked(kind, tmp_path / "out" / name, path)
    error = refuses(cli.main, capsys, tmp_path, command, path, "-o", tmp_path / "out")
    assert f"{name}: cannot be written: is the same file as the input {path}" in error


def test_a_result_may_be_named_like_an_output(tmp_path, save, capsys):
    path = save(gpu_cases()).rename(tmp_path / "sort.csv")
    assert "same file" in refuses(cli.main, capsys, tmp_path, "sort", path, "-o", tmp_path)
    os.symlink(tmp_path, tmp_path / "again")
    folder = tmp_path / "again"
    assert "same file" in refuses(cli.main, capsys, tmp_path, "sort", path, "-o", folder)


def test_inputs_that_were_found_in_the_folder_count_too(tmp_path, save, every_case, capsys):
    out, path = tmp_path / "out", save(every_case)
    out.mkdir()
    path.rename(tmp_path / "bench.json")
    save(synthetic_ablation.every_case()).rename(out / "ablation.json")
    linked("hard", out / "index.html", out / "ablation.json")
    error = refuses(cli.main, capsys, tmp_path, "build", tmp_path / "bench.json", "-o", out)
    assert "index.html: cannot be written: is the same file as the input" in error


def test_two_files_of_a_report_may_not_be_one(tmp_path, save, capsys):
    path = save(synthetic_ablation.every_case())
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "regret.csv").symlink_to("ablation.csv")  # which does not exist yet
    error = refuses(cli.main, capsys, tmp_path, "ablation", path, "-o", tmp_path / "out")
    assert "is the same file as the output" in error


@pytest.mark.parametrize(
    "output", [None, "{}/a.npy", "{}/sub/../a.npy", "{}/link.npy", "{}/b/a.npy"]
)
def test_no_scene_is_written_over_its_file(tmp_path, capsys, output):
    (tmp_path / "a.npy").write_text(XYZ)
    (tmp_path / "sub").mkdir()
    (tmp_path / "b").symlink_to(tmp_path)
    os.link(tmp_path / "a.npy", tmp_path / "link.npy")
    options = ["-o", output.format(tmp_path)] if output else []
    arguments = [tmp_path / "a.npy", "--format", "xyz", *options]
    assert "same file as the input" in refuses(importer.main, capsys, tmp_path, *arguments)


def test_no_scene_is_written_over_the_topology(tmp_path, capsys):
    (tmp_path / "a.xyz").write_text(XYZ)
    (tmp_path / "t.xyz").write_text(XYZ)
    (tmp_path / "a.npy").symlink_to(tmp_path / "t.xyz")
    arguments = [tmp_path / "a.xyz", "--topology", tmp_path / "t.xyz"]
    assert "t.xyz" in refuses(importer.main, capsys, tmp_path, *arguments)


@pytest.mark.parametrize("to", ["../a.xyz", "frame_00000.npy"])
def test_no_frame_is_written_over_its_file_nor_over_another(tmp_path, capsys, to):
    (tmp_path / "a.xyz").write_text(FRAMES)
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / "frame_00001.npy").symlink_to(to)
    arguments = [tmp_path / "a.xyz", "--all-frames", tmp_path / "b"]
    assert "is the same file as" in refuses(importer.main, capsys, tmp_path, *arguments)


def test_a_folder_where_a_file_belongs_changes_nothing(tmp_path, save, capsys):
    path = save(synthetic_ablation.every_case())
    (tmp_path / "out" / "regret.csv").mkdir(parents=True)
    (tmp_path / "out" / "ablation.md").write_text("old")
    error = refuses(cli.main, capsys, tmp_path, "ablation", path, "-o", tmp_path / "out")
    assert "regret.csv: cannot be written: is a folder" in error


def test_what_is_read_only_stays(tmp_path, save, capsys):
    (tmp_path / "a.xyz").write_text(XYZ)
    path = save(synthetic_ablation.every_case())
    for name in ("a.npy", "regret.csv"):
        (tmp_path / name).write_text("old")
        (tmp_path / name).chmod(0o444)
    assert "read-only" in refuses(importer.main, capsys, tmp_path, tmp_path / "a.xyz")
    assert "read-only" in refuses(cli.main, capsys, tmp_path, "ablation", path, "-o", tmp_path)


def test_links_go_on_pointing_to_what_is_written(tmp_path, save):
    path = save(synthetic_ablation.every_case())
    (tmp_path / "a.xyz").write_text(XYZ)
    (tmp_path / "elsewhere").mkdir()
    for name in ("a.npy", "regret.csv"):
        (tmp_path / name).symlink_to(f"elsewhere/{name}")
    assert cli.main(["ablation", str(path), "-o", str(tmp_path)]) == 0
    assert importer.main([str(tmp_path / "a.xyz")]) == 0
    assert all((tmp_path / name).is_symlink() for name in ("a.npy", "regret.csv"))
    names = sorted(p.name for p in (tmp_path / "elsewhere").iterdir())
    assert names == ["a.npy", "regret.csv"]


def mode_of(path):
    return stat.S_IMODE(path.stat().st_mode)


def test_permissions_stay(tmp_path, save):
    path = save(synthetic_ablation.every_case())
    (tmp_path / "a.xyz").write_text(XYZ)
    marked = tmp_path / "P.md"
    for file, mode in (("a.npy", 0o600), ("regret.csv", 0o640), ("P.md", 0o606)):
        (tmp_path / file).write_text("")
        (tmp_path / file).chmod(mode)
    assert importer.main([str(tmp_path / "a.xyz")]) == 0
    assert cli.main(["ablation", str(path), "-o", str(tmp_path)]) == 0
    files.write_text(marked, "new")
    modes = [mode_of(tmp_path / name) for name in ("a.npy", "regret.csv", "P.md")]
    assert modes == [0o600, 0o640, 0o606]
    assert mode_of(tmp_path / "ablation.csv") == 0o666 & ~mask()


def mask():
    known = os.umask(0)
    os.umask(known)
    return known


def test_a_private_file_is_private_from_the_first_byte_on(tmp_path, monkeypatch):
    path, seen = tmp_path / "a.npy", []
    path.write_bytes(b"old")
    path.chmod(0o600)
    replace = os.replace

    def spy(source, target):
        seen.append(mode_of(Path(source)))
        replace(source, target)

    opened = os.open

    def open_spy(name, flags, mode=0o777, **more):
        if flags & os.O_CREAT:
            seen.append(mode)
        return opened(name, flags, mode, **more)

    monkeypatch.setattr(os, "replace", spy)
    monkeypatch.setattr(os, "open", open_spy)
    (tmp_path / "a.xyz").write_text(XYZ)
    assert importer.main([str(tmp_path / "a.xyz")]) == 0
    assert seen == [0o600, 0o600]


def test_what_fails_half_way_leaves_nothing(tmp_path, monkeypatch):
    def broken(source, target):
        raise OSError(28, "No space left on device")

    (tmp_path / "a").write_bytes(b"old")
    monkeypatch.setattr(os, "replace", broken)
    with pytest.raises(ReportError, match="a: cannot be written: No space left"):
        files.write_whole(tmp_path / "a", b"new")
    assert contents(tmp_path) == {str(tmp_path / "a"): b"old"}


def test_a_pipe_is_written_to_and_stays(tmp_path):
    os.mkfifo(tmp_path / "a.npy")
    (tmp_path / "a.xyz").write_text(XYZ)
    got = []
    reader = threading.Thread(target=lambda: got.append((tmp_path / "a.npy").read_bytes()))
    reader.start()
    assert importer.main([str(tmp_path / "a.xyz")]) == 0
    reader.join(10)
    assert got[0].startswith(b"\x93NUMPY") and len(got[0]) == 128 + 16
    assert stat.S_ISFIFO((tmp_path / "a.npy").stat().st_mode)


def run(module, *arguments, **options):
    command = [sys.executable, "-m", module, *map(str, arguments)]
    environment = os.environ | {"PYTHONPATH": str(REPORTS)}
    environment.pop("PYTHONUNBUFFERED", None)  # argparse would hide that its help was not written
    return subprocess.run(command, env=environment, stderr=subprocess.PIPE, check=False, **options)


def test_a_scene_on_standard_output_is_a_scene(tmp_path):
    (tmp_path / "a.xyz").write_text(XYZ)
    (tmp_path / "out.npy").symlink_to("/dev/stdout")
    done = run("octocell_import", tmp_path / "a.xyz", "-o", tmp_path / "out.npy", stdout=-1)
    assert done.returncode == 0 and (tmp_path / "out.npy").is_symlink()
    assert done.stdout.startswith(b"\x93NUMPY")


@pytest.mark.parametrize("module", ["octocell_import", "octocell_report"])
def test_a_full_disk_behind_standard_output_is_said(tmp_path, save, module):
    (tmp_path / "a.xyz").write_text(XYZ)
    result = save(synthetic_ablation.every_case())
    arguments = [tmp_path / "a.xyz"] if module == "octocell_import" else ["check", result]
    for what in (arguments, ["--help"]):
        with open("/dev/full", "w") as full:
            done = run(module, *what, stdout=full)
        assert done.returncode == 2
        assert b"standard output: No space left" in done.stderr and done.stderr.count(b"\n") == 1


def test_a_closed_pipe_is_no_traceback(tmp_path, save):
    result = save(synthetic_ablation.every_case())
    end, start = os.pipe()
    os.close(end)
    done = run("octocell_report", "compare", result, result, stdout=start)
    os.close(start)
    assert (done.returncode, done.stderr) == (141, b"")


def test_ctrl_c_leaves_nothing(tmp_path, save, monkeypatch, capsys):
    def interrupt(*arguments):
        raise KeyboardInterrupt

    path = save(synthetic_ablation.every_case())
    (tmp_path / "a.xyz").write_text(FRAMES)
    before = contents(tmp_path)
    monkeypatch.setattr(images, "write", interrupt)
    monkeypatch.setattr(os, "replace", interrupt)
    assert cli.main(["build", str(path), "-o", str(tmp_path / "new" / "out")]) == 130
    assert importer.main([str(tmp_path / "a.xyz")]) == 130
    assert importer.main([str(tmp_path / "a.xyz"), "--all-frames", str(tmp_path / "f")]) == 130
    assert capsys.readouterr().err.count("interrupted\n") == 3
    assert contents(tmp_path) == before and not list(tmp_path.glob(".*"))
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.xyz", "result.json"]
