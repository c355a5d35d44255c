#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Damages a small file of each format in many ways, and watches what octocell-import makes of it.

Each mutant has to be refused in one line, or to be read as a plain reader reads it that knows the
format's rules and no mercy. A traceback, a hang and a value where the plain reader refuses count as
faults. What the plain reader reads and the importer refuses is counted, too.

  scripts/mutate_import.py 100000              # of each format, a process each
  scripts/mutate_import.py 1000 pdb --seed 7
"""

import argparse
import io
import random
import resource
import signal
import sys
from collections import Counter
from importlib import import_module
from multiprocessing import Process
from pathlib import Path

import numpy as np
from import_mutants import PLAIN_READERS, SAMPLES, Frames, Refused, Unjudged

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "reports"))

from octocell_import.scene import Converter  # noqa: E402
from octocell_import.text import DAMAGED, File  # noqa: E402
from octocell_report.fields import ReportError  # noqa: E402

READ_BY_PLAIN = "refused, read by the plain reader"
SECONDS = 5  # of this process, for one mutant
SHOWN = {"fault": 5, READ_BY_PLAIN: 2}
MEMORY = 4 << 30  # bytes, for all mutants of a format
SOME_BYTES = [*range(256), *b" 0159.-+eE\n" * 20]
WORDS = b"nan -inf 1e999 1e-50 -0 1_0 0x1p3 1,5 1.0.0 +1 .5 5. 1d0 -1 0 3 END ' \" # ; ? *".split()
WORDS += [b"9" * 18, b"9" * 5000, b"\xc2\xb2", b"", b"\t", b"\r"]
AS_COMMAND = argparse.Namespace(
    length_unit=None, drop_invalid=False, radius=["1"], radii=None, altloc="", chain="", residue=""
)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int, help="mutants of each format")
    parser.add_argument("formats", nargs="*", metavar="FORMAT", help="default: all")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    codes = []
    for name in options.formats or sorted(PLAIN_READERS):
        process = Process(target=report, args=(name, options.count, options.seed))
        process.start()
        process.join()
        codes.append(process.exitcode)
    return int(any(codes))


def report(name: str, count: int, seed: int) -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    outcomes = Counter()
    for mutant in mutants(name, count, seed):
        outcome, detail = judge(name, mutant)
        outcomes[outcome] += 1
        if outcomes[outcome] <= SHOWN.get(outcome, 0):
            print(f"{name}: {detail}\n  {mutant[:1500]!r}", flush=True)
    print(f"{name:12}", ", ".join(f"{n} {k}" for k, n in sorted(outcomes.items())), flush=True)
    sys.exit(outcomes["fault"] > 0)


def mutants(name: str, count: int, seed: int):
    dice = random.Random(f"{name} {seed}")
    for _ in range(count):
        content = dice.choice(SAMPLES[name])
        for _ in range(dice.choice((1, 1, 1, 2, 3))):
            content = dice.choice(DAMAGES)(content, dice)
        yield content


def change_byte(content: bytes, dice: random.Random) -> bytes:
    k = dice.randrange(len(content) + 1)
    return content[:k] + bytes([dice.choice(SOME_BYTES)]) + content[k + 1 :]


def insert_byte(content: bytes, dice: random.Random) -> bytes:
    k = dice.randrange(len(content) + 1)
    return content[:k] + bytes([dice.choice(SOME_BYTES)]) + content[k:]


def delete_bytes(content: bytes, dice: random.Random) -> bytes:
    k = dice.randrange(len(content) + 1)
    return content[:k] + content[k + dice.choice((1, 1, 2, 8)) :]


def cut(content: bytes, dice: random.Random) -> bytes:
    return content[: dice.randrange(len(content) + 1)]


def change_word(content: bytes, dice: random.Random) -> bytes:
    words = content.split(b" ")
    words[dice.randrange(len(words))] = dice.choice(WORDS)
    return b" ".join(words)


def move_line(content: bytes, dice: random.Random) -> bytes:
    lines = content.split(b"\n")
    line = lines.pop(dice.randrange(len(lines)))
    if dice.random() < 0.7:
        lines.insert(dice.randrange(len(lines) + 1), line)
    return b"\n".join(lines)


def repeat_line(content: bytes, dice: random.Random) -> bytes:
    lines = content.split(b"\n")
    lines.insert(dice.randrange(len(lines) + 1), dice.choice(lines))
    return b"\n".join(lines)


DAMAGES = (change_byte, insert_byte, delete_bytes, cut, change_word, move_line, repeat_line)


def judge(name: str, content: bytes) -> tuple[str, str]:
    def stop(*_: object) -> None:
        raise TimeoutError(f"more than {SECONDS} s")

    signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)
    try:
        found = read_ours(name, content)
    except ReportError as error:
        found, refusal = None, str(error)
    except Exception as error:
        return "fault", f"{type(error).__name__}: {str(error)[:200]}"
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    if found is None and ("\n" in refusal or len(refusal) > 1000):
        return "fault", f"more than a line: {refusal!r}"
    try:
        expected = PLAIN_READERS[name](content)
    except Unjudged:
        return "not judged", ""
    except Refused:
        return ("refused by both", "") if found is None else ("fault", f"read as {found}")
    if found is None:
        return READ_BY_PLAIN, refusal
    return ("read by both", "") if same(found, expected) else ("fault", f"{found}, not {expected}")


def read_ours(name: str, content: bytes) -> Frames:
    """What --all-frames does, but in memory."""
    module, _, part = name.partition("-")
    read = getattr(import_module(f"octocell_import.{module}"), f"read_{part}" if part else "read")
    converter, found = Converter(AS_COMMAND), []
    try:
        for frame in read(File(io.BufferedReader(io.BytesIO(content)), "")):
            found.append(converter.spheres(Path("x"), frame)[0][:, :3].tolist())
    except DAMAGED as error:  # pragma: a stream in memory cannot be damaged, but may be packed
        raise ReportError(str(error)) from error
    return found


def same(found: Frames, expected: Frames) -> bool:
    """But for the last bit, which the plain reader may round twice."""
    return len(found) == len(expected) and all(
        len(a) == len(b) and np.allclose(a, b, rtol=2e-7, atol=1e-44)
        for a, b in zip(found, expected, strict=True)
    )


if __name__ == "__main__":
    sys.exit(main())
