# SPDX-License-Identifier: MIT
"""Checks, plots and pages from the JSON that `octocell bench` writes."""

__version__ = "0.1.0"
