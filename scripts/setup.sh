#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing and nothing else: run again, or without a network, it does nothing.
set -euo pipefail
cd "$(dirname "$0")/.."

# OCTOCELL_DEVELOPER=OFF: only what the library and the command line need;
# with OCTOCELL_JUDGE=ON what judges hand-ins, too.
developer=${OCTOCELL_DEVELOPER:-ON}
judge=${OCTOCELL_JUDGE:-$developer}

packages=(
  g++ cmake ninja-build ccache pkg-config git
  libfmt-dev nlohmann-json3-dev libcli11-dev
  libboost-dev    # Asio's thread pool (headers)
  zlib1g-dev      # files that gzip packed
)
[ "$judge" = OFF ] || packages+=(libgmp-dev)  # the exact reference
[ "$developer" = OFF ] || packages+=(
  libbenchmark-dev libgtest-dev
  libfcl-dev libbullet-dev  # the baselines
  libtbb-dev libhwy-dev     # sorts to compare with
  python3-venv    # the reports
  python3-dev     # the Python module
)

has_nvcc() {
  command -v nvcc >/dev/null || [ -x "${CUDA_HOME:-/usr/local/cuda}/bin/nvcc" ] || [ -x .cuda/bin/nvcc ]
}

# OCTOCELL_CUDA is ON, or AUTO (the default) and there is a GPU to compile for.
wants_nvcc() {
  case ${OCTOCELL_CUDA:-AUTO} in
    ON) ;;
    AUTO) nvidia-smi --list-gpus >/dev/null 2>&1 ;;
    *) false ;;
  esac
}

# Thrust's headers come with a CUDA toolkit; where there will be none, from Debian.
has_nvcc || wants_nvcc || packages+=(libthrust-dev)

say() { echo "setup: $*"; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

is_installed() { dpkg-query -W -f '${Status}' "$1" 2>/dev/null | grep -q 'ok installed'; }

install_packages() {
  local missing=()
  for package in "${packages[@]}"; do
    is_installed "$package" || missing+=("$package")
  done
  [ ${#missing[@]} = 0 ] && return
  command -v apt-get >/dev/null || { say "no apt-get here; please install: ${missing[*]}"; exit 2; }
  say "installing ${missing[*]}"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# Not in every distribution; without it the property tests are left out.
install_rapidcheck() {
  is_installed librapidcheck-dev && return
  apt-cache show librapidcheck-dev >/dev/null 2>&1 || return 0
  say "installing librapidcheck-dev"
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends librapidcheck-dev >/dev/null ||
    say "librapidcheck-dev could not be installed: property tests are left out"
}

# The environment is made again when the pins change.
make_python_environment() {
  local wanted
  wanted=$(sha256sum reports/requirements.txt reports/pyproject.toml | sha256sum)
  [ -x .venv/bin/python ] && [ "$(cat .venv/octocell-pins 2>/dev/null)" = "$wanted" ] && return
  say "making a Python environment in .venv"
  python3 -m venv --clear .venv
  .venv/bin/python -m pip install --quiet --disable-pip-version-check -r reports/requirements.txt
  .venv/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --editable reports
  echo "$wanted" >.venv/octocell-pins
}

# Scenes of what was fetched, made once; what could not be fetched is no error.
import_scene() {  # FILE, options of octocell-import ...
  local file=$1 scene=${1%.*}.npy
  [ -f "$file" ] && [ ! "$scene" -nt "$file" ] || return 0
  .venv/bin/octocell-import "$@" -o "$scene" >/dev/null
  say "$scene made of $file"
}

# A moving scene: one .npy a frame.
import_frames() {  # TRAJECTORY, FOLDER, options of octocell-import ...
  local file=$1 folder=$2
  shift 2
  [ -f "$file" ] && [ ! "$folder/frame_00000.npy" -nt "$file" ] || return 0
  .venv/bin/octocell-import "$file" "$@" --all-frames "$folder" >/dev/null
  say "$folder/ made of $file"
}

install_packages
has_nvcc || ! wants_nvcc || scripts/cuda_toolkit.sh
[ "$developer" = OFF ] && exit 0
install_rapidcheck
make_python_environment
.venv/bin/python scripts/fetch_data.py
import_scene data/adk_oplsaa.gro --radius MW=0  # the water's fourth site: charge without size
import_scene data/bigbox.gro
import_frames data/adk_oplsaa.trr data/adk_frames --topology data/adk_oplsaa.gro --radius MW=0
