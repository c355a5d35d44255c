# SPDX-License-Identifier: MIT
"""Rows of a device: bandwidth, runs side by side, and a page where the host ends early."""

from __future__ import annotations

import math

import pandas as pd
import pytest

from octocell_report import (
    bandwidth,
    front,
    page,
    page_tables,
    plots,
    readme_gpu,
    style,
    tables,
)
from octocell_report.cli import main
from octocell_report.fields import ReportError
from octocell_report.load import DEVICE_RUNS, Place, parse

import synthetic
import synthetic_gpu
from synthetic import group, row
from synthetic_gpu import device_row

DEVICE_FILES = {"stages_device.png", "bandwidth.png", "bandwidth_by_size.png", "bandwidth.csv"}


@pytest.fixture(scope="module")
def result():
    return parse(synthetic_gpu.whole_run())


def of_rows(*rows, **context):
    groups = [group("gas", n) for n in sorted({r["n"] for r in rows})]
    return parse(synthetic.document(groups, list(rows), **context))


def test_a_rate_is_least_bytes_by_median_time():
    stages = {"sort": [1.0, 3.0, 2.0], "resolve": [1.0]}
    known = device_row(stage_ms=stages, stage_bytes={"sort": 2_900_000_000, "bounds": 5})
    found = of_rows(known, gpu=synthetic_gpu.gpu())
    first, last, whole = bandwidth.frame(found).itertuples()
    assert (first.stage, first.gbps, first.share) == ("sort", 1450.0, 0.5)
    assert whole.stage == bandwidth.ALL and math.isnan(whole.gbps)  # resolve's bytes are not known
    assert math.isnan(last.share)


def test_too_few_bytes_are_told_and_not_ranked():
    known = device_row(
        stage_ms={"bounds": [1.0], "sort": [1.0]},
        stage_bytes={"bounds": 1000, "sort": 1_450_000_000},
        total_ms=[2.0],
    )
    found = of_rows(known, gpu=synthetic_gpu.gpu())
    assert bandwidth.frame(found)["tiny"].tolist() == [True, False, False]


def test_without_a_measured_copy_rates_stand_alone():
    known = device_row(stage_ms={"sort": [1.0]}, stage_bytes={"sort": 10**9}, total_ms=[1.0])
    found = of_rows(known)
    assert found.gpu is None
    rate = bandwidth.frame(found).iloc[0]
    assert (rate["gbps"], rate["tiny"]) == (1000, False) and math.isnan(rate["share"])
    assert dict(plots.draw_all(found)).keys() >= {"bandwidth"}


def test_rows_that_are_not_exact_have_no_bandwidth():
    bad = synthetic.wrong(device_row(), missed=1)
    control = device_row(rule="chapter32", negative_control=True)
    assert bandwidth.frame(of_rows(bad, control)).empty


def test_runs_are_held_against_the_warm_one_round_by_round():
    times = {"warm": [1.0, 2.0, 4.0], "graph": [0.5, 1.0, 4.0], "transfers": [3.0, 6.0, 12.0]}
    rows = [device_row(n=1000, run=r, total_ms=t, device_bytes=9000) for r, t in times.items()]
    (line,) = page_tables.english(page_tables.gpu(of_rows(*rows, row(n=1000)))).to_dict("records")
    assert line["graph [ms]"] == "1.00 (0.50×)" and line["with transfers [ms]"] == "6.00 (3.00×)"
    assert line["warm [ms]"] == "2.00 (1.00–4.00)" and line["device bytes per sphere"] == "9.00"
    assert "cold [ms]" not in line


def test_each_side_is_shown_at_its_own_largest_size(result):
    named = dict(plots.draw_all(result))
    for name, size in (("backend", "1M"), ("baseline", "1M"), ("device", "30M")):
        axes = named[f"stages_{name}"].axes
        assert axes[0].get_title(loc="left") == f"gas {size}"
    assert not {f"time_{run}" for run in DEVICE_RUNS} & set(named)
    assert tables.compared(result, "gas", "warm") == Place("gas", 10**6)


