"""A massless rail on springs under a wheel. `contact.kernels.elastic_rail` finds its deflection (other_wheels.md)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from contact.errors import require_number


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

    def record(self) -> tuple[float, float, float, float]:
        """Return ky, kz, preload_y, preload_z as the kernel uses them: 0 is rigid."""
        ky, kz = (0.0 if k == math.inf else k for k in (self.ky, self.kz))
        return ky, kz, self.preload_y, self.preload_z
