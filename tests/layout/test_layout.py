# SPDX-License-Identifier: MIT
"""Every backend and the docs have the same six stages in the same order."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NOT_OURS = {"data", "dist", "out", "__pycache__"}  # and what begins with a dot or "build"
CPP = {".cpp", ".hpp", ".cu", ".cuh"}
SOURCES = CPP | {".py", ".sh"}
MOST_LINES, MANY_LINES = 500, 350

IMPLEMENTATIONS = sorted(path for path in ROOT.glob("impl_*") if path.is_dir())
BACKENDS = tuple(f"{path.name}/" for path in IMPLEMENTATIONS)

# What the files of a folder may include besides their own folder's. The longest name counts, so a
# line for core/planner speaks of that folder alone. Nothing points back up.
MAY_INCLUDE: dict[str, tuple[str, ...]] = {
    "include/": (),
    "core/": (),
    "core/planner/": ("core/",),
    **dict.fromkeys(BACKENDS, ("core/",)),
    "baselines/": ("core/",),
    "course/": ("core/", "core/planner/"),
    "harness/scenes/": ("core/",),
    "harness/files/": ("core/", "harness/scenes/"),
    "harness/plugin/": ("core/", "include/"),
    "harness/engine/": ("core/", "core/planner/", "harness/plugin/", *BACKENDS, "baselines/"),
    "library/": ("core/", "core/planner/", "harness/engine/"),
    "python/": ("core/available_memory.hpp",),
    "harness/trace/": ("core/", "core/planner/"),
    "harness/verify/reference/": ("core/", "harness/scenes/scene.hpp"),
    "harness/verify/near_tangent/": ("core/",),
    "harness/verify/stress/": (
        "core/",
        "core/planner/",
        "harness/scenes/",
        "harness/files/",
        "harness/engine/",
        "harness/verify/reference/",
    ),
    "harness/judge/": (
        "core/",
        "core/planner/",
        "harness/scenes/",
        "harness/files/",
        "harness/trace/",
        "harness/verify/reference/",
    ),
    "harness/try/": (
        "core/",
        "harness/scenes/",
        "harness/files/",
        "harness/plugin/",
        "harness/engine/",
        "harness/judge/",
        "harness/verify/reference/",
        "harness/verify/stress/",
        "include/",
    ),
    "harness/doctor/": ("core/", "harness/try/"),
    "harness/bench/": (
        "core/",
        "core/planner/",
        *BACKENDS,
        "baselines/",
        "harness/scenes/",
        "harness/files/",
        "harness/engine/",
        "harness/verify/reference/",
    ),
}
# These see the library as its users do.
MAY_INCLUDE["examples/"] = ()
# These stand on all of the above.
MAY_INCLUDE["harness/cli/"] = tuple(folder for folder in MAY_INCLUDE if folder not in BACKENDS)
MAY_INCLUDE["tests/"] = tuple(folder for folder in MAY_INCLUDE if folder != "harness/cli/")
# What a backend needs of the planner: stage 1 is the planner's pass over the scene, in parallel,
# and each frame shows how wide a skin the next ones need.
PLANNERS_PARTS = {"core/planner/scene_stats.hpp", "core/planner/skin_width.hpp"}
OUR_FOLDERS = {name.split("/")[0] for name in MAY_INCLUDE}


def files(folder: Path = ROOT, suffixes: set[str] = SOURCES) -> Iterator[Path]:
    for path in sorted(folder.iterdir()):
        if path.is_dir() and path.name not in NOT_OURS and not path.name.startswith((".", "build")):
            yield from files(path, suffixes)
        elif path.is_file() and path.suffix in suffixes:
            yield path


def name_of(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@cache
def stages() -> list[str]:
    """The words of our own backends, in order, as the interface spells them."""
    text = (ROOT / "core/stage.hpp").read_text(encoding="utf-8")
    body = re.search(r"enum class Stage[^{]*\{(.*?)\};", text, re.DOTALL)
    names = re.search(r"kStageNames = \{(.*?)\};", text, re.DOTALL)
    assert body and names
    words = re.findall(r"^\s*(\w+),", body[1], re.MULTILINE)
    assert re.findall(r'"(\w+)"', names[1]) == words, "enumerators and their names differ"
    ours, _, baselines = body[1].partition("// baselines")
    assert baselines, "stage.hpp no longer says where the baselines' stages begin"
    return re.findall(r"^\s*(\w+),", ours, re.MULTILINE)


def stage_files() -> list[tuple[Path, int, str]]:
    """(file, number, word) for each backend's files named stage*."""
    found = []
    for folder in IMPLEMENTATIONS:
        for path in files(folder, CPP):
            if match := re.fullmatch(r"stage(\d+)_(\w+)", path.stem):
                found.append((path, int(match[1]), match[2]))
    return found


