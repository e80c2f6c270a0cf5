"""The one numba policy of the project.

* ``cache=True``: a user pays for compilation once a machine, not once a process.
* The cache is keyed by the sources of this package, without those that hold no kernel, and of the kernel's own: numba alone
  compares a kernel's own file only, and would go on running yesterday's version of every kernel that it calls from others.
* ``error_model="numpy"``: no exception branches; a division by zero is prevented by the kernel, not caught.
* ``nogil=True``: a kernel touches no Python object, so threads of a host run in parallel.
* no ``fastmath``: results must not depend on the instruction set (the native FMU is compared bit for bit).

Kernels allocate nothing, raise nothing, take no function argument: one source serves Python, batches and the native FMU.
"""

import hashlib
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from numba import config, njit

_WITHOUT_KERNELS = (
    *("accumulation", "cli", "life", "plot", "study", "temperature.py"),
    *(f"geometry/{name}.py" for name in ("en15302", "files", "outline", "profile", "rigid", "smoothing", "standard")),
)


@cache
def _cache_directory(package: str) -> str:
    """Directory of kernels of `package`, compiled from exactly these sources; numba has its own if that is not writable."""
    own = Path(__file__).parent
    fingerprint = hashlib.sha256()
    for root in sorted({own, *map(Path, getattr(sys.modules[package], "__path__", ()))}):
        for path in sorted(root.rglob("*.py")):
            source = path.relative_to(root)
            if any(source.is_relative_to(part) for part in _WITHOUT_KERNELS):
                continue
            stat = path.stat()
            fingerprint.update(f"{source} {stat.st_mtime_ns} {stat.st_size}\n".encode())
    base = Path(config.CACHE_DIR) if config.CACHE_DIR else own / "__pycache__"
    return str(base / f"kernels-{fingerprint.hexdigest()[:16]}")


def kernel(function: Callable[..., Any]) -> Any:
    """Compile `function` under the policy above."""
    users_choice = config.CACHE_DIR
    config.CACHE_DIR = _cache_directory(function.__module__.partition(".")[0])
    try:
        return njit(cache=True, error_model="numpy", nogil=True)(function)
    finally:
        config.CACHE_DIR = users_choice