def test_the_front_has_a_column_for_the_device(result):
    assert list(front.best(result).columns) == [
        *("Octocell", "Octocell, 16 threads", "Octocell, GPU", "FCL", "Bullet")
    ]


def test_backends_keep_their_colours(result):
    looks = style.looks(result)
    assert looks["impl_cuda_custom lowest_cell"].colour == style.GREEN.lower()
    assert looks["impl_thrust_cuda lowest_cell"].colour == style.ORANGE.lower()
    bare = [(look.colour, str(look.line)) for look in looks.values()]
    assert len(set(bare)) == len(bare)


def test_a_build_with_a_device_and_one_without(save, tmp_path):
    out = tmp_path / "out"
    assert main(["build", str(save(synthetic_gpu.whole_run())), "-o", str(out)]) == 0
    names = {path.name for path in out.iterdir()}
    assert names >= DEVICE_FILES and names <= page.owned_names()
    table = pd.read_csv(out / "bandwidth.csv")
    assert set(table.run) == {"warm", "cold_cache"} and table.share_of_copy.notna().all()
    html = (out / "index.html").read_text()
    for text in ("On the GPU", "在 GPU 上", "Example GPU 100, copies 2\u202f900 GB/s", "Bandwidth"):
        assert text in html
    plain = synthetic.document([group("gas", 1000)], [row(), row(run="cold")], gpu=None)
    assert main(["build", str(save(plain)), "-o", str(out)]) == 0
    assert not DEVICE_FILES & {path.name for path in out.iterdir()}
    html = (out / "index.html").read_text()
    assert 'id="device"' not in html


@pytest.mark.parametrize(
    ("context", "changes", "message"),
    [
        ({"gpu": {"name": "X"}}, {}, "field 'copy_gigabytes_per_second'"),
        ({"gpu": synthetic_gpu.gpu(copy_gigabytes_per_second=0)}, {}, "is 0: Expected"),
        ({}, {"stage_bytes": {"sort": 1.5}}, "stage_bytes.*Expected 'int', got"),
        ({}, {"device_bytes": -1}, "device_bytes .* is -1"),
    ],
)
def test_what_is_broken_is_named(context, changes, message):
    with pytest.raises(ReportError, match=message):
        of_rows(device_row(**changes), **context)


def cells(block, first):
    line = next(line for line in block.splitlines() if line.startswith(f"| {first} |"))
    return [cell.strip() for cell in line.strip("|").split("|")][1:]


def test_readme_speed_by_size():
    rows = [
        device_row(n=1000, total_ms=[1.0, 2.0]),
        device_row(n=1000, run="graph", total_ms=[0.5, 0.5]),
        synthetic.wrong(device_row(n=1000, run="transfers"), missed=3),
        device_row("impl_thrust_cuda", n=1000, total_ms=[4.0, 6.0]),
        row(n=1000, total_ms=[30.0, 60.0]),
        device_row(n=2000, total_ms=[2.0, 2.0]),
    ]
    block = readme_gpu.speed(of_rows(*rows))
    small = ["1.50", "0.500", "**wrong −3 +0**", "5.00", "45.0", "3.50×", "30.0×"]
    assert cells(block, "1\u202f000") == small
    assert cells(block, "2\u202f000") == ["2.00", *"––––––"]
    with pytest.raises(ReportError, match="'gpu_speed' needs warm rows"):
        readme_gpu.speed(of_rows(row()))


def test_readme_stages_at_two_sizes(result):
    block = readme_gpu.stages(result)
    assert block.startswith("| stage | 1M: ms | share | GB/s | of copy | 10M: ms |")
    assert cells(block, "`sort`")[6:] == ["1\u202f688", "58 %"]
    assert cells(block, "`cell_index`")[2].startswith("(")
    assert cells(block, "all stages")[1] == "100 %"
    assert "2\u202f900 GB/s that a copy on this Example GPU 100" in block
    small = parse(synthetic.document([group("gas", 1000)], [device_row(n=1000)]))
    assert readme_gpu.stages(small).startswith("| stage | 1k: ms | share | GB/s |\n")
    with pytest.raises(ReportError, match="'gpu_stages' needs stages"):
        readme_gpu.stages(of_rows(row()))
