# SPDX-License-Identifier: MIT
from octocell_report.schema import Place as Place
