"""Surface fatigue index of the shakedown map (thesis Eq. 6.6; Ekberg, Kabo & Andersson 2002)."""

from contact.core import entry


@entry
def fatigue_index_kernel(utilisation: float, max_pressure: float, shear_yield: float) -> float:
    """Return FI_surf = utilisation - k/p0 [-]."""
    return utilisation - shear_yield / max_pressure
