#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs every CPU benchmark whose results are committed, one after the other (half an hour on a
# quiet machine), into reports/out/published. See docs/measuring.md for what to do with them.
set -euo pipefail
cd "$(dirname "$0")/.."

out=reports/out/published
planned='backend:impl_cpu/method:planned/.*threads:1'
million=n=1000000

bench() {  # NAME OPTION...
  echo "== $1" >&2
  build/octocell bench -o "$out/$1.json" "${@:2}"
}

# A gas times 1e4, radii included, every other sphere 1e10 further on each axis.
two_clusters() {
  build/octocell generate "gas:$million" -o "$out/gas.npy"
  .venv/bin/python - "$out" <<'PYTHON'
import sys

import numpy as np

spheres = np.load(f"{sys.argv[1]}/gas.npy").astype(np.float64) * 1e4
spheres[1::2, :3] += 1e10
np.save(f"{sys.argv[1]}/two_clusters.npy", spheres.astype(np.float32))
PYTHON
}

mkdir -p "$out"
two_clusters
bench headline "gas:$million" --rounds 15 --no-memory \
  --benchmark_filter="$planned/run:cold|(fcl_dynamic_aabb_tree(_array)?_morton|bullet_dbvt)/.*run:cold"
bench scenes --rounds 7 --no-memory --benchmark_filter="$planned/run:cold" \
  "gas:$million" "discs:$million,ratio=1" "discs:$million,ratio=100" "poly:$million,ratio=1e6" \
  "poly:$million" "giant:$million" "chain:$million" "lattice:$million" \
  "lattice:$million,shuffle=1" "shifted:$million,offset=1e7" "$out/two_clusters.npy" \
  "dense:$million" "cluster:$million" gas:n=1e7
bench frames --preset frames --backend impl_cpu
bench moving "gas:$million" --motion brownian --frames 12 --rounds 3
bench ablation --preset ablation --backend impl_cpu
bench ablation_thrust --preset ablation --backend impl_thrust
bench quick
