"""Steps of the creepages for difference quotients."""

import math


def creepage_steps(mu: float, N: float, G: float, area: float) -> tuple[float, float, float]:
    """Return the steps of longitudinal [-], lateral [-] and spin creepage [1/m] for difference quotients.

    A step is a millionth of mu N/(G area), as in `contact.kernels.jacobian`. Linear theory reaches mu N at mu N/(G a b C);
    C is about 4 and a b = area/π. The step of the spin is this divided by the size of the patch. Without contact or friction
    the forces are zero and any step is right.
    """
    if mu * N == 0.0 or area == 0.0:
        return 1e-9, 1e-9, 1e-6
    creepage = 1e-6 * mu * N / (G * area)
    return creepage, creepage, creepage / math.sqrt(area / math.pi)
