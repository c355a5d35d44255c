# SPDX-License-Identifier: MIT
"""Sentences computed from the rows of a device."""

from __future__ import annotations

from octocell_report import bandwidth, gpu_runs, words
from octocell_report.bandwidth import Rate
from octocell_report.language import listed, spanned, tell
from octocell_report.load import Result


def bandwidths(result: Result, language: str = "en") -> list[str]:
    """For each backend, how far its stages are from the copy, over the scenes' largest sizes."""
    every: dict[str, list[Rate]] = {}
    places = bandwidth.places(result)
    for place in places:
        for row in bandwidth.best(result, place):
            every.setdefault(row.impl.backend, []).extend(bandwidth.rates(result, row))
    scenes = tell(language, "scenes_one" if len(places) == 1 else "scenes", scenes=len(places))
    found = []
    for backend, rates in every.items():
        told = [rate for rate in rates if not rate.tiny]
        parts = [_stage(stage, told, language) for stage in bandwidth.met(told)]
        values = {"name": backend, "scenes": scenes, "stages": listed(parts, language)}
        if parts and result.gpu:
            copied = words.grouped(result.gpu.copy_gbps)
            found.append(tell(language, "of_copy", **values, copied=copied))
        elif parts:
            found.append(tell(language, "of_no_copy", **values))
    return found + _too_little(every, language)


def _stage(stage: str, rates: list[Rate], language: str) -> str:
    """'sort 60 to 71 %', or GB/s where no copy was measured."""
    here = [rate for rate in rates if rate.stage == stage]
    shares = [100 * rate.share for rate in here if rate.share is not None]
    if shares:
        return f"{stage} {spanned(shares, words.percent, language)} %"
    return f"{stage} {spanned([rate.gbps for rate in here], words.number, language)} GB/s"


def _too_little(every: dict[str, list[Rate]], language: str) -> list[str]:
    tiny = [rate for rates in every.values() for rate in rates if rate.tiny]
    if not tiny:
        return []
    names = {
        stage: dict.fromkeys(words.place(r.row.place) for r in tiny if r.stage == stage)
        for stage in bandwidth.met(tiny)
    }
    parts = [f"{stage} ({listed(list(where), language)})" for stage, where in names.items()]
    limit = f"{bandwidth.LAUNCH_US:g}"
    return [tell(language, "too_little", stages=listed(parts, language), limit=limit)]


def by_size(result: Result, language: str = "en") -> list[str]:
    """Over all stages of the plain scene: its best size, by backend and run."""
    labels, found = words.labels(result), []
    place = next((p for p in bandwidth.places(result) if p.scene == bandwidth.SCENE), None)
    for best in bandwidth.best(result, place) if place else []:
        for run in bandwidth.RUNS:
            rows = bandwidth.over_sizes(result, best.impl, run)
            rates = [rate for row in rows if (rate := bandwidth.whole(result, row))]
            if len(rates) < 2:
                continue
            top = max(rates, key=lambda rate: rate.gbps)
            values = {
                "name": labels[best.impl],
                "run": tell(language, f"run_{run}"),
                "place": words.place(top.row.place),
                "rate": words.number(top.gbps),
            }
            if top.share is None:
                found.append(tell(language, "best_rate", **values))
            else:
                share = words.percent(100 * top.share)
                found.append(tell(language, "best_rate_share", **values, share=share))
    return found


def runs(result: Result, language: str = "en") -> list[str]:
    """For each implementation, its runs by its warm run over all groups, and its memory."""
    found, labels, every = [], words.labels(result), gpu_runs.all_runs(result)
    for impl in result.impls_of("device"):
        ours = [runs for runs in every if runs.impl == impl]
        parts = []
        for run in gpu_runs.RUNS[1:]:
            ratios = [ratio for runs in ours if (ratio := runs.to_warm(run)) is not None]
            if ratios:
                times = spanned(ratios, words.ratio, language)
                parts.append(f"{tell(language, f'run_{run}')} {times}")
        if parts:
            values = {"name": labels[impl], "groups": len(ours), "runs": listed(parts, language)}
            found.append(tell(language, "runs_by_warm", **values))
        needs = [need for runs in ours if (need := runs.bytes_per_sphere) is not None]
        if needs:
            bytes_each = spanned(needs, words.grouped, language)
            found.append(tell(language, "device_bytes", name=labels[impl], needs=bytes_each))
    return found
