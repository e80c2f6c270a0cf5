"""The profile after wear."""

from __future__ import annotations

import numpy as np

from contact.accumulation.histogram import Histogram
from contact.arrays import Array
from contact.errors import require_number
from contact.geometry.profile import Profile


def worn_profile(histogram: Histogram, times: float = 1.0, *, smoothing: float = 2e-3) -> Profile:
    """Return the histogram's profile, moved along its normal into the body by `times` the smoothed wear depth.

    Parameters
    ----------
    histogram : Histogram
    times : float
        Factor on the accumulated depth, not negative. For a wheel it is the mileage over `histogram.distance`, for a rail
        the number of axle passes. The contact conditions are assumed constant.
    smoothing : float
        Standard deviation of the Gaussian that smooths the depth [m], from the bins' width to 0.05. It preserves the area
        lost.

    Returns
    -------
    Profile

    Raises
    ------
    ContactError
        For arguments outside their range.
    """
    require_number("times", times, 0.0)
    sigma = require_number("smoothing", smoothing, histogram.width, 0.05)
    profile = histogram.profile
    depth, slope = _smoothed(times * histogram.depth, histogram, sigma)
    if profile.kind == "wheel":  # the normal n points from the wheel into the rail
        depth, slope = -depth, -slope
    # P + δ n has the tangent (1 - δ κ) t + δ' n, as t' = κ n and n' = -κ t
    curvature = np.gradient(profile.angle, histogram.arc)
    y, z = profile.y - depth * np.sin(profile.angle), profile.z + depth * np.cos(profile.angle)
    angle = profile.angle + np.arctan2(slope, 1.0 - depth * curvature)
    return Profile(profile.kind, y, z, angle, f"{profile.name or profile.kind}, worn")


def _smoothed(depth: Array, histogram: Histogram, sigma: float) -> tuple[Array, Array]:
    """Return the depth [m] and its slope along the arc [-] at the points of the profile, as a sum of Gaussians of the bins.

    If sigma is not below the bins' width, the relative ripple of the sum is at most 2 exp(-2 π²) = 5e-9.
    """
    t = (histogram.arc[:, None] - histogram.centres) / sigma
    weight = histogram.width / (np.sqrt(2.0 * np.pi) * sigma) * np.exp(-0.5 * t * t)
    return weight @ depth, (-t / sigma * weight) @ depth
