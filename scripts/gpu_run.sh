#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# On a machine with a GPU, from an unpacked bundle: what proves it (measure.sh makes what is published).
# gpu_run.sh STEP..., steps being tests, check, stress, sanitizers, mutants (default: tests check).
# OUT names the folder for logs and JSON (default: out, beside this file).
# shellcheck disable=SC2317  # steps are called by their names
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
OUT=${OUT:-$here/out}
mkdir -p "$OUT"
octocell=$here/octocell
failures=$OUT/failures  # a file: steps may run side by side
rm -f "$failures"

say() { echo "== $*"; }
run() { say "$*"; "$@" || say "FAILED: $*" | tee -a "$failures"; }
quietly() {  # NAME COMMAND...: only how it ended is shown
  local name=$1 log=$OUT/$1.log
  shift
  if "$@" >"$log" 2>&1; then
    say "$name: $(tail -n 1 "$log")"
  else
    say "FAILED: $name ($log): $*" | tee -a "$failures"
    grep -E 'FAILED|Failure|error|ERROR|wrong' "$log" | head -20
  fi
}

tests() {
  local name cases
  while read -r name cases; do
    quietly "$name" "$here/tests/$name" --gtest_brief=1 --gtest_filter="$cases" </dev/null
  done <"$here/tests/gpu_tests.txt"
}

# Scenes on which a plain grid holds nearly all spheres in one cell.
hard_scenes() {
  "$octocell" generate gas:n=50000 -o "$OUT/far.csv" >/dev/null
  printf '%s\n' 3e38,1,1,0.5 -3e38,2e38,0,0.5 1e10,-1e20,5,0.5 1e10,-1e20,5,0.5 7,-1e30,7,9 >>"$OUT/far.csv"
  awk 'BEGIN { srand(1); print "x,y,z,r"; for (k = 0; k < 50000; ++k) print rand() "," rand() "," rand() ",0"
               print "0.5,0.5,0.5,0.1"; print "0.5,0.5,0.5,0" }' >"$OUT/points.csv"
}

check() {
  hard_scenes
  for backend in impl_cuda_custom impl_thrust_cuda; do
    quietly "check_$backend" "$octocell" check --backend "$backend"
    quietly "check_hard_$backend" "$octocell" check --backend "$backend" "$OUT/far.csv" "$OUT/points.csv"
    quietly "check_large_$backend" "$octocell" check --backend "$backend" gas:n=1e6 dense:n=3e5 poly:n=1e6 \
      cluster:n=1e6 lattice:n=1e6,shuffle=1 shifted:n=1e6 giant:n=3e5 discs:n=3e5 identical:n=5e3 chain:n=1e6
  done
}

stress() {  # SIZE: slice, quick (minutes) or full (hours)
  export OMP_WAIT_POLICY=passive
  quietly stress "$octocell" stress --backend ours --size "${SIZE:-quick}" -o "$OUT/stress.json"
}

sanitizers() {  # small scenes: the tools make everything hundreds of times slower
  for tool in memcheck racecheck initcheck synccheck; do
    quietly "sanitize_$tool" compute-sanitizer --tool "$tool" --error-exitcode 9 "$octocell" check \
      --backend impl_cuda_custom gas:n=3000 poly:n=2000 giant:n=3000 identical:n=900 lattice:n=3000 &
    quietly "sanitize_sort_$tool" compute-sanitizer --tool "$tool" --error-exitcode 9 \
      "$here/tests/test_radix_sort" --gtest_brief=1 --gtest_filter='*FewerPairs*:*NoMore*:*AgreesWith*' &
    quietly "sanitize_frames_$tool" compute-sanitizer --tool "$tool" --error-exitcode 9 \
      "$here/tests/test_cuda_coherence" --gtest_brief=1 \
      --gtest_filter='*OnlyCounted*:*MoreUncertainPairs*:*AnotherNumber*:*ThatFailed*:*OtherFlags*' &
  done
  for tool in memcheck initcheck; do  # the others would take a quarter of an hour
    quietly "sanitize_precision_$tool" compute-sanitizer --tool "$tool" --error-exitcode 9 \
      "$here/tests/test_cuda_precision" --gtest_brief=1 &
  done
  wait
}

mutants() {  # of a bundle made with FAULTS=ON
  run python3 "$here/mutation/mutants.py" --build "$here" --only 'cuda_.*' \
    --checks 'test_(radix_sort|cuda_.*)' --jobs 4 -o "$OUT/mutants.json"
}

for step in "${@:-tests check}"; do
  for name in $step; do
    declare -F "$name" >/dev/null || { say "no step $name"; exit 2; }
    "$name"
  done
done
[ ! -e "$failures" ]
