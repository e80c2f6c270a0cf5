"""Conditions that hold for every solution."""

import math

import numpy as np
import pytest

import contact

FIELDS = ("x", "y", "p", "qx", "qy", "sx", "sy", "stick", "dA")
LIMIT = 1 + 1e-9


def assert_post_conditions(sol: contact.Solution) -> None:
    """Assert |F| ≤ μN, p ≥ 0, ∫p dA = N, |q| ≤ μp, dissipation ≥ 0 and finite numbers."""
    method = contact.methods().tangential[sol.tangential]
    for name in FIELDS if method.fields else ("x", "y", "p", "dA"):
        assert np.isfinite(getattr(sol, name)).all(), name
    for name in ("Fx", "Fy", "Mz", "N", "approach", "max_pressure", "area", "power_per_metre", "slip_ratio"):
        assert math.isfinite(getattr(sol, name)), name
    assert (sol.p >= 0).all()
    assert (sol.p * sol.dA).sum() == pytest.approx(sol.N, rel=1e-9, abs=1e-9), "Σ p dA = N"
    if method.saturates:
        assert math.hypot(sol.Fx, sol.Fy) <= sol.friction * sol.N * LIMIT + 1e-12, "|F| ≤ μN"
    assert sol.power_per_metre >= 0, "dissipation"
    if method.fields and method.admissible:
        assert (np.hypot(sol.qx, sol.qy) <= sol.friction * sol.p * LIMIT + 1e-6).all(), "|q| ≤ μp"
        assert -(sol.qx * sol.sx + sol.qy * sol.sy).min(initial=0.0) >= -1e-9
    assert -1e-12 <= sol.slip_ratio <= 1 + 2e-3
