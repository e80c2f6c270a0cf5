"""T-gamma: force times creepage, the global energy measure (thesis Eq. 6.1)."""

from contact.core import entry


@entry
def t_gamma_kernel(Fx: float, Fy: float, Mz: float, vx: float, vy: float, phi: float) -> float:
    """Return |Fx vx| + |Fy vy| + |Mz phi| [N]. Mz = 0 gives thesis Eq. 6.1."""
    return abs(Fx * vx) + abs(Fy * vy) + abs(Mz * phi)
