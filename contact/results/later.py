"""Results that copy a kernel's arrays at once and make their attributes of them when one is first read."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from contact.kernels.enumerations import Status
from contact.view.tables import Tabular

#: Value of the member `status` → the status.
STATES = {int(status): status for status in Status}
#: Member of the records RESULT and TOTAL → attribute of a solution, for the numbers that are called otherwise.
RENAMED = {"pmax": "max_pressure", "power": "power_per_metre", "stiffness": "normal_stiffness"}


def arrays_of(kind: Any, records: NDArray[np.void], shape: tuple[int, ...]) -> dict[str, NDArray[Any]]:
    """Return the members of records of which `kind`, a dataclass, has attributes: attribute → array of this shape."""
    names = {RENAMED.get(member, member): member for member in records.dtype.names or ()}
    return {
        name: np.ascontiguousarray(records[member]).reshape(shape)
        for name, member in names.items()
        if name in kind.__dataclass_fields__
    }


def reader(dtype: np.dtype) -> struct.Struct:
    """Return what reads a record as numbers of Python, members that are arrays too: numpy takes 2 µs for each member."""

    def letter(kind: np.dtype) -> str:
        return f"{kind.itemsize // 8}{'d' if kind.base.kind == 'f' else 'q'}"

    return struct.Struct("".join(letter(dtype[name]) for name in dtype.names or ()))


class MadeLater(Tabular):
    """Base of solutions: dataclasses whose attributes are made from copies of arrays when one of them is first read."""

    @classmethod
    def later(cls, numbers: dict[str, Any], make: Callable[..., dict[str, Any]], *left: Any) -> Self:
        """Return a solution with these attributes. `make` returns all other ones from what is left, when one is first read."""
        solution = cls.__new__(cls)
        solution.__dict__.update(numbers, _left=(make, left))
        return solution

    def __getattr__(self, name: str) -> Any:
        held = self.__dict__
        later = held.get("_left")
        if later is not None:
            make, left = later
            held.update(make(*left))
            held.pop("_left", None)  # last, because another thread may read the solution too
        if name not in held:
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        return held[name]

    def __dir__(self) -> list[str]:
        """Return all names, those too that are made when they are first read."""
        return sorted({*super().__dir__(), *self.__dataclass_fields__} - {"_left"})

    def __getstate__(self) -> dict[str, Any]:
        """Return all attributes, for a copy or a pickle."""
        if "_left" in self.__dict__:
            self.__getattr__("status")
        return dict(self.__dict__)

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
