"""Friction that falls with the temperature, on a grid of equal elements (theory.md 8.5)."""

import math

from contact._jit import kernel
from contact.kernels.friction import heating, of_heat


@kernel
def heat_up(case, flux, dx, coefficients):
    """Let the `coefficients`, shape (ny, nx) over increasing x, fall with the temperature by their own friction.

    `flux` is p |s|/V [Pa], overwritten with the heat that is left; a row is heated from its leading edge, x = max, on, each
    element by all ahead and by itself.
    """
    ny, nx = coefficients.shape
    for i in range(ny):
        for k in range(nx - 1, -1, -1):
            warm = 0.0
            for j in range(k + 1, nx):
                weight = 2.0 * (math.sqrt(j - k + 0.5) - math.sqrt(j - k - 0.5))
                warm += weight * flux[i, j]
            own = heating(case, dx, flux[i, k])
            coefficients[i, k] = of_heat(case, coefficients[i, k], warm, math.sqrt(2.0) * own)
            flux[i, k] = coefficients[i, k] * own
