#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the step page's module for WebAssembly, course/page/module.wasm, and notes what it is of.
#
#   scripts/build_page_module.sh            needs clang, lld, wasi-libc, libc++-14-dev-wasm32,
#                                           libclang-rt-14-dev-wasm32 (Debian); only for changes
#   scripts/build_page_module.sh --digest   prints the digest of the sources
set -euo pipefail
cd "$(dirname "$0")/.."

sources=(course/page/module.cpp course/page/trace.cpp core/planner/make_grid.cpp)
exports=(room_for trace text_length grid_numbers)

# Every source that the compiler reads of ours, without comments and blanks, which change nothing.
digest() {
  for source in "${sources[@]}"; do
    g++ -std=c++20 -I . -MM "$source" | tr ' \\' '\n\n' | grep -E '^(core|course|include)/'
  done | sort -u | while read -r file; do
    g++ -std=c++20 -fpreprocessed -dD -E -P -x c++ "$file" 2>/dev/null
  done | sha256sum | cut -d ' ' -f 1
}

if [ "${1:-}" != --digest ]; then
  clang++ --target=wasm32-wasi -std=c++20 -O2 -fno-exceptions -ffp-contract=off -mexec-model=reactor -I . \
    "${exports[@]/#/-Wl,--export=}" -Wl,--strip-all "${sources[@]}" -o course/page/module.wasm
  chmod -x course/page/module.wasm
  digest >course/page/module.sha256
fi
digest
