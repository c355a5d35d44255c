# SPDX-License-Identifier: MIT
"""`octocell bench-sort`: its JSON, its flags, Ctrl-C, and what it refuses."""

from __future__ import annotations

import signal
import subprocess
import time
from pathlib import Path
from statistics import median

import pytest

from program import Json, Octocell, Refused, load

ROUNDS = 2
TINY = ("--device", "cpu", "--rounds", ROUNDS, "--threads", 2, "--filter", "n:4096/bits:(8|32)/")
ROW = """name algorithm device n bits order threads stable packed status reason iterations total_ms
items_per_second_median""".split()
SORTS = {  # name: stable, packed, thread counts; the last two may be missing from a build
    "impl_cpu": (True, False, [1, 2]),
    "std_sort": (False, True, [1]),
    "std_stable_sort": (True, True, [1]),
    "boost_spreadsort": (False, True, [1]),
    "tbb_parallel_sort": (False, True, [1, 2]),
    "highway_vqsort": (False, True, [1]),
}
OPTIONAL = {"tbb_parallel_sort": "tbb", "highway_vqsort": "highway"}


@pytest.fixture(scope="module")
def tiny(octocell: Octocell, tmp_path_factory: pytest.TempPathFactory) -> Json:
    path = tmp_path_factory.mktemp("sort") / "new_folder" / "x.json"
    result = octocell.ok("bench-sort", "-o", path, *TINY)
    assert result.stdout == ""
    assert result.stderr.startswith("[1/") and str(path) in result.stderr
    assert [other.name for other in path.parent.iterdir()] == ["x.json"]
    return load(path)


def test_document(tiny: Json) -> None:
    assert list(tiny) == ["schema", "kind", "context", "rows"]
    assert (tiny["schema"], tiny["kind"]) == (2, "sort")
    context = tiny["context"]
    assert set(context["libraries"]) == {"boost", "tbb", "highway"}
    assert (context["preset"], context["rounds"], context["finished"]) == ("quick", ROUNDS, True)
    assert (context["device"], context["gpu"], context["gpu_reason"]) == ("cpu", None, None)
    assert {"date", "commit", "dirty", "machine", "compiler", "flags"} <= set(context)


def test_every_sort_has_its_rows(tiny: Json) -> None:
    assert len({row["name"] for row in tiny["rows"]}) == len(tiny["rows"])
    for name, (stable, packed, threads) in SORTS.items():
        rows = [row for row in tiny["rows"] if row["algorithm"] == name]
        assert {row["bits"] for row in rows} == {8, 32}
        for bits in (8, 32):
            assert [row["threads"] for row in rows if row["bits"] == bits] == threads
        assert {(row["stable"], row["packed"]) for row in rows} == {(stable, packed)}
    assert {row["algorithm"] for row in tiny["rows"]} == set(SORTS)


def test_every_row_is_right_or_its_library_is_missing(tiny: Json) -> None:
    for row in tiny["rows"]:
        assert list(row) == ROW
        library = OPTIONAL.get(row["algorithm"])
        if library and tiny["context"]["libraries"][library] is None:
            assert row["status"] == "skipped" and "built without" in row["reason"]
            assert (row["total_ms"], row["items_per_second_median"]) == ([], None)
            continue
        assert (row["status"], row["reason"]) == ("ok", None)
        assert len(row["total_ms"]) == ROUNDS and min(row["total_ms"]) > 0
        assert row["iterations"] >= 1
        rate = row["n"] / (median(row["total_ms"]) / 1e3)
        assert row["items_per_second_median"] == pytest.approx(rate)


def test_names_are_keys_with_values(tiny: Json) -> None:
    for row in tiny["rows"]:
        head, *parts = row["name"].split("/")
        keys = "algorithm n bits order threads".split()
        assert head == "sort"
        assert dict(part.split(":") for part in parts) == {key: str(row[key]) for key in keys}


