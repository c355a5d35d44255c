# SPDX-License-Identifier: MIT
"""The guarantee as tables: what was tried to break it, how much of it, and what broke."""

from collections.abc import Callable

from pandas import DataFrame, concat

from octocell_report.markdown import bold, code, table
from octocell_report.texts import Said, listed, say
from octocell_report.verification import ENDINGS, LOSSES, SIDES, STATUSES, Verification
from octocell_report.words import NONE, family, family_title, grouped

NOT_RUN = "not run"
OWNERS = ("Octocell", "FCL", "Bullet")  # columns


def guarantee(found: Verification) -> str:
    """The one table: ours beside the libraries, where the same was asked of them."""
    ties, stress = found["near_tangent"], found["stress"]
    entries, families = stress["entry"], stress["entry"].str.rstrip("0123456789")  # 'C' of 'C18'
    catalogue = f"stress catalogue ({families.nunique()} families, {entries.nunique()} entries)"
    stress_lines = {
        f"{catalogue}: answers": _answers,
        "– wrong answers": lambda rows: _bad(rows["wrong"].sum()),
        "– pairs missed, false, repeated": _losses,
        "– crashed or too late": lambda rows: _bad(rows["crashed"].sum() + rows["late"].sum()),
    }
    asked, bad = (stress[(stress["asks"] == "refusal") == refusal] for refusal in (False, True))
    lines = [
        *(line for side in SIDES for line in _near_tangent(ties[ties["where"] == side], side)),
        *([title, *_by_owner(asked, show)] for title, show in stress_lines.items()),
        ["bad inputs tried, refused by name", *_by_owner(bad, _refused)],
        ["inputs made by fuzzers", _told(found["fuzz"], _fuzzed)],
        ["faults planted in the sources, found", _told(_best(found["mutants"]), _killed)],
        ["compilers and flags with one checksum", _told(found["compilers"], _configurations)],
        ["reports of sanitizers", _told(found["sanitizers"], _reports)],
    ]
    note = (
        "A near-tangent pair has |D − R| ≤ 64 u R: its squared distance is so close to the square "
        "of the sum of radii that float32 may decide wrongly. Each answer was compared with "
        "integers. Where none of N was wrong, the rate is below 3/N with 95 % confidence. "
        f"{NONE}: not asked of a library. Libraries use our exact overlap test, so their broad "
        "phases lost every pair that they miss."
    )
    told = table(DataFrame(lines, columns=["", *OWNERS]), note)
    return f"{told}\n\n{_sources(*found.values())}"


def _told(rows: DataFrame, show: Callable[[DataFrame], str]) -> str:
    return NOT_RUN if rows.empty else show(rows)


def _bad(count: int) -> str:
    """A number that should be 0."""
    return bold(grouped(count)) if count else "0"


def _near_tangent(ties: DataFrame, side: str) -> list[list[str]]:
    tried = _told(ties, lambda t: f"{grouped(t['pairs'].sum())} in {t['name'].nunique()} families")
    wrong = _told(ties, _mismatches)
    return [[f"near-tangent pairs decided, {side}", tried], ["– of these wrong", wrong]]


def _mismatches(ties: DataFrame) -> str:
    """With 3/N, which the rate stays below with 95 % where none of N failed: '2.5 · 10⁻⁹'."""
    wrong, pairs = ties["mismatches"].sum(), ties["pairs"].sum()
    if wrong or not pairs:
        return _bad(wrong) if pairs else NOT_RUN
    mantissa, exponent = f"{3 / pairs:.1e}".split("e")
    superscripts = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"0 (rate below {mantissa} · 10{superscripts})"


def _owners(rows: DataFrame) -> dict[str, DataFrame]:
    """Rows of the stress catalogue: ours, then library by library."""
    libraries = rows["backend"].map(family).map(family_title)
    owners = libraries.where(rows["kind"] == "baseline", OWNERS[0])
    return {owner: rows[owners == owner] for owner in OWNERS}


def _by_owner(rows: DataFrame, show: Callable[[DataFrame], str]) -> list[str]:
    return [_told(own, show) for own in _owners(rows).values()]


def _answered(rows: DataFrame) -> int:
    return int(rows[["exact", "late", "crashed", "wrong"]].sum().sum())


def _answers(rows: DataFrame) -> str:
    """Questions, not scenes: each scene is asked of every implementation."""
    return f"{grouped(_answered(rows))} by {rows['implementation'].nunique()} implementations"


def _losses(rows: DataFrame) -> str:
    counts = rows[[*LOSSES]].sum()
    text = ", ".join(map(grouped, counts))
    return bold(text) if counts.any() else text


