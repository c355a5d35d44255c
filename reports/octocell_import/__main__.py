# SPDX-License-Identifier: MIT
import sys

from octocell_import.cli import main

sys.exit(main())
