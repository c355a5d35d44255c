# SPDX-License-Identifier: MIT
"""`octocell explain`; --no-skip and --force."""

from __future__ import annotations

import json
import re

import pytest

from program import ROOT, Json, Octocell, Refused

SKIPS = re.findall(
    r'^    \{"(\w+)",', (ROOT / "core/skips.hpp").read_text(), re.MULTILINE
)
SCENES = (
    "gas:n=60",
    "gas:n=3000",
    "giant:n=3000",
    "discs:n=3000",
    "chain:n=3000",
    "identical:n=99",
)


def explained(octocell: Octocell, scene: str, *args: object) -> Json:
    answer: Json = json.loads(octocell.ok("explain", scene, "--json", *args).stdout)
    return answer


def taken(answer: Json) -> set[str]:
    return {d["skip"] for d in answer["decisions"] if d["taken"]}


def test_skips_are_known() -> None:
    assert len(SKIPS) == len(set(SKIPS)) >= 8


@pytest.mark.parametrize("scene", SCENES)
def test_every_decision_has_a_fact_and_a_proof(octocell: Octocell, scene: str) -> None:
    answer = explained(octocell, scene)
    assert answer["pairs"] == octocell.find(scene)["pairs"]
    for decision in answer["decisions"]:
        assert decision["skip"] in SKIPS
        assert decision["fact"] and decision["proof"] and decision["saves"]
    text = octocell.ok("explain", scene).stdout
    for skip in taken(answer):
        assert re.search(rf"^\|-- SKIPS {skip}\b", text, re.MULTILINE), text


def test_scenes_show_what_they_do_not_need(octocell: Octocell) -> None:
    assert "grid" in taken(explained(octocell, "gas:n=60"))
    assert "phantoms" in taken(explained(octocell, "gas:n=3000"))
    assert "wide_cells" in taken(explained(octocell, "giant:n=3000"))
    assert "layers" in taken(explained(octocell, "discs:n=3000"))
    assert {"sort", "layers"} <= taken(explained(octocell, "chain:n=3000"))


def test_analyze_measures_what_is_taken(octocell: Octocell) -> None:
    answer = explained(octocell, "gas:n=3000", "--analyze")
    for decision in answer["decisions"]:
        assert (decision["measured_saving"] is not None) == decision["taken"]


LARGE_AMONG_SMALL = "giant:n=100000,size=1"


def test_a_choice_that_costs_much_is_warned_of(octocell: Octocell) -> None:
    assert explained(octocell, LARGE_AMONG_SMALL)["warnings"] == []
    asked = ("--rule", "chapter32")
    (warning,) = explained(octocell, LARGE_AMONG_SMALL, *asked)["warnings"]
    times = re.search(r"rule chapter32 is expected to cost about (\d+) times", warning)
    assert times and int(times[1]) > 20, warning
    assert "half_shell" in warning and "leave out --rule" in warning
    for command in ("explain", "find"):
        flags = ("--explain",) if command == "find" else ()
        done = octocell.ok(command, LARGE_AMONG_SMALL, *asked, *flags)
        assert f"warning: {warning}\n" in (done.stderr if flags else done.stdout)


def test_a_choice_that_costs_little_is_not(octocell: Octocell) -> None:
    for choice in (("--rule", "chapter32"), ("--cell-side", "2"), ("--method", "half_shell")):
        assert explained(octocell, "gas:n=20000", *choice)["warnings"] == []
    (warning,) = explained(octocell, "gas:n=20000", "--cell-side", "100")["warnings"]
    assert "cell side 100" in warning and "--cell-side" in warning


def test_rules_are_of_home_phantom(octocell: Octocell, refused: Refused) -> None:
    answer = explained(octocell, "gas:n=3000", "--rule", "chapter32")
    assert answer["method"] == "home_phantom" and "chapter32" in answer["cells"]
    line = refused("explain", "gas:n=3000", "--method", "half_shell", "--rule", "chapter32")
    assert "no rules" in line


def test_a_method_is_refused_by_a_backend_without_it(refused: Refused) -> None:
    for backend in ("impl_cpu", "impl_thrust"):
        line = refused("explain", "gas:n=3000", "--backend", backend, "--method", "tiles")
        assert f"{backend} has no method tiles" in line


@pytest.mark.parametrize("skip", SKIPS)
def test_forbidding_a_skip_changes_no_answer(octocell: Octocell, skip: str) -> None:
    for scene in SCENES:
        plain = octocell.find(scene)
        without = octocell.find(scene, "--no-skip", skip)
        assert without["checksum"] == plain["checksum"], scene
        assert skip not in taken(explained(octocell, scene, "--no-skip", skip))


def test_forcing_a_skip_takes_it(octocell: Octocell) -> None:
    assert "grid" in taken(explained(octocell, "gas:n=3000", "--force", "grid"))
    assert "phantoms" in taken(explained(octocell, "gas:n=60", "--force", "phantoms"))
    forced = octocell.find("gas:n=60", "--force", "phantoms")
    assert forced["checksum"] == octocell.find("gas:n=60")["checksum"]


@pytest.mark.parametrize(
    ("scene", "skip", "words"),
    [
        ("gas:n=3000", "layers", ["cells"]),
        ("gas:n=3000", "sort", ["in order"]),
        ("gas:n=3000", "wide_cells", ["one octave"]),
        ("gas:n=60", "layers", ["brute_force"]),
        ("gas:n=60", "nonsense", ["unknown skip 'nonsense'", "phantoms"]),
    ],
)
def test_what_cannot_be_forced_is_refused(
    refused: Refused, scene: str, skip: str, words: list[str]
) -> None:
    for command in ("find", "explain"):
        line = refused(command, scene, "--force", skip)
        assert all(word in line for word in (skip, *words)), line


def test_what_a_backend_does_not_have_is_said(octocell: Octocell, refused: Refused) -> None:
    thrust = ("chain:n=9000", "--backend", "impl_thrust", "--force", "phantoms")
    answer = explained(octocell, *thrust)
    bits = next(d for d in answer["decisions"] if d["skip"] == "key_bits")
    assert not bits["taken"] and "does not have it" in bits["fact"]
    assert "sort" in taken(answer)
    for command in ("find", "explain"):
        line = refused(command, *thrust, "--force", "key_bits")
        assert "key_bits cannot be forced" in line and "does not have it" in line


def test_forced_and_forbidden_is_refused(refused: Refused) -> None:
    assert "forced and forbidden" in refused(
        "find", "gas:n=60", "--force", "sort", "--no-skip", "sort"
    )


def test_baselines_have_no_plan_of_ours(refused: Refused) -> None:
    assert "baseline" in refused("explain", "gas:n=60", "--backend", "bullet_dbvt")
    assert "baseline" in refused("find", "gas:n=60", "--backend", "fcl_sap", "--no-skip", "sort")
