#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what the browser tests need: Chromium, its driver, Chinese fonts, selenium, jsonschema. Run again, or
# without a network, it does nothing. Where Chromium is no package (Ubuntu), it says so, and the
# tests are left out.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { echo "setup: $*"; }
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }
is_installed() { dpkg-query -W -f '${Status}' "$1" 2>/dev/null | grep -q 'ok installed'; }

missing=()
for package in chromium chromium-driver fonts-noto-cjk; do
  is_installed "$package" || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  say "installing ${missing[*]}"
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null ||
    say "no Chromium here: browser tests are left out"
fi
.venv/bin/python -c 'import jsonschema, selenium' 2>/dev/null ||
  .venv/bin/python -m pip install --quiet --disable-pip-version-check -r tests/course/requirements.txt ||
  say "selenium and jsonschema could not be installed: their tests are left out"
