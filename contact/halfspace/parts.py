"""Parts of a patch whose pressures act on each other with less than the half space's influence."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.halfspace.influence import Influence
from contact.halfspace.norm import ALL, Ground, Normal, from_coarser, in_window, stiffness
from contact.inputs.material import Material


class Parts(NamedTuple):
    """Rows of a grid in parts.

    Attributes
    ----------
    of_row : ndarray of int, shape (ny,)
        Number of the part of each row, from 0.
    factor : ndarray, shape (n, n)
        Share of the displacement that the pressure of part j has in part i; 1 on the diagonal, symmetric.
    """

    of_row: NDArray[np.int64]
    factor: Array


def norm_of_parts(
    gap: Array,
    dx: float,
    dy: float,
    material: Material,
    *,
    approach: float,
    parts: Parts,
    tolerance: float = 1e-5,
    start: Array | None = None,
) -> Normal:
    """Solve the normal problem, as `contact.halfspace.norm` does, of parts that act on each other in shares."""
    if approach <= gap.min():
        return Normal(np.zeros(gap.shape), approach, 0.0, 0, True)
    ground = _Parted(dx, dy, material, parts=parts)
    if start is None:
        start = from_coarser(gap, Ground(dx, dy, material), approach)
    p, iterations, converged = in_window(gap - approach, ground, start, tolerance)
    return Normal(p, approach, float(stiffness(p, ground).sum()) * ground.element, iterations, converged)


@dataclass(frozen=True, slots=True)
class _Parted(Ground):
    """The plane half space in parts."""

    parts: Parts | None = None

    def under(self, shape: tuple[int, ...], rows: slice = ALL) -> Influence:
        """Return the influence numbers of a grid of `shape`, whose rows are these."""
        assert self.parts is not None
        parts = self.parts._replace(of_row=self.parts.of_row[rows])
        return _Influence(shape, self.dx, self.dy, self.material, parts)


class _Influence(Influence):
    """The normal problem of a half space whose parts act on each other in shares."""

    def __init__(self, shape: tuple[int, ...], dx: float, dy: float, material: Material, parts: Parts) -> None:
        super().__init__(shape, dx, dy, material)
        self._parts = parts

    def normal(self, p: Array) -> Array:
        """Return the displacement [m] from the pressure `p` [Pa]."""
        of_row, factor = self._parts
        found = np.zeros_like(p)
        for j in range(factor.shape[0]):
            found += factor[of_row, j, None] * super().normal(p * (of_row == j)[:, None])
        return found
