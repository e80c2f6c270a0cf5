"""The one numba policy of the project.

* ``cache=True``: a user pays for compilation once a machine, not once a process.
* ``error_model="numpy"``: no exception branches; a division by zero is prevented by the kernel, not caught.
* ``nogil=True``: a kernel touches no Python object, so threads of a host run in parallel.
* no ``fastmath``: results must not depend on the instruction set (the native FMU is compared bit for bit).

Kernels allocate nothing, raise nothing, take no function argument: one source serves Python, batches and the native FMU.
"""

from collections.abc import Callable
from typing import Any

from numba import njit

kernel: Callable[..., Any] = njit(cache=True, error_model="numpy", nogil=True)
