"""`Jacobian`: derivatives of what a contact answers by what it is given."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError
from contact.notebook import table

_UNITS = {
    "Fx": "N",
    "Fy": "N",
    "Mz": "N m",
    "N": "N",
    "approach": "m",
    "power_per_metre": "N",
    "longitudinal": "1",
    "lateral": "1",
    "spin": "1/m",
    "load": "N",
    "friction": "1",
}


@dataclass(frozen=True, eq=False)
class Jacobian:
    """Derivatives of one contact, ``jacobian["Fx", "longitudinal"]``.

    Where a force has a kink, because a strip changes between stick and slip, they hold on the side of larger values. The
    columns of creepages and friction are exact but for about 1e-6 of themselves, that of the load or approach but for 1e-4.

    Attributes
    ----------
    values : ndarray, shape (6, 5)
        Derivatives in SI units, read-only.
    given : str
        Name of the fourth column: "load" or "approach".
    rows, columns : tuple of str
        What is derived, as in `Solution`, and by what: the three creepages, the load or approach, and the friction. A
        friction law changes as a whole, by the coefficient at rest.
    """

    values: NDArray[np.float64]
    given: str
    rows: ClassVar[tuple[str, ...]] = ("Fx", "Fy", "Mz", "N", "approach", "power_per_metre")

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return "longitudinal", "lateral", "spin", self.given, "friction"

    def __getitem__(self, of: tuple[str, str]) -> float:
        """Return the derivative of the first name by the second.

        Raises
        ------
        ContactError
            If there is no such row or column.
        """
        row, column = of
        if row not in self.rows or column not in self.columns:
            raise ContactError(
                f"jacobian[{row!r}, {column!r}]: rows are {', '.join(self.rows)}; columns are {', '.join(self.columns)}"
            )
        return float(self.values[self.rows.index(row), self.columns.index(column)])

    def __array__(self, dtype: object = None, copy: bool | None = None) -> NDArray[np.float64]:
        return np.array(self.values, dtype=dtype, copy=copy)  # type: ignore[call-overload]

    def __repr__(self) -> str:
        lines = [" ".join((f"{'d':16}", *(f"/d {name:>12}" for name in self.columns)))]
        for row, values in zip(self.rows, self.values, strict=True):
            lines.append(" ".join((f"{row:16}", *(f"{value:15.6g}" for value in values))))
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        headings = ("d of / by", *(f"{name} [{_UNITS.get(name, 'm')}]" for name in self.columns))
        rows = (
            (f"{row} [{_UNITS[row]}]", *(f"{value:.6g}" for value in values))
            for row, values in zip(self.rows, self.values, strict=True)
        )
        return table(headings, rows)
