# SPDX-License-Identifier: MIT
from octocell_report.schema import Motion as Motion
