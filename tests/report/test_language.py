# SPDX-License-Identifier: MIT
"""The page's two languages say the same things, and plots need no Chinese font."""

from __future__ import annotations

import re
import string

import pytest

from octocell_report import check, findings, language, page, plots
from octocell_report.language import Said, say
from octocell_report.load import parse
from octocell_report.words_en import TEXTS as ENGLISH
from octocell_report.words_zh import TEXTS as CHINESE

HAN = re.compile(r"[\u4e00-\u9fff]")


def fields(text):
    return sorted(name for _, name, _, _ in string.Formatter().parse(text) if name)


def test_both_languages_have_the_same_keys():
    assert list(ENGLISH) == list(CHINESE)


@pytest.mark.parametrize("key", list(ENGLISH))
def test_a_text_has_the_same_values_in_both_languages(key):
    assert fields(ENGLISH[key]) == fields(CHINESE[key])
    assert not HAN.search(ENGLISH[key])


def test_every_text_is_said_somewhere(every_case):
    """No key is left over: each stands in the sources, or is built from a name that does."""
    folder = page.Path(page.__file__).parent
    paths = [*folder.glob("*.py"), folder / "page.html.j2"]
    sources = "".join(p.read_text() for p in paths if not p.name.startswith("words_"))
    sources = sources.replace("'", '"')
    built = re.compile(r"(title|how|run|speed|read|column|heaviest|where|verdict|class)_.*")
    plain = [key for key in ENGLISH if not built.fullmatch(key)]
    assert [k for k in plain if f'"{k}"' not in sources and f"texts.en.{k} " not in sources] == []


def test_alike_is_written_once_and_unlike_twice():
    assert Said("n < 3", "n < 3").__html__() == "n &lt; 3"
    assert (
        Said("<b>", "好").__html__() == '<span lang="en">&lt;b&gt;</span><span lang="zh">好</span>'
    )


def test_values_may_be_said_in_both_languages():
    assert say("column_run_ms", run=say("run_warm")) == ("warm [ms]", "热运行 [ms]")


def test_computed_sentences_exist_in_both(every_case):
    result = parse(every_case)
    for name in ("time_warm", "stages_backend", "stages_per_sphere", "speed_update", "memory"):
        english, chinese = (page._sentences(result, name, spoken) for spoken in language.TEXTS)
        assert len(english) == len(chinese) > 0
        assert all(HAN.search(sentence) for sentence in chinese)
    assert check.headline(check.judge(result), "zh").startswith("200 个默认行中有 4 个错误")
    assert findings.overview(result, "zh")[-1].startswith("热运行：我们最快的精确行")


def test_plots_need_no_chinese_font(every_case):
    for name, figure in plots.draw_all(parse(every_case)):
        texts = [text.get_text() for text in figure.findobj(plots.plt.Text)]
        assert not any(HAN.search(text) for text in texts), name
