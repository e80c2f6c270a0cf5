"""The locus on a round wheel at which it is nearest to a rail with slices, as CONTACT's search with D = 2 follows it."""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.geometry.records import Pose
from contact.geometry.surfaces import SurfacePair
from contact.geometry.surfaces.frame import Frame
from contact.inp.outline import Outline, standing
from contact.inp.rail import Rail

#: Most iterations, a change at which they end [m], the step of a slope along the track [m], and shares of the way to an end of
#: the bracket: of a step that would leave it, and the most of others.
_MOST, _REST, _STEP, _HALF, _SHARE = 150, 1e-6, 1e-5, 0.5, 0.7
#: Reach over the wheel's radius, the same for brackets, and that below which the rail's curvature counts.
_REACH, _BRACKET, _CURVED = 0.5, 0.6, 0.1
#: The spline of the locus breaks where x times the share turns by more than this angle [rad] over y.
_SHARE_OF_X, _KINK = 0.1, 0.1 * np.pi
#: Steps of the locus on a roller.
_ROLLER_STEPS = 3
#: [m] by which the locus reaches beyond the range that is asked for.
_BESIDE = 2e-3


class Locus(NamedTuple):
    """Places x of the locus over rows y, and the depth of the wheel in the rail there, in a view [m]."""

    x: Array
    depth: Array


def locus(pair: SurfacePair, pose: Pose, wheel: Outline, rail: Rail, view: Frame, y: Array) -> Locus:
    """Return the locus over the rows `y` of a view, which is turned about x at most. All in right-side form."""
    at = points_of(pair, pose, wheel, view, (float(y[0]) - _BESIDE, float(y[-1]) + _BESIDE), rail)
    height = np.zeros(at.shape[0])
    if not rail.straight or rail.roller is not None:
        height = rail.at(view, at[:, 0], at[None, :, 1])[0]
    order = np.argsort(at[:, 1])
    order = order[np.isfinite(height[order])]
    found = np.stack((at[order, 0], at[order, 2] - height[order]), axis=1)
    x_there, depth = _between(at[order, 1], found, y).T
    if rail.straight and rail.roller is None:
        depth = depth - rail.heights(view, np.zeros(1), y)[:, 0]
    return Locus(x_there, np.nan_to_num(depth))


def points_of(
    pair: SurfacePair, pose: Pose, wheel: Outline, view: Frame, box: tuple[float, float], rail: Rail
) -> Array:
    """Return the places in a view of the points of a wheel's profile, turned to the locus, within a box of y, (n, 3) [m]."""
    turn, origin = standing(pair, pose)
    axes, to = view.axes @ turn, view.axes @ (origin - view.origin)
    (across, z), (rate_y, rate_z) = wheel.points.T, wheel.rates.T
    in_view = across * axes[1, 1] + z * axes[1, 2] + to[1]
    near = (in_view > box[0]) & (in_view < box[1]) & (np.abs(rate_y) > 1e-3)
    points = _Points(across[near], z[near], (rate_z / np.where(np.abs(rate_y) > 1e-3, rate_y, 1.0))[near])
    placed = _Placed(points, pair.nominal_radius, axes, to)
    if rail.roller is not None:
        x = _on_roller(placed, rail, view)
    elif rail.straight:
        # where the wheel is lowest along the rail
        r = placed.radius + points.z
        x = placed.bounded((r * points.slope * axes[0, 1] - placed.radius * axes[0, 2]) / axes[0, 0])
    else:
        x = _nearest(placed, rail, view, _available(pair, rail, in_view[near], view))
    return placed.at(x)


class _Points(NamedTuple):
    """Points of a wheel's profile [m], and its slope dz/dy there."""

    y: Array
    z: Array
    slope: Array


class _Placed(NamedTuple):
    """Points of a wheel in a view, by its axes and the place of the profile's origin."""

    points: _Points
    radius: float
    axes: Array
    to: Array

    def at(self, x: Array) -> Array:
        """Return the places in the view of the points turned to `x` along the wheel, (point, 3) [m]."""
        z = np.sqrt((self.radius + self.points.z) ** 2 - x**2) - self.radius
        return np.asarray(np.stack((x, self.points.y, z), axis=-1) @ self.axes.T + self.to)

    def bounded(self, x: Array) -> Array:
        """Return `x` where points are not turned too far."""
        return np.clip(x, -_REACH * self.radius, _REACH * self.radius)


