"""Trace line and search kernels compared with brute force."""

import math

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from contact.geometry import profile, wheelset
from contact.kernels.geometry import search
from contact.kernels.records import LOBE, MAX_LOBES
from contact.kernels.rows import N_LINE_ROWS, Curve

RADIUS, TAPE = 0.460, 0.750
WHEEL = wheelset._facing(profile.s1002())


def trace_line(y, roll, yaw):
    line = np.zeros((N_LINE_ROWS, WHEEL.shape[1]))
    first = search.trace(WHEEL, WHEEL.shape[1], RADIUS, TAPE, y, roll, yaw, line)
    return line[:, first:]


def wheel_surface(y, roll, yaw, theta):
    """Return points of the wheel of revolution rotated by Rz(yaw) Rx(roll) about its centre, arrays (profile, theta)."""
    fine = np.interp(np.linspace(0, WHEEL.shape[1] - 1, 8 * WHEEL.shape[1]), np.arange(WHEEL.shape[1]), WHEEL[0])
    d, r = TAPE + fine[:, None], RADIUS + CubicHermiteSpline(*WHEEL)(fine)[:, None]
    py, pz = d + 0 * theta, r * np.cos(theta)
    px = r * np.sin(theta)
    c, s = math.cos(roll), math.sin(roll)
    py, pz = c * py - s * pz, s * py + c * pz
    c, s = math.cos(yaw), math.sin(yaw)
    return s * px + c * py + y, pz - RADIUS


@pytest.mark.parametrize(("roll", "yaw"), [(0.0, 0.0), (0.01, 0.0), (0.0, 0.03), (-0.01, -0.05), (0.02, 0.08)])
def test_trace_line_is_the_outline_of_the_wheel_seen_along_the_track(roll, yaw):
    line = trace_line(1e-3, roll, yaw)
    py, pz = wheel_surface(1e-3, roll, yaw, np.linspace(-0.25, 0.25, 1001))
    nodes = np.arange(20, line.shape[1] - 20, 15)
    lowest = np.max([np.interp(line[0, nodes], *ray) for ray in zip(py.T, pz.T, strict=True)], axis=0)
    np.testing.assert_allclose(line[1, nodes], lowest, atol=1e-7)


@pytest.mark.parametrize(("roll", "yaw"), [(0.0, 0.0), (0.005, 0.02), (0.0, -0.05)])
def test_point_and_radius_follow_from_the_slope_of_the_trace_line(roll, yaw):
    line = trace_line(0.0, roll, yaw)
    axle = search.axle(roll, yaw)
    for k in range(0, line.shape[1], 10):
        x, d, r = search.on_wheel(line[2, k], line[0, k], line[1, k] + RADIUS, *axle)
        assert r - RADIUS == pytest.approx(np.interp(d - TAPE, WHEEL[0], WHEEL[1]), abs=1e-6)
        point = np.array([x, line[0, k], line[1, k] + RADIUS])
        assert point @ axle == pytest.approx(d, abs=1e-12)
        assert np.linalg.norm(np.cross(point, axle)) == pytest.approx(r, abs=1e-12)


def lobes_of(y, gap, opening, z):
    line = np.zeros((N_LINE_ROWS, y.size))
    line[0], line[Curve.GAP], line[Curve.OPENING] = y, gap, opening
    lobe = np.zeros(MAX_LOBES, LOBE)
    n = search.lobes(line, 0, y.size, z, lobe)
    return lobe[:n]


def test_moments_of_a_parabolic_lobe():
    # depth d(1 - (u/w)²): the integral of depth^(5/2) is d^(5/2) w 5 pi/16
    y = np.linspace(-0.01, 0.02, 121)
    d, w, centre = 1e-4, 4e-3, 3.3e-3
    (lobe,) = lobes_of(y, d * ((y - centre) / w) ** 2, 2 * d * (y - centre) / w**2, d)
    assert lobe.low == pytest.approx(centre - w, abs=1e-12)
    assert lobe.high == pytest.approx(centre + w, abs=1e-12)
    assert lobe.weight == pytest.approx(5 * math.pi / 16 * d**2.5 * w, rel=1e-4)
    assert lobe.moment / lobe.weight == pytest.approx(centre, abs=1e-8)


def test_a_lobe_narrower_than_the_nodes_is_found():
    y = np.linspace(-0.01, 0.01, 41)
    centre = 0.23e-3
    (lobe,) = lobes_of(y, (y - centre) ** 2, 2 * (y - centre), 1e-10)
    assert lobe.high - lobe.low == pytest.approx(2e-5, rel=1e-9)


@pytest.mark.parametrize(
    ("distance", "angle", "most", "patches"),
    [(8e-3, 0.3, 4, 2), (20e-3, 0.3, 4, 1), (8e-3, 1.0, 4, 1), (0.0, 0.0, 4, 2), (0.0, 0.0, 1, 1)],
)
def test_lobes_become_patches_when_apart_in_place_and_in_angle(distance, angle, most, patches):
    lobe = np.zeros(MAX_LOBES, LOBE)
    lobe[0] = (-0.030, -0.028, 0.0, 0.0, 1.0, -0.029, math.cos(0.5), math.sin(-0.5), *[0.0] * 7)
    lobe[1] = (-0.016, -0.010, 0.0, 0.0, 3.0, -0.039, 3 * math.cos(0.05), 3 * math.sin(-0.05), *[0.0] * 7)
    assert search.combine(lobe, 2, distance, angle, most) == patches
    if patches == 1:
        assert lobe[0].weight == 4.0
        assert lobe[0].high == -0.010
