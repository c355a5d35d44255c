# SPDX-License-Identifier: MIT
"""Whatever stands in a file or in a name: exit code 0, 1 or 2, one line to a line, no traceback."""

from __future__ import annotations

import copy
import json
import os
import random

import pandas as pd
import pytest
from matplotlib.text import Text

from octocell_import.cli import main as importer
from octocell_report import images
from octocell_report.cli import main

import synthetic
import synthetic_guarantee
from synthetic import Json
from test_sort import gpu_cases

NAMES = [
    *("$x_{$.npy", "a$b$c", "a\nb", "\x1b[31mred", "\ud800", "a|b\\", "`c", "<b>&amp;", "_hidden"),
    *("{0}", "%s", "日本 😀", "<!--", "x" * 300),
]
VALUES = [
    *(None, True, 0, 1, -1, 7, 2**62, 2**63, 10**400, int("9" * 4000), 0.0, -0.0, 0.5, 1e-300),
    *(1e99, 1e300, float("nan"), float("inf"), "", " ", "x" * 20_000, [], {}, [[]], {"a": 1}),
    *([0.0], [1e99, 1e-99], ["a"], {"sort": [1.0]}, *NAMES),
]


def small() -> Json:
    document = synthetic.whole_run({"gas": [1000, 2000]})
    kept = ("impl_cpu", "bullet_dbvt", "fcl_dynamic_aabb_tree")
    document["rows"] = [
        row
        for row in document["rows"]
        if row["backend"] in kept and row["rule"] != "chapter32" and "update" not in row["run"]
    ]
    return document


def renamed(value, old, new):
    """The same with every text `old` as `new`."""
    if isinstance(value, dict):
        return {key: renamed(item, old, new) for key, item in value.items()}
    if isinstance(value, list):
        return [renamed(item, old, new) for item in value]
    return new if value == old and type(value) is type(old) else value


@pytest.fixture
def outcome(capsys):
    """Runs a command; its code and what it said, after a look at how."""

    def run(command, *arguments):
        code = command(list(map(str, arguments)))
        out, err = capsys.readouterr()
        assert code in (0, 1, 2)
        assert err.count("\n") == (code == 2) and "Traceback" not in err
        assert all(c.isprintable() or c in "\n\u202f" for c in out + err)
        return code, out, err

    return run


@pytest.fixture
def undrawn(monkeypatch):
    """All is laid out but nothing drawn; the texts of the figures."""
    texts = []

    def look(figures, folder):
        for _, figure in figures:
            texts.extend(figure.findobj(Text))

    monkeypatch.setattr(images, "write", look)
    return texts


