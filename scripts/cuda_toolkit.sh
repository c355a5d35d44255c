#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes a CUDA toolkit in .cuda/ of NVIDIA's wheels on PyPI: nvcc, its headers and libraries, Thrust.
# Enough to compile, a tenth of the full toolkit; to run, a driver (580 or later) and a GPU are needed.
set -euo pipefail
cd "$(dirname "$0")/.."

version=13.0
packages=(
  nvidia-cuda-nvcc nvidia-cuda-crt nvidia-nvvm  # the compiler
  nvidia-cuda-runtime                           # cudart and its headers
  nvidia-cuda-cccl                              # Thrust and CUB
)

say() { echo "cuda-toolkit: $*"; }

[ "$(uname -sm)" = "Linux x86_64" ] || { say "made for x86-64 Linux, this is $(uname -sm)"; exit 2; }

if [ -x .cuda/bin/nvcc ] && [ "$(cat .cuda/octocell-version 2>/dev/null)" = "$version" ]; then
  say "there already: $(.cuda/bin/nvcc --version | grep release)"
  exit 0
fi

say "installing ${packages[*]}, version $version"
rm -rf .cuda
python3 -m venv .cuda/installer
.cuda/installer/bin/python -m pip install --quiet --disable-pip-version-check --no-deps \
  --only-binary :all: --target .cuda/wheels "${packages[@]/%/==$version.*}"
rm -rf .cuda/installer

# The layout that nvcc and CMake expect of a toolkit.
root=.cuda/wheels/nvidia/cu13
[ -x "$root/bin/nvcc" ] || { say "no nvcc in $root: the wheels have changed their layout"; exit 1; }
for folder in bin include lib nvvm; do ln -s "wheels/nvidia/cu13/$folder" ".cuda/$folder"; done
ln -sfn lib "$root/lib64"
ln -s lib .cuda/lib64
[ -e "$root/lib/libcudart.so" ] || ln -s libcudart.so.13 "$root/lib/libcudart.so"
echo "$version" >.cuda/octocell-version
say "$(.cuda/bin/nvcc --version | grep release); build with OCTOCELL_CUDA=AUTO or ON"