def _refused(rows: DataFrame) -> str:
    """An answer to a bad input is exact if it is the error that names the sphere."""
    tried = _answered(rows)
    return f"{rows['exact'].sum()} of {tried}" if tried else NONE


def _fuzzed(targets: DataFrame) -> str:
    return f"{grouped(targets['runs'].sum())}, failures: {_bad(targets['crashes'].sum())}"


def _best(faults: DataFrame) -> DataFrame:
    """A fault not run on one machine may have run on another; a survival counts first."""
    order = {"survived": 0, "killed": 1, "not_run": 2}
    ranked = faults.sort_values("status", key=lambda status: status.map(order), kind="stable")
    return (
        ranked.drop_duplicates("name").set_index("name").loc[faults["name"].unique()].reset_index()
    )


def _killed(faults: DataFrame) -> str:
    killed, survived, rest = ((faults["status"] == status).sum() for status in STATUSES)
    if not killed + survived:
        return NOT_RUN
    text = f"{killed} of {killed + survived}"
    return (bold(text) if survived else text) + (f" ({rest} not run)" if rest else "")


def _configurations(files: DataFrame) -> str:
    total, failures = (files[column].map(len).sum() for column in ("configurations", "failures"))
    return bold(f"{failures} failures in {total}") if failures else str(total)


def _reports(tools: DataFrame) -> str:
    # "memcheck, frames": what was run under it is for the table of the details.
    names = ", ".join(tools["name"].str.split(",").str[0].unique())
    return f"{_bad(tools['reports'].sum())} in {grouped(tools['tests'].sum())} tests ({names})"


def _sources(*frames: DataFrame) -> str:
    """Which files this was written from."""
    names = dict.fromkeys(name for frame in frames for name in frame["source"])
    return f"From {', '.join(names)}." if names else "From no file yet."


def details(found: Verification, kind: str) -> str:
    """The lines of one kind; of a kind without a file, that it was not run."""
    rows = found[kind]
    if rows.empty:
        return "Not run yet."
    summary = {"near_tangent": _with_sum, "stress": _by_implementation, "mutants": _best}
    lines = summary.get(kind, _by_compiler if kind == "compilers" else DataFrame)(rows)
    shown = {
        column: lines[column].map(_bad if column in _FAILURES else grouped, "ignore")
        for column in lines.select_dtypes("number")
    }
    lines = lines.assign(**shown).replace("survived", bold("survived"))
    lines = lines.drop(columns="source", errors="ignore")
    note = f"{_refusals(rows)} " if kind == "compilers" else ""
    return table(lines.rename(columns=lambda name: name.replace("_", " ")), note + _sources(rows))


_FAILURES = ("mismatches", "crashes", "reports", *ENDINGS[3:])


def _with_sum(ties: DataFrame) -> DataFrame:
    wrong = ties["mismatches"].map(_bad)
    last = {"name": "all", "pairs": ties["pairs"].sum(), "mismatches": _mismatches(ties)}
    return concat([ties.assign(mismatches=wrong), DataFrame([last])])


def _by_implementation(rows: DataFrame) -> DataFrame:
    """Backends first: how their cases ended."""
    by = rows.sort_values("kind", kind="stable").groupby("implementation", sort=False)
    losses = [_losses(own) for _, own in by]
    return by[[*ENDINGS]].sum().assign(**{"missed, false, repeated": losses}).reset_index()


def _by_compiler(files: DataFrame) -> DataFrame:
    every = files.explode("configurations", ignore_index=True)
    every[["compiler", "flags"]] = every["configurations"].str.extract(r"(\S+)\s*(.*)")
    by = every.groupby(["compiler", "machine"], sort=False)["flags"]
    return by.agg(configurations="size", flags=lambda of: ", ".join(map(code, of))).reset_index()


def _refusals(files: DataFrame) -> str:
    refused = {code(name.split()[-1]) for name in files["refused"].explode().dropna()}
    failures = files["failures"].map(len).sum()
    told = f"{files['checksums'].max()} checksums each; failures: {_bad(failures)}."
    return f"{told} Refused at compile time: {', '.join(sorted(refused))}." if refused else told


def front(found: Verification) -> Said:
    """The README's number: wrong answers to the stress catalogue, ours, then each library's."""
    asked = found["stress"][found["stress"]["asks"] != "refusal"]
    counts = {
        owner: {"wrong": grouped(rows["wrong"].sum()), "answers": grouped(_answered(rows))}
        for owner, rows in _owners(asked).items()
    }
    parts = [say("front_owner", owner=owner, **known) for owner, known in counts.items()]
    return say("front_wrong", owners=listed(parts))
