# SPDX-License-Identifier: MIT
"""`octocell bench`: the JSON that the reports read, its flags, Ctrl-C, and what it refuses."""

from __future__ import annotations

import re
import signal
import subprocess
import time
from collections import Counter
from pathlib import Path

import pytest

from program import Json, Octocell, Refused, load

ROUNDS = 2
RUNS = ("cold", "warm", "first_update", "update")  # of a baseline
DEVICE_RUNS = ("cold_cache", "graph", "transfers")
TINY = ("--rounds", ROUNDS, "--benchmark_min_time=0.001")
BACKEND_STAGES = ["bounds", "cell_ids", "sort", "cell_index", "pair_tests", "resolve"]
CONTEXT = """date commit dirty version machine compiler flags instruction_set build_type libraries
preset rounds candidate_limit gpu finished""".split()
GROUP = "scene n spec real unavailable frames scene_class input_rounding truth".split()
ROW = """name backend kind method rule predicate skips scene n threads run negative_control known_issues
status reason pairs checksum missed false duplicates worst_missed_depth worst_false_gap
distinct_checksums candidates uncertain_pairs iterations total_ms stage_ms marked_total_ms
plan_ms plan fused stage_bytes peak_bytes device_bytes output_bytes""".split()


@pytest.fixture(scope="module")
def tiny(octocell: Octocell, tmp_path_factory: pytest.TempPathFactory) -> Json:
    path = tmp_path_factory.mktemp("bench") / "new_folder" / "x.json"
    result = octocell.ok("bench", "gas:n=500", "-o", path, *TINY)
    assert result.stdout == ""
    assert result.stderr.startswith("[1/") and str(path) in result.stderr
    assert [other.name for other in path.parent.iterdir()] == ["x.json"]
    return load(path)


def test_context(tiny: Json) -> None:
    assert tiny["schema"] == 2
    context = tiny["context"]
    assert set(CONTEXT) <= set(context)
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", context["date"])
    assert list(context["machine"]) == ["name", "cpu", "cores", "memory_bytes", "os"]
    assert all(context["machine"].values())
    assert {"fcl", "bullet"} <= set(context["libraries"])
    assert (context["preset"], context["rounds"], context["finished"]) == ("custom", ROUNDS, True)
    assert isinstance(context["dirty"], bool)
    assert context["commit"] == "unknown" or re.fullmatch("[0-9a-f]{7,40}", context["commit"])


def test_group(tiny: Json, octocell: Octocell) -> None:
    (group,) = tiny["groups"]
    assert list(group) == GROUP
    answer = octocell.find("gas:n=500")
    assert group == {
        "scene": "gas",
        "n": 500,
        "spec": answer["scene"],
        "real": False,
        "unavailable": None,
        "frames": 1,
        "scene_class": None,
        "input_rounding": None,
        "truth": {"pairs": answer["pairs"], "checksum": answer["checksum"]},
    }


def test_every_implementation_has_its_rows(tiny: Json, octocell: Octocell) -> None:
    rows = {(r["backend"], r["method"], r["rule"], r["run"]) for r in tiny["rows"]}
    expected: set[tuple[str | None, ...]] = set()
    for _, backend, *how in octocell.implementations():
        if not how:
            expected |= {(backend, None, None, run) for run in RUNS}
            continue
        method, rule = ("home_phantom", how[1]) if how[0] == "--rule" else (how[1], None)
        runs = ("cold", "warm", *(DEVICE_RUNS if backend == "impl_cuda_custom" else ()))
        expected |= {(backend, method, rule, run) for run in runs}
    assert rows == expected
    assert Counter(r["name"] for r in tiny["rows"]).most_common(1)[0][1] == 1


def test_names_are_keys_with_values(tiny: Json) -> None:
    for row in tiny["rows"]:
        head, *parts = row["name"].split("/")
        assert head == "find_pairs"
        named = dict(part.split(":") for part in parts)
        keys = "backend method rule predicate skips scene n threads run".split()
        silent = (None, "exact")  # the default predicate goes without saying
        assert named == {key: str(row[key]) for key in keys if row[key] not in silent}
        assert list(named) == [key for key in keys if key in named]


@pytest.fixture
def tiny_runs(tiny: Json, octocell: Octocell) -> list[Json]:
    """Rows of what can run here."""
    return [row for row in tiny["rows"] if row["backend"] not in octocell.unavailable()]


