"""A massless rail on springs under a wheel: its deflection balances the contact force (elastic_rail.md).

    k_y dy = F_y + P_y,   k_z dz = F_z + P_z,

with the contact force F on the rail and an external force P on it, in track coordinates. The rail moves before the contact
search.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from contact.errors import require_number
from contact.geometry.records import Irregularity
from contact.rising_root import rising_root

if TYPE_CHECKING:
    from contact.pair import PairSolution

#: Reach of the search for a deflection beyond where it starts [m], the shortest bracket [m], and the largest error of the
#: balance over the vertical force. The force of a warm pair repeats to about this.
_REACH, _SHORTEST, _TOLERANCE = 0.03, 1e-12, 2e-5


@dataclass(frozen=True, slots=True)
class ElasticRail:
    """Springs under one rail, and an external force on it.

    Parameters
    ----------
    ky, kz : float
        Lateral and vertical stiffness [N/m], positive; infinite is rigid.
    preload_y, preload_z : float
        External force on the rail [N], to the right and down.

    Raises
    ------
    ContactError
        For a number outside its range.
    """

    ky: float = math.inf
    kz: float = math.inf
    preload_y: float = 0.0
    preload_z: float = 0.0

    def __post_init__(self) -> None:
        for name in ("ky", "kz"):
            if getattr(self, name) != math.inf:
                require_number(f"rail.{name}", getattr(self, name), 0.0, open_minimum=True)
        for name in ("preload_y", "preload_z"):
            require_number(f"rail.{name}", getattr(self, name))

    def damped(self, cy: float, cz: float, step: float, last: tuple[float, float]) -> ElasticRail:
        """Return the springs that stand for springs and dampers in an implicit step.

        `cy`, `cz` are damping constants [N s/m] ≥ 0, `step` is the time step [s] and `last` the deflection (dy, dz) [m]
        before it. The rate of the deflection is then (new - last)/step; give it to the irregularity, so that creepages
        contain it.
        """
        step = require_number("step", step, 0.0, open_minimum=True)
        cy, cz = (require_number(name, c, 0.0) for name, c in (("cy", cy), ("cz", cz)))
        forces = self.preload_y + cy / step * last[0], self.preload_z + cz / step * last[1]
        return ElasticRail(self.ky + cy / step, self.kz + cz / step, *forces)


class Settled:
    """A rail in balance under a wheel.

    Parameters
    ----------
    rail : ElasticRail
    solve : callable
        Returns the solution of the pair for a displacement of the rail.
    irregularity : Irregularity
        Displacement of the unloaded rail.
    free_height : bool
        The wheel's height follows from its load, so dz does not change the forces.
    start : (dy, dz)
        Deflection to start from [m]. Where several deflections are in balance, it decides.

    Attributes
    ----------
    solution : PairSolution
    given : displacement of the unloaded rail
    dy, dz : deflection [m]
    balanced : False if the force jumps and no deflection is in balance
    """

    def __init__(
        self,
        rail: ElasticRail,
        solve: Callable[[Irregularity], PairSolution],
        irregularity: Irregularity,
        *,
        free_height: bool,
        start: tuple[float, float],
    ) -> None:
        self._rail, self._solve, self.given, self._free = rail, solve, irregularity, free_height
        self.dy, self.dz = start
        self.balanced = True
        self.solution: PairSolution
        if rail.ky == math.inf:
            self.dy = 0.0
            self._settle_height()
        else:
            self.balanced = self._root(self._lateral, self.dy, rail.ky) and self.balanced

    def _lateral(self, dy: float) -> float:
        """Return what is left of the lateral balance [N] at the deflection `dy`, with the vertical one in balance."""
        self.dy = dy
        self._settle_height()
        return self._left(self._rail.ky * dy + float(self.solution.force[1]) - self._rail.preload_y)

    def _vertical(self, dz: float) -> float:
        """Return what is left of the vertical balance [N] at the deflection `dz`."""
        self.dz = dz
        self.solution = self._solve(replace(self.given, y=self.given.y + self.dy, z=self.given.z + dz))
        return self._left(self._rail.kz * dz + float(self.solution.force[2]) - self._rail.preload_z)

    def _settle_height(self) -> None:
        """Solve with the vertical deflection in balance."""
        if self._rail.kz == math.inf:
            self._vertical_rigid()
        elif self._free:
            left = self._vertical(self.dz)
            if left != 0.0:  # the force does not depend on dz
                self._vertical(self.dz - left / self._rail.kz)
        else:
            self.balanced = self._root(self._vertical, self.dz, self._rail.kz)

    def _vertical_rigid(self) -> None:
        self.dz = 0.0
        self.solution = self._solve(replace(self.given, y=self.given.y + self.dy))

    def _root(self, left: Callable[[float], float], start: float, stiffness: float) -> bool:
        ends = start - _REACH, start + _REACH
        return rising_root(left, start, stiffness, ends, shortest=_SHORTEST).residual == 0.0

    def _left(self, residual: float) -> float:
        """Return the residual [N], or 0.0 if it is within the tolerance."""
        return 0.0 if abs(residual) <= _TOLERANCE * max(abs(float(self.solution.Q)), 1.0) else residual
