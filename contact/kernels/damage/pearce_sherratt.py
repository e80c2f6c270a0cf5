"""Tread wear from T-gamma after Pearce & Sherratt 1991."""

from contact.core import entry
from contact.kernels.arrays import Numbers

_MM2_PER_KM = 1e-9  # [m² per m rolled]


@entry
def pearce_sherratt_kernel(T_gamma: float, diameter: float, constants: Numbers) -> float:
    """Return the area loss [m² per m rolled] for T-gamma [N] and wheel diameter [m]."""
    mild_slope, plateau, severe_slope, severe_offset, mild_limit, severe_from, floor = (
        constants[0],
        constants[1],
        constants[2],
        constants[3],
        constants[4],
        constants[5],
        constants[6],
    )
    if T_gamma < mild_limit:
        loss = mild_slope * T_gamma
    elif T_gamma <= severe_from:
        loss = plateau
    else:
        loss = max(floor, severe_slope * T_gamma - severe_offset)
    return _MM2_PER_KM * loss / (1e3 * diameter)
