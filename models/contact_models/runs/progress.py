"""How far a command is: lines on the terminal, where there is no bar, and in a log file."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from pathlib import Path

import typer

#: Name of the log file, beside the results.
LOG = "progress.log"
_TOLD = 10.0  # between two lines on the terminal [s]
_LOGGED = 60.0  # between two lines of the log file [s]


class Progress:
    """Lines about a command that runs: every 10 s on a terminal without a bar, and every minute in progress.log.

    Parameters
    ----------
    folder : Path
        Of the log file. It is made when the first line is written.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / LOG
        self._told = self._logged = time.monotonic()

    def tell(self, line: Callable[[], str]) -> None:
        """Write the line that a function returns where it is time for one."""
        now = time.monotonic()
        if now - self._told >= _TOLD and not sys.stderr.isatty():
            typer.echo(line(), err=True)
            self._told = now
        if now - self._logged >= _LOGGED:
            self.log(line())

    def log(self, line: str) -> None:
        """Add a line with the time to the log file, at once."""
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with self._path.open("a", encoding="utf-8") as file:
            file.write(f"{time.strftime('%Y-%m-%d %H:%M:%S')}  {line}\n")
        self._logged = time.monotonic()


def time_left(seconds: float) -> str:
    """Return the time left as the end of a line: nothing if there is none, or no estimate."""
    if not 0.5 < seconds < math.inf:
        return ""
    return f", about {seconds:.0f} s left" if seconds < 90.0 else f", about {seconds / 60.0:.0f} min left"
