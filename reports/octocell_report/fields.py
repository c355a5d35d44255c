# SPDX-License-Identifier: MIT
"""Fields of a JSON object, taken with a check: an error says whose field, which, and why."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Annotated, Any, TypeVar

import msgspec
from msgspec import Meta

Json = dict[str, Any]

_BELOW = 2**63  # whole numbers: pairs, bytes
_MOST = 1e100  # other numbers: times, depths in units of a radius
_LONGEST = 10_000  # characters of a text
_THIN = "\u202f"  # a space, but to Python it is none that can be printed


class ReportError(Exception):
    """Input that cannot be reported on; the message is one line for people."""


def printable(text: str) -> str:
    """On one line: control characters, line breaks and lone surrogates as escapes."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c == _THIN else ascii(c)[1:-1] for c in text)


@contextmanager
def naming(what: object) -> Iterator[None]:
    """An error in here says whose it is: a file's, say."""
    try:
        yield
    except ReportError as error:
        raise ReportError(f"{what}: {error}") from error


def shown(value: Any) -> str:
    """A value of a document, in a few characters."""
    spelled = json.dumps(value)
    return spelled if len(spelled) <= 40 else spelled[:37] + "..."


# Types of fields, for msgspec structs.
Whole = Annotated[int, Meta(ge=0, le=_BELOW - 1)]  # pairs, bytes
Number = Annotated[float, Meta(ge=0, lt=_MOST)]  # times, depths in units of a radius
Text = Annotated[str, Meta(max_length=_LONGEST)]
Name = Annotated[str, Meta(max_length=_LONGEST, pattern=r"\S")]  # not empty


def choice(*words: str) -> Meta:
    """One of these words, as in Annotated[str, choice("ok", "wrong")]; the message lists them."""
    return Meta(pattern=f"^({'|'.join(words)})$")


_Kind = TypeVar("_Kind")


def convert(document: Any, kind: type[_Kind]) -> _Kind:
    """The document as a msgspec type. Throws ReportError: the place, what is there, and the rule.

    A struct's own check is a ValueError thrown in its __post_init__.
    """
    try:
        return msgspec.convert(document, kind)
    except msgspec.ValidationError as error:
        rule, _, path = str(error).partition(" - at `$")
        raise ReportError(_place(path.strip("`."), document) + rule.replace("`", "'")) from error


def _place(path: str, document: Any) -> str:
    """'rows[3].n (name of the row) is -1: ' of 'rows[3].n'."""
    value, name = document, None
    for key in re.findall(r"\w+", path.partition("[...]")[0]):
        value = value[int(key)] if isinstance(value, list) else value[key]
        name = value.get("name", name) if isinstance(value, dict) else name
    place = f"{path} ({name})" if name else path
    known = "" if isinstance(value, dict | list) else f" is {shown(value)}"
    return f"{place}{known}: " if place else ""


# What a value may be: a word for the message, and the test.
Check = tuple[str, Callable[[Any], bool]]


def number(value: Any) -> bool:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return is_number and 0 <= value < _MOST


def whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < _BELOW


def text(value: Any) -> bool:
    return isinstance(value, str) and len(value) <= _LONGEST


def numbers(value: Any) -> bool:
    return isinstance(value, list) and all(number(v) for v in value)


def one_of(*words: str) -> Check:
    return "one of " + ", ".join(words), lambda v: isinstance(v, str) and v in words


def or_null(check: Check) -> Check:
    return f"{check[0]} or null", lambda v: v is None or check[1](v)


is_object: Check = ("an object", lambda v: isinstance(v, dict))
is_list: Check = ("a list", lambda v: isinstance(v, list))
is_text: Check = (f"text of at most {_LONGEST} characters", text)
is_filled: Check = ("text, not empty", lambda v: text(v) and v.strip() != "")
is_texts: Check = (
    "a list of texts",
    lambda v: isinstance(v, list) and all(text(t) for t in v),
)
is_filled_texts: Check = (
    "a list of texts, none empty",
    lambda v: isinstance(v, list) and all(text(t) and t.strip() for t in v),
)
is_bool: Check = ("true or false", lambda v: isinstance(v, bool))
is_whole: Check = ("a whole number, 0 or more, below 2^63", whole)
is_number: Check = (f"a number, 0 or more, below {_MOST:g}", number)
is_positive: Check = ("a number above 0", lambda v: number(v) and v > 0)
is_times: Check = ("a list of times, 0 or more", numbers)
is_stages: Check = (
    "an object of lists of times",
    lambda v: isinstance(v, dict) and all(numbers(t) for t in v.values()),
)
is_bytes: Check = (
    "an object of whole numbers, 0 or more",
    lambda v: isinstance(v, dict) and all(whole(b) for b in v.values()),
)
is_frames: Check = (
    "a list of rounds, each a list of times",
    lambda v: isinstance(v, list) and bool(v) and all(numbers(t) for t in v),
)
is_names: Check = (
    "an object of names",
    lambda v: isinstance(v, dict) and all(text(t) for t in v.values()),
)


class Fields:
    """One JSON object and how to call it when a field of it is not as it should be."""

    def __init__(self, value: Any, title: str) -> None:
        if not isinstance(value, dict):
            raise ReportError(f"{title}: is not an object")
        self.value: Json = value
        self.title = title

    def take(self, key: str, check: Check) -> Any:
        if key not in self.value:
            raise ReportError(f"{self.title}: lacks the field '{key}'")
        found = self.value[key]
        if not check[1](found):
            raise ReportError(f"{self.title}: field '{key}' is {shown(found)}, not {check[0]}")
        return found

    def optional(self, key: str, check: Check) -> Any:
        """None where the object has no such field."""
        return self.take(key, check) if key in self.value else None
