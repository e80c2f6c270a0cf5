"""Elasticity has no length of its own: bodies of 1:k under loads of 1:k² have the same pressures and forces over their load.

It is linear too: a gap k times as high has the same patch under k times the load.
"""

import functools
import math
import warnings

import numpy as np
import pytest

import contact
from contact.errors import ModelWarning, PlausibilityWarning
from contact.geometry import profile, wheelset
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK
from contact.pair import WheelRailPair

SCALES = (0.5, 2.0, 5.0, 20.0)
LOAD = 80e3
BATCHED = contact.methods().batched


@functools.cache
def patch_at(y):
    (patch,) = wheelset.contacts(
        profile.s1002(), profile.rail_60e1(inclination=1 / 40), wheelset.Pose(y=y), side="right", load=LOAD
    )
    return patch


def solved(y, k, **methods):
    """Return (Fx, Fy, Mz k) over the load, k² N over the load, and the largest pressure of a patch of 1:k."""
    s, creepage = patch_at(y).separation, patch_at(y).creepage
    scaled = contact.Separation(s.y / k, s.g / k, s.A * k, s.x_c / k, s.tilt, s.rolling * k)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelWarning)
        sol = contact.solve(
            scaled, contact.Creepage(1e-3, -1e-3, creepage.spin * k), load=LOAD / k**2, throw=False, **methods
        )
    size = math.sqrt(sol.area)
    force = np.array([sol.Fx, sol.Fy, sol.Mz / size, sol.N]) * k**2 / LOAD
    return np.r_[force, sol.max_pressure / 1e9, sol.area * k**2 / 1e-4, sol.approach * k / 1e-4]


@pytest.mark.parametrize("normal", BATCHED.normal)
def test_every_normal_method_is_the_same_at_any_size(normal):
    for y in (2e-3, 5.4e-3):
        whole = solved(y, 1.0, normal=normal, tangential="fastrip_mapped")
        for k in SCALES:
            assert solved(y, k, normal=normal, tangential="fastrip_mapped") == pytest.approx(whole, abs=1e-4)


@pytest.mark.parametrize("normal", BATCHED.normal)
def test_a_gap_k_times_as_high_has_the_same_patch_under_k_times_the_load(normal):
    def found(y, k):
        s = patch_at(y).separation
        higher = contact.Separation(s.y, s.g * k, s.A * k, s.x_c, s.tilt, s.rolling)
        sol = contact.solve(higher, contact.Creepage(), load=LOAD * k, normal=normal, throw=False)
        return np.r_[sol.max_pressure / (1e9 * k), 1e4 * sol.area, sol.approach / (1e-4 * k)]

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelWarning)
        for y in (2e-3, 5.4e-3):
            whole = found(y, 1.0)
            for k in (0.05, 0.3, 3.0):
                assert found(y, k) == pytest.approx(whole, rel=1e-4), (y, k)


@pytest.mark.parametrize("tangential", BATCHED.tangential)
def test_every_tangential_method_is_the_same_at_any_size(tangential):
    whole = solved(2e-3, 1.0, tangential=tangential)
    for k in SCALES:
        assert solved(2e-3, k, tangential=tangential) == pytest.approx(whole, abs=1e-4)


def small(shape, k):
    return profile.Profile(shape.kind, shape.y / k, shape.z / k, shape.angle)


@functools.cache
def pair_of(k, normal):
    wheel, rail = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
    tape = 0.5 * 1.360 + TAPE_FROM_FLANGE_BACK
    return WheelRailPair(
        wheelset.Pair(
            small(wheel, k), small(rail, k), nominal_radius=0.46 / k, gauge=1.435 / k,
            flange_back=2.0 * (tape / k - TAPE_FROM_FLANGE_BACK), gauge_point=0.014 / k, combine_distance=8e-3 / k,
        ),
        normal=normal,
    )  # fmt: skip


@pytest.mark.parametrize("normal", ["strip_halfspace", "analyn", "hertz"])
@pytest.mark.parametrize(("y", "yaw"), [(0.0, 0.0), (3e-3, 2e-3), (5.4e-3, 5e-3), (6.6e-3, -2e-3)])
def test_a_wheel_of_any_size_on_its_rail_bears_the_same(normal, y, yaw):
    def found(k):
        s = pair_of(k, normal).solve(
            wheelset.Pose(y=y / k, yaw=yaw), wheelset.Velocity(forward=20.0), vertical=LOAD / k**2, friction=0.3
        )
        force = np.array(s.force) * k**2 / LOAD
        return np.r_[force, np.array(s.moment) * k**3 / LOAD, s.max_pressure / 1e9, 1e2 * s.z * k]

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PlausibilityWarning)
        warnings.simplefilter("ignore", ModelWarning)
        whole = found(1.0)
        for k in SCALES[:3]:  # the flange back of 1:20 would lie beyond the middle of the track
            assert found(k) == pytest.approx(whole, abs=1e-3)
