"""Where the strips of a patch lie on a profile, and what each of them does to it while the wheel rolls a metre."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from contact.damage import Damage
from contact.errors import ContactError
from contact.geometry.profile import Profile
from contact.geometry.records import Patch
from contact.solution import Solution

Array = NDArray[np.float64]

_OFF = 1e-4  # [m] from the profile at which a contact point cannot be meant to lie on it
_TURNED = 0.17  # cosine of the angle to the contact plane, 80°, beyond which a profile no longer faces it
_BEYOND = 1.0  # [m] by which the ends of the profile are continued straight


def arc_length(profile: Profile) -> Array:
    """Distance of each point along the profile from the one nearest to y = 0 [m], positive to the field side."""
    arc = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(profile.y), np.diff(profile.z)))))
    return arc - arc[np.argmin(np.abs(profile.y))]


def edges_on(profile: Profile, arc: Array, patch: Patch, solution: Solution) -> tuple[Array, Array]:
    """Arc lengths [m] at which each strip begins and ends on the profile, in the profile's right-side convention.

    The strip's edges are projected along the normal of the contact plane. The plane is taken not to be rolled relative to
    the profile: a roll of 10 mrad shifts a point 0.1 mm off the plane by 1 µm. Beyond its ends, and where it turns away from
    the plane, the profile is continued straight.

    Raises
    ------
    ContactError
        If the patch does not lie on this profile.
    """
    mirror = math.copysign(1.0, patch.position[1])  # the right rail lies at positive y
    y0, z0 = patch.on_wheel if profile.kind == "wheel" else patch.on_rail
    c, s = math.cos(patch.angle), mirror * math.sin(patch.angle)
    u = (profile.y - y0) * c + (profile.z - z0) * s
    v = (profile.z - z0) * c - (profile.y - y0) * s
    nearest = int(np.argmin(u * u + v * v))
    turned = np.flatnonzero(np.diff(u) < _TURNED * np.diff(arc))
    first = int(turned[turned < nearest].max(initial=-1)) + 1
    last = int(turned[turned >= nearest].min(initial=u.size - 1))
    facing = slice(first, last + 1)
    off = abs(np.interp(0.0, u[facing], v[facing]))
    if off > _OFF or not u[first] - _OFF < 0.0 < u[last] + _OFF:
        raise ContactError(
            f"patch.on_{profile.kind} = ({y0:g}, {z0:g}) does not lie on {profile!r}; was it found with another profile?"
        )
    along = np.concatenate(([u[first] - _BEYOND], u[facing], [u[last] + _BEYOND]))
    there = np.concatenate(([arc[first] - _BEYOND], arc[facing], [arc[last] + _BEYOND]))
    y, half = mirror * solution.strips.y, 0.5 * solution.strips.dy
    return np.interp(y - half, along, there), np.interp(y + half, along, there)


def shares(low: Array, high: Array, edges: Array) -> Array:
    """Share of each strip in each bin, shape (n_strips, n_bins): rows add up to one. The outer bins are open outwards."""
    left, right = edges[:-1].copy(), edges[1:].copy()
    left[0], right[-1] = -np.inf, np.inf
    overlap = np.minimum(high[:, None], right) - np.maximum(low[:, None], left)
    return np.maximum(overlap, 0.0) / (high - low)[:, None]


def rates(kind: str, solution: Solution, damage: Damage) -> Array:
    """What each strip does per metre rolled, in the order of `histogram.SUMS`, shape (7, n_strips).

    What is spread over the whole patch (T-gamma, as the laws over T-gamma/A take it) is shared by contact area. A strip may
    have none, where a patch is about to part.
    """
    strips, wear = solution.strips, damage.archard
    area = solution.dA.sum(axis=1)
    energy = (damage.energy_index.field * solution.dA).sum(axis=1) / np.maximum(area, np.finfo(float).tiny)
    everywhere = np.ones(strips.y.size)
    return np.stack(
        (
            everywhere,
            wear.depth_per_strip if kind == "wheel" else wear.depth_per_revolution,
            wear.depth_per_revolution,  # volume per metre rolled and metre across
            damage.T_gamma * area / (area.sum() * strips.dy),
            energy,
            damage.stress_index.field.max(axis=1) > 0.0,
            everywhere * (damage.fatigue_index > 0.0),
        )
    )
