"""Damage on a bent surface: each strip has its own rigid slip, and areas are measured along the surface."""

import numpy as np
import pytest

import contact
from contact import damage
from contact.accumulation import Histogram
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from contact.kernels.conformal import surface_at

Y = np.linspace(-15e-3, 15e-3, 121)
SEPARATION = contact.Separation(Y, 2.0 * Y**2, 1.1, 0.02 * Y, 60.0 * Y, 1.0 / 0.46)
CREEPAGE = contact.Creepage(2e-3, -1e-3, 0.3)


METHODS = {
    "analyn": contact.THESIS,
    "default": {},
    "halfspace": {"normal": "halfspace", "tangential": "halfspace", "n_strips": 30, "n_elements": 30},
}
#: How far the index over the surface may be from the power. The half space with 30 x 30 elements dissipates much at the edges
#: (.14).
MISFIT = {"analyn": 0.02, "default": 0.02, "halfspace": 0.2}


@pytest.fixture(scope="module", params=METHODS)
def solution(request):
    return contact.solve(SEPARATION, CREEPAGE, load=8e4, conformal=True, **METHODS[request.param])


def test_the_energy_index_is_traction_times_the_rigid_slip_on_the_surface(solution):
    found = damage.evaluate(solution).energy_index
    kappa, origin = SEPARATION.rolling, surface_at(Y, SEPARATION.tilt, 0.0)[1]
    for i, y in enumerate(solution.strips.y):
        slope, height = surface_at(Y, SEPARATION.tilt, y)
        cosine = 1.0 / np.hypot(1.0, slope)
        slip_x = CREEPAGE.longitudinal - kappa * (height - origin) - CREEPAGE.spin * y
        slip_y = CREEPAGE.lateral * cosine + (CREEPAGE.spin + kappa * slope) * cosine * solution.x[i]
        expected = -(solution.qx[i] * slip_x + solution.qy[i] * slip_y)
        np.testing.assert_allclose(found.field[i], expected, rtol=1e-9, atol=1e-9 * found.max)


def test_the_energy_index_over_the_surface_is_nearly_all_dissipated(solution, request):
    found = damage.evaluate(solution)
    longer = np.hypot(1.0, solution.strips.tilt)[:, None]
    power = (found.energy_index.field * solution.dA * longer).sum()
    misfit = MISFIT[request.node.callspec.params["solution"]]
    assert power == pytest.approx(solution.power_per_metre, rel=misfit)


def test_the_worn_volume_counts_the_surface(solution):
    wear = damage.evaluate(solution).archard
    width = solution.strips.dy * np.hypot(1.0, solution.strips.tilt)
    assert wear.volume == pytest.approx((wear.depth_per_revolution * width).sum(), rel=1e-12)
    assert wear.volume > 1.001 * (wear.depth_per_revolution * solution.strips.dy).sum()


def test_a_histogram_holds_the_volume_of_the_surface():
    wheel = profile.s1002()
    (patch,) = Pair(wheel, profile.rail_60e1()).contacts(Pose(y=6.5e-3), load=80e3)
    sol = contact.solve(patch.separation, patch.creepage, load=patch.load, conformal=True)
    histogram = Histogram(wheel, radius=patch.rolling_radius)
    histogram.add(patch, sol, distance=10.0)
    assert histogram.volume == pytest.approx(10.0 * damage.evaluate(sol, patch.rolling_radius).archard.volume, rel=1e-9)


def test_on_a_plane_strips_carry_no_creepages_of_their_own():
    assert contact.solve(SEPARATION, CREEPAGE, load=8e4).strips.longitudinal is None
