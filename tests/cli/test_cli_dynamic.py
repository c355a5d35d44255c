# SPDX-License-Identifier: MIT
"""Dynamic runs of `octocell bench`: frames, verified one by one."""

from __future__ import annotations

import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest

from program import Json, Octocell, Refused, load

TINY = ("--rounds", 2, "--no-memory")
FRAMES = 6


def dynamic(octocell: Octocell, tmp_path: Path, *args: object) -> Json:
    octocell.ok("bench", *args, "-o", tmp_path / "x.json", *TINY)
    document = load(tmp_path / "x.json")
    unavailable = octocell.unavailable()
    document["rows"] = [row for row in document["rows"] if row["backend"] not in unavailable]
    return document


@pytest.mark.parametrize(
    "motion", ["brownian", "free_fall", "gravity", "slow", "few", "darts", "still"]
)
def test_every_row_is_exact_on_every_frame(octocell: Octocell, tmp_path: Path, motion: str) -> None:
    document = dynamic(octocell, tmp_path, "gas:n=800", "--motion", motion, "--frames", FRAMES)
    assert document["groups"][0]["scene"] == f"gas_{motion}"
    assert document["groups"][0]["frames"] == FRAMES
    assert document["rows"]
    for row in document["rows"]:
        assert (row["run"], row["status"]) == ("dynamic", "ok"), row
        frame_ms = row["frames"]["frame_ms"]
        assert [len(times) for times in frame_ms] == [FRAMES, FRAMES], row["name"]
        assert len(row["total_ms"]) == 2
        assert row["frames"]["warmup_frames"] < FRAMES
        for total, times in zip(row["total_ms"], frame_ms, strict=True):
            assert total in times[row["frames"]["warmup_frames"] :]
        unchanged = motion == "still" and set(row["stage_ms"]) == {"bounds"}
        assert unchanged or "update" in row["stage_ms"] or "pair_tests" in row["stage_ms"]


def test_frames_may_come_from_a_folder(octocell: Octocell, tmp_path: Path) -> None:
    random = np.random.default_rng(1)
    scene = random.uniform(0, 8, (300, 4)).astype(np.float32)
    scene[:, 3] = 0.5
    frames = tmp_path / "film"
    frames.mkdir()
    for k in range(4):
        scene[:, :3] += random.uniform(-0.2, 0.2, (300, 3)).astype(np.float32)
        np.save(frames / f"frame_{k:05}.npy", scene)
    document = dynamic(octocell, tmp_path, "--trajectory", frames)
    assert document["groups"][0]["scene"] == "film"
    assert {row["status"] for row in document["rows"]} == {"ok"}


def test_teleporting_spheres_are_found_again(octocell: Octocell, tmp_path: Path) -> None:
    frames = tmp_path / "jump"
    frames.mkdir()
    random = np.random.default_rng(2)
    for k in range(5):
        scene = random.uniform(-(10.0**k), 10.0**k, (200, 4)).astype(np.float32)
        scene[:, 3] = 10.0**k / 10
        np.save(frames / f"{k}.npy", scene)
    document = dynamic(octocell, tmp_path, "--trajectory", frames)
    ours = [row for row in document["rows"] if row["kind"] == "backend"]
    assert ours and {row["status"] for row in ours} == {"ok"}


def test_bad_motions_are_refused(refused: Refused) -> None:
    assert "swirl" in refused("bench", "gas:n=9", "--motion", "swirl", "-o", "x.json")
    assert "nowhere" in refused("bench", "--trajectory", "nowhere", "-o", "x.json")
    assert "--frames" in refused("bench", "gas:n=9", "--motion", "gravity", "--frames", "1")


def test_ctrl_c_does_not_wait_for_the_exact_pairs_of_all_frames(
    octocell: Octocell, tmp_path: Path
) -> None:
    path = tmp_path / "x.json"
    film = ("gas:n=50000", "--motion", "slow", "--frames", "400")
    bench = subprocess.Popen(
        [str(octocell.path), "bench", *film, "-o", str(path), *map(str, TINY)],
        stderr=subprocess.PIPE,
        text=True,
    )
    assert bench.stderr is not None
    assert bench.stderr.readline().startswith("[1/")
    bench.send_signal(signal.SIGINT)
    _, after = bench.communicate(timeout=120)
    assert bench.returncode == 130
    assert "interrupted" in after and "frame" not in after
    assert load(path)["groups"] == []
