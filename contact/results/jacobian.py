"""`Jacobian`: derivatives of what a contact answers by what it is given."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError
from contact.inputs.options import MOTION
from contact.kernels.records import GIVEN, unit_of
from contact.view.notebook import table
from contact.view.units import UNITS

_UNITS = {**UNITS, **{n: unit_of(f"given.{member}") for n, member in zip(MOTION, GIVEN.names or (), strict=True)}}


@dataclass(frozen=True, eq=False)
class _Labelled:
    """A matrix of derivatives whose rows and columns have names."""

    values: NDArray[np.float64]
    rows: ClassVar[tuple[str, ...]]

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        raise NotImplementedError

    def __getitem__(self, of: tuple[str, str]) -> Any:
        """Return the derivative of the first name by the second; an array of them for arrays of cases.

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
        found = self.values[..., self.rows.index(row), self.columns.index(column)]
        return found if found.ndim else float(found)

    def __array__(self, dtype: object = None, copy: bool | None = None) -> NDArray[np.float64]:
        return np.array(self.values, dtype=dtype, copy=copy)  # type: ignore[call-overload]

    def __repr__(self) -> str:
        if self.values.ndim > 2:
            return f"derivatives of {', '.join(self.rows)} by {', '.join(self.columns)}, shape {self.values.shape}"
        width = max(12, *(len(name) for name in self.columns))
        lines = [" ".join((f"{'d':16}", *(f"/d {name:>{width}}" for name in self.columns)))]
        for row, values in zip(self.rows, self.values, strict=True):
            lines.append(" ".join((f"{row:16}", *(f"{value:{width + 3}.6g}" for value in values))))
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        if self.values.ndim > 2:
            return repr(self)
        headings = ("d of / by", *(f"{name} [{_UNITS[name]}]" for name in self.columns))
        rows = (
            (f"{row} [{_UNITS[row]}]", *(f"{value:.6g}" for value in values))
            for row, values in zip(self.rows, self.values, strict=True)
        )
        return table(headings, rows)


@dataclass(frozen=True, eq=False, repr=False)
class Jacobian(_Labelled):
    """Derivatives of one contact, or of an array of contacts, ``jacobian["Fx", "longitudinal"]``.

    Where a force has a kink, because a strip changes between stick and slip, they hold on the side of larger values. The
    columns of creepages and friction are exact but for about 1e-6 of themselves, that of the load or approach but for 1e-3.

    Attributes
    ----------
    values : ndarray, shape (6, 5), or (…, 6, 5) of arrays of cases
        Derivatives in SI units, read-only.
    given : str
        Name of the fourth column: "load" or "approach".
    rows, columns : tuple of str
        What is derived, as in `Solution`, and by what: the three creepages, the load or approach, and the friction. A
        friction law changes as a whole, by the coefficient at rest.
    """

    given: str
    rows = ("Fx", "Fy", "Mz", "N", "approach", "power_per_metre")

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return "longitudinal", "lateral", "spin", self.given, "friction"


@dataclass(frozen=True, eq=False, repr=False)
class PairJacobian(_Labelled):
    """Derivatives of what a rail does to a wheelset, ``jacobian["Fy", "pose.yaw"]``.

    Every column is a partial derivative: the other arguments stay, an angular velocity that was left out too
    (`velocity.spin` = -forward/radius). Under a load or on springs, height and deflection follow.

    Attributes
    ----------
    values : ndarray
        Derivatives in SI units, read-only.
    given : str or None
        What prescribes the height and has a column: "load", "penetration" or "vertical".
    one_sided : tuple of str
        Columns in whose step a patch comes or goes. There the derivative is that on the other side or, where one comes or
        goes on both sides, the slope of the force over the step. All columns, if the force does not rise with the depth, so
        that the height is not determined.
    rows, columns : tuple of str
        What is derived, as in `PairSolution` (force, moment, z), and by what: the members of pose, velocity and irregularity,
        the amount that is given, and the friction. A friction law changes as a whole.
    """

    given: str | None
    one_sided: tuple[str, ...] = ()
    rows = ("Fx", "Fy", "Fz", "Mx", "My", "Mz", "z")

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return columns_of_pair(self.given)


def columns_of_pair(given: str | None) -> tuple[str, ...]:
    """Return the names of the columns of a pair's jacobian."""
    return (*MOTION, *((given,) if given else ()), "friction")