def test_every_input_order_is_sorted_rightly(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    rows = "n:4096/bits:(12|17|24)/"
    options = ("--device", "cpu", "--preset", "full", "--rounds", 1)
    octocell.ok("bench-sort", *options, "--filter", rows, "-o", path)
    document = load(path)
    orders = {row["order"] for row in document["rows"]}
    assert orders == {"random", "sorted", "reversed", "constant", "few_distinct"}
    assert {row["status"] for row in document["rows"]} <= {"ok", "skipped"}


GPU_SORTS = [
    *("cuda_one_bit_split", "cuda_digit_passes", "cuda_reduce_then_scan", "cuda_onesweep"),
    "cub",
]


def test_a_gpu_has_its_rows_or_the_reason_is_given(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    rows = "n:4096/bits:(8|32)/order:random/threads:[01]"
    result = octocell.ok("bench-sort", "--rounds", 3, "--filter", rows, "-o", path)
    document = load(path)
    found = [row for row in document["rows"] if row["device"] == "gpu"]
    reason = document["context"]["gpu_reason"]
    if reason is not None:
        assert f"no rows on a GPU: {reason}" in result.stderr
        assert document["context"]["gpu"] is None and found == []
        return
    assert document["context"]["gpu"]["copy_gigabytes_per_second"] > 0
    assert [row["algorithm"] for row in found if row["bits"] == 32] == GPU_SORTS
    for row in found:
        assert list(row) == ROW
        assert (row["status"], row["threads"], len(row["total_ms"])) == ("ok", 0, 3)


def test_rows_on_a_gpu_alone_need_one(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    rows = "n:4096/bits:32/order:random"
    octocell.ok("bench-sort", "--rounds", 1, "--filter", rows, "-o", path)
    reason = load(path)["context"]["gpu_reason"]
    command = [str(octocell.path), "bench-sort", "--device", "gpu", "--rounds", "1"]
    command += ["--filter", rows, "-o", str(tmp_path / "y.json")]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if reason is None:
        assert result.returncode == 0
        assert {row["device"] for row in load(tmp_path / "y.json")["rows"]} == {"gpu"}
        return
    assert result.returncode == 2 and reason in result.stderr
    assert not (tmp_path / "y.json").exists()


def test_a_comparison_sort_of_a_large_size_says_why_it_was_left_out(
    octocell: Octocell, tmp_path: Path
) -> None:
    path = tmp_path / "x.json"
    octocell.ok("bench-sort", "--filter", "std_sort/n:4194304/bits:16", "-o", path)
    (row,) = load(path)["rows"]
    assert (row["status"], row["total_ms"]) == ("skipped", [])
    assert "--preset full" in row["reason"]


def test_ctrl_c_keeps_the_whole_cases(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    options = ["--device", "cpu", "--rounds", "2", "--threads", "2", "-o", str(path)]
    command = [str(octocell.path), "bench-sort", *options]
    bench = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    until = time.monotonic() + 30
    while time.monotonic() < until and not (path.exists() and load(path)["rows"]):
        time.sleep(0.01)
    bench.send_signal(signal.SIGINT)
    _, err = bench.communicate(timeout=30)
    assert bench.returncode == 130
    assert "interrupted" in err and str(path) in err
    assert [other.name for other in tmp_path.iterdir()] == ["x.json"]
    document = load(path)
    assert document["context"]["finished"] is False
    rows = sum(len(threads) for _, _, threads in SORTS.values())
    assert document["rows"] and len(document["rows"]) % rows == 0
    assert all(len(row["total_ms"]) == 2 for row in document["rows"] if row["status"] == "ok")


REFUSALS = {
    "unknown_preset": (["--preset", "slow"], ["'slow'", "quick, full"]),
    "rounds_zero": (["--rounds", "0"], ["--rounds"]),
    "rounds_word": (["--rounds", "two"], ["--rounds", "two"]),
    "threads_negative": (["--threads", "-1"], ["--threads -1"]),
    "threads_many": (["--threads", "100000"], ["--threads 100000"]),
    "bad_filter": (["--filter", "("], ["'('"]),
    "filter_without_rows": (["--filter", "nothing"], ["'nothing'"]),
    "unknown_device": (["--device", "tpu"], ["'tpu'", "cpu, gpu, all"]),
    "unknown_flag": (["--nothing"], ["--nothing"]),
    "stray_word": (["gas:n=9"], ["gas:n=9"]),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_refusals_leave_the_old_output(refused: Refused, tmp_path: Path, name: str) -> None:
    (tmp_path / "old.json").write_text("what was there", encoding="utf-8")
    arguments, words = REFUSALS[name]
    line = refused("bench-sort", *arguments, "-o", "old.json")
    assert all(word in line for word in words), line


@pytest.mark.parametrize("target", ["plain/x.json", "folder", "/dev/full"])
def test_outputs_that_cannot_be_written(refused: Refused, tmp_path: Path, target: str) -> None:
    (tmp_path / "plain").write_text("a file", encoding="utf-8")
    (tmp_path / "folder").mkdir()
    line = refused("bench-sort", "-o", target)
    assert "cannot write" in line and target in line
