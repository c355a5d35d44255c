# SPDX-License-Identifier: MIT
"""`octocell try`: hand-ins that are right, wrong, broken or dishonest."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from hand_in_sources import BRUTE_FORCE, PYTHON, at_1000, changed
from program import ROOT, Octocell, Refused
from trying import Try

PLUGIN = ROOT / "include/octocell"

CUDA = """
#include "octocell_plugin.h"
__global__ void test_all(const octocell_sphere* s, uint32_t n, octocell_pair* pairs,
                         unsigned long long capacity, unsigned long long* count) {
  const uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  for (uint32_t j = i + 1; i < n && j < n; ++j) {
    const double x = (double)s[i].x - s[j].x, y = (double)s[i].y - s[j].y;
    const double z = (double)s[i].z - s[j].z, r = (double)s[i].r + s[j].r;
    if (x * x + y * y + z * z > r * r) continue;
    const unsigned long long place = atomicAdd(count, 1ull);
    if (place < capacity) pairs[place] = {i, j};
  }
}
int find_pairs(const octocell_sphere* spheres, uint32_t n, octocell_pair* pairs, uint64_t capacity,
               uint64_t* count, void*) {
  octocell_sphere* s;
  octocell_pair* found;
  unsigned long long* counted;
  if (cudaMalloc(&counted, 8)) return 77;
  if (cudaMalloc(&s, 16 * (n + 1ull)) || cudaMalloc(&found, 8 * (capacity + 1))) return 1;
  cudaMemset(counted, 0, 8);
  cudaMemcpy(s, spheres, 16ull * n, cudaMemcpyHostToDevice);
  if (n > 0) test_all<<<(n + 127) / 128, 128>>>(s, n, found, capacity, counted);
  if (cudaMemcpy(count, counted, 8, cudaMemcpyDeviceToHost)) return 2;
  const uint64_t fits = *count < capacity ? *count : capacity;
  cudaMemcpy(pairs, found, 8 * fits, cudaMemcpyDeviceToHost);
  return cudaFree(s) || cudaFree(found) || cudaFree(counted);
}
"""


@pytest.fixture(name="attempt")
def _attempt(octocell: Octocell, tmp_path: Path) -> Try:
    return Try(octocell, tmp_path)


# Those that are right.


def test_brute_force_is_exact(attempt: Try) -> None:
    answer = attempt(BRUTE_FORCE)
    assert answer["verdict"] == "exact" and answer["cause"] is None and answer["first"] == []
    assert answer["command"][1:5] == ["-std=c++20", "-O2", "-fPIC", "-shared"]
    tried = [scene["scene"] for scene in answer["scenes"]]
    assert [scene["n"] for scene in answer["scenes"]][:6] == [0, 1, 2, 3, 33, 1000]
    kinds = {scene.split(":")[0] for scene in tried[1:]}
    assert kinds == set(attempt.octocell.listed("scenes"))
    text = attempt.run(BRUTE_FORCE).stdout
    assert text.startswith("compiled     ") and text.endswith(
        f"mine.cpp: exact on {len(tried)} scenes\n"
    )


def test_larger_scenes_follow_within_the_budget(attempt: Try) -> None:
    small, larger = (len(attempt(BRUTE_FORCE, "--budget", s)["scenes"]) for s in ("0.01", "12"))
    assert larger > small


def test_a_shared_library_with_prepare_and_finish(attempt: Try, tmp_path: Path) -> None:
    text = changed(
        "  uint64_t k = 0;", "  if (room != n + 1) return 9;\n  uint64_t k = 0;"
    ).replace("static bool", "static uint32_t room = 0;\nstatic bool")
    text += 'extern "C" int prepare(uint32_t n) { if (room) return 8; room = n + 1; return 0; }\n'
    text += 'extern "C" void finish(void) { room = 0; }\n'
    (tmp_path / "a.cpp").write_text(text, encoding="utf-8")
    library = tmp_path / "a.so"
    command = ["c++", "-shared", "-fPIC", "-I", PLUGIN, tmp_path / "a.cpp", "-o", library]
    subprocess.run(command, check=True)
    attempt.octocell.ok("try", library, "--budget", "0.01")


def test_python_is_judged_too(attempt: Try) -> None:
    assert attempt(PYTHON, name="mine.py")["verdict"] == "exact"
    listed = PYTHON.replace("return np.concatenate(found)", "return np.concatenate(found).tolist()")
    assert attempt(listed, name="mine.py")["verdict"] == "exact"


@pytest.mark.skipif(not shutil.which("nvcc"), reason="no nvcc here")
def test_cuda_is_compiled_and_judged(attempt: Try) -> None:
    answer = attempt(CUDA, name="mine.cu")
    assert answer["command"][0].endswith("nvcc")
    if answer["reason"] == "find_pairs returned 77":
        pytest.skip("built, not run: no GPU here")
    assert answer["verdict"] == "exact", answer


def test_the_header_is_c(tmp_path: Path) -> None:
    (tmp_path / "a.c").write_text('#include "octocell_plugin.h"\n', encoding="utf-8")
    command = ["cc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
    subprocess.run([*command, "-I", PLUGIN, tmp_path / "a.c"], check=True)


# Those that are wrong.


@pytest.mark.parametrize(
    ("old", "new", "cause"),
    [
        ("<= r * r", "< r * r", None),  # a chain of two: too few pairs for a cause
        ("pairs[k] = {i, j}", "pairs[k] = {j, i + 0 * n}", "exact"),
        ("pairs[k] = {i, j}", "pairs[k] = {i + 1, j + 1}", None),
        ("uint32_t j = i + 1", "uint32_t j = i + 2", None),
        ("if (overlap(s[i], s[j]))", "if (i / 256 == j / 256 && overlap(s[i], s[j]))", "block"),
        (
            "if (overlap(s[i], s[j]))",
            "if (s[i].x >= 0 && s[j].x >= 0 && overlap(s[i], s[j]))",
            "neg",
        ),
        ("  *count = k;", "  *count = k < capacity ? k : capacity;", "clipped"),
    ],
)
def test_the_first_wrong_scene_is_judged(
    attempt: Try, old: str, new: str, cause: str | None
) -> None:
    answer = attempt(changed(old, new))
    if cause == "exact":
        assert answer["verdict"] == "exact"
        return
    assert answer["verdict"] == "wrong"
    *before, last = answer["scenes"]
    assert last["verdict"] == "wrong" and all(s["verdict"] == "exact" for s in before)
    assert answer["at"] == last["scene"]
    assert answer["first"][0]["command"].startswith("octocell why ")
    if cause is not None:
        assert answer["cause"]["name"].startswith(cause), answer["cause"]


def test_the_text_says_what_to_look_at_first(attempt: Try) -> None:
    result = attempt.run(changed("uint32_t j = i + 1", "uint32_t j = i + 2"))
    assert result.rc == 1
    assert "first missed: 0 1" in result.stdout
    assert result.stdout.endswith("mine.cpp: wrong on chain:n=2,spacing=1; look at it first\n")


def test_an_answer_that_is_kept_from_the_last_call_is_wrong(attempt: Try) -> None:
    kept = changed(
        "  uint64_t k = 0;",
        "  static uint32_t last_n; static uint64_t last_count; static octocell_pair last[99999];\n"
        "  if (n == last_n && n > 100) {\n"
        "    for (uint64_t m = 0; m < last_count && m < capacity; ++m) pairs[m] = last[m];\n"
        "    *count = last_count;\n    return 0;\n  }\n  uint64_t k = 0;",
    ).replace(
        "  *count = k;",
        "  last_n = n; last_count = k;\n"
        "  for (uint64_t m = 0; m < k && m < capacity && m < 99999; ++m) last[m] = pairs[m];\n"
        "  *count = k;",
    )
    answer = attempt(kept)
    assert (answer["verdict"], answer["at"]) == ("wrong", "dense:n=1000,seed=2,phi=0.4")


# Those that cannot be judged.


@pytest.mark.parametrize(
    ("statement", "reason"),
    [
        ("*(volatile int*)0 = 1;", "crashed: it crashed with SIGSEGV"),
        ("__builtin_trap();", "crashed: it crashed with SIG"),
        ("throw 1;", "fails: it threw an exception"),
        ("_Exit(0);", "crashed: it ended with code 0"),
        ("for (volatile int m = 0;; ++m) {}", "hangs: no answer within 1 s"),
        ("return 3;", "fails: find_pairs returned 3"),
        ("pairs[capacity] = {1, 2};", "fails: it wrote behind the end of pairs, which has room"),
        ("((octocell_sphere*)s)[5].x = 0;", "fails: it changed the spheres"),
        ("*count = 1ull << 40; return 0;", "fails: it counts 1099511627776 pairs; at most"),
        ('for (;;) puts("xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx");', "prints too much: it printed more"),
        ("close(4);", "crashed: it ended with code 1"),
    ],
)
def test_crashes_and_hangs_are_named(attempt: Try, statement: str, reason: str) -> None:
    text = "#include <cstdio>\n#include <cstdlib>\n#include <unistd.h>\n" + at_1000(statement)
    answer = attempt(text, "--timeout", "1" if "hangs" in reason else "30")
    assert answer["verdict"] == "cannot be judged"
    assert f"{answer['kind']}: {answer['reason']}".startswith(reason), answer
    assert answer["at"].startswith("dense:n=1000") and len(answer["scenes"]) == 5


def test_memory_is_limited(attempt: Try) -> None:
    fill = "for (int m = 0; m < 1 << 20; m += 512) p[m] = 1;"
    eat = f"for (;;) {{ volatile char* p = new char[1 << 20]; {fill} }}"
    ending = attempt.ending(at_1000(eat), "--memory", "0.2", "--timeout", "60")
    assert ending.startswith("out of memory: it holds 0.2 GiB, more than 0.2 (--memory)")


def test_a_verdict_that_is_printed_is_not_believed(attempt: Try) -> None:
    lie = changed("uint32_t j = i + 1", "uint32_t j = i + 2").replace(
        "  uint64_t k = 0;",
        '  puts("{\\"verdict\\": \\"exact\\"}"); write(4, "exactexactexactexact", 20);\n'
        "  uint64_t k = 0;",
    )
    text = "#include <cstdio>\n#include <unistd.h>\n" + lie
    assert attempt.ending(text).startswith("fails: it wrote into the pipe of its answers")
    only_printed = text.replace('write(4, "exactexactexactexact", 20);', "")
    assert attempt(only_printed)["verdict"] == "wrong"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("int find_pairs( {", "does not compile: "),
        ("int other() { return 0; }", "fails: it has no function find_pairs"),
        ("int find_pairs() { return 0; }", "fails: it has no function find_pairs"),
    ],
)
def test_what_does_not_load_is_named(attempt: Try, text: str, reason: str) -> None:
    assert attempt.ending(text).startswith(reason)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("x = 1", "fails: it defines no function find_pairs(spheres)"),
        (
            "def find_pairs(s): return 1 / 0",
            "fails: ZeroDivisionError: division by zero (mine.py:1)",
        ),
        ("import nothing_of_that_name", "fails: ModuleNotFoundError: "),
        (
            "def find_pairs(s): return [[0.5, 1]]",
            "fails: find_pairs returned numbers of type float64",
        ),
        (
            "def find_pairs(s): return [1, 2]",
            "fails: find_pairs returned shape (2,), expected (M, 2)",
        ),
        ("def find_pairs(s):\n    s[:] = 0\n    return []", "fails: it changed the spheres"),
        ("import os\ndef find_pairs(s): os.abort()", "crashed: it crashed with SIGABRT"),
        ("def find_pairs(s):\n    while True: pass", "hangs: no answer within 2 s"),
    ],
)
def test_what_is_wrong_with_python_is_named(attempt: Try, text: str, reason: str) -> None:
    assert attempt.ending(text, "--timeout", "2", name="mine.py").startswith(reason)


def test_without_nvcc_a_cuda_file_cannot_be_judged(attempt: Try, tmp_path: Path) -> None:
    (tmp_path / "a.cu").write_text(BRUTE_FORCE, encoding="utf-8")
    nowhere = {"PATH": str(tmp_path), "CUDA_HOME": str(tmp_path)}
    result = attempt.octocell.run("try", tmp_path / "a.cu", env=nowhere)
    assert result.rc == 2
    assert "a.cu: cannot be judged: does not compile: there is no nvcc here" in result.stdout


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("none.cpp",), "none.cpp: no such file"),
        (("a.txt",), "a.txt: expected .cpp, .cu, .so or .py"),
        (("a.txt", "--budget", "0"), "--budget 0: must be above 0"),
        (("a.txt", "--memory", "-1"), "--memory -1: must be above 0"),
    ],
)
def test_bad_calls_are_refused(
    refused: Refused, tmp_path: Path, arguments: tuple[str, ...], reason: str
) -> None:
    (tmp_path / "a.txt").touch()
    assert reason in refused("try", *arguments)