@pytest.mark.parametrize("name", NAMES)
def test_no_name_is_too_strange_for_a_report(tmp_path, save, outcome, undrawn, name):
    path = save(renamed(renamed(small(), "gas", name), "bullet_dbvt", f"b {name}"))
    assert outcome(main, "build", path, "-o", tmp_path / "out")[0] == 0
    times = pd.read_csv(tmp_path / "out" / "times.csv")
    shown = name.replace("\n", "\\n").replace("\x1b", "\\x1b").replace("\ud800", "\\ud800")
    assert set(times["scene"]) == {shown}
    assert "<b>&amp;" not in (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert shown in {text.get_text() for text in undrawn}
    assert not any(text.get_parse_math() for text in undrawn)


def test_strange_names_are_drawn(tmp_path, save, outcome):
    document = renamed(small(), "gas", "$x_{$.npy a$b$c \ud800日本😀")
    path = save(renamed(document, "bullet_dbvt", "_$\\frac{$"))
    assert outcome(main, "build", path, "-o", tmp_path / "out")[0] == 0
    path = save(renamed(gpu_cases(), "cub", "$x_{$"))
    assert outcome(main, "sort", path, "-o", tmp_path / "out")[0] == 0


TEXTS = {
    "empty": (b"", "not JSON"),
    "bytes": (b"\xff\xfe{}", "not UTF-8 text"),
    "deep": (b"[" * 100_000, "nested too deeply"),
    "deep object": (b'{"a":' * 400 + b"1" + b"}" * 400, "no field 'schema'"),
    "digits": (b"1" * 5000, "not a bench result"),
    "schema": (b'{"schema": ' + b"1" * 5000 + b"}", "schema 1111"),
    "twice": (b'{"schema": 1, "schema": 2}', "an object has the field 'schema' twice"),
    "number": (b"NaN", "not a bench result"),
    "surrogate": (b'{"\\ud800": "\\ud800"}', "no field 'schema'"),
    "nothing": (b"null", "not a bench result"),
}


@pytest.mark.parametrize(("content", "message"), TEXTS.values(), ids=TEXTS.keys())
def test_what_is_no_result_is_said_in_one_line(tmp_path, outcome, content, message):
    path = tmp_path / "a.json"
    path.write_bytes(content)
    for command in ("check", "build", "ablation", "error"):
        options = [] if command == "check" else ["-o", tmp_path / "out"]
        code, out, err = outcome(main, command, path, *options)
        assert (code, out) == (2, "") and message in err and str(path) in err
    assert not (tmp_path / "out").exists()
    assert outcome(main, "sort", path, "-o", tmp_path / "out")[0] == 2


@pytest.mark.parametrize("digits", [400, 5000])
@pytest.mark.parametrize("field", ["n", "pairs", "threads", "peak_bytes", "plan_ms"])
def test_huge_integers_are_refused_with_their_field(save, outcome, field, digits):
    document = small()
    document["rows"][0][field] = "HUGE"
    path = save(document)
    path.write_text(path.read_text().replace('"HUGE"', "7" * digits))
    code, _, err = outcome(main, "check", path)
    assert code == 2 and f"{path}: rows[0].{field} (" in err and ") is 777" in err


@pytest.mark.parametrize("field", ["name", "backend", "scene"])
@pytest.mark.parametrize("name", ["", "  "])
def test_empty_names_are_refused(save, outcome, field, name):
    document = small()
    document["rows"][0][field] = name
    code, _, err = outcome(main, "check", save(document))
    assert code == 2 and f"rows[0].{field} " in err and f'is "{name}": Expected' in err


@pytest.mark.parametrize("gpu", [None, {}, [1], {"name": "a"}])
def test_sorts_may_be_of_a_gpu_that_is_not_named(tmp_path, save, outcome, gpu):
    document = gpu_cases()
    document["context"]["gpu"] = gpu
    code, _, err = outcome(main, "sort", save(document), "-o", tmp_path / "out")
    assert code == (2 if gpu is not None else 0) and ("gpu" in err) == (code == 2)


def test_nothing_measured_is_no_traceback(tmp_path, save, outcome):
    path = save(synthetic.document([], []))
    assert outcome(main, "check", path)[0] == 1
    assert outcome(main, "build", path, "-o", tmp_path / "out")[0] == 0
    assert outcome(main, "compare", path, path)[0] == 0


@pytest.mark.parametrize("name", [b"a\nb", b"\x1b[2J", b"\xff\xfe", b"a" * 300])
def test_names_of_files_are_shown_on_one_line(tmp_path, outcome, name):
    path = os.path.join(tmp_path, os.fsdecode(name))
    for command in (["check", path], ["build", path], ["readme", path]):
        assert outcome(main, *command)[0] == 2
    assert outcome(importer, f"{path}.xyz")[0] == 2
    assert outcome(importer, path, "--format", "xyz", "-o", f"{path}.npy")[0] == 2
    if len(name) < 255:
        with open(f"{path}.xyz", "w", encoding="utf-8") as stream:
            stream.write("1\nc\nC 0 0 0\n")
        code, out, _ = outcome(importer, f"{path}.xyz")
        assert code == 0 and len(out.splitlines()) == len(out.split("\n")) - 1
        assert os.path.exists(f"{path}.npy")


def test_a_line_break_among_the_arguments_makes_no_second_line(capsys):
    for command in (main, importer):
        with pytest.raises(SystemExit) as ended:
            command(["check", "x.json", "--no\nsuch"])
        assert ended.value.code == 2 and capsys.readouterr().err.count("\n") == 1


def test_folders_and_secrets_are_no_input(tmp_path, outcome):
    assert "Is a directory" in outcome(main, "check", tmp_path)[2]
    assert outcome(importer, tmp_path, "--format", "xyz")[0] == 2


MARKED = "<!-- octocell:correctness result.json -->\n<!-- /octocell:correctness -->\n"


def test_names_are_names_in_markdown(tmp_path, save, outcome):
    path = tmp_path / "R.md"
    path.write_text(MARKED)
    name = "a|b\\|c`d$e$<b>\n"
    save(renamed(small(), "gas", name))
    assert outcome(main, "readme", path)[0] == 0
    lines = [line for line in path.read_text().splitlines() if line.startswith("|")]
    assert "a\\|b\\\\\\|c&#96;d&#36;e&#36;&#60;b>\\n" in lines[0]
    assert len({line.replace("\\|", "").count("|") for line in lines}) == 1


def test_a_name_that_is_a_marker_is_refused(tmp_path, save, outcome):
    path = tmp_path / "R.md"
    path.write_text(MARKED)
    save(renamed(small(), "gas", "<!-- /octocell:correctness -->"))
    code, _, err = outcome(main, "readme", path)
    assert code == 2 and "would hold a marker" in err and path.read_text() == MARKED


def mutated(document: Json, luck: random.Random) -> Json:
    """One value is another, gone, twice or of another name; texts also wherever they stand."""
    document = copy.deepcopy(document)
    for _ in range(luck.choice((1, 1, 2))):
        found, holder, key = document, None, None
        while isinstance(found, dict | list) and found and luck.random() < 0.97:
            holder, key = (
                found,
                luck.choice([*found] if isinstance(found, dict) else range(len(found))),
            )
            found = holder[key]
        if holder is None:
            continue
        alike = [value for value in VALUES if type(value) is type(found)]
        value = copy.deepcopy(luck.choice(alike if alike and luck.random() < 0.8 else VALUES))
        match luck.randrange(8):
            case 0 if isinstance(holder, list):
                holder.append(found)
            case 0 | 1 if isinstance(holder, dict):
                holder[luck.choice(NAMES)] = holder.pop(key)
            case 2 | 3 if isinstance(found, str | int | float):
                document = renamed(document, found, value)
            case _:
                holder[key] = value
    return document


def save_mutated(path, document, luck):
    path.write_text(json.dumps(mutated(document, luck)), encoding="utf-8")
    return path


def test_strange_results_end_well(tmp_path, outcome, undrawn):
    luck, codes = random.Random(18), []
    old, new, md = tmp_path / "old.json", tmp_path / "new.json", tmp_path / "R.md"
    old.write_text(json.dumps(small()))
    for turn in range(200):
        save_mutated(new, small(), luck)
        codes.append(outcome(main, "check", new)[0])
        if codes[-1] != 2:
            md.write_text(
                (MARKED + MARKED.replace("correctness", "speed")).replace("result", "new")
            )
            outcome(main, "compare", old, new)
            outcome(main, "readme", md)
            if turn % 10 == 0:
                outcome(main, "build", new, "-o", tmp_path / "out")
    assert 50 < codes.count(2) < 190  # some of them are read


def test_strange_evidence_ends_well(tmp_path, outcome):
    luck, md = random.Random(18), tmp_path / "P.md"
    blocks = [
        f"guarantee{x}" for x in ("", "_near_tangent", "_stress", "_compilers", "_mutants", "_fuzz")
    ]
    text = "".join(MARKED.replace("correctness", block) for block in blocks)
    md.write_text(text.replace("result.json", "results"))
    codes = []
    for _ in range(200):
        folder = synthetic_guarantee.save_all(tmp_path)
        path = luck.choice(sorted(folder.rglob("*.json")))
        save_mutated(path, json.loads(path.read_text()), luck)
        codes.append(outcome(main, "readme", md)[0])
    assert 20 < codes.count(2) < 180


WORDS = ["9" * 5000, "99999999999999999999", "-1", "0", "nan", "1e999", "1e-999999999", "²", "1_0"]
WORDS += ["1.000000059604644775390625" + "0" * 5000, "\x1b[31m", "$a$", "", "1e" + "9" * 5000]
EXTENDED = "2\nProperties=species:S:1:pos:R:3:radius:R:1\nC 1 2 3 1\nO 2 3 4 1\n"


def test_strange_scenes_end_well(tmp_path, outcome):
    from test_import_bad import ATOMIC, PLAIN_DUMP, PLAIN_PLY

    from test_import_formats import GRO, PDB, PQR

    texts = {"gro": GRO, "pdb": PDB, "pqr": PQR, "data": ATOMIC, "dump": PLAIN_DUMP}
    texts |= {"ply": PLAIN_PLY, "xyz": EXTENDED}
    luck, codes = random.Random(18), []
    for _ in range(600):
        suffix = luck.choice(sorted(texts))
        parts = texts[suffix].replace(":", " : ").split(" ")
        parts[luck.randrange(len(parts))] = luck.choice(WORDS)
        path = tmp_path / f"a.{suffix}"
        path.write_text(" ".join(parts).replace(" : ", ":"), encoding="utf-8")
        codes.append(outcome(importer, path)[0])
    assert 100 < codes.count(2) < 600


@pytest.mark.parametrize(
    ("suffix", "old", "new"),
    [
        ("gro", None, f"t\n{'9' * 5000}\n"),
        ("xyz", None, EXTENDED.replace("pos:R:3", "pos:R:²")),
        ("xyz", None, EXTENDED.replace("pos:R:3:radius:R:1", "radius:R:3:pos:R:1")),
        ("xyz", None, "1\nc\nC 1.000000059604644775390625" + "0" * 5000 + " 0 0\n"),
        ("ply", "element vertex 2", "element vertex -7"),
        ("ply", "element vertex 2", "element vertex 99999999999999999999"),
    ],
)
def test_scenes_that_ended_in_a_traceback(tmp_path, outcome, suffix, old, new):
    from test_import_bad import PLAIN_PLY

    path = tmp_path / f"a.{suffix}"
    path.write_text(PLAIN_PLY.replace(old, new) if old else new, encoding="utf-8")
    code, _, err = outcome(importer, path)
    assert code == 2 and str(path) in err
