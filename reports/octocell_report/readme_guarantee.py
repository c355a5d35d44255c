# SPDX-License-Identifier: MIT
"""The guarantee as tables: what was tried to break it, how much of it, and what broke."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import groupby

from octocell_report import words
from octocell_report.markdown import table
from octocell_report.verification import (
    ENDINGS,
    SIDES,
    Mutant,
    NearTangent,
    Source,
    StressRow,
    Verification,
)

NOT_RUN = "not run"
OURS, LIBRARIES = "Octocell", ("fcl", "bullet")  # columns
_NONE = [words.NONE] * len(LIBRARIES)


def guarantee(verification: Verification) -> str:
    """The one table: ours beside the libraries, where the same was asked of them."""
    lines = [
        *_near_tangent(verification),
        *_stress(verification),
        ["inputs made by fuzzers", _fuzzed(verification), *_NONE],
        ["faults planted in the sources and found", _killed(verification), *_NONE],
        ["compilers and flags with one checksum", _configurations(verification), *_NONE],
        ["reports of sanitizers", _reports(verification), *_NONE],
    ]
    header = ["", OURS, *map(words.family_title, LIBRARIES)]
    note = (
        "A near-tangent pair is one with |D − R| ≤ 64 u R: its squared distance is so near to the "
        "square of the sum of radii that float32 may fail to tell; each was decided and compared "
        "with integers. Where nothing was wrong, 3/N bounds the rate with 95 %. "
        f"{words.NONE}: not asked of a library. Libraries run with our exact test of a pair, so "
        "that what they miss their broad phases lost."
    )
    return "\n".join([table(header, lines, note), "", _sources(_all_sources(verification))])


def _near_tangent(verification: Verification) -> list[list[str]]:
    found = []
    for side in SIDES:
        ties = [tie for tie in verification.near_tangent if tie.where == side]
        families = len({tie.family for tie in ties})
        tried = f"{words.grouped(_pairs(ties))} in {families} families" if ties else NOT_RUN
        found.append([f"near-tangent pairs decided, {side}", tried, *_NONE])
        found.append(["– of these wrong", _mismatches(ties), *_NONE])
    return found


def _pairs(ties: Iterable[NearTangent]) -> int:
    return sum(tie.pairs for tie in ties)


def _mismatches(ties: list[NearTangent]) -> str:
    wrong, pairs = sum(tie.mismatches for tie in ties), _pairs(ties)
    if not pairs:
        return NOT_RUN
    return f"**{words.grouped(wrong)}**" if wrong else f"0 (rate below {bound(pairs)})"


def bound(trials: int) -> str:
    """3/N, which a rate stays below with 95 % where none of N failed: '2.5 · 10⁻⁹'."""
    mantissa, exponent = f"{3 / trials:.1e}".split("e")
    superscripts = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{mantissa} · 10{superscripts}"


def _stress(verification: Verification) -> list[list[str]]:
    """Questions, not scenes: each scene is asked of every implementation."""
    entries = {row.entry for row in verification.stress}
    families = len({row.family for row in verification.stress})
    asked = [row for row in verification.stress if row.asks != "refusal"]
    bad = [row for row in verification.stress if row.asks == "refusal"]
    title = "stress catalogue"
    if entries:
        title += f" ({families} families, {len(entries)} entries)"
    return [
        [f"{title}: answers", *_columns(asked, _answers)],
        ["– wrong answers", *_columns(asked, lambda rows: _bold(_ended(rows, "wrong")))],
        ["– pairs missed, false, given again", *_columns(asked, _losses)],
        [
            "– crashed or too late",
            *_columns(asked, lambda rows: _bold(_ended(rows, "crashed", "late"))),
        ],
        ["bad inputs tried, rejected by name", *_columns(bad, _rejected)],
    ]


def by_owner(rows: list[StressRow]) -> dict[str, list[StressRow]]:
    """Ours, then library by library."""
    owners = {"Octocell": [row for row in rows if row.kind == "backend"]}
    for family in LIBRARIES:
        owners[words.family_title(family)] = [
            r for r in rows if r.kind == "baseline" and words.family(r.backend) == family
        ]
    return owners


def _columns(rows: list[StressRow], show: Callable[[list[StressRow]], str]) -> list[str]:
    return [show(own) if own else NOT_RUN for own in by_owner(rows).values()]


def wrong(rows: list[StressRow]) -> int:
    return _ended(rows, "wrong")


def _ended(rows: Iterable[StressRow], *endings: str) -> int:
    return sum(row.cases[ending] for row in rows for ending in endings)


def answered(rows: Iterable[StressRow]) -> int:
    return _ended(rows, *(ending for ending in ENDINGS if ending not in ("skipped", "refused")))


def _answers(rows: list[StressRow]) -> str:
    implementations = len({row.implementation for row in rows})
    return f"{words.grouped(answered(rows))} by {implementations} implementations"


def _losses(rows: list[StressRow]) -> str:
    counts = [sum(getattr(row, kind) for row in rows) for kind in ("missed", "false", "duplicates")]
    text = ", ".join(map(words.grouped, counts))
    return f"**{text}**" if any(counts) else text


def _bold(count: int) -> str:
    return f"**{words.grouped(count)}**" if count else "0"


def _rejected(rows: list[StressRow]) -> str:
    """An answer to a bad input is exact if it is the error that names the sphere."""
    tried = answered(rows)
    return f"{_ended(rows, 'exact')} of {tried}" if tried else words.NONE


def _fuzzed(verification: Verification) -> str:
    if not verification.fuzz:
        return NOT_RUN
    runs, crashes = (sum(getattr(t, key) for t in verification.fuzz) for key in ("runs", "crashes"))
    return f"{words.grouped(runs)}, failures: {_bold(crashes)}"


def _killed(verification: Verification) -> str:
    verdicts = _best(verification.mutants)
    tried = [mutant for mutant in verdicts if mutant.status != "not_run"]
    if not tried:
        return NOT_RUN
    killed = sum(mutant.status == "killed" for mutant in tried)
    text = f"{killed} of {len(tried)}"
    rest = len(verdicts) - len(tried)
    return (text if killed == len(tried) else f"**{text}**") + (
        f" ({rest} not run)" if rest else ""
    )


def _best(mutants: list[Mutant]) -> list[Mutant]:
    """A fault not run on one machine may have run on another; a survival counts first."""
    order = ("survived", "killed", "not_run")
    found: dict[str, Mutant] = {}
    for mutant in sorted(mutants, key=lambda m: order.index(m.status)):
        found.setdefault(mutant.name, mutant)
    names = dict.fromkeys(mutant.name for mutant in mutants)
    return [found[name] for name in names]


def _configurations(verification: Verification) -> str:
    if not verification.compilers:
        return NOT_RUN
    total = sum(len(matrix.configurations) for matrix in verification.compilers)
    failures = sum(len(matrix.failures) for matrix in verification.compilers)
    return f"{total}" if not failures else f"**{failures} failures in {total}**"


def _reports(verification: Verification) -> str:
    if not verification.sanitizers:
        return NOT_RUN
    tests = sum(tool.tests for tool in verification.sanitizers)
    # "memcheck, frames": what was run under it is for the table of the details.
    names = ", ".join(dict.fromkeys(tool.name.split(",")[0] for tool in verification.sanitizers))
    reports = _bold(sum(tool.reports for tool in verification.sanitizers))
    return f"{reports} in {words.grouped(tests)} tests ({names})"


def _all_sources(verification: Verification) -> list[Source]:
    lists: tuple[list[object], ...] = tuple(vars(verification).values())
    sources = [item.source for items in lists for item in items]  # type: ignore[attr-defined]
    return list(dict.fromkeys(sources))


def _sources(sources: list[Source]) -> str:
    """Which files this was written from."""
    if not sources:
        return "From no file yet."
    parts = [f"`{s.title}` ({s.commit[:12]}, {s.date[:10]})" for s in sources]
    return f"From {', '.join(parts)}."


def near_tangent(verification: Verification) -> str:
    """By family, and where it ran."""
    ties = verification.near_tangent
    lines = [
        [tie.family, tie.where, tie.source.machine, words.grouped(tie.pairs), _bold(tie.mismatches)]
        for tie in ties
    ]
    lines.append(["all", "", "", words.grouped(_pairs(ties)), _mismatches(ties)])
    return _told(["family", "where", "machine", "near-tangent pairs", "wrong"], lines, ties)


def stress(verification: Verification) -> str:
    """By implementation: how its cases ended."""
    lines = []
    rows = sorted(verification.stress, key=lambda row: row.kind)  # backends first, else as met
    for name in dict.fromkeys(row.implementation for row in rows):
        own = [row for row in rows if row.implementation == name]
        endings = [words.grouped(_ended(own, ending)) for ending in ENDINGS[:3]]
        endings += [_bold(_ended(own, ending)) for ending in ENDINGS[3:]]
        lines.append([name, *endings, _losses(own)])
    return _told(
        ["implementation", *ENDINGS, "missed, false, given again"], lines, verification.stress
    )


def compilers(verification: Verification) -> str:
    lines = []
    for matrix in verification.compilers:
        for compiler, names in groupby(matrix.configurations, key=lambda name: name.split()[0]):
            flags = [name.removeprefix(compiler).strip() for name in names]
            lines.append(
                [compiler, matrix.source.machine, str(len(flags)), f"`{'`, `'.join(flags)}`"]
            )
    header = ["compiler", "machine", "configurations", "flags"]
    failures = sum(len(matrix.failures) for matrix in verification.compilers)
    checksums = max((matrix.checksums for matrix in verification.compilers), default=0)
    refused = sorted(
        {name.split()[-1] for matrix in verification.compilers for name in matrix.refused}
    )
    note = f"{checksums} checksums each; failures: {_bold(failures)}."
    if refused:
        note += f" Refused at compile time: `{'`, `'.join(refused)}`."
    return _told(header, lines, verification.compilers, note)


def mutants(verification: Verification) -> str:
    lines = [
        [f"`{mutant.name}`", mutant.what, _status(mutant), mutant.killed_by or words.NONE]
        for mutant in _best(verification.mutants)
    ]
    return _told(["fault", "what is wrong", "", "found by"], lines, verification.mutants)


def _status(mutant: Mutant) -> str:
    if mutant.status == "survived":
        return "**survived**"
    return (
        "killed" if mutant.status == "killed" else f"not run: {mutant.reason or 'no reason given'}"
    )


def fuzz(verification: Verification) -> str:
    lines = [
        [
            f"`{t.name}`",
            t.source.machine,
            words.grouped(t.runs),
            words.grouped(t.seconds),
            _bold(t.crashes),
        ]
        for t in verification.fuzz
    ]
    return _told(["target", "machine", "inputs", "seconds", "failures"], lines, verification.fuzz)


def sanitizers(verification: Verification) -> str:
    lines = [
        [tool.name, tool.source.machine, words.grouped(tool.tests), _bold(tool.reports)]
        for tool in verification.sanitizers
    ]
    return _told(["tool", "machine", "tests", "reports"], lines, verification.sanitizers)


def _told(
    header: list[str], lines: list[list[str]], items: Sequence[object], note: str = ""
) -> str:
    """What the items' lines are; of a kind without a file, that it was not run."""
    if not items:
        return "Not run yet."
    sources = dict.fromkeys(item.source for item in items)  # type: ignore[attr-defined]
    return table(header, lines, f"{note} {_sources(list(sources))}".strip())


BLOCKS: dict[str, Callable[[Verification], str]] = {
    "guarantee": guarantee,
    "guarantee_near_tangent": near_tangent,
    "guarantee_stress": stress,
    "guarantee_compilers": compilers,
    "guarantee_mutants": mutants,
    "guarantee_fuzz": fuzz,
    "guarantee_sanitizers": sanitizers,
}
