"""Wear rate over T-gamma/A: the University of Sheffield's function (Lewis & Dwyer-Joyce 2004, Braghin et al. 2006)."""

from contact.core import entry
from contact.kernels.arrays import Numbers


@entry
def usfd_kernel(T_gamma: float, area: float, constants: Numbers) -> float:
    """Return the volume lost per contact area and metre rolled [m] for T-gamma [N] and contact area [m²]."""
    mild_slope, mild_limit, plateau, severe_limit, severe_slope, intercept, density = (
        constants[0],
        constants[1],
        constants[2],
        constants[3],
        constants[4],
        constants[5],
        constants[6],
    )
    intensity = 1e-6 * T_gamma / area  # N/mm²
    if intensity < mild_limit:
        rate = mild_slope * intensity
    elif intensity <= severe_limit:
        rate = plateau
    else:
        rate = severe_slope * intensity + intercept
    return 1e-3 * rate / density  # 1 µg/mm² = 1e-3 kg/m²
