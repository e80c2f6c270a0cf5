"""The one numba policy of the project.

* ``cache=True``: a user pays for compilation once a machine, not once a process.
* The cache is keyed by the sources of the package, without those that hold no kernel: numba alone compares a kernel's own
  file only, and would go on running yesterday's version of every kernel that it calls from other files.
* ``error_model="numpy"``: no exception branches; a division by zero is prevented by the kernel, not caught.
* ``nogil=True``: a kernel touches no Python object, so threads of a host run in parallel.
* no ``fastmath``: results must not depend on the instruction set (the native FMU is compared bit for bit).

Kernels allocate nothing, raise nothing, take no function argument: one source serves Python, batches and the native FMU.
"""

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from numba import config, njit

_WITHOUT_KERNELS = ("cli", "plot")


def _cache_directory() -> str:
    """Directory of compiled kernels for exactly these sources; numba falls back to the user's own if it is not writable."""
    package = Path(__file__).parent
    fingerprint = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        if path.relative_to(package).parts[0] in _WITHOUT_KERNELS:
            continue
        stat = path.stat()
        fingerprint.update(f"{path.relative_to(package)} {stat.st_mtime_ns} {stat.st_size}\n".encode())
    base = Path(config.CACHE_DIR) if config.CACHE_DIR else package / "__pycache__"
    return str(base / f"kernels-{fingerprint.hexdigest()[:16]}")


_DIRECTORY = _cache_directory()


def kernel(function: Callable[..., Any]) -> Any:
    """Compile `function` under the policy above."""
    users_choice = config.CACHE_DIR
    config.CACHE_DIR = _DIRECTORY
    try:
        return njit(cache=True, error_model="numpy", nogil=True)(function)
    finally:
        config.CACHE_DIR = users_choice
