"""Steering of a wheelset in curves, and how the conicity changes with the amplitude: two figures beside the conicity.

In a curve of radius R a wheelset stands radially, without longitudinal creepage, if its rolling radii differ by
Δr = e r0/R, with the distance e of the tape circles and their radius r0. The radial steering index is this Δr over the
largest one that the profiles give before the flange of the outer wheel touches. At most 1 means that the profiles can steer.
EN 14363 and UIC 518 use such an index; their limit of the displacement was not at hand, so it is an argument here [memory].

The nonlinearity parameter (Polach 2010 [memory]) is the slope of the equivalent conicity between the amplitudes 2 and 4 mm.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, brief, require_numbers
from contact.errors import ContactError, require_number
from contact.geometry.en15302 import equivalent_conicity
from contact.geometry.rigid import ContactPoints
from contact.inputs.options import RADIUS

FLANGE = math.radians(30.0)


@dataclass(frozen=True, eq=False)
class Steering:
    """Radial steering in curves.

    Attributes
    ----------
    curve_radius : ndarray, shape (n,)
        R [m].
    index : ndarray, shape (n,)
        Needed over available Δr [-]; at most 1 if the profiles can steer.
    needed : ndarray, shape (n,)
        e r0/R [m].
    available : float
        Largest Δr before the flange touches [m].
    at : float
        Displacement at which Δr has this value [m].
    smallest_radius : float
        R with an index of 1 [m]; infinite if the profiles give no Δr.
    """

    curve_radius: Array
    index: Array
    needed: Array
    available: float
    at: float
    smallest_radius: float

    __repr__ = brief


def steering(
    points: ContactPoints,
    curve_radius: ArrayLike,
    *,
    base: float = 1.5,
    radius: float = RADIUS.usual,
    flange: float = FLANGE,
) -> Steering:
    """Return the radial steering index of a wheelset whose right wheel is the outer one.

    Parameters
    ----------
    points : ContactPoints
        Contact points, with displacements to the right up to the flange (`contact_points`).
    curve_radius : array_like
        R [m], 10 to 1e6.
    base, radius : float
        Distance e of the tape circles and their radius r0 [m].
    flange : float
        Contact angle of the outer wheel at which its flange counts as touching [rad].

    Returns
    -------
    Steering

    Raises
    ------
    ContactError
        For values outside their range, and if no displacement to the right has a smaller contact angle than `flange`.
    """
    require_number("base", base, 0.0, open_minimum=True)
    require_number("radius", radius, 0.0, open_minimum=True)
    require_number("flange", flange, 0.0, math.radians(80.0), open_minimum=True)
    wanted = np.atleast_1d(require_numbers("curve_radius", curve_radius, 10.0, 1e6))
    outward = points.y >= 0.0
    steep = outward & (points.right.angle > flange)
    end = float(points.y[steep].min()) if steep.any() else math.inf
    free = outward & (points.y < end)
    if not free.any():
        raise ContactError(f"flange = {flange:g}: the contact angle is steeper at all displacements to the right")
    k = np.flatnonzero(free)[int(np.argmax(points.radius_difference[free]))]
    available = float(points.radius_difference[k])
    needed = base * radius / wanted
    smallest = base * radius / available if available > 0.0 else math.inf
    index = needed / available if available > 0.0 else np.full(wanted.shape, math.inf)
    return Steering(wanted, index, needed, available, float(points.y[k]), smallest)


def nonlinearity(points: ContactPoints) -> float:
    """Return the slope of the equivalent conicity between the amplitudes 2 and 4 mm [1/m]. Raises as `equivalent_conicity`."""
    small, large = equivalent_conicity(points, [2e-3, 4e-3]).conicity
    return float(large - small) / 2e-3
