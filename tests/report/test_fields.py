# SPDX-License-Identifier: MIT
"""What is wrong with a document is said in one line: where, what is there, and the rule."""

from __future__ import annotations

from typing import Annotated

import pytest
from msgspec import Struct

from octocell_report.fields import Name, Number, ReportError, Whole, choice, convert

ROW = {"name": "a", "n": 1, "state": "ok", "ms": {"sort": [1, 0.5]}, "note": {"text": "b"}}


class Note(Struct):
    text: Name


class Row(Struct):
    name: Name
    n: Whole
    state: Annotated[str, choice("ok", "wrong")]
    ms: dict[str, list[Number]]
    note: Note | None = None

    def __post_init__(self) -> None:
        if self.state == "wrong" and self.n == 0:
            raise ValueError("wrong about nothing")


class Document(Struct):
    rows: list[Row]


def test_what_is_right_comes_through():
    assert convert({"rows": [ROW, ROW | {"note": None}]}, Document).rows[0].ms["sort"] == [1, 0.5]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"n": -1}, r"rows\[1\]\.n \(a\) is -1: Expected 'int' >= 0"),
        ({"n": 2**63}, r"rows\[1\]\.n \(a\) is 9223372036854775808: Expected 'int' <= 9"),
        ({"n": 10**400}, r"rows\[1\]\.n \(a\) is 10{36}\.\.\.: Expected"),
        ({"n": True}, r"rows\[1\]\.n \(a\) is true: Expected 'int', got 'bool'"),
        ({"state": "odd"}, r"rows\[1\]\.state \(a\) is \"odd\": .*\(ok\|wrong\)"),
        ({"name": " "}, r"rows\[1\]\.name \( \) is \" \": Expected 'str' matching regex"),
        ({"ms": {"sort": [float("nan")]}}, r"rows\[1\]\.ms\[\.{3}\]\[0\] \(a\): Expected 'float'"),
        ({"ms": {"sort": [1e200]}}, r"rows\[1\]\.ms\[\.{3}\]\[0\] \(a\): .* < 1e\+100"),
        ({"note": {}}, r"rows\[1\]\.note \(a\): Object missing required field 'text'"),
        ({"state": "wrong", "n": 0}, r"rows\[1\] \(a\): wrong about nothing"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named_with_its_place(changes, message):
    with pytest.raises(ReportError, match=f"^{message}"):
        convert({"rows": [ROW, ROW | changes]}, Document)


@pytest.mark.parametrize(
    ("document", "message"),
    [([], "Expected 'object', got 'array'"), ({"rows": 3}, "rows is 3: Expected 'array'")],
)
def test_what_is_no_document_is_said(document, message):
    with pytest.raises(ReportError, match=f"^{message}"):
        convert(document, Document)
