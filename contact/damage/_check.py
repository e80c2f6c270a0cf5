"""Helper of the damage models' public functions: call a kernel for each element."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError


def elementwise(kernel: Callable[..., float], *arrays: Array, constants: tuple[Array, ...] = ()) -> float | Array:
    """Return the results of a scalar kernel for each element of the broadcast `arrays`; a float if all are scalars."""
    try:
        columns = np.broadcast_arrays(*arrays)
    except ValueError:
        raise ContactError(f"arguments of shapes {[a.shape for a in arrays]} do not broadcast") from None
    out = np.empty(columns[0].shape)
    for index in np.ndindex(out.shape):
        out[index] = kernel(*(float(column[index]) for column in columns), *constants)
    return out if out.ndim else float(out)
