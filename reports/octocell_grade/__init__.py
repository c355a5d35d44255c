# SPDX-License-Identifier: MIT
"""Grades a folder of hand-ins with `octocell try`."""

__version__ = "0.1.0"
