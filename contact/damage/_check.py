"""Helpers of the damage models' public functions: check the arrays, and call a kernel for each element."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array
from contact.errors import ContactError, require_number


def numbers(name: str, values: ArrayLike, minimum: float = -math.inf, *, open_minimum: bool = False) -> Array:
    """Return `values` as a float64 array. Every element is checked as by `contact.errors.require_number`."""
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise ContactError(f"{name} = {values!r} is not a number or an array of numbers") from None
    if array.ndim == 0:
        require_number(name, array, minimum, open_minimum=open_minimum)
        return array
    finite = np.isfinite(array)
    known = np.where(finite, array, 0.0)  # NaN is not compared, which would be a floating-point trap
    good = finite & (known > minimum if open_minimum else known >= minimum)
    if not good.all():
        index = np.unravel_index(np.argmin(good), array.shape)
        where = ", ".join(map(str, index))
        require_number(f"{name}[{where}]", array[index], minimum, open_minimum=open_minimum)
    return array


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
