"""The type of arrays of numbers, and the one way in which arrays that a user gives become such arrays."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError, real, require_number

Array = NDArray[np.float64]
#: Arrays of so many values are told in full.
_FEW = 6


def brief(record: Any) -> str:
    """Return a `__repr__` of a record: of long arrays only shape and range."""
    values = ((each.name, getattr(record, each.name)) for each in fields(record) if each.repr)
    return f"{type(record).__name__}({', '.join(f'{name}={_range(value)}' for name, value in values)})"


def _range(value: Any) -> str:
    if not isinstance(value, np.ndarray) or value.size <= _FEW or value.dtype.kind not in "iufb":
        return repr(value.tolist() if isinstance(value, np.ndarray) else value)
    return f"<{' × '.join(map(str, value.shape))}: {value.min():g} … {value.max():g}>"


def as_array(name: str, values: object) -> Array:
    """Return `values` as a new float64 array, which may have NaN.

    Raises
    ------
    ContactError
        For anything but real numbers: text, truth values, complex numbers, dates, what is missing, rows of unequal length; and
        for a masked value, of which numpy would take the number under the mask.
    """
    _require_present(name, values)
    try:
        raw = np.asarray(values)
        kind = raw.dtype.kind
        if kind == "O":
            numbers = [real(_placed(name, where), value) for where, value in np.ndenumerate(raw)]
            return np.array(numbers, dtype=np.float64).reshape(raw.shape)
        if kind in "iuf":
            return np.array(raw, dtype=np.float64, order="C")
        if raw.ndim == 0:
            real(name, values)
    except ContactError:
        raise
    except (TypeError, ValueError, OverflowError, RuntimeError):
        raise ContactError(f"{name} is not an array of numbers") from None
    raise ContactError(f"{name} is not an array of numbers, but of {raw.dtype}")


def require_numbers(
    name: str, values: object, minimum: float = -math.inf, maximum: float = math.inf, *, open_minimum: bool = False
) -> Array:
    """Return `values` as a new float64 array of finite numbers. Each is checked as by `contact.errors.require_number`.

    Raises
    ------
    ContactError
        As `as_array`, and for the first number outside the range, with its place.
    """
    array = as_array(name, values)
    finite = np.isfinite(array)
    known = np.where(
        finite, array, minimum if math.isfinite(minimum) else 0.0
    )  # NaN compared with a number may be a trap
    good = finite & (known > minimum if open_minimum else known >= minimum) & (known <= maximum)
    if not good.all():
        where = np.unravel_index(int(np.argmin(good)), array.shape)
        require_number(_placed(name, where), float(array[where]), minimum, maximum, open_minimum=open_minimum)
    return array


def require_aligned(**given: Any) -> None:
    """Raise a ContactError for arguments of xarray or pandas whose labels differ, since cases are paired by position."""
    for label in ("dims", "index"):
        labels = {name: getattr(value, label, ()) for name, value in given.items()}
        (first, expected), *others = [one for one in labels.items() if not callable(one[1]) and len(one[1])] or [
            ("", ())
        ]
        for name, own in others:
            n = min(len(own), len(expected)) if label == "dims" else max(len(own), len(expected))
            if list(own[-n:]) != list(expected[-n:]):
                raise ContactError(
                    f"{label} of {first} and {name} differ, but cases are paired by position; align them "
                    "(xarray.broadcast, DataFrame.align), or take their .values"
                )


def broadcast(arrays: Mapping[str, NDArray[Any]]) -> list[NDArray[Any]]:
    """Return arrays, given by name, with one shape.

    Raises
    ------
    ContactError
        If their shapes do not broadcast.
    """
    try:
        return list(np.broadcast_arrays(*arrays.values()))
    except ValueError:
        told = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise ContactError(f"shapes do not broadcast: {told}") from None


def connected(steps: NDArray[np.bool_], first: int) -> slice:
    """Return the range of points around one that true steps connect; step k leads from point k to the next one."""
    before, behind = np.flatnonzero(~steps[:first]), np.flatnonzero(~steps[first:])
    return slice(int(before[-1]) + 1 if before.size else 0, 1 + (first + int(behind[0]) if behind.size else steps.size))


def _placed(name: str, where: tuple[int | np.intp, ...]) -> str:
    """Return the name of an element of an array."""
    return f"{name}[{', '.join(map(str, where))}]" if where else name


def _require_present(name: str, values: object) -> None:
    """Raise a ContactError for a masked value, in an array, or in a list of arrays or numbers."""
    if isinstance(values, np.ma.MaskedArray):
        mask = np.ma.getmaskarray(values)
        if mask.any():
            where = np.unravel_index(int(np.argmax(mask)), mask.shape)
            raise ContactError(
                f"{_placed(name, where)} is masked; leave masked values out, for example by compressed()"
            )
    elif isinstance(values, list | tuple):
        for i, part in enumerate(values):
            if isinstance(part, list | tuple | np.ma.MaskedArray):
                _require_present(f"{name}[{i}]", part)
