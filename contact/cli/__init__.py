"""The command line `contact`. Only this package imports typer and rich."""

from __future__ import annotations

import sys


def main() -> None:
    """Entry point: run the command that sys.argv names; exit code 0, 1 (something is missing) or 2 (bad input)."""
    try:
        from contact.cli.app import run
    except ModuleNotFoundError as missing:
        if missing.name not in ("typer", "rich"):
            raise
        sys.stderr.write(f"contact: {missing.name} is missing; pip install 'wheelrail-contact[cli]'\n")
        sys.exit(1)
    run(sys.argv[1:])
