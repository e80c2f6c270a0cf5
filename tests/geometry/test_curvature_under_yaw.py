"""A(y) of a separation compared with second differences of the wheel's surface, constructed point by point."""

import math

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq

from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from contact.kernels.geometry import search

STEP = 0.4e-3  # [m] along x


def from_the_surface(pair, u):
    """Return half the second x derivative of the gap at `u` of the first patch. The wheel is a surface of revolution."""
    motion, patch, (y, _, _, x_c, _) = pair.space.motion[0], pair.patches[0], pair.separations[0]
    axle = np.array(search.axle(motion.roll, motion.yaw))
    radius = CubicHermiteSpline(*pair.space.wheel)
    c, s = math.cos(patch.angle), math.sin(patch.angle)
    top = np.array((0.0, motion.y, motion.z - motion.radius))

    def height(x):
        def outside(v):
            point = np.array((x, patch.y + u * c - v * s, patch.z + u * s + v * c)) - top
            d = point @ axle
            return np.linalg.norm(point - d * axle) - motion.radius - radius(d - motion.tape)

        return brentq(outside, -1e-3, 1e-3, xtol=1e-15)

    x = patch.x + np.interp(u, y, x_c)
    left, middle, right = (height(x + k * STEP) for k in (-1, 0, 1))
    return -0.5 * (left - 2.0 * middle + right) / STEP**2


@pytest.mark.parametrize(
    ("y", "roll", "yaw"),
    [
        (0.0, 0.0, 0.0),
        (0.0, 0.01, 0.03),
        (7.2e-3, 0.0, 0.01),
        (7.2e-3, 0.0, -0.02),
        (8e-3, 0.005, 0.05),
        (8e-3, -0.02, 0.0),
    ],
)
def test_A_is_the_second_derivative_of_the_surface(y, roll, yaw):
    pair = Pair(profile.s1002(), profile.rail_60e1(), samples=201, combine_distance=1.0)
    assert pair.locate(Pose(y=y, roll=roll, yaw=yaw), penetration=1e-4) == 1
    at, _, A, _, _ = pair.separations[0]
    low, high = pair.patches[0].low, pair.patches[0].high
    inside = np.flatnonzero((at > low) & (at < high))[5:-5:12]
    assert inside.size > 3
    exact = np.array([from_the_surface(pair, at[k]) for k in inside])
    error = A[inside] / exact - 1.0
    assert np.median(np.abs(error)) < 5e-4
    assert np.abs(error).max() < 5e-3  # where arcs of different radii meet
