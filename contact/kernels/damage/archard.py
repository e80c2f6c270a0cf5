"""Archard's sliding wear with the KTH map of wear coefficients (thesis Eqs. 6.3-6.4; Jendel 2002)."""

from contact.core import entry, kernel
from contact.kernels.arrays import Numbers


@entry
def wear_coefficient_kernel(velocity: float, pressure: float, hardness: float, constants: Numbers) -> float:
    """Return Archard's coefficient k [-] for a sliding velocity [m/s], pressure and hardness [Pa]."""
    mild, severe, mild_fast, seizure = constants[0], constants[1], constants[2], constants[3]
    k = severe if velocity <= constants[5] else mild_fast  # selections instead of branches, for vector instructions
    k = mild if velocity < constants[4] else k
    return seizure if pressure > constants[6] * hardness else k


@kernel
def depth_times_hardness(slip, pressure, dx, speed, hardness, constants):
    """Return k p Δs [Pa m] with Δs = slip·dx (Eq. 6.4).

    Divided by the hardness it is the depth that a particle loses on its way dx [m]. `slip` is the sliding velocity
    divided by the rolling speed V. A particle passes dx in the time dx/V and slides slip·V·dx/V.
    """
    k = wear_coefficient_kernel(slip * speed, pressure, hardness, constants)
    return k * pressure * slip * dx
