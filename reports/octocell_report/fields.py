# SPDX-License-Identifier: MIT
"""A decoded JSON document as a type: an error says where, what is there, and the rule."""

import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Any, TypeVar

import msgspec
from msgspec import Meta

Json = dict[str, Any]

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
Whole = Annotated[int, Meta(ge=0, le=2**63 - 1)]  # pairs, bytes
Number = Annotated[float, Meta(ge=0, lt=1e100)]  # times, depths in units of a radius
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
