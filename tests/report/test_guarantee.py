# SPDX-License-Identifier: MIT
"""What was tried to break the guarantee: read from folders, checked, and told as tables."""

from __future__ import annotations

import pytest

from octocell_report import readme, readme_guarantee, verification
from octocell_report.cli import main
from octocell_report.fields import ReportError

import synthetic_guarantee
from synthetic_guarantee import fault, save, stress_row

MARKED = """<!-- octocell:guarantee results -->
<!-- /octocell:guarantee -->
"""


def lines_of(block):
    rows = [line for line in block.splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in rows]
    return {line[0]: line[1:] for line in cells}


def told(folder, block="guarantee"):
    read, write = readme.BLOCKS[block]
    return lines_of(write(read(folder)))


def test_the_table_adds_up_what_the_files_hold(tmp_path):
    lines = told(synthetic_guarantee.save_all(tmp_path))
    thin = "\u202f"
    assert lines == {
        "": ["Octocell", "FCL", "Bullet"],
        "---": ["---:"] * 3,
        "near-tangent pairs decided, CPU": [
            f"1{thin}250{thin}000{thin}000 in 2 families",
            "–",
            "–",
        ],
        "– of these wrong": ["0 (rate below 2.5 · 10⁻¹⁰)", "–", "–"],
        "near-tangent pairs decided, GPU": [
            f"12{thin}000{thin}000{thin}000 in 1 families",
            "–",
            "–",
        ],
        "stress catalogue (2 families, 3 entries): answers": [
            "6 by 2 implementations",
            "4 by 1 implementations",
            "3 by 1 implementations",
        ],
        "– wrong answers": ["0", "**1**", "0"],
        "– pairs missed, false, repeated": ["0, 0, 0", "**9, 0, 4**", "0, 0, 0"],
        "– crashed or too late": ["0", "0", "**1**"],
        "bad inputs tried, refused by name": ["27 of 27", "–", "–"],
        "inputs made by fuzzers": [f"13{thin}000{thin}000, failures: 0", "–", "–"],
        "faults planted in the sources, found": ["1 of 1 (1 not run)", "–", "–"],
        "compilers and flags with one checksum": ["3", "–", "–"],
        "reports of sanitizers": ["0 in 413 tests (ASan + UBSan, TSan)", "–", "–"],
    }


def test_what_is_absent_was_not_run(tmp_path):
    found = verification.read(save(tmp_path))
    lines = lines_of(readme_guarantee.guarantee(found))
    ours = {cells[0] for title, cells in lines.items() if title not in ("", "---")}
    assert ours == {"not run"}
    for name, (_, write) in readme.BLOCKS.items():
        if name.startswith("guarantee_"):
            assert write(found) == "Not run yet."


@pytest.mark.parametrize(
    ("kind", "made", "title", "cell"),
    [
        ("near_tangent", synthetic_guarantee.near_tangent(a=(10, 3)), "– of these wrong", "**3**"),
        ("fuzz", synthetic_guarantee.fuzz(1), "inputs made by fuzzers", "failures: **1**"),
        ("sanitizers", synthetic_guarantee.sanitizers(2), "reports of sanitizers", "**2** in 413"),
        (
            "compilers",
            synthetic_guarantee.compilers(failures=["g++ -O0: gas differs"]),
            "compilers and flags with one checksum",
            "**1 failures in 3**",
        ),
        (
            "mutants",
            synthetic_guarantee.mutants(fault("a"), fault("b", "survived")),
            "faults planted in the sources, found",
            "**1 of 2**",
        ),
    ],
)
def test_what_broke_stands_out(tmp_path, kind, made, title, cell):
    block = readme_guarantee.guarantee(verification.read(save(tmp_path, **{kind: made})))
    assert any(line.startswith(f"| {title} |") and cell in line for line in block.splitlines())


def test_a_fault_is_judged_over_machines(tmp_path):
    first = synthetic_guarantee.mutants(fault("a", "not_run"), fault("b"), fault("c", "not_run"))
    second = synthetic_guarantee.mutants(fault("a"), fault("b", "survived"))
    folder = save(tmp_path, mutants=first, mutants_gpu=second)
    assert told(folder)["faults planted in the sources, found"][0] == "**1 of 2** (1 not run)"
    lines = told(folder, "guarantee_mutants")
    assert [lines[name][1] for name in "abc"] == ["killed", "**survived**", "not_run"]


def test_faults_that_ran_nowhere_are_not_run(tmp_path):
    folder = save(tmp_path, mutants=synthetic_guarantee.mutants(fault("a", "not_run")))
    assert told(folder)["faults planted in the sources, found"][0] == "not run"


def test_details_have_a_line_each(tmp_path):
    folder = synthetic_guarantee.save_all(tmp_path)
    ties = told(folder, "guarantee_near_tangent")
    assert ties["quadruples"][2:] == ["0", "epyc"]
    assert ties["all"][2] == "0 (rate below 2.3 · 10⁻¹⁰)"
    stress = told(folder, "guarantee_stress")
    assert list(stress)[2:] == [
        "impl_cpu planned",
        "impl_cpu home_phantom chapter32",
        "fcl_sap",
        "bullet_dbvt",
    ]
    assert stress["fcl_sap"] == ["3", "27", "0", "0", "0", "**1**", "**9, 0, 4**"]
    compilers = readme_guarantee.details(verification.read(folder), "compilers")
    assert "| g++ | epyc | 2 | `-O0`, `-O3 -mfma` |" in compilers
    assert "84 checksums each; failures: 0. Refused at compile time: `-Ofast`." in compilers
    assert told(folder, "guarantee_fuzz")["fuzz_scenes"][3] == "epyc"
    assert told(folder, "guarantee_sanitizers")["TSan"][0] == "198"
    assert "`epyc/stress.json` (0123456789ab, 2026-01-02)" in readme_guarantee.details(
        verification.read(folder), "stress"
    )


