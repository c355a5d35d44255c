# SPDX-License-Identifier: MIT
"""What docs/how_to/call_from_python.md shows is what happens."""

from __future__ import annotations

import doctest
import importlib
import re

from program import ROOT, module_of

PAGE = ROOT / "docs/how_to/call_from_python.md"


def test_examples_of_the_page_print_what_it_says() -> None:
    # The end of a block is no output.
    text = PAGE.read_text(encoding="utf-8").replace("\n```\n", "\n\n")
    test = doctest.DocTestParser().get_doctest(text, {}, PAGE.name, str(PAGE), 0)
    results = doctest.DocTestRunner().run(test)
    assert results.failed == 0 and results.attempted > 15


def test_functions_that_the_page_names_are_there() -> None:
    text = PAGE.read_text(encoding="utf-8")
    named = re.findall(r"^from (octocell\.compat\.\w+) import (\w+)", text, re.MULTILINE)
    assert len(named) == 4
    for module, function in named:
        assert callable(getattr(importlib.import_module(module), function))