def includes(path: Path) -> list[str]:
    text = path.read_text(encoding="utf-8")
    return re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', text, re.MULTILINE)


def is_ours(included: str) -> bool:
    return included.split("/")[0] in OUR_FOLDERS


@cache
def reached_from(path: Path) -> frozenset[str]:
    """Our own files that `path` includes, directly or through others."""
    reached: set[str] = set()
    waiting = [path]
    while waiting:
        for included in includes(waiting.pop()):
            if included not in reached and (ROOT / included).is_file():
                reached.add(included)
                waiting.append(ROOT / included)
    return frozenset(reached)


def test_there_are_six_stages_and_a_backend() -> None:
    assert stages() == ["bounds", "cell_ids", "sort", "cell_index", "pair_tests", "resolve"]
    assert IMPLEMENTATIONS


@pytest.mark.parametrize("folder", IMPLEMENTATIONS, ids=lambda path: path.name)
def test_every_backend_has_the_stages_as_files(folder: Path) -> None:
    stems = [path.stem for path in files(folder, CPP) if path.stem.startswith("stage")]
    numbered = [f"stage{k}_{word}" for k, word in enumerate(stages(), 1)]
    assert sorted(stem for stem in stems if stem != "stages") == numbered


@pytest.mark.parametrize(("path", "number", "word"), stage_files(), ids=lambda x: str(x))
def test_stage_files_open_with_the_four_lines(path: Path, number: int, word: str) -> None:
    opening: list[str] = []
    for line in path.read_text(encoding="utf-8").splitlines()[1:]:
        if not line.startswith("//"):
            break
        if re.match(r"//  +\S", line):  # goes on from the line before
            opening[-1] += " " + line[2:].strip()
        else:
            opening.append(line)
    expected = [
        rf"// Stage {number}, {word}: \S.*",
        r"// Reads (and writes \S.*|.*\bWrites \S.*)",
        r"// Cost: \S.*",
        r"// Idea: \S.*",
    ]
    assert len(opening) == 4, opening
    for line, pattern in zip(opening, expected, strict=True):
        assert re.fullmatch(pattern, line), f"{name_of(path)}: {line!r} is not {pattern!r}"


