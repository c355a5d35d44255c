# SPDX-License-Identifier: MIT
"""Bad input is refused: exit code 2, one line that says what and where, and no file is left."""

from __future__ import annotations

import os
import resource
import struct
from pathlib import Path

import numpy as np
import pytest

from program import Octocell, Refused
from hard_scenes import SCENES

GOOD = SCENES["gas"]


def npy(dictionary: str, data: bytes = b"", version: bytes = b"\x01\x00") -> bytes:
    """An NPY file with a header of one's own."""
    header = dictionary.encode() + b"\n"
    length = struct.pack("<H" if version[0] == 1 else "<I", len(header))
    return b"\x93NUMPY" + version + length + header + data


def header_of(shape: str, descr: str = "'<f4'", order: str = "False") -> str:
    return f"{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}, }}"


ONE = np.array([1, 2, 3, 4], np.float32).tobytes()
BAD_NPY = {
    "not_npy": (b"x,y,z,r\n1,2,3,4\n", ["not an NPY file"]),
    "magic_only": (b"\x93NUMPY", ["truncated"]),
    "version_9": (npy(header_of("(1, 4)"), ONE, b"\x09\x00"), ["version 9.0"]),
    "header_cut": (npy(header_of("(1, 4)"))[:40], ["truncated", "header"]),
    "header_too_long": (b"\x93NUMPY\x02\x00\xff\xff\xff\xff" + b" " * 99, ["header of 4294967295"]),
    "no_dictionary": (npy("garbage"), ["header", "'{'", "garbage"]),
    "key_unknown": (npy("{'descr': '<f4', 'colour': False, 'shape': (1, 4)}", ONE), ["colour"]),
    "key_missing": (npy("{'descr': '<f4', 'shape': (1, 4)}", ONE), ["fortran_order"]),
    "key_twice": (npy("{'descr': '<f4', 'descr': '<f4', 'shape': (1, 4)}", ONE), ["only once"]),
    "text_after": (npy(header_of("(1, 4)") + "more", ONE), ["more"]),
    "shape_no_number": (npy(header_of("(a, 4)"), ONE), ["whole number"]),
    "shape_negative": (npy(header_of("(-1, 4)"), ONE), ["whole number", "-1"]),
    "shape_3": (npy(header_of("(1, 3)"), ONE[:12]), ["(1, 3)", "--radius"]),
    "shape_5": (npy(header_of("(1, 5)"), ONE + ONE[:4]), ["(1, 5)", "(n, 4)"]),
    "shape_1d": (npy(header_of("(4,)"), ONE), ["(4,)", "(n, 4)"]),
    "shape_3d": (npy(header_of("(1, 1, 4)"), ONE), ["(1, 1, 4)"]),
    "shape_0d": (npy(header_of("()"), ONE[:4]), ["()"]),
    "shape_huge": (npy(header_of("(4611686018427387904, 4)"), ONE), ["4611686018427387904"]),
    "too_many": (npy(header_of("(268435457, 4)"), ONE), ["268435457 spheres"]),
    "fortran": (npy(header_of("(1, 4)", order="True"), ONE), ["Fortran"]),
    "float64": (npy(header_of("(1, 4)", "'<f8'"), ONE * 2), ["<f8", "--round-input"]),
    "big_endian": (npy(header_of("(1, 4)", "'>f4'"), ONE), [">f4", "big-endian"]),
    "int32": (npy(header_of("(1, 4)", "'<i4'"), ONE), ["<i4", "float32"]),
    "record": (npy(header_of("(1,)", "[('x', '<f4')]"), ONE), ["header"]),
    "truncated": (npy(header_of("(2, 4)"), ONE), ["truncated", "(2, 4)"]),
    "no_data": (npy(header_of("(1, 4)")), ["truncated"]),
    "overlong": (npy(header_of("(1, 4)"), ONE + b"\0"), ["too long", "(1, 4)"]),
}


@pytest.mark.parametrize("name", BAD_NPY)
def test_npy(refused: Refused, tmp_path: Path, name: str) -> None:
    content, words = BAD_NPY[name]
    (tmp_path / "bad.npy").write_bytes(content)
    line = refused("find", "bad.npy")
    assert all(word in line for word in ["bad.npy", *words]), line


