"""`python -m frisure` is the command `frisure`."""

import sys

from frisure._cli import main

sys.exit(main())
