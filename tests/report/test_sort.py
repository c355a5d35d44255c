# SPDX-License-Identifier: MIT
from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from octocell_report import sort, sort_figures
from octocell_report.cli import main
from octocell_report.fields import ReportError

import synthetic
from synthetic import Json


def row(algorithm: str = "impl_cpu", **changes: object) -> Json:
    known: Json = {
        "algorithm": algorithm, "device": "cpu", "n": 4096, "bits": 8,
        "order": "random", "threads": 1,
        "stable": True, "packed": algorithm != "impl_cpu", "status": "ok", "reason": None,
        "iterations": 9, "total_ms": [1.0, 4.0, 2.0], "items_per_second_median": 2048e3,
    }  # fmt: skip
    known |= changes
    if known["status"] != "ok":
        known |= {"total_ms": [], "items_per_second_median": None}
    keys = ("algorithm", "n", "bits", "order", "threads")
    return {"name": "sort/" + "/".join(f"{key}:{known[key]}" for key in keys), **known}


LADDER = ("cuda_one_bit_split", "cuda_digit_passes", "cuda_reduce_then_scan", "cuda_onesweep",
          "cub")  # fmt: skip


def gpu_row(algorithm: str, **changes: object) -> Json:
    return row(algorithm, **({"device": "gpu", "threads": 0, "packed": False} | changes))


def gpu_cases() -> Json:
    """Two widths over two sizes, a third at the larger, two orders there."""
    rows = [
        gpu_row(name, n=n, bits=bits, total_ms=[n * cost * bits, n * cost * bits * 1.1])
        for name, cost in zip(LADDER, (1e-7, 5e-8, 2e-8, 1e-8, 1.1e-8), strict=True)
        for n, bits in ((1 << 20, 20), (1 << 20, 32), (1 << 24, 20), (1 << 24, 32), (1 << 24, 8))
    ]
    rows += [gpu_row(name, n=1 << 24, bits=20, order="sorted") for name in LADDER[2:]]
    result = document(*rows)
    gpu = {"name": "Example GPU 100", "copy_gigabytes_per_second": 2900.4}
    return result | {"context": result["context"] | {"gpu": gpu, "gpu_reason": None}}


def document(*rows: Json) -> Json:
    return {"schema": 2, "kind": "sort", "context": synthetic.context(), "rows": list(rows)}


def every_case() -> Json:
    rows = [
        row(name, n=n, bits=bits, total_ms=[n * cost, n * cost * 1.1])
        for name, cost in (("impl_cpu", 4e-6), ("std_sort", 6e-5), ("newcomer", 1e-5))
        for n in (4096, 16384)
        for bits in (8, 32)
    ]
    rows += [row(n=n, threads=2, bits=8) for n in (4096, 16384)]
    rows += [row(n=16384, bits=8, order=order) for order in ("sorted", "few_distinct")]
    rows += [row("std_sort", n=16384, order="sorted", status="wrong", reason="not sorted: key 1")]
    rows += gpu_cases()["rows"]
    rows += [row("highway_vqsort", status="skipped", reason="built without a Highway")]
    return document(*rows) | {"context": gpu_cases()["context"]}


def on_host() -> sort.SortResult:
    return sort.parse(every_case()).on("cpu")


def test_figures_and_a_table_of_every_row(save, tmp_path: Path, capsys):
    out = tmp_path / "out"
    assert main(["sort", str(save(every_case())), "-o", str(out)]) == 0
    assert {path.name for path in out.iterdir()} == set(sort_figures.NAMES)
    assert all(name in capsys.readouterr().out for name in ("sort.csv",))
    table = pd.read_csv(out / "sort.csv")
    assert len(table) == len(every_case()["rows"])
    bare = table[table.status != "ok"]
    assert len(bare) == 2 and bare.median_ms.isna().all() and bare.reason.notna().all()


def test_numbers_of_the_table():
    frame = sort.table(sort.parse(document(row())))
    assert frame.loc[0, ["median_ms", "min_ms", "max_ms", "rounds"]].tolist() == [2.0, 1.0, 4.0, 3]
    assert frame.gitems_per_second_median[0] == pytest.approx(4096 / 2e6)


