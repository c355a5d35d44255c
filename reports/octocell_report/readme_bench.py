# SPDX-License-Identifier: MIT
"""Tables of a bench: what is right, how fast it is beside libraries, by kind of scene, by frame.

Ratios are taken within interleaved rounds; where an interval is given, it holds 99 % (spread.py).
"""

from pathlib import Path
from statistics import median, mode
from typing import Any

import pandas as pd

from octocell_report import spread, tables, words
from octocell_report.fields import ReportError
from octocell_report.load import Group, Place, Result
from octocell_report.markdown import bold, code, table
from octocell_report.plan import PLANNED, REBUILT
from octocell_report.texts import Said, listed, say
from octocell_report.words import NONE, family_title, grouped, number

SCENE = "gas"  # the plain scene: the tables of speeds are about it alone
RUNS = ("cold", "warm")
WITHOUT_FLAGS = "_without_flags"  # ends the name of a scene whose flags only say who moves

_INTERVAL = "Ratios are medians over the rounds, in brackets their 99 % interval."

Row = Any  # a named tuple of the columns of Result.frame


def chosen(frame: pd.DataFrame, **fixed: object) -> pd.DataFrame:
    """Lines with these values, in the order of tables."""
    for column, value in fixed.items():
        frame = frame[frame[column] == value]
    return frame.sort_values("order", kind="stable")


def best(frame: pd.DataFrame, **fixed: object) -> Row | None:
    """The fastest exact line with these values; the first that is wrong if none is exact."""
    rows = chosen(frame[frame["ran"] & ~frame["negative_control"]], **fixed)
    ranked = rows.sort_values(["counts", "median_ms"], ascending=[False, True], kind="stable")
    return next(ranked.itertuples(), None)


def plan(result: Result, place: Place) -> Row | None:
    """Our fastest plan there on one thread, cold; None without an exact one."""
    known = {"run": "cold", "method": PLANNED, "threads": 1, "counts": True}
    return best(result.frame, scene=place.scene, n=place.n, **known)


def shown(row: Row | None) -> str:
    """The time; of what is not exact the verdict, since its time would mislead."""
    if row is None or not row.ran:
        return NONE if row is None else "skipped"
    return number(row.median_ms) if row.counts else bold(words.verdict(row))


def faster(row: Row | None, reference: Row | None) -> str:
    """How many times as fast as the reference: '3.00×'."""
    rounds = _rounds(reference, row)
    return words.ratio(median(rounds)) if rounds else NONE


def longer(row: Row | None, reference: Row | None) -> str:
    """How many times as long it takes, with the interval: '1.04 (1.03 to 1.06)'."""
    rounds = _rounds(row, reference)
    if not rounds:
        return NONE
    middle, low, high = spread.estimate(rounds)[:3]
    show = number if (low + high) / 2 >= 9.995 else "{:.2f}".format
    return f"{show(middle)} ({show(low)} to {show(high)})"


def _rounds(above: Row | None, below: Row | None) -> tuple[float, ...]:
    """Time by time, round by round; none unless both are exact."""
    if above is None or below is None or not (above.counts and below.counts):
        return ()
    return spread.ratios(above.round_ms, below.round_ms)


def machine(result: Result) -> str:
    """One line: what the numbers beside it belong to."""
    context, box = result.context, result.context["machine"]
    dirty = " with uncommitted changes" if context["dirty"] else ""
    parts = [
        *([result.gpu.name] if result.gpu else []),
        f"{box['cpu']}, {box['cores']} cores, {box['memory_bytes'] / 1e9:.0f} GB, {box['os']}",
        f"{context['compiler']} ({context['build_type']}, `{context['flags']}`)",
        f"commit {context['commit'][:12]}{dirty}",
        context["date"][:10],
        *([] if context["finished"] else ["run interrupted"]),
    ]
    return f"{'; '.join(parts)}."


def correctness(result: Result) -> str:
    """Implementations that are wrong somewhere, by scene; all others in one line."""
    titles, met = words.titles(result), result.frame.groupby("label")["status"].agg(set)
    wrong = [label for label in titles if "wrong" in met[label]]
    exact = [
        code(titles[label]) for label in titles if "wrong" not in met[label] and "ok" in met[label]
    ]
    absent = [code(titles[label]) for label in titles if met[label] == {"skipped"}]
    said = f"Exact wherever they ran, of {len(result.groups)} scenes and sizes: {', '.join(exact)}."
    said += f" Not run here: {', '.join(absent)}." if absent else ""
    if not wrong:
        return said
    lines = [[titles[of], *(_right(result, of, scene) for scene in result.scenes)] for of in wrong]
    note = (
        f"{words.MINUS} pairs missed, + pairs that do not overlap, × pairs given twice; at the "
        "largest size that is wrong."
    )
    return f"{said}\n\n{table(pd.DataFrame(lines, columns=['wrong', *result.scenes]), note)}"


