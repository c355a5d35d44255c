# SPDX-License-Identifier: MIT
"""The library as programs use it: from the installed tree, by CMake and by pkg-config."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from program import ROOT, module_of
from users_build import checked, users_build

EXAMPLES = ROOT / "examples"
PAGE = ROOT / "docs/how_to/call_from_cpp.md"
show_examples = module_of(ROOT / "scripts/show_examples.py")

RUNTIME = {"libstdc++.so.6", "libm.so.6", "libgcc_s.so.1", "libc.so.6", "libpthread.so.0"}
# A function or a table of the library; what stands behind its name is of no interest.
VISIBLE = re.compile(
    r"(?:(?:typeinfo|typeinfo name|vtable) for )?(octocell_\w+|octocell::[\w:~]+=?)(?:[\[(].*)?"
)
STRICT = ("-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror")


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Installed in one place and moved to another: nothing in it may name the first."""
    folder = tmp_path_factory.mktemp("installed")
    checked("cmake", "--install", users_build(), "--prefix", folder / "first")
    return (folder / "first").rename(folder / "moved")


@pytest.fixture(scope="module")
def library(installed: Path) -> Path:
    return next(installed.rglob("liboctocell.so.*.*.*"))


@pytest.fixture(scope="module")
def programs(installed: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The examples, built as their CMakeLists.txt says."""
    folder = tmp_path_factory.mktemp("examples")
    strict = [f"-DCMAKE_{language}_FLAGS={' '.join(STRICT)}" for language in ("C", "CXX")]
    prefix = f"-DCMAKE_PREFIX_PATH={installed}"
    checked("cmake", "-S", EXAMPLES, "-B", folder, "-G", "Ninja", prefix, *strict)
    checked("cmake", "--build", folder)
    return folder


def names_of(library: Path) -> list[str]:
    """What a program can see of the library."""
    text = checked("nm", "-DC", "--defined-only", library)
    return [line.split(maxsplit=2)[2] for line in text.splitlines()]


def pkg_config(installed: Path, *asked: str) -> list[str]:
    folder = next(installed.rglob("octocell.pc")).parent
    environment = {**os.environ, "PKG_CONFIG_PATH": str(folder)}
    return checked("pkg-config", *asked, "octocell", env=environment).split()


def test_the_page_shows_every_example_as_it_is() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert show_examples.with_examples(text) == text, "run scripts/show_examples.py"
    files = {f"examples/{path.name}" for path in EXAMPLES.glob("*.c*")}
    assert show_examples.examples_in(text) == files


def test_the_programs_print_what_the_page_says(programs: Path) -> None:
    outputs = show_examples.outputs_in(PAGE.read_text(encoding="utf-8"))
    assert outputs.keys() == {path.stem for path in EXAMPLES.glob("*.cpp")}
    for name, output in outputs.items():
        assert checked(programs / name) == output, name
    for same in ("find_pairs_static", "find_pairs_c"):
        assert checked(programs / same) == outputs["find_pairs"], same


def test_the_static_kind_needs_no_shared_library_of_ours(programs: Path) -> None:
    assert "octocell" in checked("ldd", programs / "find_pairs")
    assert "octocell" not in checked("ldd", programs / "find_pairs_static")


def test_pkg_config_is_enough(installed: Path, library: Path, tmp_path: Path) -> None:
    program = tmp_path / "find_pairs"
    flags = pkg_config(installed, "--cflags", "--libs")
    checked("cc", "-std=c99", *STRICT, EXAMPLES / "find_pairs.c", "-o", program, *flags)
    environment = {**os.environ, "LD_LIBRARY_PATH": str(library.parent)}
    outputs = show_examples.outputs_in(PAGE.read_text(encoding="utf-8"))
    assert checked(program, env=environment) == outputs["find_pairs"]


def test_the_shared_library_names_its_release(installed: Path, library: Path) -> None:
    release = pkg_config(installed, "--modversion")[0]
    major, minor, _ = release.split(".")
    assert library.name == f"liboctocell.so.{release}"
    assert f"[liboctocell.so.{major}.{minor}]" in checked("readelf", "-d", library)
    assert (library.parent / "liboctocell.so").resolve() == library
    assert (library.parent / f"liboctocell.so.{major}.{minor}").resolve() == library


def test_it_needs_the_runtime_only(library: Path) -> None:
    needed = set(re.findall(r"\(NEEDED\).*\[(.+)\]", checked("readelf", "-d", library)))
    assert {name for name in needed if not name.startswith("ld-linux")} <= RUNTIME


def test_programs_see_what_the_headers_declare(installed: Path, library: Path) -> None:
    headers = "".join(path.read_text() for path in (installed / "include/octocell").iterdir())
    names = names_of(library)
    assert any(name.startswith("octocell::find_pairs(") for name in names)
    assert "octocell_find_pairs" in names
    for name in names:
        words = VISIBLE.fullmatch(name)
        assert words, name
        last = words[1].split("::")[-1]
        assert re.search(rf"(?<!\w){re.escape(last)}(?!\w)", headers), f"no header has {name}"


@pytest.mark.parametrize(
    ("language", "compiler", "standard", "header"),
    [
        ("c++", "c++", "-std=c++20", "octocell.hpp"),
        ("c++", "clang++", "-std=c++20", "octocell.hpp"),
        ("c++", "c++", "-std=c++20", "octocell.h"),
        ("c", "cc", "-std=c99", "octocell.h"),
    ],
)
def test_headers_stand_alone(
    installed: Path, language: str, compiler: str, standard: str, header: str
) -> None:
    include = installed / "include"
    command = f"{compiler} {standard} -I{include} -x {language} -fsyntax-only -H -".split()
    if shutil.which(compiler) is None:
        pytest.skip(f"no {compiler} here")
    done = subprocess.run(
        [*command, *STRICT],
        input=f"#include <octocell/{header}>\n",
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    read = {line.lstrip(". ") for line in done.stderr.splitlines() if line.startswith(".")}
    ours = {name for name in read if "octocell" in name}
    assert ours and all(Path(name).parent == include / "octocell" for name in ours), ours
    assert not any(word in name for name in read for word in ("fmt", "boost", "nlohmann"))


def test_nothing_names_the_place_of_the_build(installed: Path) -> None:
    for path in installed.rglob("*"):
        if path.suffix in {".cmake", ".pc", ".h", ".hpp"}:
            text = path.read_text(encoding="utf-8")
            assert str(ROOT) not in text and "/first" not in text, path


def test_the_command_line_is_installed_too(installed: Path) -> None:
    assert "impl_cpu" in checked(installed / "bin/octocell", "list")


def test_another_minor_release_is_not_accepted(installed: Path, tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.22)\n"
        "project(p CXX)\n"
        "find_package(octocell 0.0 REQUIRED)\n"
    )
    command = ["cmake", "-S", tmp_path, "-B", tmp_path / "b", f"-DCMAKE_PREFIX_PATH={installed}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode != 0 and "version: 0.1.0" in done.stderr, done.stderr
