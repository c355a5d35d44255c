#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Packs the program, the libraries it needs, the GPU tests, the reports and the real scenes into
# dist/octocell.tar.gz, for a machine where nothing can be installed. Arguments: architectures of
# GPUs as CMake spells them (90-real). Ends with a trial in a root directory that holds only glibc.
# With FAULTS=ON, dist/octocell-faults.tar.gz: the same from a build with planted faults.
set -euo pipefail
cd "$(dirname "$0")/.."

IFS=';' architectures="$*"
unset IFS
FAULTS=${FAULTS:-OFF}
name=octocell
build="build-bundle"
[ "$FAULTS" = OFF ] || { name=octocell-faults; build="build-bundle-faults"; }
bundle=dist/$name

say() { echo "bundle: $*"; }

# glibc belongs to the machine; all else travels.
libraries_of() {
  ldd "$@" | awk '$2 == "=>" {print $3}' | sort -u |
    grep -Ev '/(libc|libm|libdl|librt|libpthread|ld-linux[^/]*)\.so'
}

build() {
  cmake --preset bundle -B "$build" -DOCTOCELL_FAULTS="$FAULTS" -DCMAKE_CUDA_ARCHITECTURES="$architectures" >/dev/null
  mapfile -t tests < <(awk '{print $1}' "$build/tests/gpu_tests.txt")
  cmake --build "$build" --target octocell "${tests[@]}"
}

pack() {
  rm -rf "$bundle"
  mkdir -p "$bundle"/{lib,tests,data}
  install --strip "$build/octocell" "$bundle"
  for test in "${tests[@]}"; do install --strip "$build/tests/$test" "$bundle/tests"; done
  cp "$build/tests/gpu_tests.txt" "$bundle/tests"
  libraries_of "$bundle/octocell" "$bundle"/tests/test_* | xargs -I{} install --mode=644 {} "$bundle/lib"
  cp -r reports/octocell_report reports/requirements.txt "$bundle"
  find "$bundle" -name __pycache__ -prune -exec rm -rf {} +
  cp scripts/gpu_run.sh scripts/measure.sh README.md LICENSE "$bundle"
  git rev-parse HEAD >"$bundle/commit"
  for scene in data/1A2C.pqr data/adk_oplsaa.npy; do [ ! -f "$scene" ] || cp "$scene" "$bundle/data"; done
  [ "$FAULTS" = OFF ] || cp -r tests/mutation "$bundle"
  tar -C dist -czf "dist/$name.tar.gz" "$name"
}

# A root with the bundle and glibc, nothing more: what else it needed would be missing.
try_in_bare_root() {
  [ "$(id -u)" = 0 ] || { say "not tried in a bare root: that takes root"; return; }
  local root
  root=$(mktemp -d)
  trap 'rm -rf "$root"' RETURN
  tar -C "$root" -xzf "dist/$name.tar.gz"
  ldd "$build/octocell" | grep -Eo '/[^ ]*/(libc|libm|libdl|librt|libpthread|ld-linux[^/ ]*)\.so[^ ]*' |
    sort -u | while read -r file; do install -D "$file" "$root$file"; done
  mkdir "$root/proc"
  for command in "octocell check gas:n=500" "tests/test_cuda_custom --gtest_brief=1"; do
    say "$command"  # the loader asks /proc where $ORIGIN is
    unshare --mount bash -c "mount --bind /proc $root/proc && chroot $root /$name/$command" | tail -n 2
  done
}

build
pack
say "trying it in a bare root"
try_in_bare_root
size=$(stat -c %s "dist/$name.tar.gz")
say "dist/$name.tar.gz: $((size / 1000000)) MB, GPUs $architectures"
[ "$size" -lt 60000000 ] || { say "more than 60 MB"; exit 1; }
