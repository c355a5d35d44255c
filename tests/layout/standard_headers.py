# SPDX-License-Identifier: MIT
"""Which header of the standard library declares what; and a file's include lines.

`python tests/layout/standard_headers.py --fix FILE...` adds the lines that are missing.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

# The names that this project uses. A new one fails the test until it stands here.
HEADERS = {
    "algorithm": "adjacent_find all_of any_of clamp copy copy_n count count_if equal fill fill_n find"
    " find_if includes is_sorted lower_bound max max_element merge min minmax nth_element remove_if"
    " reverse shuffle sort stable_sort transform upper_bound"
    " ranges::adjacent_find ranges::all_of ranges::any_of ranges::binary_search"
    " ranges::copy ranges::count"
    " ranges::count_if ranges::equal ranges::fill ranges::find ranges::find_if ranges::for_each"
    " ranges::is_sorted ranges::lower_bound ranges::max ranges::max_element ranges::minmax_element"
    " ranges::mismatch ranges::none_of"
    " ranges::replace ranges::reverse ranges::set_difference ranges::set_intersection ranges::sort"
    " ranges::stable_partition ranges::stable_sort ranges::unique ranges::upper_bound",
    "array": "array",
    "atomic": "atomic atomic_ref memory_order_relaxed",
    "bit": "bit_cast bit_width countr_zero endian has_single_bit popcount",
    "cctype": "isalnum isdigit",
    "charconv": "from_chars",
    "chrono": "chrono chrono_literals",
    "cmath": "abs cbrt ceil cos exp exp2 fabs floor fma fmod frexp hypot ilogb isfinite isinf isnan"
    " ldexp log log10 log2 lround nanf nextafter pow rint round signbit sin sqrt",
    "compare": "strong_ordering",
    "csignal": "raise sig_atomic_t signal",
    "cstddef": "byte max_align_t nullptr_t ptrdiff_t size_t to_integer",
    "cstdint": "int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t",
    "cstdio": "ferror fflush fprintf fputs printf rename sscanf",
    "cstdlib": "abort aligned_alloc atexit exit free getenv realloc strtod strtof strtoull",
    "cstring": "memcmp memcpy memset strerror strlen",
    "deque": "deque",
    "exception": "current_exception exception exception_ptr rethrow_exception set_terminate",
    "experimental/simd": "experimental",
    "filesystem": "filesystem",
    "fstream": "ifstream ofstream",
    "functional": "function greater ranges::greater",
    "initializer_list": "initializer_list",
    "ios": "hexfloat ios streamsize",
    "iostream": "cerr cout",
    "iterator": "back_inserter default_sentinel_t distance end istreambuf_iterator size",
    "latch": "latch",
    "limits": "numeric_limits",
    "map": "map multimap",
    "memory": "make_shared make_unique shared_ptr unique_ptr weak_ptr",
    "mutex": "mutex scoped_lock",
    "new": "align_val_t bad_alloc",
    "numbers": "numbers",
    "numeric": "accumulate iota partial_sum",
    "optional": "nullopt optional",
    "ostream": "ostream",
    "random": "mt19937 mt19937_64 normal_distribution uniform_int_distribution"
    " uniform_real_distribution",
    "ratio": "milli",
    "regex": "regex regex_error regex_match regex_search smatch sregex_token_iterator",
    "set": "multiset set",
    "source_location": "source_location",
    "span": "as_bytes as_writable_bytes span",
    "sstream": "istringstream",
    "stdexcept": "logic_error out_of_range runtime_error",
    "string": "getline string to_string",
    "string_view": "string_view",
    "system_error": "errc error_code system_error",
    "thread": "jthread this_thread thread",
    "tuple": "ignore tie tuple",
    "type_traits": "conditional_t is_default_constructible_v is_same_v",
    "unordered_map": "unordered_map",
    "utility": "exchange index_sequence make_index_sequence move pair swap",
    "vector": "erase erase_if vector",
}
HEADER_OF = {name: header for header, names in HEADERS.items() for name in names.split()}

# Declared in several headers, by the standard or by need.
CONTAINERS = {"array", "deque", "map", "set", "span", "string", "string_view", "vector"}
ALSO_IN = {
    "size_t": CONTAINERS | {"cstdio", "cstdlib", "cstring"},
    "end": CONTAINERS,
    "size": CONTAINERS,
    "abs": {"cstdlib"},
    "erase": CONTAINERS,
    "erase_if": CONTAINERS,
    "milli": {"chrono"},
    "ios": {"fstream", "iostream"},
    "hexfloat": {"iostream"},
    "pair": {"map"},
    "streamsize": {"fstream", "iostream"},
}

_NAME = re.compile(r"(?<![\w:])(?:::)?std::((?:ranges::)?[a-z_][a-z_0-9]*)")
_INCLUDE = re.compile(r'^#include ([<"])([^>"]+)[>"]', re.MULTILINE)
_COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)


def names_used(text: str) -> set[str]:
    """What a file takes from namespace std, without std::."""
    code = "\n".join(line for line in text.splitlines() if not line.lstrip().startswith("#include"))
    return {match[1] for match in _NAME.finditer(_COMMENT_OR_STRING.sub("", code))}


def included(text: str) -> set[str]:
    return {match[2] for match in _INCLUDE.finditer(text) if match[1] == "<"}


def own_header(path: Path) -> Path | None:
    """A source file may rely on what its own header includes."""
    if path.suffix not in {".cpp", ".cu"}:
        return None
    found = [path.with_suffix(suffix) for suffix in (".hpp", ".cuh")]
    return next((header for header in found if header.is_file()), None)


def missing(path: Path) -> set[str]:
    """Standard headers whose names the file uses, and that neither it nor its own header includes."""
    text = path.read_text(encoding="utf-8")
    there = included(text)
    header = own_header(path)
    if header is not None:
        there |= included(header.read_text(encoding="utf-8"))
    lacking = set()
    for name in names_used(text):
        declared_in = HEADER_OF[name]
        if declared_in not in there and not there & ALSO_IN.get(name, set()):
            lacking.add(declared_in)
    return lacking


def _blocks(lines: list[str]) -> Iterator[tuple[int, int]]:
    """Runs of lines that include standard headers: <name> without a dot or a slash."""
    begin = None
    for number, line in enumerate([*lines, ""]):
        standard = re.fullmatch(r"#include <[a-z_]+(/[a-z]+)?>.*", line) is not None
        if standard and begin is None:
            begin = number
        if not standard and begin is not None:
            yield begin, number
            begin = None


def add_missing(path: Path) -> None:
    lacking = missing(path)
    if not lacking:
        return
    lines = path.read_text(encoding="utf-8").splitlines()
    new = [f"#include <{header}>" for header in lacking]
    blocks = list(_blocks(lines))
    if blocks:
        begin, end = max(blocks, key=lambda block: block[1] - block[0])
        lines[begin:end] = sorted({*lines[begin:end], *new})
    else:
        first = next((n for n, line in enumerate(lines) if line.startswith("#include")), None)
        if first is None:
            first = next(n for n, line in enumerate(lines) if line.startswith("#pragma once")) + 1
            lines[first:first] = ["", *sorted(new)]
        elif lines[first].startswith("#include <"):
            while lines[first].startswith("#include <"):
                first += 1
            lines[first:first] = ["", *sorted(new)]
        elif own_header(path) is not None:
            lines[first + 1 : first + 1] = ["", *sorted(new)]
        else:
            lines[first:first] = [*sorted(new), ""]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if sys.argv[1:2] != ["--fix"]:
        sys.exit(__doc__)
    for argument in sys.argv[2:]:
        add_missing(Path(argument))