@pytest.mark.parametrize("column", range(4))
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, -0.5])
def test_npy_with_a_bad_sphere(refused: Refused, tmp_path: Path, column: int, value: float) -> None:
    if np.isfinite(value) and column != 3:
        return  # only the radius may not be negative
    spheres = GOOD.copy()
    spheres[37, column] = value
    spheres[99, 3] = np.nan  # the first one is named
    np.save(tmp_path / "bad.npy", spheres)
    line = refused("find", "bad.npy")
    assert f"bad.npy: sphere 37: {'xyzr'[column]} is {value}" in line


def test_float64_beyond_float32(refused: Refused, tmp_path: Path) -> None:
    spheres = GOOD.astype(np.float64)
    spheres[3, 1] = 1e39
    np.save(tmp_path / "bad.npy", spheres)
    line = refused("find", "bad.npy", "--round-input")
    assert "bad.npy: sphere 3: y is 1e+39" in line


BAD_CSV = {
    "word": ("1,2,3,4\n1,2,three,4\n", [":2:", "'three'", "not a number"]),
    "empty_field": ("1,2,3,4\n\n1,,3,4\n", [":3:", "not a number"]),
    "two_numbers": ("1,2,3,4\n1,2 2,3,4\n", [":2:", "'2 2'"]),
    "hexadecimal": ("0x1p3,2,3,4\n", [":1:", "'0x1p3'"]),
    "comma_for_point": ("0,5;1,5;2,5;1,0\n", [":1:", "--decimal-comma"]),
    "three_fields": ("1,2,3,4\n1,2,3\n", [":2:", "3 fields"]),
    "five_fields": ("1,2,3,4,5\n", [":1:", "5 fields"]),
    "too_large": ("1,2,3,4\n1,2,1e39,4\n", [":2:", "1e39", "too large"]),
    "nan": ("1,2,3,4\n1,nan,3,4\n", [":2:", "y is nan"]),
    "infinite": ("1,2,3,4\n-inf,2,3,4\n", [":2:", "x is -inf"]),
    "negative_radius": ("x,y,z,r\n\n1,2,3,-4\n", [":3:", "r is -4"]),
    "header_unknown": ("a,b,c,d\n1,2,3,4\n", [":1:", "header"]),
    "header_twice_x": ("x,x,z,r\n1,2,3,4\n", [":1:", "header"]),
    "header_in_the_middle": ("1,2,3,4\nx,y,z,r\n", [":2:", "'x'"]),
    "only_comments": ("# nothing\n\n", ["neither a header nor a sphere"]),
    "control_characters": ("1,2,3,\x1b[31m\n", [":1:", r"\x1b"]),
    "null_byte": ("1,2,3,4\0\n", [":1:", r"\x00"]),
}


@pytest.mark.parametrize("name", BAD_CSV)
def test_csv(refused: Refused, tmp_path: Path, name: str) -> None:
    text, words = BAD_CSV[name]
    (tmp_path / "bad.csv").write_text(text, encoding="utf-8")
    line = refused("find", "bad.csv")
    assert all(word in line for word in ["bad.csv", *words]), line
    assert "\x1b" not in line


BAD_PQR = {
    "no_atom": ("REMARK nothing\nEND\n", ["no ATOM"]),
    "few_fields": ("REMARK\nATOM 1 N GLY A 1 0 0 0\n", [":2:", "9 fields"]),
    "word": ("ATOM 1 N GLY A 1 0 zero 0 0 1\n", [":1:", "'zero'"]),
    "negative_radius": ("ATOM 1 N GLY A 1 0 0 0 0 -1\n", [":1:", "r is -1"]),
    "too_large": ("ATOM 1 N GLY A 1 0 1e39 0 0 1\n", [":1:", "1e39"]),
}


@pytest.mark.parametrize("name", BAD_PQR)
def test_pqr(refused: Refused, tmp_path: Path, name: str) -> None:
    text, words = BAD_PQR[name]
    (tmp_path / "bad.pqr").write_text(text, encoding="utf-8")
    line = refused("find", "bad.pqr")
    assert all(word in line for word in ["bad.pqr", *words]), line


@pytest.mark.parametrize("ending", ["npy", "csv", "pqr"])
def test_files_that_are_not_there_or_no_files(
    refused: Refused, tmp_path: Path, ending: str
) -> None:
    assert f"missing.{ending}: No such file" in refused("find", f"missing.{ending}")
    (tmp_path / f"folder.{ending}").mkdir()
    assert "is a folder" in refused("find", f"folder.{ending}")
    (tmp_path / f"empty.{ending}").touch()
    assert f"empty.{ending}: is empty" in refused("find", f"empty.{ending}")
    os.mkfifo(tmp_path / f"pipe.{ending}")  # nobody writes: reading it would wait for ever
    assert "not a regular file" in refused("find", f"pipe.{ending}", timeout=10)


