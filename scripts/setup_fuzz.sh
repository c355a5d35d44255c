#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What only the fuzz build needs: clang++ and its runtime with libFuzzer and the sanitizers.
set -euo pipefail

works() {
  command -v clang++ >/dev/null &&
    echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, long) { return 0; }' |
    clang++ -x c++ -fsanitize=fuzzer,address,undefined -o /dev/null - 2>/dev/null
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

install() {
  echo "setup-fuzz: installing $*"
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

works && exit 0
command -v apt-get >/dev/null || { echo "setup-fuzz: no apt-get here; please install clang and libclang-rt"; exit 2; }
as_root apt-get update -qq
command -v clang++ >/dev/null || install clang
# A package of its own, or part of clang's, by distribution.
runtime=libclang-rt-$(clang++ -dumpversion | cut -d. -f1)-dev
works || install "$runtime"
works || { echo "setup-fuzz: clang++ is here, and its libFuzzer does not link"; exit 2; }