def test_rows_of_what_cannot_run_here_say_why(tiny: Json, octocell: Octocell) -> None:
    for row in tiny["rows"]:
        reason = octocell.unavailable().get(row["backend"])
        assert (row["status"] == "skipped") == (reason is not None), row["name"]
        assert row["reason"] == reason


def test_every_row_that_is_no_negative_control_is_right(tiny: Json, tiny_runs: list[Json]) -> None:
    truth = tiny["groups"][0]["truth"]
    for row in tiny_runs:
        assert row["negative_control"] == (row["rule"] == "as_written")
        if row["negative_control"]:
            assert (row["status"], row["false"], row["duplicates"]) == ("wrong", 0, 0)
            assert row["missed"] == truth["pairs"] - row["pairs"] > 0
            assert 0 < row["worst_missed_depth"] <= 1
            continue
        assert (row["status"], row["reason"]) == ("ok", None)
        assert (row["missed"], row["false"], row["duplicates"]) == (0, 0, 0)
        assert (row["worst_missed_depth"], row["worst_false_gap"]) == (None, None)
        assert row["distinct_checksums"] == 1
        assert {key: row[key] for key in truth} == truth


def stages_of(row: Json) -> list[str]:
    if row["kind"] == "baseline":
        return ["update" if "update" in row["run"] else "build", "query"]
    if row["method"] == "brute_force":
        return ["bounds", "pair_tests", "resolve"]
    return BACKEND_STAGES


def test_rows_hold_what_the_schema_says(tiny_runs: list[Json]) -> None:
    for row in tiny_runs:
        assert set(row) == set(ROW), row["name"]
        assert (row["device_bytes"] is None) == ("cuda" not in row["backend"])
        baseline = row["kind"] == "baseline"
        assert row["kind"] in ("backend", "baseline")
        assert (row["uncertain_pairs"] is None) == (row["plan_ms"] is None) == baseline
        assert (row["plan"] is None) == baseline
        assert row["candidates"] >= row["pairs"]
        assert row["output_bytes"] == 8 * row["pairs"]
        assert row["iterations"] >= 1
        assert row["peak_bytes"] is None or row["peak_bytes"] >= 0
        whole_only = row["run"] in ("graph", "transfers")
        assert list(row["stage_ms"]) == ([] if whole_only else stages_of(row))
        marked = 0 if whole_only else 1 if row["run"] == "cold" else ROUNDS  # runs with stage marks
        lists = [row["marked_total_ms"], *row["stage_ms"].values()]
        assert all(len(times) == marked and min(times) >= 0 for times in lists), row["name"]
        assert len(row["total_ms"]) == ROUNDS and min(row["total_ms"]) >= 0, row["name"]
        for k, total in enumerate(row["marked_total_ms"]):
            assert sum(times[k] for times in row["stage_ms"].values()) <= total + 1e-6


def test_memory_is_measured_unless_told_not_to(
    tiny: Json, octocell: Octocell, tmp_path: Path
) -> None:
    assert any(row["peak_bytes"] for row in tiny["rows"])
    path = tmp_path / "x.json"
    octocell.ok("bench", "gas:n=100", "-o", path, *TINY, "--no-memory")
    assert {row["peak_bytes"] for row in load(path)["rows"]} == {None}