def test_a_name_with_a_line_break_stays_on_one_line(refused: Refused) -> None:
    refused("find", "no\nfile.csv")
    refused("find", "no\nscene")
    refused("find", "gas:n=10", "--backend", "no\nbackend")


def test_an_unknown_extension(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "scene.text").write_text("1,2,3,4\n", encoding="utf-8")
    line = refused("find", "./scene.text")
    assert "scene.text" in line and ".npy, .csv" in line


ARGUMENTS = {
    "no_subcommand": ([], ["subcommand"]),
    "unknown_subcommand": (["seek"], ["seek", "known"]),
    "no_scene": (["find"], ["SCENE"]),
    "two_scenes": (["find", "gas:n=9", "gas:n=8"], ["gas:n=8"]),
    "unknown_scene": (["find", "gaz"], ["'gaz'", "gas, dense, poly"]),
    "empty_scene": (["find", ""], ["''"]),
    "unknown_parameter": (["find", "gas:m=9"], ["gas", "'m'", "seed"]),
    "no_parameter": (["find", "gas:"], ["gas"]),
    "no_value": (["find", "gas:n"], ["gas", "'n'"]),
    "twice": (["find", "gas:n=9,n=9"], ["n is given twice"]),
    "n_negative": (["find", "gas:n=-1"], ["n=-1", "out of range"]),
    "n_fraction": (["find", "gas:n=1.5"], ["n=1.5", "whole"]),
    "n_too_large": (["find", "gas:n=268435457"], ["n=268435457", "out of range"]),
    "n_far_too_large": (["find", "gas:n=1e400"], ["n="]),
    "n_not_a_number": (["find", "gas:n=many"], ["'many'"]),
    "n_nan": (["find", "gas:n=nan"], ["n=nan"]),
    "unknown_backend": (["find", "gas:n=9", "--backend", "gpu"], ["'gpu'", "impl_cpu"]),
    "unknown_method": (["find", "gas:n=9", "--method", "magic"], ["'magic'", "brute_force"]),
    "unknown_rule": (["find", "gas:n=9", "--rule", "none"], ["'none'", "lowest_cell"]),
    "unknown_flag": (["find", "gas:n=9", "--fast"], ["--fast"]),
    "threads_negative": (["find", "gas:n=9", "--threads", "-1"], ["--threads", "-1"]),
    "threads_word": (["find", "gas:n=9", "--threads", "abc"], ["--threads", "abc"]),
    "threads_fraction": (["find", "gas:n=9", "--threads", "1.5"], ["--threads", "1.5"]),
    "threads_many": (["find", "gas:n=9", "--threads", "100000"], ["--threads", "100000"]),
    "threads_overflow": (["find", "gas:n=9", "--threads", "9" * 30], ["--threads"]),
    "threads_missing": (["find", "gas:n=9", "--threads"], ["--threads"]),
    "cell_side_zero": (["find", "gas:n=9", "--cell-side", "0"], ["cell side 0"]),
    "cell_side_negative": (["find", "gas:n=9", "--cell-side", "-2"], ["cell side -2"]),
    "cell_side_nan": (["find", "gas:n=9", "--cell-side", "nan"], ["cell side nan"]),
    "cell_side_word": (["find", "gas:n=9", "--cell-side", "small"], ["--cell-side", "small"]),
    "cell_side_tiny": (["find", "gas:n=9999", "--cell-side", "1e-3"], ["cell side"]),
    "cell_side_fixed": (
        ["find", "gas:n=9", "--rule", "chapter32", "--cell-side", "2"],
        ["chapter32", "cell side"],
    ),
    "cell_side_none": (
        ["find", "gas:n=9", "--method", "brute_force", "--cell-side", "2"],
        ["brute_force"],
    ),
    "brute_force_rule": (
        ["find", "gas:n=9", "--method", "brute_force", "--rule", "lowest_cell"],
        ["brute_force", "rule"],
    ),
    "baseline_method": (
        ["find", "gas:n=9", "--backend", "bullet_dbvt", "--method", "home_phantom"],
        ["bullet_dbvt", "method"],
    ),
    "baseline_rule": (
        ["find", "gas:n=9", "--backend", "bullet_dbvt", "--rule", "lowest_cell"],
        ["bullet_dbvt", "rule"],
    ),
    "chapter32_refuses": (
        ["find", "shifted:n=99,offset=1e9", "--rule", "chapter32"],
        ["rule chapter32 does not hold", "lowest_cell"],
    ),
    "check_scene": (["check", "gaz"], ["'gaz'"]),
    "check_file": (["check", "missing.npy"], ["missing.npy"]),
    "check_backend": (["check", "gas:n=9", "--backend", "gpu"], ["'gpu'"]),
    "check_threads": (["check", "gas:n=9", "--threads", "-1"], ["--threads", "-1"]),
    "check_limit": (["check", "gas:n=9", "--candidate-limit", "-1"], ["--candidate-limit"]),
    "check_flag": (["check", "--nothing"], ["--nothing"]),
    "list_argument": (["list", "more"], ["more"]),
    "generate_no_output": (["generate", "gas:n=9"], ["--output"]),
    "generate_scene": (["generate", "gaz", "-o", "a.npy"], ["'gaz'"]),
    "generate_file": (["generate", "missing.csv", "-o", "a.npy"], ["missing.csv"]),
}


