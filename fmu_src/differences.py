"""How far creepages are moved for difference quotients; both packagings take them with these steps."""

import math


def creepage_steps(mu: float, N: float, G: float, area: float) -> tuple[float, float, float]:
    """Steps of a thousandth of the creepages and the spin at which linear theory reaches mu N: mu N/(G a b C).

    C is about 4, so with a b = area/π about mu N/(G area); spin counts by the size of the patch. Without contact or
    friction any step is right, the forces are zero.
    """
    if mu * N == 0.0 or area == 0.0:
        return 1e-6, 1e-6, 1e-3
    creepage = 1e-3 * mu * N / (G * area)
    return creepage, creepage, creepage / math.sqrt(area / math.pi)