def test_skipped_rows_say_why(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    octocell.ok(
        "bench", "shifted:n=200,offset=1e7", "-o", path, *TINY, "--benchmark_filter=chapter32"
    )
    rows = load(path)["rows"]
    assert rows
    for row in rows:
        assert row["status"] == "skipped"
        why_not = octocell.unavailable().get(row["backend"], "rule chapter32 does not hold")
        assert why_not in row["reason"]
        assert set(row) == set(ROW)
        nulls = """pairs checksum missed false duplicates worst_missed_depth worst_false_gap
        distinct_checksums candidates uncertain_pairs""".split()
        assert {row[key] for key in nulls} == {None}
        assert row["total_ms"] == []


def test_a_baseline_that_takes_too_long_is_skipped(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    args = ("--backend", "bullet_simple", "--timeout", 0.05)
    octocell.ok("bench", "gas:n=30000", "-o", path, *TINY, *args)
    assert {row["reason"] for row in load(path)["rows"]} == {"no answer within 0.05 s"}


def test_filter_and_backend_choose_rows(octocell: Octocell, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    octocell.ok("bench", "gas:n=100", "-o", path, *TINY, "--benchmark_filter=dbvt/.*run:warm")
    assert [(r["backend"], r["run"]) for r in load(path)["rows"]] == [("bullet_dbvt", "warm")]
    octocell.ok("bench", "gas:n=100", "-o", path, *TINY, "--backend", "impl_cpu")
    assert {row["backend"] for row in load(path)["rows"]} == {"impl_cpu"}


def test_benchmark_flags_are_understood(octocell: Octocell, tmp_path: Path) -> None:
    octocell.ok(
        "bench",
        "gas:n=100",
        "--benchmark_repetitions=3",
        "--benchmark_min_time=0.001s",
        f"--benchmark_out={tmp_path / 'y.json'}",
    )
    rows = load(tmp_path / "y.json")["rows"]
    assert {len(row["total_ms"]) for row in rows if row["status"] == "ok"} == {3}


def test_list_names_the_rows_of_a_run(tiny: Json, octocell: Octocell, tmp_path: Path) -> None:
    result = octocell.ok("bench", "gas:n=500", "--benchmark_list_tests", cwd=tmp_path)
    assert result.stdout.splitlines() == [row["name"] for row in tiny["rows"]]
    assert list(tmp_path.iterdir()) == []


def test_list_of_a_preset_obeys_the_filter(octocell: Octocell, tmp_path: Path) -> None:
    names = octocell.ok("bench", "--benchmark_list_tests", cwd=tmp_path).stdout.splitlines()
    assert len(set(names)) == len(names)
    for scene in "gas dense poly cluster lattice shifted giant 1A2C".split():
        assert any(f"/scene:{scene}/" in name for name in names)
    flag = "--benchmark_filter=scene:poly/n:10000/"
    some = octocell.ok("bench", "--benchmark_list_tests", flag, cwd=tmp_path).stdout.splitlines()
    assert some == [name for name in names if "/scene:poly/n:10000/" in name]
    full = octocell.ok("bench", "--preset", "full", "--benchmark_list_tests", cwd=tmp_path)
    assert len(full.stdout.splitlines()) > len(names)


def test_scenes_that_differ_in_one_parameter_have_rows_of_their_own(
    octocell: Octocell, tmp_path: Path
) -> None:
    path = tmp_path / "x.json"
    octocell.ok("bench", "gas:n=50,seed=1", "gas:n=50,seed=2", "-o", path, *TINY, "--no-memory")
    names = Counter(row["name"] for row in load(path)["rows"])
    assert names.most_common(1)[0][1] == 1, "two rows have one name"


def test_a_real_scene_that_was_not_fetched(octocell: Octocell, tmp_path: Path) -> None:
    result = octocell.ok(
        "bench", "-o", "x.json", *TINY, "--benchmark_filter=1A2C", cwd=tmp_path
    )  # where there is no data/
    assert "1A2C" in result.stderr
    document = load(tmp_path / "x.json")
    assert document["rows"] == []
    assert document["context"]["finished"] is True
    group = next(group for group in document["groups"] if group["scene"] == "1A2C")
    assert list(group) == GROUP
    assert (group["n"], group["truth"], group["real"]) == (0, None, True)
    assert "data/1A2C.pqr" in group["unavailable"]


def test_groups_without_rows_are_left_out(octocell: Octocell, tmp_path: Path) -> None:
    scenes = ["gas:n=100", "poly:n=100"]
    octocell.ok(
        "bench", *scenes, "-o", "x.json", *TINY, "--benchmark_filter=scene:poly", cwd=tmp_path
    )
    assert [group["scene"] for group in load(tmp_path / "x.json")["groups"]] == ["poly"]


def test_a_filter_that_matches_nothing_is_refused(refused: Refused) -> None:
    line = refused("bench", "gas:n=100", "-o", "x.json", "--benchmark_filter=nothing")
    assert "nothing" in line


def interrupt_when(octocell: Octocell, folder: Path, groups: int) -> Json:
    """The JSON of a bench that got Ctrl-C once so many groups were written."""
    path = folder / "x.json"
    scenes = [f"gas:n={n}" for n in range(500, 560)]
    command = [str(octocell.path), "bench", *scenes, "-o", str(path), "--rounds", str(ROUNDS)]
    bench = subprocess.Popen(
        [*command, "--benchmark_min_time=0.005", "--no-memory"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    until = time.monotonic() + 30
    while time.monotonic() < until and not (path.exists() and len(load(path)["groups"]) >= groups):
        time.sleep(0.01)
    bench.send_signal(signal.SIGINT)
    out, err = bench.communicate(timeout=30)
    assert (bench.returncode, out) == (130, "")
    assert "interrupted" in err and str(path) in err
    assert [other.name for other in folder.iterdir()] == ["x.json"]
    return load(path)


@pytest.mark.parametrize("groups", [0, 2])
def test_ctrl_c_keeps_the_whole_groups(octocell: Octocell, tmp_path: Path, groups: int) -> None:
    document = interrupt_when(octocell, tmp_path, groups)
    assert document["context"]["finished"] is False
    assert groups <= len(document["groups"]) < 60
    rows_of = Counter(row["n"] for row in document["rows"])
    assert sorted(rows_of) == [group["n"] for group in document["groups"]]
    assert len(set(rows_of.values())) <= 1
    for row in document["rows"]:
        assert len(row["total_ms"]) == ROUNDS or row["status"] == "skipped"


REFUSALS = {
    "unknown_scene": (["gaz"], ["'gaz'"]),
    "unknown_second_scene": (["gas:n=9", "gaz"], ["'gaz'"]),
    "bad_parameter": (["gas:n=-1"], ["n=-1"]),
    "missing_file": (["missing.csv"], ["missing.csv"]),
    "missing_second_file": (["gas:n=9", "missing.csv"], ["missing.csv"]),
    "unknown_preset": (["--preset", "slow"], ["'slow'", "quick, full, gpu"]),
    "unknown_preset_beside_scenes": (["gas:n=9", "--preset", "slow"], ["'slow'"]),
    "unknown_backend": (["gas:n=9", "--backend", "gpu"], ["'gpu'", "impl_cpu"]),
    "bad_filter": (["gas:n=9", "--benchmark_filter=("], ["'('"]),
    "rounds_zero": (["gas:n=9", "--rounds", "0"], ["--rounds"]),
    "rounds_word": (["gas:n=9", "--rounds", "two"], ["--rounds", "two"]),
    "repetitions_zero": (["gas:n=9", "--benchmark_repetitions=0"], ["--benchmark_repetitions"]),
    "repetitions_half": (["gas:n=9", "--benchmark_repetitions=0.5"], ["--benchmark_repetitions"]),
    "min_time": (["gas:n=9", "--benchmark_min_time=long"], ["--benchmark_min_time", "long"]),
    "warmup": (["gas:n=9", "--benchmark_min_warmup_time=long"], ["--benchmark_min_warmup_time"]),
    "format": (["gas:n=9", "--benchmark_format=fancy"], ["--benchmark_format"]),
    "unknown_benchmark_flag": (["gas:n=9", "--benchmark_nothing"], ["--benchmark_nothing"]),
    "timeout_zero": (["gas:n=9", "--timeout", "0"], ["--timeout"]),
    "unknown_flag": (["gas:n=9", "--nothing"], ["--nothing"]),
}


@pytest.mark.parametrize("name", REFUSALS)
def test_refusals_leave_the_old_output(refused: Refused, tmp_path: Path, name: str) -> None:
    (tmp_path / "old.json").write_text("what was there", encoding="utf-8")
    arguments, words = REFUSALS[name]
    line = refused("bench", *arguments, "-o", "old.json")
    assert all(word in line for word in words), line


def test_refusals_make_no_folders(refused: Refused) -> None:
    refused("bench", "--preset", "slow")
    refused("bench", "gas:n=9", "--backend", "gpu", "-o", "new/x.json")


@pytest.mark.parametrize("target", ["plain/x.json", "folder", "/dev/full", "n" * 300 + ".json"])
def test_outputs_that_cannot_be_written(refused: Refused, tmp_path: Path, target: str) -> None:
    (tmp_path / "plain").write_text("a file", encoding="utf-8")
    (tmp_path / "folder").mkdir()
    line = refused("bench", "gas:n=9", "-o", target)
    assert "cannot write" in line and target in line