@pytest.mark.parametrize("name", ARGUMENTS)
def test_arguments(refused: Refused, name: str) -> None:
    arguments, words = ARGUMENTS[name]
    line = refused(*arguments)
    assert all(word in line for word in words), line


def test_an_unknown_subcommand_is_named(refused: Refused) -> None:
    assert "seek" in refused("seek", "gas:n=9")


WRITERS = [("find", "gas:n=300"), ("generate", "gas:n=300")]


@pytest.mark.parametrize("command", WRITERS)
@pytest.mark.parametrize(
    ("target", "words"),
    [
        ("no_folder/a.npy", "No such file"),
        ("plain.csv/a.npy", "Not a directory"),
        ("folder", "Is a directory"),
        ("folder/", "Is a directory"),
        ("a.txt", ".npy"),
        ("a", ".npy"),
        ("", "cannot write"),
        ("n" * 300 + ".npy", "too long"),
        ("/dev/full", "No space left"),
    ],
)
def test_outputs_that_cannot_be_written(
    refused: Refused, tmp_path: Path, command: tuple[str, str], target: str, words: str
) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "plain.csv").write_text("1,2,3,4\n", encoding="utf-8")
    line = refused(*command, "-o", target)
    assert words in line and target in line


@pytest.mark.parametrize("command", WRITERS)
def test_a_disk_that_fills_up_leaves_the_old_file(
    refused: Refused, tmp_path: Path, command: tuple[str, str]
) -> None:
    (tmp_path / "a.npy").write_bytes(b"what was there")

    def shrink_disk() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (256, 256))

    # SIGXFSZ stays ignored, as Python has it, so that write() fails like on a full disk.
    line = refused(*command, "-o", "a.npy", preexec_fn=shrink_disk, restore_signals=False)
    assert "cannot write a.npy" in line


def test_a_bad_scene_leaves_the_old_output(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "a.npy").write_bytes(b"what was there")
    (tmp_path / "bad.csv").write_text("1,2,3\n", encoding="utf-8")
    for command in ("find", "generate"):
        assert "bad.csv:1:" in refused(command, "bad.csv", "-o", "a.npy")
    refused("find", "shifted:n=99,offset=1e9", "--rule", "chapter32", "-o", "a.npy")


def test_count_keeps_no_pairs_to_write(refused: Refused) -> None:
    line = refused("find", "gas:n=9", "--count", "-o", "a.npy")
    assert "--count" in line and "--output" in line


def test_a_good_run_replaces_the_old_output_and_leaves_nothing_else(
    octocell: Octocell, tmp_path: Path
) -> None:
    (tmp_path / "a.npy").write_bytes(b"what was there")
    octocell.ok("find", "gas:n=300", "-o", "a.npy", cwd=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["a.npy"]
    assert np.load(tmp_path / "a.npy").shape[1] == 2


@pytest.mark.parametrize(
    "arguments",
    [
        ["find", "gas:n=9"],
        ["find", "gas:n=9", "--json"],
        ["check", "gas:n=9"],
        ["list"],
        ["bench", "gas:n=9", "--benchmark_list_tests"],
        ["--help"],
        ["--version"],
        ["find", "--help"],
    ],
)
def test_a_full_standard_output(refused: Refused, arguments: list[str]) -> None:
    with open("/dev/full", "w", encoding="utf-8") as full:
        assert "standard output" in refused(*arguments, stdout=full)
