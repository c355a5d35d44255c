# SPDX-License-Identifier: MIT
"""Turns files of molecules, particles and points into scenes that octocell reads."""

__version__ = "0.1.0"
