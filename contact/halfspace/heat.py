"""Friction that falls with the temperature, on a grid of equal elements (theory.md 8.5)."""

import math

from contact.core import entry
from contact.kernels.arrays import Case, Matrix
from contact.kernels.friction import heating, of_heat


@entry
def heat_up(case: Case, flux: Matrix, dx: float, coefficients: Matrix) -> None:
    """Reduce the `coefficients` of friction, shape (ny, nx) over increasing x, by the flash temperature.

    On entry `flux` is p |s|/V [Pa]; on return it is the heat with the reduced coefficients. Each row is marched from its
    leading edge, x = max. An element is heated by itself and by all elements ahead of it.
    """
    ny, nx = coefficients.shape
    for i in range(ny):
        for k in range(nx - 1, -1, -1):
            warm = 0.0
            for j in range(k + 1, nx):
                weight = 2.0 * (math.sqrt(j - k + 0.5) - math.sqrt(j - k - 0.5))
                warm += weight * flux[i, j]
            warming = heating(case, dx, flux[i, k])
            coefficients[i, k] = of_heat(case, coefficients[i, k], warm, math.sqrt(2.0) * warming)
            flux[i, k] = coefficients[i, k] * warming
