# SPDX-License-Identifier: MIT
"""Texts exist in both languages and say the same numbers; plots need no Chinese font."""

from __future__ import annotations

import re
import string
from itertools import chain

import pytest

from octocell_report import captions, check, page, page_tables, plots
from octocell_report.load import parse
from octocell_report.texts import TEXTS, Said, how, listed, say, title

HAN = re.compile(r"[\u4e00-\u9fff]")
# Letters alone, or names: the same in both languages.
ALIKE = {"dot", "space", "fact_gpu", "column_ms", "column_ns_per_sphere"}


def fields(text):
    return sorted(name for _, name, _, _ in string.Formatter().parse(text) if name)


@pytest.mark.parametrize("key", list(TEXTS))
def test_a_text_has_the_same_values_in_both_languages(key):
    english, chinese = TEXTS[key]
    assert fields(english) == fields(chinese)
    assert not HAN.search(english)
    assert key in ALIKE or HAN.search(chinese) or key == "comma"


def test_every_text_is_said_somewhere():
    """No key is left over: each stands in the sources, or is built from a name that does."""
    folder = page.Path(page.__file__).parent
    paths = [*folder.rglob("*.py"), folder / "page.html.j2"]
    sources = "".join(path.read_text() for path in paths if path.name != "texts.py")
    built = {"front", *" ".join(chain(*page.SECTIONS.values())).split()}
    built |= {name.partition("_")[0] for name in built}  # what several pictures share
    sources += '"comma"' if "listed(" in sources else ""  # its mark, unless another is named
    for key in TEXTS:
        kind, _, name = key.partition("_")
        known = name in built and kind in ("title", "how")
        named = re.search(rf'"(?:{kind}_)?{re.escape(name or kind)}"|texts\.{key}\b', sources)
        assert known or named or f'"{key}"' in sources, key


def test_every_block_has_its_texts():
    for section, names in page.SECTIONS.items():
        assert f"section_{section}" in TEXTS
        for name in " ".join(names).split():
            for text in (title(name), how(name)):
                assert text.en and HAN.search(text.zh), name


def test_alike_is_written_once_and_unlike_twice():
    assert Said("n < 3", "n < 3").__html__() == "n &lt; 3"
    both = '<span lang="en">&lt;b&gt;</span><span lang="zh">好</span>'
    assert Said("<b>", "好").__html__() == both


def test_values_may_be_said_in_both_languages():
    assert say("column_ms", run=say("run_warm")) == ("warm [ms]", "热运行 [ms]")
    assert listed(["a", say("run_warm")]) == ("a, warm", "a、热运行")


def test_numbers_are_in_both_languages(every_case):
    result = parse(every_case)
    notes = [
        check.judge(result).headline,
        *captions.counts(result, check.judge(result)),
        *captions.first_scene(result),
    ]
    for english, chinese in notes:
        numbers = [sorted(re.findall(r"\d[\d.]*", text)) for text in (english, chinese)]
        assert numbers[0] == numbers[1] != []
        assert HAN.search(chinese) and not HAN.search(english)
    headings = map(page_tables.heading, page_tables.times(result).columns)
    assert any(HAN.search(heading.zh) for heading in headings)


def test_plots_say_what_the_page_says_and_need_no_chinese_font(every_case):
    for name, figure in plots.draw_all(parse(every_case)):
        texts = [text.get_text() for text in figure.findobj(plots.plt.Text)]
        assert not any(HAN.search(text) for text in texts), name
        told = "" if name == "front" else f"{title(name).en} {how(name).en}"
        assert " ".join(figure.get_suptitle().split()) == told
