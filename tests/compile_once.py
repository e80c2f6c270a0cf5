"""Workers of pytest compile each kernel once: the first one that needs it compiles, the others wait and read the cache.

From an empty cache, workers need the same kernels at about the same time. Each compiled them, and the last one was kept.
"""

from __future__ import annotations

import fcntl  # not on Windows
import hashlib
from pathlib import Path
from typing import IO, Any

import pytest
from numba.core import event

from contact._jit import _ContentCache

_held: dict[Any, IO[str]] = {}  # cache of a kernel that is being compiled → its locked file


def _release(cache: Any) -> None:
    if cache in _held:
        _held.pop(cache).close()


class _Failed(event.Listener):
    """Release the lock of a kernel that does not compile."""

    def on_start(self, event: event.Event) -> None:
        pass

    def on_end(self, event: event.Event) -> None:
        if event._exc_details is not None:  # `is_failed` says the opposite in numba 0.68
            _release(event.data["dispatcher"]._cache)


def compile_once(patch: pytest.MonkeyPatch, folder: Path) -> None:
    """From now on, wait for a kernel that another process with the same `folder` compiles."""
    load, save = _ContentCache.load_overload, _ContentCache.save_overload
    folder.mkdir(exist_ok=True)

    def load_or_wait(self: Any, signature: Any, context: Any) -> Any:
        found = load(self, signature, context)
        if found is None:
            _release(self)
            name = hashlib.sha256(f"{self._impl.filename_base} {signature}".encode()).hexdigest()
            _held[self] = (folder / name).open("w")
            fcntl.flock(_held[self], fcntl.LOCK_EX)
            found = load(self, signature, context)
            if found is not None:
                _release(self)
        return found

    def save_and_release(self: Any, signature: Any, data: Any) -> None:
        try:
            save(self, signature, data)
        finally:
            _release(self)

    patch.setattr(_ContentCache, "load_overload", load_or_wait)
    patch.setattr(_ContentCache, "save_overload", save_and_release)
    event.register("numba:compile", _Failed())
