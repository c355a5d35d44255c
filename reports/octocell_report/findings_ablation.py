# SPDX-License-Identifier: MIT
"""Sentences on what skips are worth and how well the plan is chosen, computed from the rows."""

from __future__ import annotations

from collections import Counter

from octocell_report import ablation, check, words
from octocell_report.ablation import TARGET, Effect, Regret, Step, Study
from octocell_report.language import listed, scenes, spanned, tell
from octocell_report.load import Result
from octocell_report.spread import Estimate

_MOST = 3  # named one by one; more are counted


def sentences(result: Result, name: str, language: str = "en") -> list[str]:
    """Under the figure of that name."""
    found = {"ablation_skips": _skips, "ablation_steps": _steps, "ablation_regret": _regret}
    told = [
        text for b, s in ablation.backends(result).items() for text in found[name](b, s, language)
    ]
    return told + (_faults(result, language) if name == "ablation_skips" else [])


def _skips(backend: str, studies: list[Study], language: str) -> list[str]:
    """How many of the plan's skips save time, and the one that saves most."""
    known = [
        (effect.ratio, effect, study)
        for study in studies
        for effect in ablation.effects(study)
        if effect.ratio is not None
    ]
    taken = [item for item in known if item[1].taken]
    if not taken:
        return [tell(language, "skips_none", name=backend)] if known else []
    costly = sum(ratio.above(1.0) for ratio, _, _ in taken)
    ratio, effect, study = max(taken, key=lambda item: item[0].median)
    values = {"name": backend, "taken": len(taken), "costly": costly, "skip": effect.skip}
    values |= {"place": study.title, "ratio": words.times(ratio.median)}
    found = [tell(language, "skips_worth", **values)]
    chance = [ratio.median for ratio, effect, _ in known if not effect.taken]
    if chance:
        ratios = spanned(chance, words.times, language)
        found.append(tell(language, "skips_chance", name=backend, count=len(chance), ratios=ratios))
    return found + _faster_without(taken, backend, language)


def _faster_without(
    taken: list[tuple[Estimate, Effect, Study]], backend: str, language: str
) -> list[str]:
    harm = sorted((item for item in taken if item[0].below(1.0)), key=lambda item: item[0].median)
    if not harm:
        return []
    parts = [
        tell(language, "skip_on", skip=effect.skip, place=study.title, value=words.times(e.median))
        for e, effect, study in harm[:_MOST]
    ]
    values = {"name": backend, "count": len(harm)}
    return [tell(language, "skips_harm", cases=listed(parts, language), **values)]


def _steps(backend: str, studies: list[Study], language: str) -> list[str]:
    """How much faster all skips together make it, which step does most, and where one hurts."""
    held = [(study, e) for study in studies if (e := ablation.whole(study)) is not None]
    if not held:
        return []
    best = Counter(
        max(gains, key=lambda gain: gain[0])[1]
        for study, _ in held
        if (gains := [(-s.change, s.skip) for s in ablation.steps(study) if s.kind == "saved"])
    )
    found = [
        tell(
            language,
            "steps_whole",
            name=backend,
            ratios=spanned([e.median for _, e in held], words.ratio, language),
            scenes=scenes(len(held), language),
            steps=listed(
                [_step_of(skip, n, language) for skip, n in best.most_common()]
                or [tell(language, "steps_no_gain")],
                language,
            ),
        )
    ]
    lost = [
        (step, study)
        for study, _ in held
        for step in ablation.steps(study)
        if step.told and step.kind == "lost"
    ]
    return found + _worst_steps(lost, backend, language)


def _step_of(skip: str, n: int, language: str) -> str:
    return tell(language, "step_on_scenes", skip=skip, scenes=scenes(n, language))


def _worst_steps(lost: list[tuple[Step, Study]], backend: str, language: str) -> list[str]:
    if not lost:
        return []
    parts = [
        tell(
            language,
            "skip_on",
            skip=step.skip,
            place=study.title,
            value=f"+{words.number(step.change)}",
        )
        for step, study in sorted(lost, key=lambda item: -item[0].change)[:_MOST]
    ]
    values = {"name": backend, "count": len(lost), "cases": listed(parts, language)}
    return [tell(language, "steps_lost", **values)]


def _regret(backend: str, studies: list[Study], language: str) -> list[str]:
    """How often the plan is as good as asked, and where it is not."""
    every = ablation.regrets(studies)
    if not every:
        return []
    worst = max(every, key=lambda regret: regret.ratio.median)
    counts = Counter(regret.verdict for regret in every)
    target = f"{TARGET:.2f}"
    found = [
        tell(
            language,
            "regret_within",
            name=backend,
            target=target,
            within=counts["within"],
            scenes=scenes(len(every), language),
            worst=_against(worst, language),
        )
    ]
    above = sorted((r for r in every if r.verdict == "above"), key=lambda r: -r.ratio.median)
    if above:
        cases = listed([_against(regret, language) for regret in above], language)
        found.append(tell(language, "regret_above", target=target, cases=cases))
    for verdict, key in (("unclear", "regret_unclear"), ("unknown", "regret_unknown")):
        titles = [regret.study.title for regret in every if regret.verdict == verdict]
        if titles:
            cases = listed(titles, language)
            found.append(tell(language, key, target=target, cases=cases))
    return found


def _against(regret: Regret, language: str) -> str:
    values = {"place": regret.study.title, "choice": ablation.choice(regret.best)}
    return tell(language, "regret_case", ratio=words.ratio(regret.ratio.median), **values)


def _faults(result: Result, language: str) -> list[str]:
    """What is not in the figures, and which answers were wrong."""
    found = []
    left = [f"{study.key.backend} {study.title}" for study in ablation.unjudged(result)]
    if left:
        found.append(tell(language, "ablation_left_out", cases=listed(left, language)))
    verdict = check.judge(result)
    wrong = [
        f"{row.impl.backend} {ablation.choice(row)} {words.place(row.place)} ({words.losses(row)})"
        for row in [*verdict.wrong, *verdict.wrong_variants]
    ]
    if wrong:
        found.append(tell(language, "ablation_wrong", cases=listed(wrong, language)))
    return found
