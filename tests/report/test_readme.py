# SPDX-License-Identifier: MIT
from __future__ import annotations

import pytest

from octocell_report import readme, readme_bench
from octocell_report.cli import main
from octocell_report.fields import ReportError
from octocell_report.load import load, parse

import synthetic
from synthetic import group, row, skipped, unavailable_group, wrong

TEXT = """# Title
<!-- octocell:speed result.json -->
stale words
<!-- /octocell:speed -->
between
<!-- octocell:machine result.json --><!-- /octocell:machine -->
end"""


@pytest.fixture
def document():
    rows = [
        row(total_ms=[1.0, 1.0, 1.0]),
        row(run="cold", total_ms=[2.0, 2.0, 2.0]),
        wrong(row(rule="as_written", negative_control=True), missed=334),
        skipped(row(method="brute_force", rule=None), "9 candidates, over the limit of 3"),
        row("fcl_a", None, None, total_ms=[4.0, 5.0, 6.0]),
        row("fcl_a", None, None, run="cold", total_ms=[9.0, 9.0, 9.0]),
        row("fcl_b", None, None, total_ms=[40.0, 50.0, 60.0]),
        row("fcl_b", None, None, run="cold", total_ms=[6.0, 6.0, 6.0]),
        row("bullet_dbvt", None, None, total_ms=[3.0, 3.0, 3.0]),
        row("bullet_dbvt", None, None, run="cold", total_ms=[1.0, 1.0, 1.0]),
    ]
    return synthetic.document([group("gas", 1000), unavailable_group()], rows)


def cells(block, label):
    line = next(line for line in block.splitlines() if line.startswith(f"| {label} |"))
    return [cell.strip() for cell in line.strip("|").split("|")][1:]


def test_speed_leads_with_ratios_cold_and_warm(document):
    block = readme_bench.speed(parse(document))
    assert cells(block, "implementation") == [
        "vs fastest FCL", "vs fastest Bullet", "cold [ms]", "warm [ms]"
    ]  # fmt: skip
    ours = ["3.00× / 5.00×", "0.50× / 3.00×", "2.00", "1.00"]
    assert cells(block, "impl_cpu lowest_cell") == ours
    assert "The fastest FCL is `fcl_b` (cold), `fcl_a` (warm)." in block
    assert "The fastest Bullet is `bullet_dbvt`." in block


def test_speed_gives_no_time_to_what_is_not_exact(document):
    block = readme_bench.speed(parse(document))
    no_ratios = ["– / –"] * 2
    control = "**negative control −334 +0**"
    assert cells(block, "impl_cpu as_written") == [*no_ratios, "–", control]
    assert cells(block, "impl_cpu brute_force") == [*no_ratios, "–", "skipped"]


def test_correctness_has_a_line_for_what_is_wrong_and_one_for_the_rest(document):
    block = readme_bench.correctness(parse(document))
    assert cells(block, "wrong") == ["gas", "1A2C"]
    control = "impl_cpu as_written (negative control)"
    assert cells(block, control) == ["**−334 +0** at 1k", "–"]
    said = block.partition("\n")[0]
    assert said.startswith(
        "Exact wherever they ran, of 2 scenes and sizes: `impl_cpu lowest_cell`,"
    )
    assert said.endswith("Not run here: `impl_cpu brute_force`.")


def test_correctness_says_where_it_was_wrong_and_how_many_sizes_were_exact(document):
    document["groups"].append(group("gas", 2000))
    document["rows"].append(row(n=2000))
    document["rows"].append(wrong(row("fcl_a", None, None, n=2000), missed=5))
    document["rows"].append(wrong(row(rule="as_written", n=2000, negative_control=True), missed=7))
    block = readme_bench.correctness(parse(document))
    assert cells(block, "fcl_a")[0] == "**−5 +0** at 2k"
    assert cells(block, "impl_cpu as_written (negative control)")[0] == "**−7 +0** at 2k"


def test_correctness_needs_no_table_where_all_is_exact():
    block = readme_bench.correctness(parse(synthetic.document([group("gas", 1000)], [row()])))
    assert block == "Exact wherever they ran, of 1 scenes and sizes: `impl_cpu lowest_cell`."


def test_machine_is_one_line(document):
    document["context"] |= {"dirty": True, "finished": False}
    assert readme_bench.machine(parse(document)) == (
        "Example CPU 9000, 2 cores, 25 GB, Debian GNU/Linux 12; g++ 12.2.0 (Release, "
        "`-O3 -march=native -DNDEBUG`); commit 0123456789ab with uncommitted changes; 2026-01-02; "
        "run interrupted."
    )


