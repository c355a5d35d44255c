#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes all published results of this machine, from one commit.
#
#   scripts/measure.sh cpu [STEP...]      in a clone, on a quiet machine: some three hours, not yet timed
#   scripts/measure.sh gpu [STEP...]      in an unpacked bundle (make bundle), on a GPU: some 40 minutes, not yet timed
#   scripts/measure.sh publish MACHINE    packs them into reports/results/MACHINE
#
# Resumable: a step whose result of this commit is there, whole, is not run again. Results lie in
# reports/out/published (gpu: out, beside the bundle's program). What gpu_run.sh looks for, sanitizers
# and planted faults, is published from its logs (docs/how_to/run_on_a_gpu.md).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

cpu_steps=(headline scenes frames moving ablation ablation_thrust error near_tangent_cpu stress quick
           compilers sanitizers fuzz mutants)
gpu_steps=(gpu gpu_large ablation_gpu ablation_thrust_gpu error_gpu frames sort near_tangent_gpu stress_gpu)
planned='backend:impl_cpu/method:planned/.*threads:1'
million=n=1000000

usage() {
  sed -n '5,7s/^# *//p' "$0" >&2
  exit 2
}
say() { echo "== $(date +%T) $*" >&2; }

# True if the step's file is of this commit and its run came to an end.
is_done() {
  "$python" - "$out/$1.json" "$commit" <<'PYTHON'
import json
import sys

try:
    with open(sys.argv[1], encoding="utf-8") as stream:
        context = json.load(stream)["context"]
except (OSError, ValueError, KeyError):
    sys.exit(1)
done = context.get("finished") is not False and not context.get("dirty")
sys.exit(not (done and context["commit"] == sys.argv[2]))
PYTHON
}

bench() { "$octocell" bench -o "$out/$1.json" "${@:2}"; }

# A gas times 1e4, radii included, every other sphere 1e10 further on each axis.
two_clusters() {
  "$octocell" generate "gas:$million" -o "$out/gas.npy" >/dev/null
  "$python" - "$out" <<'PYTHON'
import sys

import numpy as np

spheres = np.load(f"{sys.argv[1]}/gas.npy").astype(np.float64) * 1e4
spheres[1::2, :3] += 1e10
np.save(f"{sys.argv[1]}/two_clusters.npy", spheres.astype(np.float32))
PYTHON
}

step_headline() {
  bench headline "gas:$million" --rounds 15 --no-memory \
    --benchmark_filter="$planned/run:cold|(fcl_dynamic_aabb_tree(_array)?_morton|bullet_dbvt)/.*run:cold"
}
step_scenes() {
  two_clusters
  bench scenes --rounds 7 --no-memory --benchmark_filter="$planned/run:cold" \
    "gas:$million" "discs:$million,ratio=1" "discs:$million,ratio=100" "poly:$million,ratio=1e6" \
    "poly:$million" "giant:$million" "chain:$million" "lattice:$million" \
    "lattice:$million,shuffle=1" "shifted:$million,offset=1e7" "$out/two_clusters.npy" \
    "dense:$million" "cluster:$million" gas:n=1e7
}
step_moving() { bench moving "gas:$million" --motion brownian --frames 12 --rounds 3; }
step_ablation() { bench ablation --preset ablation --backend impl_cpu; }
step_ablation_thrust() { bench ablation_thrust --preset ablation --backend impl_thrust; }
step_error() { bench error --preset error --no-memory --timeout 3; }
step_quick() { bench quick --preset quick; }
step_near_tangent_cpu() { "$octocell" near-tangent --pairs 2e8 -o "$out/near_tangent_cpu.json"; }
step_stress() { OMP_WAIT_POLICY=passive "$octocell" stress -o "$out/stress.json"; }
made() { make --no-print-directory "$1" >&2 && cp "reports/out/$1.json" "$out/$2.json"; }
step_compilers() { made compilers compilers; }
step_fuzz() { made fuzz fuzz; }
step_mutants() { made mutants mutants; }
step_sanitizers() { make --no-print-directory sanitize >&2 && cp reports/out/sanitizers.json "$out/sanitizers.json"; }

step_gpu() { bench gpu --preset gpu; }
step_gpu_large() {
  bench gpu_large dense:n=1e7 poly:n=1e7 cluster:n=1e7 lattice:n=1e7,shuffle=1 shifted:n=1e7 giant:n=1e7 \
    --rounds 3 --benchmark_filter='cuda.*method:planned.*run:warm'
}
step_ablation_gpu() { bench ablation_gpu --preset ablation --backend impl_cuda_custom; }
step_ablation_thrust_gpu() { bench ablation_thrust_gpu --preset ablation --backend impl_thrust_cuda; }
step_error_gpu() { bench error_gpu --preset error --backend impl_cuda_custom --no-memory --timeout 3; }
step_sort() { "$octocell" bench-sort --device gpu -o "$out/sort.json"; }
step_near_tangent_gpu() { "$octocell" near-tangent --device --pairs 2e9 -o "$out/near_tangent_gpu.json"; }
step_stress_gpu() { OMP_WAIT_POLICY=passive "$octocell" stress --backend ours -o "$out/stress_gpu.json"; }
step_frames() {
  case $side in
    cpu) bench frames --preset frames --backend impl_cpu ;;
    gpu) bench frames --preset frames --backend impl_cuda_custom ;;
  esac
}

run_steps() {
  local step
  for step; do
    declare -F "step_$step" >/dev/null || { say "no step $step"; exit 2; }
    if is_done "$step"; then
      say "$step: is there"
    else
      say "$step"
      "step_$step"
    fi
  done
}

publish() {  # MACHINE: without blanks, packed, always the same bytes
  "$python" - "$out" "reports/results/$1" <<'PYTHON'
import gzip
import json
import sys
from pathlib import Path

source, target = map(Path, sys.argv[1:])
target.mkdir(parents=True, exist_ok=True)
for path in sorted(source.glob("*.json")):
    document = json.loads(path.read_text(encoding="utf-8"))
    text = json.dumps(document, separators=(",", ":"), ensure_ascii=False)
    with (target / f"{path.name}.gz").open("wb") as raw, gzip.GzipFile("", "wb", 9, raw, 0) as packed:
        packed.write(text.encode())
    print(target / f"{path.name}.gz")
PYTHON
}

side=${1:-}
case $side in
  cpu | publish)
    cd "$here/.."
    octocell=build/octocell python=.venv/bin/python out=reports/out/published
    commit=$(git rev-parse HEAD) steps=("${cpu_steps[@]}")
    ;;
  gpu)
    octocell=$here/octocell python=python3 out=$here/out
    commit=$(<"$here/commit") steps=("${gpu_steps[@]}")
    ;;
  *)
    usage
    ;;
esac
shift
mkdir -p "$out"
if [ "$side" = publish ]; then
  [ $# = 1 ] || usage
  publish "$1"
else
  [ $# = 0 ] || steps=("$@")
  run_steps "${steps[@]}"
fi