def _nearest(placed: _Placed, rail: Rail, view: Frame, bracket: tuple[Array, Array]) -> Array:
    """Return x of the points at which they are nearest to a rail with slices."""
    (low, high), axes, radius = bracket, placed.axes, placed.radius
    r, a = radius + placed.points.z, (radius + placed.points.z) * placed.points.slope
    x, slope_low, slope_high = np.zeros_like(r), np.zeros_like(r), np.zeros_like(r)
    for _ in range(_MOST):
        at = placed.at(x)
        here, ahead = (rail.at(view, at[:, 0] + step, at[None, :, 1])[0] for step in (0.0, _STEP))
        rise = np.nan_to_num((ahead - here) / _STEP)
        down = x * axes[2, 0] - a * axes[2, 1] + np.sqrt(r**2 - x**2) * axes[2, 2]
        width = high - low
        known = (width > _REST) & (width <= _CURVED * radius)
        bend = np.where(known, (slope_high - slope_low) / np.where(known, width, 1.0), 0.0)
        bend = np.where(known, np.clip(bend, -0.5 / down, 0.5 / down), 0.0)
        new = (a * axes[0, 1] - down * rise + down * bend * x) / (axes[0, 0] + down * bend)
        most = np.where(new < x, low, high) - x
        beyond = np.where(new < low, low, high)
        new = np.where((new < low) | (new > high), _HALF * beyond + (1.0 - _HALF) * x, _bounded(x, new, most))
        up, back = new > x, new < x
        low, slope_low = np.where(up, x, low), np.where(up, rise, slope_low)
        high, slope_high = np.where(back, x, high), np.where(back, rise, slope_high)
        new = placed.bounded(new)
        change = float(np.abs(new - x).max(initial=0.0))
        x = new
        if change < _REST:
            break
    return x


def _on_roller(placed: _Placed, rail: Rail, view: Frame) -> Array:
    """Return x of the points at which they are nearest to a roller, by three steps of CONTACT's."""
    axes, roller = placed.axes, float(rail.roller or math.inf)
    a = (placed.radius + placed.points.z) * placed.points.slope
    x = np.zeros_like(a)
    for _ in range(_ROLLER_STEPS):
        at = placed.at(x)
        ahead = view.origin[0] + at[:, 0]
        crown = rail.at(view, np.full_like(ahead, -view.origin[0]), at[None, :, 1])[0]
        rise = ahead / (roller - crown - view.origin[2])
        height = np.sqrt((placed.radius + placed.points.z) ** 2 - x**2)
        down = x * axes[2, 0] - a * axes[2, 1] + height * axes[2, 2]
        across = a * axes[0, 1] - height * axes[0, 2]
        x = placed.bounded(np.nan_to_num((down * (x / roller - rise) + across) / (axes[0, 0] + down / roller)))
    return x


def _bounded(x: Array, new: Array, most: Array) -> Array:
    """Return a step within the bracket, which goes at most a share of the way to its end."""
    far = (new - x) / np.where(most == 0.0, 1.0, most) > _SHARE
    return np.asarray(np.where(far, x + _SHARE * most, new))


def _available(pair: SurfacePair, rail: Rail, y: Array, view: Frame) -> tuple[Array, Array]:
    """Return the range of x in which slices of the rail have a place at each `y` of a view [m]; 0 without one."""
    station, most = float(pair.space.motion[0].station), _BRACKET * pair.nominal_radius
    places = pair.rail.sheet.u
    nodes = rail.across(view, places - station)
    low, high = np.full_like(y, np.inf), np.full_like(y, -np.inf)
    for k, u in enumerate(places):
        x = float(u - station)
        if abs(x) > most and 0 < k < places.size - 1:
            continue
        there = (y >= np.nanmin(nodes[k])) & (y <= np.nanmax(nodes[k]))
        low[there], high[there] = np.minimum(low[there], x), np.maximum(high[there], x)
        if k == 0:
            low[there] = -most
        if k == places.size - 1:
            high[there] = most
    low, high = np.maximum(low, -most), np.minimum(high, most)
    absent = low > high
    return np.where(absent, 0.0, low), np.where(absent, 0.0, high)


def _between(at: Array, f: Array, y: Array) -> Array:
    """Return natural splines through `f` at the places `y`, which break at kinks of the first column; NaN beyond."""
    out = np.full((y.size, f.shape[1]), np.nan)
    if at.size < 2:
        return out
    angle = np.arctan2(_SHARE_OF_X * np.diff(f[:, 0]), np.diff(at))
    cuts = [0, *(np.flatnonzero(np.abs(np.diff(angle)) > _KINK) + 1).tolist(), at.size - 1]
    for first, last in itertools.pairwise(cuts):
        inside = (y >= at[first]) & (y <= at[last])
        out[inside] = _natural(at[first : last + 1], f[first : last + 1], y[inside])
    return out


def _natural(u: Array, f: Array, y: Array) -> Array:
    """Return the natural cubic splines through `f` over `u` at places between."""
    n, h = u.size, np.diff(u)
    bend = np.zeros_like(f)
    if n > 2:
        d = np.diff(f, axis=0) / h[:, None]
        matrix = np.diag(2.0 * (h[1:] + h[:-1])) + np.diag(h[1:-1], 1) + np.diag(h[1:-1], -1)
        bend[1:-1] = np.linalg.solve(matrix, 6.0 * np.diff(d, axis=0))
    k = np.clip(np.searchsorted(u, y, side="right") - 1, 0, n - 2)
    step = h[k][:, None]
    t = (y - u[k])[:, None] / step
    w = 1.0 - t
    bent = (w**3 - w) * bend[k] + (t**3 - t) * bend[k + 1]
    return np.asarray(w * f[k] + t * f[k + 1] + step**2 / 6.0 * bent)
