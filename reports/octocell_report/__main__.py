# SPDX-License-Identifier: MIT
import sys

from octocell_report.cli import main

sys.exit(main())
