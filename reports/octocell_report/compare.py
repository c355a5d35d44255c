# SPDX-License-Identifier: MIT
"""Two results side by side: which rows became faster or slower, beyond what the rounds scatter.

Rounds of two files have nothing to do with each other, so times are compared, not ratios: the new
median by the old one. How far that may be off is told by bootstrap: rounds are drawn again, with
replacement, from each file by itself, and the middle 99 % of the ratios so found are the interval.
A row is slower if the whole interval lies above 1 + threshold, faster if below its inverse.
With five rounds or fewer the interval is all but the range of the rounds, and with fewer than three
there is none: such rows are never called faster or slower.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from statistics import median

import numpy as np

from octocell_report import words
from octocell_report.load import Result, Row
from octocell_report.spread import LEAST_ROUNDS, SHARE, TAILS, drawn_medians


@dataclass(frozen=True)
class Change:
    """One row that is exact, and no negative control, in both."""

    old: Row
    new: Row
    ratio: float  # new median / old median: above 1 is slower
    low: float
    high: float
    verdict: str  # slower | faster | same | unknown (too few rounds)

    @property
    def name(self) -> str:
        return self.new.name


@dataclass(frozen=True)
class Comparison:
    changes: list[Change]
    other_scene: list[str]  # names of rows whose groups' true pairs differ: not the same question
    verdicts: list[tuple[Row, Row]]  # old and new: one of them has no bare time, and they differ
    only_old: list[str]
    only_new: list[str]

    def of(self, verdict: str) -> list[Change]:
        """The largest change first."""
        found = [change for change in self.changes if change.verdict == verdict]
        return sorted(found, key=lambda change: -abs(np.log(change.ratio)))


def compare(old: Result, new: Result, threshold: float) -> Comparison:
    """Rows are the same if their names are."""
    before, after = ({row.name: row for row in result.rows} for result in (old, new))
    truths = [{g.place: g.truth for g in r.groups} for r in (old, new)]
    found = Comparison(
        changes=[],
        other_scene=[],
        verdicts=[],
        only_old=[name for name in before if name not in after],
        only_new=[name for name in after if name not in before],
    )
    for name, row in before.items():
        other = after.get(name)
        if other is None:
            continue
        if truths[0][row.place] != truths[1][other.place]:
            found.other_scene.append(name)
        elif row.counts and other.counts and row.median_ms > 0 and other.median_ms > 0:
            found.changes.append(_change(row, other, threshold))
        elif _standing(row) != _standing(other):
            found.verdicts.append((row, other))
    return found


def _standing(row: Row) -> tuple[str, bool]:
    return row.status, row.negative_control


def _change(old: Row, new: Row, threshold: float) -> Change:
    low, high = interval(old.round_ms, new.round_ms)
    ratio = new.median_ms / old.median_ms
    if min(len(old.round_ms), len(new.round_ms)) < LEAST_ROUNDS:
        verdict = "unknown"
    elif low > 1 + threshold:
        verdict = "slower"
    else:
        verdict = "faster" if high < 1 / (1 + threshold) else "same"
    return Change(old, new, ratio, low, high, verdict)


def interval(old: Iterable[float], new: Iterable[float]) -> tuple[float, float]:
    """Of new median / old median; the same for the same times, as its random numbers are fixed."""
    random = np.random.default_rng(1)
    below, above = (drawn_medians(np.asarray(list(times)), random) for times in (old, new))
    # A round of no time at all may be drawn; the ratio is then beyond all bounds, as it should be.
    with np.errstate(divide="ignore", invalid="ignore"):
        low, high = np.nanpercentile(above / below, TAILS, method="inverted_cdf")
    return float(low), float(high)


_DIFFER = {
    "compiler": "compiler differs",
    "flags": "flags differ",
    "instruction_set": "instruction set differs",
    "build_type": "build type differs",
    "libraries": "libraries differ",
}


def warnings(old: Result, new: Result) -> list[str]:
    """Why a difference may not be the code's."""
    found = []
    machines = old.context["machine"], new.context["machine"]
    for key in ("cpu", "cores", "memory_bytes", "os", "name"):
        if machines[0][key] != machines[1][key]:
            found.append(f"machines differ: {key}: {machines[0][key]} / {machines[1][key]}")
    for key in _DIFFER:
        if old.context[key] != new.context[key]:
            found.append(f"{_DIFFER[key]}: {_shown(old, key)} / {_shown(new, key)}")
    for name, result in (("old", old), ("new", new)):
        if result.context["dirty"]:
            found.append(f"the {name} result was built from changed sources")
        if not result.context["finished"]:
            found.append(f"the {name} run was interrupted")
    return found


