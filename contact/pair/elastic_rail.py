"""A massless rail on springs under a wheel. `contact.kernels.elastic_rail` finds its deflection, `balanced` that under
a pair that Python solves (other_wheels.md).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from contact.errors import require_number
from contact.given_force import rising_root
from contact.pair.solution import PairSolution
from contact.results.solution import Status

#: For a pair that Python solves: reach of the search for a deflection [m], the shortest bracket [m], and the error of the
#: balance over the vertical force.
_REACH, _SHORTEST, _TOLERANCE = 0.03, 1e-9, 1e-4


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
            k = getattr(self, name)
            if not (isinstance(k, float) and math.isinf(k) and k > 0.0):  # NaN compared with a number would be a trap
                require_number(f"rail.{name}", k, 0.0, open_minimum=True)
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

    def record(self) -> tuple[float, ...]:
        """Return the numbers in the order of the record ELASTIC_RAIL, where a stiffness of 0 is rigid, before a solution."""
        ky, kz = (0.0 if k == math.inf else k for k in (self.ky, self.kz))
        return ky, kz, self.preload_y, self.preload_z, 0.0, 0.0, 0


def balanced(solve: Callable[[float, float], PairSolution], rail: ElasticRail, fixed: bool) -> PairSolution:
    """Return the solution on an elastic rail, of a pair that Python solves.

    Parameters
    ----------
    solve : callable
        Returns the solution for a deflection (dy, dz) of the rail [m].
    rail : ElasticRail
    fixed : bool
        The wheel's height is given. Else it follows from its load, so the force does not depend on dz.
    """
    dz, settled = 0.0, True

    def across(dy: float) -> PairSolution:
        nonlocal dz, settled
        settled = True
        if rail.kz == math.inf:
            return solve(dy, 0.0)
        found = solve(dy, dz)
        if not fixed:
            missed = rail.kz * dz + float(found.force[2]) - rail.preload_z
            if abs(missed) <= _TOLERANCE * abs(found.Q):
                return found
            dz -= missed / rail.kz
            return solve(dy, dz)
        by_z: dict[float, PairSolution] = {dz: found}

        def down(z: float) -> float:
            by_z[z] = by_z.get(z) or solve(dy, z)
            return _rest(rail.kz * z + float(by_z[z].force[2]) - rail.preload_z, by_z[z])

        root = rising_root(down, dz, rail.kz, (dz - _REACH, dz + _REACH), shortest=_SHORTEST)
        dz, settled = root.x, root.residual == 0.0
        return by_z[dz]

    if rail.ky == math.inf:
        found, dy = across(0.0), 0.0
    else:
        by_y: dict[float, PairSolution] = {}

        def aside(y: float) -> float:
            by_y[y] = across(y)
            return _rest(rail.ky * y + float(by_y[y].force[1]) - rail.preload_y, by_y[y])

        root = rising_root(aside, 0.0, rail.ky, (-_REACH, _REACH), shortest=_SHORTEST)
        dy, settled = root.x, settled and root.residual == 0.0
        found = by_y[dy]
    found = replace(found, deflection=(dy, dz))
    return found if settled else replace(found, status=Status.NOT_CONVERGED)


def _rest(left: float, found: PairSolution) -> float:
    """Return what is left of a balance [N], 0 within the tolerance."""
    return 0.0 if abs(left) <= _TOLERANCE * max(abs(found.Q), 1.0) else left
