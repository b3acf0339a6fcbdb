"""The command `frisure`."""

from __future__ import annotations

import sys

from frisure._frisure import run_command


def main() -> int:
    """Runs the command line of this process and returns its exit status."""
    return run_command(["frisure", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
