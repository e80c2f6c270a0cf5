"""Energy index: T-gamma of every point of the patch (thesis Eq. 6.2; Dirks & Enblom)."""

from contact.core import entry


@entry
def energy_index_kernel(qx: float, qy: float, x: float, y: float, vx: float, vy: float, phi: float) -> float:
    """Return EI = -(qx (vx - phi y) + qy (vy + phi x)) [Pa]."""
    return -(qx * (vx - phi * y) + qy * (vy + phi * x))
