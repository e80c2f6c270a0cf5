"""Quasi-static curving and the nonlinear critical speed."""

import pytest

from contact.geometry import profile
from contact_models.vehicle import curving, hunting, linear
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.layout import Sum
from contact_models.vehicle.track import Curve, Track
from tests.vehicle.parts import FAST, PACED, simulation

PROFILES = profile.s1002(), profile.rail_60e1()


def test_steady_curving_is_the_equilibrium():
    """Time response after a second and a half in the circle against Newton's method: forces within 2 % of the wheel load."""
    found = curving.in_curve(read("manchester"), PROFILES, 600.0, speed=25.0, cant=0.1, options=FAST)
    track = Track(curves=(Curve(start=5.0, radius=600.0, length=400.0, transition=40.0, cant=0.1),))
    sim = simulation("manchester", track, speed=25.0, length=300.0, options=PACED)
    sim.advance(4e-4, 8000)
    sim.state.sums[:] = 0.0
    sim.advance(4e-4, 2500)
    for name, column in (("lateral", Sum.LATERAL), ("vertical", Sum.VERTICAL)):
        mean = sim.state.sums[:, column] / sim.state.sums[:, Sum.STEPS]
        assert mean == pytest.approx(found.wheels[name], abs=0.02 * 54.5e3)
    assert found.wheels["lateral"][1] == pytest.approx(13e3, rel=0.1)  # outer wheel of the leading axle


def test_the_limit_cycle_of_a_wheelset_lasts_below_the_linear_critical_speed():
    """S1002 on 60E1: between the flanges the wheelset hunts on at speeds at which small motions already decay."""

    def at_speed(speed: float):
        return simulation("wheelset", speed=speed)

    found = hunting.fall(read("wheelset"), PROFILES, (8.0, 40.0), deceleration=3.0, threshold=4e-3, options=PACED)
    small = linear.critical_speed(at_speed, bounds=(10.0, 60.0))
    assert found.amplitude[:4].max() > 6e-3
    assert found.amplitude[-1] < 3e-3
    assert 10.0 < found.critical < 0.95 * small