def _right(result: Result, label: str, scene: str) -> str:
    """What one implementation gets wrong on a scene, or at how many sizes it is exact."""
    rows = chosen(result.frame, label=label, scene=scene)
    wrong = rows[rows["status"] == "wrong"]
    if len(wrong):
        worst = wrong.sort_values(["n", "errors"]).iloc[-1]
        return f"{bold(words.losses(worst))} at {words.size(worst['n'])}"
    exact = rows[rows["status"] == "ok"]["n"].nunique()
    sizes = sum(group.scene == scene for group in result.groups)
    if exact:
        return "exact" if exact == sizes else f"exact, {exact} of {sizes} sizes"
    return "skipped" if len(rows) else NONE


def speed(result: Result) -> str:
    """Ratios first: they carry over to other machines better than times do."""
    place = tables.compared(result, SCENE, "warm")
    if place is None:
        raise ReportError(f"block 'speed' needs the scene {SCENE}, which the result does not have")
    here = chosen(result.frame, scene=SCENE, n=place.n)
    exact = here[here["counts"] & (here["kind"] == "baseline")]
    fastest = {
        f"fastest {family_title(family)}": {run: best(rows, run=run) for run in RUNS}
        for family, rows in exact[exact["run"].isin(RUNS)].groupby("family", sort=False)
    }
    known = {(row.label, row.run): row for row in here.itertuples() if row.run in RUNS}
    lines = []
    for label in dict.fromkeys(label for label, _ in known):
        own = {run: known.get((label, run)) for run in RUNS}
        ratios = [" / ".join(faster(own[run], of[run]) for run in RUNS) for of in fastest.values()]
        lines.append([label, *ratios, *map(shown, own.values())])
    note = (
        f"Scene {SCENE}, {grouped(place.n)} spheres. Ratios, cold / warm: the baseline's time "
        "divided by the row's, median over interleaved rounds; above 1 the row is faster."
    )
    header = ["implementation", *(f"vs {title}" for title in fastest)]
    header += [f"{run} [ms]" for run in RUNS]
    named = [_named(title, rows) for title, rows in fastest.items()]
    return table(pd.DataFrame(lines, columns=header), " ".join([note, *named]))


def _named(title: str, rows: dict[str, Row | None]) -> str:
    """'The fastest FCL is `...`.', once if it is the same in all runs."""
    met = {run: code(row.backend) for run, row in rows.items() if row}
    if len(set(met.values())) > 1:
        met = {run: f"{name} ({run})" for run, name in met.items()}
    return f"The {title} is {', '.join(dict.fromkeys(met.values()))}."


def moving(result: Result) -> str:
    """Scenes that move, each at its largest size: a frame's time, once settled."""
    rows = tables.speedups(result).query("run == 'dynamic'")
    if rows.empty:
        raise ReportError("block 'moving' needs a moving scene, which the result does not have")
    rows = rows[rows["n"] == rows.groupby("scene")["n"].transform("max")]
    named = {"scene": "scene", "n": "spheres", "label": "implementation", "median_ms": "frame [ms]"}
    keys = ["group", "motion", "order", *named]
    ratios = rows.assign(ratio=[words.ratio(median(rounds)) for rounds in rows["ratios"]])
    lines = ratios.pivot(index=keys, columns="family_ref", values="ratio")[tables.families(result)]
    lines = lines.rename(columns=lambda family: f"vs fastest {family_title(family)}").reset_index()
    lines = lines.assign(n=lines["n"].map(grouped), median_ms=lines["median_ms"].map(number))
    note = (
        "Median time of a frame, without the first ones, in which structures settle. We rebuild "
        "each frame unless we can prove that nothing relevant moved; a library updates its "
        "structure. Ratio: the library's fastest time divided by the row's."
    )
    return table(lines.drop(columns=keys[:3]).rename(columns=named), note)


def _headline(result: Result, block: str) -> tuple[Group, Row, pd.DataFrame]:
    """The first scene, our plan there, and the baselines that ran, cold."""
    for group in result.groups[:1]:
        ours = plan(result, group.place)
        where = {"scene": group.scene, "n": group.n, "run": "cold", "kind": "baseline"}
        theirs = chosen(result.frame, **where, ran=True)
        if ours is not None and len(theirs):
            return group, ours, theirs
    raise ReportError(f"block '{block}' needs cold rows of a plan and of a baseline")


def against(result: Result) -> str:
    """Every baseline beside our plan."""
    group, ours, theirs = _headline(result, "against")
    lines = [[row.label, shown(row), longer(row, ours)] for row in theirs.itertuples()]
    lines.insert(0, [ours.label, shown(ours), NONE])
    note = (
        f"{_title(group)}, {grouped(group.n)} spheres, cold, 1 thread, median of {ours.rounds} "
        f"interleaved rounds. Times as long: its time divided by the first row's. {_INTERVAL}"
    )
    header = ["implementation", "time [ms]", "times as long"]
    return table(pd.DataFrame(lines, columns=header), note)


