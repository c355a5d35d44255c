#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Draws the pages in docs/ablation and docs/error from the published results: `make studies`.
set -euo pipefail
cd "$(dirname "$0")/.."
export PYTHONPATH=reports
out=reports/out/studies
cpu=reports/results/epyc-zen5-2core
gpu=reports/results/h100-80gb

# study COMMAND PAGE RESULT...: writes docs/PAGE. SVG files and the longest tables stay in reports/out.
study() {
  .venv/bin/python -m octocell_report "$1" "${@:3}" -o "$out/$2"
  find "$out/$2" -maxdepth 1 -type f ! -name '*.svg' ! -name "$1.csv" -exec cp -t "docs/$2" {} +
}

mkdir -p docs/error docs/ablation/{gpu,thrust,thrust_gpu}
study ablation ablation "$cpu/ablation.json.gz"
study ablation ablation/thrust "$cpu/ablation_thrust.json.gz"
study ablation ablation/gpu "$gpu/ablation_gpu.json.gz"
study ablation ablation/thrust_gpu "$gpu/ablation_thrust_gpu.json.gz"
study error error "$cpu/error.json.gz" "$gpu/error_gpu.json.gz"