def _shown(result: Result, key: str) -> str:
    known = result.context[key]
    return ", ".join(f"{k} {v}" for k, v in known.items()) if isinstance(known, dict) else known


def report(old: Result, new: Result, threshold: float) -> tuple[list[str], bool]:
    """Lines of text, and whether a row became slower."""
    found = compare(old, new, threshold)
    lines = [f"warning: {text}" for text in warnings(old, new)]
    lines += [
        f"old {_origin(old)}, new {_origin(new)}; ratio: new median / old median",
        f"slower: the {SHARE} % interval (bootstrap over rounds) lies above {1 + threshold:.3g}; "
        f"faster: below {1 / (1 + threshold):.3g}; "
        f"rows with fewer than {LEAST_ROUNDS} rounds are not judged",
    ]
    for verdict in ("slower", "faster"):
        lines += _table(verdict, found.of(verdict))
    pairs = [f"  {old.name}: {_word(old)} -> {_word(new)}" for old, new in found.verdicts]
    lines += _listed("changed verdict", pairs)
    lines += _listed("other scene (true pairs differ, not compared)", _names(found.other_scene))
    lines += _listed("only in the old file", _names(found.only_old))
    lines += _listed("only in the new file", _names(found.only_new))
    return [*lines, "", *_summary(found)], bool(found.of("slower"))


def _origin(result: Result) -> str:
    return f"{result.context['commit'][:12]} ({result.context['date'][:10]})"


def _names(names: list[str]) -> list[str]:
    return [f"  {name}" for name in names]


def _listed(title: str, lines: list[str]) -> list[str]:
    return ["", f"{title}: {len(lines)}", *lines] if lines else []


def _word(row: Row) -> str:
    """Its status, and what there is to say of it."""
    if row.status == "skipped":
        return f"skipped ({words.short_reason(row.reason, 40)})"
    return words.verdict(row) if row.status == "wrong" or row.negative_control else "exact"


def _table(verdict: str, changes: list[Change]) -> list[str]:
    if not changes:
        return ["", f"{verdict}: none"]
    cells = [
        [
            f"{change.ratio:.3f}",
            f"{change.low:.3f} .. {change.high:.3f}",
            words.number(change.old.median_ms),
            words.number(change.new.median_ms),
            change.name.removeprefix("find_pairs/"),
        ]
        for change in changes
    ]
    cells.insert(0, ["ratio", "interval", "old ms", "new ms", "row"])
    widths = [max(len(line[column]) for line in cells) for column in range(4)]
    lines = [
        "  " + "  ".join(f"{text:>{width}}" for text, width in zip(line, widths, strict=False))
        for line in cells
    ]
    return ["", f"{verdict}: {len(changes)}"] + [
        f"{line}  {texts[4]}" for line, texts in zip(lines, cells, strict=True)
    ]


_WORDS = {
    "slower": "slower",
    "faster": "faster",
    "same": "within the noise",
    "unknown": "not judged",
}


def _summary(found: Comparison) -> list[str]:
    """Counts, and how the baselines moved: their code is not ours, so it is the machine's drift."""
    counts = [f"{len(found.of(verdict))} {word}" for verdict, word in _WORDS.items()]
    lines = [f"{len(found.changes)} rows compared: {', '.join(counts)}"]
    for kind, title in (("backend", "ours"), ("baseline", "baselines, as a measure of drift")):
        ratios = [change.ratio for change in found.changes if change.new.kind == kind]
        if ratios:
            lines.append(f"{title}: median ratio {median(ratios):.3f} of {len(ratios)} rows")
    return lines