def facets(figure):
    return {ax.get_title(): ax for ax in figure.axes if ax.get_visible()}


def test_a_facet_for_each_width_and_a_line_for_each_sort():
    figure = sort_figures.draw_by_size(on_host())
    assert list(facets(figure)) == ["8-bit keys", "32-bit keys"]
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["Octocell radix sort", "std::sort", "newcomer",
                      "Octocell radix sort, 2 threads"]  # fmt: skip
    lines = [line for line in facets(figure)["32-bit keys"].lines if len(line.get_xdata()) == 2]
    assert len(lines) == 3
    note = figure.legends[0].get_title().get_text()
    assert "left out: Highway vqsort: built without a Highway" in note


def test_a_wrong_sort_is_named_and_has_no_mark():
    figure = sort_figures.draw_by_order(on_host())
    (ax,) = facets(figure).values()
    assert any(text.get_text() == "WRONG: std::sort" for text in ax.texts)
    assert ax.get_title() == "8-bit keys, 2¹⁴ pairs"


LADDER_LABELS = ["1 one-bit split", "2 digit passes", "3 reduce then scan", "4 onesweep", "CUB"]


def test_the_ladder_over_sizes_beside_cub():
    figure = sort_figures.draw_by_size(sort.parse(every_case()).on("gpu"))
    assert list(facets(figure)) == ["20-bit keys", "32-bit keys"]  # 8 bits have but one size
    assert [text.get_text() for text in figure.legends[0].get_texts()] == LADDER_LABELS
    note = figure.legends[0].get_title().get_text()
    assert "Example GPU 100, copies 2\u202f900 GB/s" in note and "packed" not in note


def test_the_ladder_over_widths_at_the_size_with_most():
    figure = sort_figures.draw_by_bits(sort.parse(every_case()).on("gpu"))
    (ax,) = facets(figure).values()
    lines = [line for line in ax.lines if len(line.get_xdata()) == 3]
    assert len(lines) == len(LADDER) and list(lines[0].get_xdata()) == [8, 20, 32]
    assert list(facets(figure)) == ["2²⁴ pairs"]


def test_rows_of_a_gpu_alone_need_no_rows_of_the_host(tmp_path: Path):
    names = sort_figures.build(sort.parse(gpu_cases()), tmp_path / "out")
    assert names == [name for name in sort_figures.NAMES if "gpu" in name or name == "sort.csv"]


def test_nothing_timed_is_a_table_alone(tmp_path: Path):
    result = sort.parse(document(row(status="skipped", reason="no time")))
    assert sort_figures.build(result, tmp_path / "out") == ["sort.csv"]


BROKEN = {
    "a bench result": ({"kind": "bench"}, "not a result of bench-sort"),
    "another schema": ({"schema": 3}, "schema 2 is read here"),
    "no rows": ({"rows": None}, "rows is null"),
    "a row twice": ({"rows": [row(), row()]}, "two rows are called sort/"),
    "ok without a time": ({"rows": [row(total_ms=[])]}, "says ok"),
    "wrong with a time": (
        {"rows": [row() | {"status": "wrong"}]},
        "says wrong, but 'total_ms' is [1.0, 4.0, 2.0]",
    ),
    "skipped without a reason": ({"rows": [row(status="skipped")]}, "'reason'"),
    "an unknown device": ({"rows": [row(device="tpu")]}, ".device (sort/algorithm:"),
    "no bits": ({"rows": [{k: v for k, v in row().items() if k != "bits"}]}, "'bits'"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_what_is_broken_is_refused_in_one_line(save, tmp_path: Path, capsys, name: str):
    changes, words = BROKEN[name]
    path = save(document(row()) | changes)
    assert main(["sort", str(path), "-o", str(tmp_path / "out")]) == 2
    error = capsys.readouterr().err
    assert words in error and str(path) in error and error.count("\n") == 1
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("text", ["", "[1", "[]", "3"])
def test_what_is_no_json_object_is_refused(tmp_path: Path, text: str):
    path = tmp_path / "x.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ReportError):
        sort.load(path)
