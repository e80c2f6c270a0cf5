"""T-gamma and the indices of energy, surface fatigue and stress: formulas of forces, pressures and tractions."""

import math

from contact.core import entry


@entry
def t_gamma_kernel(Fx: float, Fy: float, Mz: float, vx: float, vy: float, phi: float) -> float:
    """Return |Fx vx| + |Fy vy| + |Mz phi| [N]. Mz = 0 gives thesis Eq. 6.1."""
    return abs(Fx * vx) + abs(Fy * vy) + abs(Mz * phi)


@entry
def energy_index_kernel(qx: float, qy: float, x: float, y: float, vx: float, vy: float, phi: float) -> float:
    """Return EI = -(qx (vx - phi y) + qy (vy + phi x)) [Pa] (thesis Eq. 6.2; Dirks & Enblom)."""
    return -(qx * (vx - phi * y) + qy * (vy + phi * x))


@entry
def fatigue_index_kernel(utilisation: float, max_pressure: float, shear_yield: float) -> float:
    """Return FI_surf = utilisation - k/p0 [-] (thesis Eq. 6.6; Ekberg, Kabo & Andersson 2002)."""
    return utilisation - shear_yield / max_pressure


@entry
def stress_index_kernel(qx: float, qy: float, shear_yield: float) -> float:
    """Return SI = √(qx² + qy²) - k [Pa] (thesis Eq. 6.7; Dirks & Enblom)."""
    return math.sqrt(qx * qx + qy * qy) - shear_yield
