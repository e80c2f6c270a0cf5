"""Stress index: shear traction above the yield stress in shear (thesis Eq. 6.7; Dirks & Enblom)."""

from __future__ import annotations

from numpy.typing import ArrayLike

from contact.arrays import Array, require_numbers
from contact.damage._check import elementwise
from contact.kernels.damage.stress_index import stress_index_kernel


def stress_index(qx: ArrayLike, qy: ArrayLike, shear_yield: ArrayLike = 300e6) -> float | Array:
    """Return the stress index SI = √(qx² + qy²) - k [Pa]. A positive value predicts fatigue.

    Parameters
    ----------
    qx, qy : array_like
        Traction [Pa].
    shear_yield : array_like
        k [Pa], positive; see `fatigue_index`.

    Raises
    ------
    ContactError
        For values outside their range.

    Notes
    -----
    The limits and exponents of Dirks' crack-length model were not found (constants.md 11), so the function returns the
    index itself.
    """
    return elementwise(
        stress_index_kernel,
        require_numbers("qx", qx),
        require_numbers("qy", qy),
        require_numbers("shear_yield", shear_yield, 0.0, open_minimum=True),
    )
