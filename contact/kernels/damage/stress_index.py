"""Stress index: shear traction above the yield stress in shear (thesis Eq. 6.7; Dirks & Enblom)."""

import math

from contact.core import entry


@entry
def stress_index_kernel(qx: float, qy: float, shear_yield: float) -> float:
    """Return SI = √(qx² + qy²) - k [Pa]."""
    return math.sqrt(qx * qx + qy * qy) - shear_yield
