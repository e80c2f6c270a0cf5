"""The command line `contact`. Only this package of the library imports typer and rich."""

from __future__ import annotations

import sys

_HELP = """\
usage: contact COMMAND [OPTIONS]

Wheel-rail contact: patches, pressure, creep forces and damage.
"""


def main() -> None:
    """Run the command in sys.argv. The exit code is 0, 1 (something is missing) or 2 (bad input)."""
    try:
        from contact.cli.app import run
    except ModuleNotFoundError as missing:
        if (missing.name or "").partition(".")[0] not in ("typer", "rich"):
            raise
        line = f"contact: {missing.name} is missing; pip install wheelrail-contact installs it\n"
        if set(sys.argv[1:]) & {"-h", "--help"}:
            sys.stdout.write(f"{_HELP}\n{line}")
            sys.exit(0)
        sys.stderr.write(line)
        sys.exit(1)
    run(sys.argv[1:])
