"""Rolling-contact-fatigue index of rails from T-gamma: Burstow's whole life rail model."""

from contact.core import entry
from contact.kernels.arrays import Numbers


@entry
def burstow_kernel(T_gamma: float, constants: Numbers) -> float:
    """Return the damage per axle pass [-] for T-gamma [N]."""
    threshold, peak_at, zero_at, peak, floor = constants[0], constants[1], constants[2], constants[3], constants[4]
    if T_gamma <= threshold:
        return 0.0
    if T_gamma <= peak_at:
        return peak * (T_gamma - threshold) / (peak_at - threshold)
    return max(floor, peak * (zero_at - T_gamma) / (zero_at - peak_at))
