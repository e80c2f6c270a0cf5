"""Shared cases: one wheel-rail-like ellipse and what surrounds it."""

import pytest

import contact


@pytest.fixture(scope="session")
def ellipse() -> contact.Separation:
    """Wheel radius 0.5 m on a rail head of 0.25 m: A = 1 1/m, B = 2 1/m."""
    return contact.Separation.hertzian(1.0, 2.0)
