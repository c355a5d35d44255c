# SPDX-License-Identifier: MIT
"""Signals reach a program while it searches."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

# Forty thousand spheres in one place have 8e8 pairs, which takes a second.
PROGRAM = """
import os, signal, threading, time
import numpy as np
import octocell

class Alarm(Exception):
    pass

def ring(*_):
    raise Alarm

signal.signal(signal.SIGALRM, ring)
# Whoever started the tests may ignore it.
signal.signal(signal.SIGINT, signal.default_int_handler)
clump = np.zeros((40_000, 4), np.float32)
clump[:, 3] = 1
finder = octocell.Finder(threads=2)
SEARCH = {
    "count": lambda: octocell.count(clump, threads=1),
    "chunks": lambda: [None for _ in octocell.chunks(clump, threads=1)],
    "finder": lambda: finder.find(clump),
}[os.environ["SEARCH"]]
for number, expected in ((signal.SIGINT, KeyboardInterrupt), (signal.SIGALRM, Alarm)):
    threading.Timer(0.1, os.kill, (os.getpid(), number)).start()
    begin = time.process_time()
    try:
        SEARCH()
    except expected:
        print(time.process_time() - begin)
assert len(finder.find(clump[:100])) == octocell.count(clump[:100]) == 4950
"""


@pytest.mark.parametrize("search", ["count", "chunks", "finder"])
def test_a_signal_ends_a_search(package: Path, search: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env={"PYTHONPATH": str(package), "SEARCH": search},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert len(done.stdout.split()) == 2, "the exceptions did not come"
