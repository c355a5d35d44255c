# SPDX-License-Identifier: MIT
"""The library's errors as Python's exceptions."""

from __future__ import annotations


class InvalidSphere(ValueError):
    """A number is not finite, or a radius is negative. ``index`` is the first such sphere."""

    def __init__(self, message: str, index: int | None = None) -> None:
        super().__init__(message)
        self.index = index

    def __reduce__(self) -> tuple[type[InvalidSphere], tuple[str, int | None]]:
        return InvalidSphere, (str(self), self.index)


class LimitError(ValueError):
    """The request is sound, but larger than this implementation allows."""


class Unavailable(RuntimeError):
    """There is no such device here, or the module was built without it."""


# In the order of ErrorKind in include/octocell/error.hpp; the first needs its sphere.
_KINDS = (
    InvalidSphere,
    ValueError,
    LimitError,
    MemoryError,
    Unavailable,
    KeyboardInterrupt,
    RuntimeError,
)


def exception_for(kind: int, message: str, sphere: int | None) -> BaseException:
    """Returns what is raised for an error of the library."""
    if _KINDS[kind] is InvalidSphere:
        return InvalidSphere(message, sphere)
    return _KINDS[kind](message)