def front(result: Result) -> Said:
    """The README's number: how many times as fast as each library's fastest our plan is."""
    group, ours, _ = _headline(result, "front_libraries")
    where = {"run": "cold", "scene": group.scene, "n": group.n, "label": ours.label}
    parts = [
        say("front_library", times=f"{median(row.ratios):.0f}", family=family_title(row.family_ref))
        for row in chosen(tables.speedups(result), **where).itertuples()
    ]
    known = {"n": grouped(group.n), "ms": shown(ours), "commit": result.context["commit"][:8]}
    machine = result.context["machine"]["cpu"]
    return say("front_libraries", libraries=listed(parts), machine=machine, **known)


def kinds(result: Result, run: str) -> str:
    """Every scene beside the first, at the size that most scenes have."""
    rows = chosen(result.frame, run=run, method=PLANNED, ran=True, threads=1)
    rows = rows[rows["predicate"].isna()]
    known = {(row.group, row.backend): row for row in rows.itertuples()}
    groups = {at: group for at, group in enumerate(result.groups) if at in set(rows["group"])}
    size = mode(group.n for group in groups.values()) if groups else 0
    first = next((at for at, group in groups.items() if group.n == size), None)
    if first is None or len(groups) < 2:
        raise ReportError(f"block 'kinds_{run}' needs {run} rows of a plan on two scenes")
    met = pd.Series([backend for _, backend in known]).value_counts()
    backends = [name for name in rows["backend"].unique() if 2 * met[name] > len(groups)]
    lines = []
    for at, group in groups.items():
        cells = [_title(group), grouped(group.n), grouped(group.truth_pairs or 0)]
        for backend in backends:
            row, of = (_per_output(known.get((g, backend)), groups[g]) for g in (at, first))
            cells += [shown(row), "1" if at == first else longer(row, of)]
        lines.append(cells)
    reference = words.place(groups[first].place)
    note = (
        f"{run.capitalize()}, the planned default, one thread on a CPU; median of the rounds. "
        f"Of {reference}: time per sphere and true pair, divided by the same there. {_INTERVAL}"
    )
    header = ["scene", "spheres", "pairs"]
    header += [title for name in backends for title in (f"{name} [ms]", f"of {reference}")]
    return table(pd.DataFrame(lines, columns=header), note)


def _per_output(row: Row | None, group: Group) -> Row | None:
    """With the rounds' times per sphere and true pair."""
    output = group.n + (group.truth_pairs or 0)
    return row and row._replace(round_ms=tuple(ms / output for ms in row.round_ms))


def _title(group: Group) -> str:
    """'poly:n=1000,seed=1,ratio=1000000' -> 'poly, ratio 1 000 000'; of a file its name."""
    name, colon, parameters = group.spec.partition(":")
    if not colon:
        return Path(name).stem
    known = [text.partition("=")[::2] for text in parameters.split(",")]
    told = [f"{key} {_digits(value)}" for key, value in known if key not in ("n", "seed")]
    return ", ".join([name, *told])


def _digits(value: str) -> str:
    return grouped(int(value)) if value.isdecimal() and len(value) < 20 else value


def frames(result: Result) -> str:
    """A frame that may take over from the last, by the same frame searched again."""
    again = tables.searched_again(result)
    moving = chosen(result.frame[result.frame["motion"].notna()], counts=True)
    rows = {(row.label, row.scene, row.n): row for row in moving.itertuples()}
    told = [row for row in rows.values() if row.Index in again]
    if not told:
        raise ReportError(f"block 'frames' needs moving scenes with the variant '{REBUILT}'")
    lines = []
    for row in told:
        silent = rows.get((row.label, row.scene + WITHOUT_FLAGS, row.n))
        times = [shown(row), longer(row, again[row.Index]), longer(row, silent)]
        lines.append([row.scene, row.backend, *times])
    first = told[0]
    of_frames = result.motion_frames.query("row == @first.Index")
    count = f"{len(of_frames)} frames, the first {of_frames['warmup'].sum()} left out"
    note = (
        f"{grouped(first.n)} spheres, {count}; a round's time is its median frame. Of searching "
        "again: divided by the time of the same row, in the same rounds, when no frame reuses "
        "anything. Of the same without flags: divided by the time, measured apart, when the same "
        f"spheres move, but no flag says that the others do not. {_INTERVAL}"
    )
    header = ["scene", "implementation", "frame [ms]", "of searching again"]
    header += ["of the same without flags"]
    return table(pd.DataFrame(lines, columns=header), note)