def test_only_what_stands_between_markers_changes(document, save, tmp_path):
    save(document)
    fresh, differing = readme.filled(TEXT, tmp_path)
    assert differing == ["speed result.json", "machine result.json"]
    assert fresh.startswith("# Title\n<!-- octocell:speed result.json -->\n| implementation |")
    assert "stale words" not in fresh
    between = ".\n<!-- /octocell:speed -->\nbetween\n<!-- octocell:machine result.json -->\nExample"
    assert between in fresh
    assert fresh.endswith("<!-- /octocell:machine -->\nend")
    assert readme.filled(fresh, tmp_path) == (fresh, [])


def test_line_ends_stay_as_they_are(document, save, tmp_path):
    save(document)
    fresh, _ = readme.filled(TEXT.replace("\n", "\r\n"), tmp_path)
    assert fresh.count("\n") == fresh.count("\r\n") > 5


OPEN = "<!-- octocell:speed result.json -->"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a\n<!-- octocell:sped -->", "line 2: unknown marker 'octocell:sped'; known: machine"),
        ("<!-- octocell:speed -->", "line 1: marker 'octocell:speed' must name what"),
        ("<!-- /octocell:speed -->", "line 1: marker '/octocell:speed' closes what is not open"),
        (f"{OPEN}\n", "line 1: marker 'octocell:speed' is not closed by '/octocell:speed'"),
        (f"{OPEN}{OPEN}", "'octocell:speed' is not closed"),
        (f"{OPEN}<!-- /octocell:machine -->", "'octocell:speed' is not closed"),
        (f"{OPEN}<!-- /octocell:speed result.json -->", "'octocell:speed' is not closed"),
        ("<!-- octocell:speed a b -->", "has no octocell markers"),
        ("no markers", "has no octocell markers"),
    ],
)
def test_bad_markers_are_errors(document, save, tmp_path, text, message):
    save(document)
    with pytest.raises(ReportError, match=message):
        readme.filled(text, tmp_path)


@pytest.mark.parametrize("name", [n for n, (reads, _) in readme.BLOCKS.items() if reads is load])
def test_a_result_that_lacks_what_a_block_needs_is_an_error_that_names_it(name):
    rows = [skipped(row("bullet_dbvt", None, None), "too slow")]
    for document in (synthetic.document([], []), synthetic.document([group("gas", 1000)], rows)):
        try:
            readme.BLOCKS[name][1](parse(document))
        except ReportError as error:
            assert f"block '{name.removesuffix('_zh')}'" in str(error)


def test_parameters_of_a_scene_may_be_strange():
    told = [readme_bench._title(parse(synthetic.document([group("gas", 1, spec=s)], [])).groups[0])
            for s in ("gas:n=1,a=" + "7" * 5000, "gas:a=²,b", "/tmp/a.npy")]  # fmt: skip
    assert told == ["gas, a " + "7" * 5000, "gas, a ², b ", "a"]


def test_speed_without_its_scene_is_an_error():
    document = synthetic.document([group("fog", 1000)], [row(scene="fog")])
    with pytest.raises(ReportError, match="needs the scene gas"):
        readme_bench.speed(parse(document))


def test_the_command_rewrites_checks_and_leaves_nothing_beside(document, save, tmp_path, capsys):
    path = tmp_path / "README.md"
    save(document)
    path.write_text(TEXT)
    path.chmod(0o640)
    assert main(["readme", str(path), "--check"]) == 1
    assert path.read_text() == TEXT
    assert "differs" in capsys.readouterr().out
    assert main(["readme", str(path)]) == 0
    assert main(["readme", str(path), "--check"]) == 0
    assert path.stat().st_mode & 0o777 == 0o640
    path.write_text(path.read_text().replace("5.00×", "50.0×"))
    assert main(["readme", str(path), "--check"]) == 1
    assert sorted(p.name for p in tmp_path.iterdir()) == ["README.md", "result.json"]


def test_an_unknown_marker_leaves_the_file_alone(document, save, tmp_path, capsys):
    path, text = tmp_path / "README.md", TEXT + "<!-- octocell:weather -->"
    path.write_text(text)
    save(document)
    assert main(["readme", str(path)]) == 2
    assert path.read_text() == text
    assert "unknown marker 'octocell:weather'" in capsys.readouterr().err
