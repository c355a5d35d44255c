# SPDX-License-Identifier: MIT
"""Names of variants of a plan: 'none', 'no_sort' (that skip forbidden), 'first_3_sort' (the first
three skips allowed, sort the last of them)."""

PLANNED = "planned"  # the method of rows that the planner decides
REBUILT = "rebuilt"  # the variant whose frames take nothing over
NOTHING = "none"  # the variant for which every skip is forbidden
