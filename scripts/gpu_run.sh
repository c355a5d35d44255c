#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# On a machine with a GPU, from an unpacked bundle: tests, sanitizers, and what is published.
# gpu_run.sh STEP... with OUT naming a folder for what it writes (default: out beside this file).
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
OUT=${OUT:-$here/out}
mkdir -p "$OUT"
octocell=$here/octocell
failed=0

say() { echo "== $*"; }
run() { say "$*"; "$@" || { failed=1; say "FAILED: $*"; }; }
quietly() {  # NAME COMMAND...: only the end is shown
  local log=$OUT/$1.log
  shift
  say "$*"
  "$@" >"$log" 2>&1 || { failed=1; say "FAILED ($log):"; grep -E 'FAILED|Failure|error|ERROR' "$log" | head -20; }
  tail -n 3 "$log"
}

tests() {
  quietly radix_sort "$here/tests/test_radix_sort" --gtest_brief=1
  quietly cuda_custom "$here/tests/test_cuda_custom" --gtest_brief=1
  quietly agree "$here/tests/test_backends_agree" --gtest_brief=1 --gtest_filter='*cuda*'
  quietly buffers "$here/tests/test_buffers" --gtest_brief=1 --gtest_filter='*cuda*'
}

check() {
  for backend in impl_cuda_custom impl_thrust_cuda; do
    quietly "check_$backend" "$octocell" check --backend "$backend"
    quietly "check_large_$backend" "$octocell" check --backend "$backend" gas:n=1e6 dense:n=3e5 poly:n=1e6 \
      cluster:n=1e6 lattice:n=1e6,shuffle=1 shifted:n=1e6 giant:n=3e5 discs:n=3e5 identical:n=5e3 chain:n=1e6
  done
}

sanitizers() {  # small scenes: the tools make everything hundreds of times slower
  for tool in memcheck racecheck initcheck synccheck; do
    quietly "sanitize_$tool" timeout 170 compute-sanitizer --tool "$tool" --error-exitcode 9 \
      "$octocell" check --backend impl_cuda_custom gas:n=3000 giant:n=3000 identical:n=900 lattice:n=3000
    quietly "sanitize_sort_$tool" timeout 170 compute-sanitizer --tool "$tool" --error-exitcode 9 \
      "$here/tests/test_radix_sort" --gtest_brief=1 --gtest_filter='*Small*:*Sizes*:-*Sixty*:*Promises*:*Slow*'
  done
}

sort() { run "$octocell" bench-sort --device gpu -o "$OUT/sort.json"; }

bench() {
  run "$octocell" bench --preset gpu -o "$OUT/gpu.json"
}

for step in "${@:-tests}"; do "$step"; done
exit "$failed"
