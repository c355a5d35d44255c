#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures the step page in headless Chromium: size, first paint, steps a second.

  scripts/measure_page.py reports/out/steps.html    measures, writes course/page/measured.json
  scripts/measure_page.py                           writes the numbers into course/page/README.md

The median of nine loads; a step is a press of the right arrow key, drawn and laid out again.
"""

from __future__ import annotations

import argparse
import json
import platform
import re
import statistics
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
MEASURED = ROOT / "course/page/measured.json"
README = ROOT / "course/page/README.md"
LOADS = 9
BLOCK = re.compile(r"(<!-- measured -->\n).*?(<!-- end -->)", re.DOTALL)

PAINT = """
const done = arguments[0];
new PerformanceObserver((list) => done(list.getEntries()[0].startTime))
  .observe({type: "paint", buffered: true});
"""
STEPS = """
const begin = performance.now();
let count = 0;
while (performance.now() - begin < 1000) {
  go(state.step + 1 < steps.length ? state.step + 1 : 0);
  document.body.getBoundingClientRect();
  count += 1;
}
return count / (performance.now() - begin) * 1000;
"""


def measure(page: Path) -> dict[str, Any]:
    sys.path.append(str(ROOT / "tests/support"))
    from step_page import open_browser, open_page

    paints, rates = [], []
    browser = open_browser()
    browser.set_window_rect(0, 0, 1280, 720)
    for _ in range(LOADS):
        open_page(browser, page.resolve())
        paints.append(browser.execute_async_script(PAINT))
        rates.append(browser.execute_script(STEPS))
    version = browser.capabilities["browserVersion"]
    browser.quit()
    commit = subprocess.run(
        ["git", "-C", ROOT, "rev-parse", "--short", "HEAD"],
        capture_output=True,
        text=True,
        check=True,
    )
    return {
        "machine": cpu(),
        "browser": f"Chromium {version}, headless, 1280 x 720",
        "commit": commit.stdout.strip(),
        "bytes": page.stat().st_size,
        "first_paint_ms": spread(paints),
        "steps_per_second": spread(rates),
    }


def cpu() -> str:
    found = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return found[1] if found else platform.machine()


def spread(values: list[float]) -> dict[str, float]:
    return {"median": statistics.median(values), "lowest": min(values), "highest": max(values)}


def sentence(found: dict[str, Any]) -> str:
    def text(name: str) -> str:
        value = found[name]
        return f"{value['median']:.0f} ({value['lowest']:.0f} to {value['highest']:.0f})"

    return (
        f"The page of the course has {found['bytes'] / 1000:.0f} KB. Measured with"
        f" {found['browser']}, on {found['machine']}, at {found['commit']}:\n"
        f"first paint after {text('first_paint_ms')} ms, {text('steps_per_second')} steps a second"
        f" (median, lowest and highest of {LOADS}).\n"
    )


def main() -> int:
    parser = argparse.ArgumentParser(description="Measures the step page.")
    parser.add_argument("page", type=Path, nargs="?")
    options = parser.parse_args()
    if options.page:
        MEASURED.write_text(json.dumps(measure(options.page), indent=1) + "\n", encoding="utf-8")
    found = json.loads(MEASURED.read_text(encoding="utf-8"))
    text = README.read_text(encoding="utf-8")
    README.write_text(BLOCK.sub(rf"\g<1>{sentence(found)}\g<2>", text), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