@pytest.mark.parametrize(("path", "number", "word"), stage_files(), ids=lambda x: str(x))
def test_stage_files_define_the_function_of_their_name(path: Path, number: int, word: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert re.search(rf"^\w[\w:<> ]*\b{word}\(", text, re.MULTILINE), f"no {word}() here"


def test_docs_have_one_chapter_per_stage() -> None:
    chapters = {path.name: path for path in (ROOT / "docs/stages").glob("[0-9]*.md")}
    chapters = {name: path for name, path in chapters.items() if "zh-CN" not in name}
    assert sorted(chapters) == [f"{k}_{word}.md" for k, word in enumerate(stages(), 1)]
    for k, word in enumerate(stages(), 1):
        title = chapters[f"{k}_{word}.md"].read_text(encoding="utf-8").partition("\n")[0]
        assert title.startswith("# "), title
        assert str(k) in title and word in title, title


def test_registry_names_are_folder_names() -> None:
    tables = ("registry.cpp", "fast_backends.hpp")
    text = "".join((ROOT / "harness/engine" / name).read_text(encoding="utf-8") for name in tables)
    backends = re.findall(r'\.name = "(\w+)",\s*\.kind = Kind::backend', text)
    folders = sorted({name.removesuffix("_cuda") for name in backends})
    assert folders == [path.name for path in IMPLEMENTATIONS]
    table = (ROOT / "baselines/all.cpp").read_text(encoding="utf-8")
    baselines = re.findall(r'^    \{"(\w+)",', table, re.MULTILINE)
    libraries = [path.name for path in (ROOT / "baselines").iterdir() if path.is_dir()]
    assert baselines
    for name in baselines:
        assert name.split("_")[0] in libraries, name


def test_no_source_file_is_too_long() -> None:
    lengths = {name_of(path): len(path.read_bytes().splitlines()) for path in files()}
    for name, lines in lengths.items():
        if MANY_LINES < lines <= MOST_LINES:
            warnings.warn(f"{name}: {lines} lines, aim for {MANY_LINES}", stacklevel=1)
    too_long = {name: lines for name, lines in lengths.items() if lines > MOST_LINES}
    assert not too_long


def test_sources_begin_with_their_licence() -> None:
    for path in files():
        lines = path.read_text(encoding="utf-8").splitlines()
        mark = "//" if path.suffix in CPP else "#"
        first = lines[1] if lines[0].startswith("#!") and mark == "#" else lines[0]
        assert first == f"{mark} SPDX-License-Identifier: MIT", name_of(path)


def folder_of(name: str) -> str:
    """The longest entry of MAY_INCLUDE that `name` lies in."""
    return max((folder for folder in MAY_INCLUDE if name.startswith(folder)), key=len)


def may_include(includer: str, included: str) -> bool:
    here, there = folder_of(includer), folder_of(included)
    if here == there:
        return True
    if there == "include/":  # what spheres, pairs and errors are
        return here != "examples/"
    if here in BACKENDS and included in PLANNERS_PARTS:
        return True
    allowed = MAY_INCLUDE[here]
    return there in allowed or included in allowed


@pytest.mark.parametrize("folder", MAY_INCLUDE)
def test_includes_point_one_way(folder: str) -> None:
    """include <- core <- planner, backends, baselines <- harness, as docs/architecture.md says."""
    for path in files(ROOT / folder, CPP):
        name = name_of(path)
        for included in includes(path):
            if folder_of(name) == folder and is_ours(included):
                assert may_include(name, included), f"{name} includes {included}"


def test_every_source_lies_in_a_folder_of_the_table() -> None:
    for path in files(suffixes=CPP):
        assert any(name_of(path).startswith(folder) for folder in MAY_INCLUDE), name_of(path)


def test_an_arrow_back_up_is_noticed() -> None:
    assert not may_include("core/grid.hpp", "core/planner/planner.hpp")
    assert not may_include("impl_cpu/backend.cpp", "harness/scenes/scenes.hpp")
    assert not may_include("impl_cpu/backend.cpp", "impl_thrust/backend.hpp")
    assert not may_include("impl_cpu/backend.cpp", "core/planner/planner.hpp")
    assert not may_include("harness/scenes/gas.cpp", "harness/files/load.hpp")
    assert not may_include("harness/verify/reference/depth.cpp", "harness/scenes/scenes.hpp")
    assert not may_include("harness/engine/registry.cpp", "harness/bench/rows.hpp")
    assert not may_include("include/octocell/octocell.hpp", "core/finder.hpp")
    assert not may_include("harness/engine/registry.cpp", "library/search.hpp")
    assert not may_include("library/finder.cpp", "harness/files/load.hpp")
    assert may_include("core/sphere.hpp", "include/octocell/types.hpp")
    assert may_include("harness/cli/main.cpp", "harness/bench/rows.hpp")
    assert may_include("impl_cpu/stage1_bounds.cpp", "core/planner/scene_stats.hpp")


def test_the_reference_shares_no_formula_with_the_backends() -> None:
    formulas = {f"core/{name}.hpp" for name in ("overlap", "depth", "grid", "chapter32", "flags")}
    for path in files(ROOT / "harness/verify/reference", CPP):
        assert not reached_from(path) & formulas, name_of(path)


def test_includes_name_files_from_the_root() -> None:
    generated = {"git_revision.hpp", "tests/mutation/fault_table.hpp"}
    for path in files(suffixes=CPP):
        text = path.read_text(encoding="utf-8")
        for included in re.findall(r'^#include "([^"]+)"', text, re.MULTILINE):
            # Built in its folder, by one command; the installed headers lie side by side, and `octocell
            # try` adds their folder.
            alone = name_of(path).startswith(("course/", "examples/", "include/"))
            folders = (ROOT, path.parent, ROOT / "include/octocell") if alone else (ROOT,)
            there = included in generated or any((f / included).is_file() for f in folders)
            assert there, f"{name_of(path)} includes {included}"


def test_only_the_bench_and_the_command_line_print() -> None:
    may_print = ("harness/bench/", "harness/cli/", "tests/", "course/", "examples/")
    for path in files(suffixes=CPP):
        if name_of(path).startswith(may_print):
            continue
        text = re.sub(r"//.*", "", path.read_text(encoding="utf-8"))
        prints = re.search(r"fmt::print|std::(cout|cerr)|\b(f?printf|f?puts)\(", text)
        assert not prints, f"{name_of(path)}: {prints and prints[0]}"


def test_no_work_is_left_marked_in_the_sources() -> None:
    for path in files():
        if path == Path(__file__).resolve():
            continue
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"\b(TODO|FIXME|XXX)\b|#if 0\b", text), name_of(path)
