# SPDX-License-Identifier: MIT
"""The step page in headless Chromium: opens it and asks its C++."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest
from hard_scenes import Spheres
from program import ROOT

pytest.importorskip("selenium", reason="no selenium: scripts/setup_browser.sh installs it")
if not (shutil.which("chromium") and shutil.which("chromedriver")):
    pytest.skip("no Chromium: scripts/setup_browser.sh installs it", allow_module_level=True)

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

__all__ = [
    "PAGE",
    "ActionChains",
    "By",
    "Keys",
    "Trace",
    "open_browser",
    "open_page",
    "traced",
    "webdriver",
]

PAGE = ROOT / "course/page"

Trace = dict[str, Any]


def open_browser() -> webdriver.Chrome:
    options = webdriver.ChromeOptions()
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    options.binary_location = str(shutil.which("chromium"))
    service = webdriver.ChromeService(str(shutil.which("chromedriver")))
    return webdriver.Chrome(options, service)


def open_page(browser: webdriver.Chrome, page: Path, query: str = "") -> None:
    browser.get(f"{page.as_uri()}?{query}")
    ready = "const done = arguments[0]; const ask = () => document.body.classList.contains('ready')"
    browser.execute_async_script(f"{ready} ? done() : setTimeout(ask, 20); ask();")


def traced(browser: webdriver.Chrome, spheres: Spheres, rule: str) -> Trace:
    script = "return tracer.trace(arguments[0], arguments[1], 0)"
    found: Trace = browser.execute_script(script, spheres.tolist(), rule)
    return found
