"""Errors of a solution against the reference, as defined in docs/check/accuracy.md."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import as_array
from contact.results import Solution


@dataclass(frozen=True, slots=True)
class Errors:
    """Errors of one solution against another [-].

    Attributes
    ----------
    force : |F/(mu N) - F_ref/(mu N_ref)|; each force is divided by mu times its own N
    moment : |Mz/(mu N) - Mz_ref/(mu N_ref)|/√(area_ref/π)
    N, approach, max_pressure, area : signed errors relative to the reference; the approach is measured from first touch
    pressure : ‖p - p_ref‖/‖p_ref‖ over the elements of the reference
    """

    force: float
    moment: float
    N: float
    approach: float
    max_pressure: float
    area: float
    pressure: float


def errors_against(true: Solution, s: Solution, touch: float = 0.0) -> Errors | None:
    """Return the errors of `s` against the reference `true`; None if one of them has no contact.

    `touch` is the approach at which the bodies first touch [m]. The error of the approach is relative to it.
    """
    if not (true.N > 0.0 and s.N > 0.0):
        return None
    mu = true.friction
    limit, true_limit = ((mu * x.N if mu > 0.0 else math.inf) for x in (s, true))  # inf: no force without friction
    arm = math.sqrt(true.area / math.pi)
    p = s.pressure(true.x, true.y)
    return Errors(
        force=math.hypot(s.Fx / limit - true.Fx / true_limit, s.Fy / limit - true.Fy / true_limit),
        moment=abs(s.Mz / limit - true.Mz / true_limit) / arm,
        N=s.N / true.N - 1.0,
        approach=(s.approach - touch) / (true.approach - touch) - 1.0,
        max_pressure=s.max_pressure / true.max_pressure - 1.0,
        area=s.area / true.area - 1.0,
        pressure=float(np.linalg.norm(p - true.p) / np.linalg.norm(true.p)),
    )


def mean_p95_max(values: ArrayLike) -> tuple[float, float, float]:
    """Return mean, 95th percentile and maximum of the absolute values."""
    size = np.abs(as_array("values", values))
    return float(size.mean()), float(np.percentile(size, 95)), float(size.max())
