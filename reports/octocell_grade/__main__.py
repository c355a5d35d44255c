# SPDX-License-Identifier: MIT
import sys

from octocell_grade.cli import main

sys.exit(main())
