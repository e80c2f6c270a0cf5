"""What the steps of a contact leave behind on its elements."""

from __future__ import annotations

from dataclasses import dataclass

from contact.arrays import Array


@dataclass
class State:
    """What a step leaves behind on the elements.

    Attributes
    ----------
    traction : on the wheel [Pa], shape (2, ny, nx)
    p : pressure [Pa]
    mu : coefficient of friction [-]
    tau : yield stress of the layer [Pa]
    shear : plastic shear of the layer, wheel against rail [m], shape (2, ny, nx)
    """

    traction: Array
    p: Array
    mu: Array
    tau: Array
    shear: Array

    def placed(self, fresh: State, rows: int, columns: int) -> State:
        """Return the state on another grid, which lies `rows` and `columns` further; elsewhere it is `fresh`."""
        names = ("traction", "p", "mu", "tau", "shear")
        return State(*(_placed(getattr(self, name), getattr(fresh, name), rows, columns) for name in names))


def _placed(field: Array, fresh: Array, rows: int, columns: int) -> Array:
    new = fresh.copy()
    ny, nx = new.shape[-2:]
    oy, ox = field.shape[-2:]
    low, high = max(rows, 0), min(rows + ny, oy)
    left, right = max(columns, 0), min(columns + nx, ox)
    if low < high and left < right:
        new[..., low - rows : high - rows, left - columns : right - columns] = field[..., low:high, left:right]
    return new
