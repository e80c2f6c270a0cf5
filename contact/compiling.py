"""Say on a terminal that kernels are being compiled, and how far it is.

Numba compiles a kernel when it is first called on a machine; a first solution takes about a minute. A line on stderr says so.
It is written on a terminal only, and neither in FMUs nor in worker processes.
"""

from __future__ import annotations

import multiprocessing
import sys
import time
from typing import Any, TextIO

from numba.core import event

_EVENT = "numba:compile"
_PACKAGES = ("contact", "models", "fmu_src", "contact_models", "contact_fmu")


class Announcement(event.Listener):
    """Listener that keeps one line on `stream` while kernels of this project are compiled.

    `delay` is the time of compilation [s] before anything is written.
    """

    def __init__(self, stream: TextIO, delay: float = 0.3) -> None:
        self.stream, self.delay = stream, delay
        self.done, self.depth = 0, 0
        self.spent, self.begin = 0.0, 0.0
        self.shown = False

    def on_start(self, event: Any) -> None:
        if not _is_ours(event):
            return
        if self.depth == 0:
            self.begin = time.monotonic()
        self.depth += 1
        self._show()

    def on_end(self, event: Any) -> None:
        if not _is_ours(event):
            return
        self.done += 1
        self.depth -= 1
        if self.depth == 0:
            self.spent += time.monotonic() - self.begin
            if self.shown:
                self.stream.write("\r\033[K")
                self.stream.flush()
                self.shown = False
        else:
            self._show()

    def _show(self) -> None:
        spent = self.spent + time.monotonic() - self.begin
        if spent >= self.delay:
            self.stream.write(
                f"\rcontact: compiling, once on this machine (about a minute): {self.done} functions, {spent:.0f} s\033[K"
            )
            self.stream.flush()
            self.shown = True


_LISTENERS: list[Announcement] = []


def announce() -> None:
    """Announce compilations if stderr is a terminal and this is the main process. Further calls have no effect."""
    if not _LISTENERS and sys.stderr is not None and sys.stderr.isatty() and multiprocessing.parent_process() is None:
        _LISTENERS.append(Announcement(sys.stderr))
        event.register(_EVENT, _LISTENERS[0])


def keep_quiet() -> None:
    """Announce nothing, as in an FMU, whose host may own the terminal."""
    while _LISTENERS:
        event.unregister(_EVENT, _LISTENERS.pop())


def _is_ours(compilation: Any) -> bool:
    return str(compilation.data["dispatcher"].py_func.__module__).partition(".")[0] in _PACKAGES