def without(document, *path):
    *heads, last = path
    inner = document
    for key in heads:
        inner = inner[key]
    del inner[last]
    return document


@pytest.mark.parametrize(
    ("kind", "made", "message"),
    [
        ("fuzz", [], "Expected 'object', got 'array'"),
        ("fuzz", synthetic_guarantee.sanitizers(), "its kind is 'sanitizers', and its name says"),
        (
            "fuzz",
            without(synthetic_guarantee.fuzz(), "targets"),
            "missing required field 'targets'",
        ),
        (
            "fuzz",
            synthetic_guarantee.fuzz() | {"targets": []},
            "targets: Expected 'array' of length >= 1",
        ),
        ("fuzz", synthetic_guarantee.fuzz(-1), "targets[0].crashes (fuzz_scenes) is -1: Expected"),
        (
            "near_tangent",
            synthetic_guarantee.near_tangent("TPU"),
            'where is "TPU": ',
        ),
        (
            "near_tangent",
            synthetic_guarantee.near_tangent(a=(1, 2)),
            "families[0] (a): more mismatches than pairs",
        ),
        ("compilers", synthetic_guarantee.compilers(configurations=[]), "configurations: Expected"),
        (
            "mutants",
            synthetic_guarantee.mutants(fault("a", killed_by=None)),
            "faults[0] (a): says killed, but 'killed_by'",
        ),
        (
            "mutants",
            synthetic_guarantee.mutants(fault("a", "fine")),
            'faults[0].status (a) is "fine": ',
        ),
        (
            "stress",
            without(synthetic_guarantee.stress(), "rows", 0, "cases", "late"),
            "rows[0]: 'cases' must count exact, skipped",
        ),
        (
            "stress",
            synthetic_guarantee.stress()
            | {"rows": [stress_row("Z9", "impl_cpu planned", exact=1)]},
            "no entry has the id 'Z9'",
        ),
        (
            "sanitizers",
            without(synthetic_guarantee.sanitizers(), "context", "commit"),
            "context: Object missing required field 'commit'",
        ),
    ],
)
def test_bad_files_are_named(tmp_path, kind, made, message):
    folder = save(tmp_path, **{kind: made})
    with pytest.raises(ReportError) as caught:
        verification.read(folder)
    said = str(caught.value)
    assert said.startswith(f"{folder / 'epyc' / kind}.json: ") and message in said
    assert "\n" not in said


def test_an_interrupted_run_does_not_count(tmp_path):
    made = synthetic_guarantee.stress()
    made["context"]["finished"] = False
    with pytest.raises(
        ReportError, match="context: the run was interrupted; only whole runs count"
    ):
        verification.read(save(tmp_path, stress=made))


def test_text_that_is_no_json_and_folders_that_are_none(tmp_path):
    folder = save(tmp_path)
    (folder / "epyc" / "fuzz.json").write_text("{")
    with pytest.raises(ReportError, match=r"fuzz\.json: not JSON"):
        verification.read(folder)
    with pytest.raises(ReportError, match="nowhere: is not a folder of results"):
        verification.read(tmp_path / "nowhere")


def test_a_machine_s_folder_may_be_given_itself(tmp_path):
    folder = save(tmp_path, fuzz=synthetic_guarantee.fuzz())
    for given in (folder, folder / "epyc"):
        assert len(verification.read(given)["fuzz"]) == 2


def test_the_command_writes_and_checks_several_pages(tmp_path, monkeypatch, capsys):
    synthetic_guarantee.save_all(tmp_path)
    pages = [tmp_path / "README.md", tmp_path / "docs" / "guarantee.md"]
    pages[1].parent.mkdir()
    pages[0].write_text(MARKED)
    pages[1].write_text(MARKED.replace(" results", " ../results"))
    monkeypatch.chdir("/")  # a source is named by its path from the page
    command = ["readme", *map(str, pages)]
    assert main([*command, "--check"]) == 1 and pages[0].read_text() == MARKED
    assert main(command) == 0 and main([*command, "--check"]) == 0
    assert all("| 27 of 27 |" in page.read_text() for page in pages)
    verbs = ("differs: guarantee ", "rewritten: guarantee ", "up to date")
    said = capsys.readouterr().out.splitlines()
    assert [
        line.startswith(f"{page}: {verb}")
        for line, (verb, page) in zip(
            said, ((verb, page) for verb in verbs for page in pages), strict=True
        )
    ] == [True] * 6


def test_a_marker_must_name_its_folder(tmp_path, capsys):
    path = tmp_path / "README.md"
    path.write_text(MARKED.replace(" results", ""))
    assert main(["readme", str(path)]) == 2
    said = capsys.readouterr().err
    assert "marker 'octocell:guarantee' must name what it is written from" in said
