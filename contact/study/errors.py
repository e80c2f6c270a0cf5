"""How far a solution is from the reference, defined as in docs/accuracy.md."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contact.solution import Solution


@dataclass(frozen=True, slots=True)
class Errors:
    """Errors of one solution against another.

    Attributes
    ----------
    force : |F/(mu N) - F_ref/(mu N_ref)|, each force over its own mu N [-]
    moment : the same of Mz over mu N √(area_ref/π) [-]
    N, approach (from first touch), max_pressure, area : relative to the reference [-], signed
    pressure : ‖p - p_ref‖/‖p_ref‖ over the elements of the reference [-]
    """

    force: float
    moment: float
    N: float
    approach: float
    max_pressure: float
    area: float
    pressure: float


def errors_against(true: Solution, s: Solution, touch: float = 0.0) -> Errors | None:
    """Errors of `s` against the reference `true`; None where one of them has no contact.

    `touch` is the approach at which the bodies first touch, from which approaches are counted here.
    """
    if not (true.N > 0.0 and s.N > 0.0):
        return None
    mu = true.friction
    own, full = ((mu * x.N if mu > 0.0 else math.inf) for x in (s, true))  # without friction there is no force
    arm = math.sqrt(true.area / math.pi)
    p = s.pressure(true.x, true.y)
    return Errors(
        force=math.hypot(s.Fx / own - true.Fx / full, s.Fy / own - true.Fy / full),
        moment=abs(s.Mz / own - true.Mz / full) / arm,
        N=s.N / true.N - 1.0,
        approach=(s.approach - touch) / (true.approach - touch) - 1.0,
        max_pressure=s.max_pressure / true.max_pressure - 1.0,
        area=s.area / true.area - 1.0,
        pressure=float(np.linalg.norm(p - true.p) / np.linalg.norm(true.p)),
    )


def mean_p95_max(values: ArrayLike) -> tuple[float, float, float]:
    """Mean, 95th percentile and maximum of the absolute values."""
    size = np.abs(np.asarray(values, dtype=np.float64))
    return float(size.mean()), float(np.percentile(size, 95)), float(size.max())
