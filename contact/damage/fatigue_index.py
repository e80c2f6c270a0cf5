"""Surface fatigue index of the shakedown map (thesis Eq. 6.6; Ekberg, Kabo & Andersson 2002)."""

from __future__ import annotations

from numpy.typing import ArrayLike

from contact.arrays import Array, require_numbers
from contact.damage._check import elementwise
from contact.kernels.damage.fatigue_index import fatigue_index_kernel


def fatigue_index(utilisation: ArrayLike, max_pressure: ArrayLike, shear_yield: ArrayLike = 300e6) -> float | Array:
    """Return FI_surf = √(Fx² + Fy²)/N - k/p0 [-]. A positive value predicts surface fatigue.

    The formula uses the peak pressure, the ordinate of the shakedown map, because a non-elliptic patch has no semi-axes. On
    an ellipse it equals the thesis' form with 2πabk/(3N).

    Parameters
    ----------
    utilisation : array_like
        Utilised friction √(Fx² + Fy²)/N [-], not negative.
    max_pressure : array_like
        p0 [Pa], positive.
    shear_yield : array_like
        k [Pa], positive. For R260 it is 211 MPa at first plasticity and 288 MPa at high plastic work [1] (Meyer et al.
        2020). About 300 MPa is commonly used [R] (constants.md 5).

    Raises
    ------
    ContactError
        For values outside their range.
    """
    return elementwise(
        fatigue_index_kernel,
        require_numbers("utilisation", utilisation, 0.0),
        require_numbers("max_pressure", max_pressure, 0.0, open_minimum=True),
        require_numbers("shear_yield", shear_yield, 0.0, open_minimum=True),
    )
