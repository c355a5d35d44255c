# SPDX-License-Identifier: MIT
"""The page's two languages: one text per key and language, in words_en.py and words_zh.py."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from markupsafe import Markup, escape

from octocell_report import words_en, words_zh

TEXTS = {"en": words_en.TEXTS, "zh": words_zh.TEXTS}


class Said(NamedTuple):
    """The same thing in both languages."""

    en: str
    zh: str

    def __html__(self) -> str:
        """Both, each marked with its language, for the page's style to show one; once if alike."""
        if self.en == self.zh:
            return str(escape(self.en))
        parts = zip(self._fields, self, strict=True)
        return Markup("").join(Markup('<span lang="{}">{}</span>').format(*p) for p in parts)


def tell(language: str, key: str, **values: object) -> str:
    return TEXTS[language][key].format(**values)


def listed(parts: list[str], language: str) -> str:
    return tell(language, "comma").join(parts)


def spanned(values: list[float], show: Callable[[float], str], language: str) -> str:
    """'2 to 5', or one number if both ends read alike."""
    low, high = show(min(values)), show(max(values))
    return low if low == high else tell(language, "range", low=low, high=high)


def scenes(n: int, language: str) -> str:
    """'1 scene', '3 scenes'"""
    return tell(language, "scenes_one" if n == 1 else "scenes", scenes=n)


def say(key: str, **values: object) -> Said:
    """The text in both languages; a value that is Said itself goes in by language."""
    return both(lambda language: tell(language, key, **_spoken(values, language)))


def both(make: Callable[[str], str]) -> Said:
    return Said(make("en"), make("zh"))


def _spoken(values: dict[str, object], language: str) -> dict[str, object]:
    return {k: getattr(v, language) if isinstance(v, Said) else v for k, v in values.items()}


def all_of(make: Callable[[str], list[str]]) -> list[Said]:
    """Sentences computed once per language."""
    return [Said(en, zh) for en, zh in zip(make("en"), make("zh"), strict=True)]
