"""Stresses at points and on grids below a load, and the place where they are largest."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, broadcast, require_numbers
from contact.errors import ContactError, require_number
from contact.halfspace.influence import fast_length
from contact.inputs.material import STEEL
from contact.inputs.plausibility import doubt_combined
from contact.kernels.stress.below import N_LOADS, N_STRESSES, stresses_at
from contact.results import Solution
from contact.stress.field import Peak, StressField, require_criterion
from contact.stress.load import SurfaceLoad
from contact.stress.response import Grid, stresses

#: The bodies, and the sign of the library's traction (on the wheel) on each.
BODIES = {"rail": -1.0, "wheel": 1.0}
#: Depths over the radius of the contact at which the largest stress is looked for first, and refinements in between.
_DEPTHS = np.array([0.0, 0.04, 0.08, 0.13, 0.2, 0.28, 0.37, 0.47, 0.58, 0.7, 0.85, 1.05, 1.3, 1.6])
_REFINEMENTS = 8


def at(
    load: Solution | SurfaceLoad,
    x: ArrayLike,
    y: ArrayLike,
    z: ArrayLike,
    *,
    body: str = "rail",
    poisson_ratio: float | None = None,
) -> StressField:
    """Return the stresses at points. Use `below` for many points.

    The load is uniform on each element. At depths less than an element, sample at the centres of the elements.

    Parameters
    ----------
    load : Solution or SurfaceLoad
        Any solution with contact and traction.
    x, y : array_like
        Places in the plane of the solution [m].
    z : array_like
        Depths below the surface [m] ≥ 0. `x`, `y` and `z` broadcast.
    body : str
        "rail" or "wheel".
    poisson_ratio : float
        Of the body, 0 to 0.5; default that of the solution's material, for a `SurfaceLoad` that of steel.

    Returns
    -------
    StressField

    Raises
    ------
    ContactError
        For bad arguments, without contact, or if the tangential method gives forces only.
    """
    surface, nu, sign = _prepared(load, body, poisson_ratio)
    points = _points(x, y, z)
    found = np.empty((points[0].size, N_STRESSES))
    flat = (v.ravel() for v in points)
    stresses_at(surface, sign, nu, *flat, np.empty((N_LOADS, N_STRESSES)), found)
    return _field(points, found.T.reshape(N_STRESSES, *points[0].shape), body)


def below(
    load: Solution | SurfaceLoad,
    z: ArrayLike,
    *,
    body: str = "rail",
    poisson_ratio: float | None = None,
    margin: float = 0.25,
) -> StressField:
    """Return the stresses at all centres of the load's elements at the depths `z`.

    The sums over the elements are convolutions, done by FFT. Sixteen depths below 44 × 44 elements take .06 s.

    Parameters
    ----------
    load, body, poisson_ratio
        As in `at`.
    z : array_like, shape (nz,)
        Depths below the surface [m] ≥ 0.
    margin : float
        The grid extends beyond that of the load by this share of its size on every side, 0 to 10.

    Returns
    -------
    StressField
        Arrays of shape (nz, ny, nx) with increasing x and y.
    """
    surface, nu, sign = _prepared(load, body, poisson_ratio)
    surface = surface.padded(require_number("margin", margin, 0.0, 10.0))
    depths = _depths(z)
    ny, nx = surface.p.shape
    dx, dy = surface.steps
    grid = Grid(nx, ny, dx, dy, (fast_length(2 * ny), fast_length(2 * nx)))
    transforms = np.fft.rfft2(np.stack((surface.p, sign * surface.qx, sign * surface.qy)), grid.padded)
    found = np.empty((N_STRESSES, depths.size, ny, nx))
    for k, depth in enumerate(depths):
        found[:, k] = stresses(transforms, grid, float(depth), nu)
    points = _points(surface.x, surface.y[:, None], depths[:, None, None])
    return _field(points, found, body)


def largest(
    load: Solution | SurfaceLoad,
    criterion: str = "von_mises",
    *,
    body: str = "rail",
    poisson_ratio: float | None = None,
) -> Peak:
    """Return the largest value of a scalar in the body, and its place.

    It is searched at the centres of the elements and refined over the depth, down to 1.6 radii of a circle of the
    contact's area.

    Parameters
    ----------
    load, body, poisson_ratio
        As in `at`.
    criterion : str
        "von_mises", "tresca", "largest_principal", "shear_xz" or "shear_yz", see `StressField`.

    Returns
    -------
    Peak
        Value [Pa], place x, y and depth z [m].
    """
    require_criterion(criterion)
    surface, nu, _ = _prepared(load, body, poisson_ratio)
    depths = surface.radius * _DEPTHS
    given: dict[str, Any] = {"body": body, "poisson_ratio": nu}
    peak = below(surface, depths, margin=0.0, **given).peak(criterion)
    low, high = _beside(depths, peak.z)
    between = np.unique([0.5 * (low + peak.z), 0.5 * (peak.z + high)])
    closer = below(surface, between, margin=0.0, **given).peak(criterion)
    depths = np.unique([low, peak.z, high, *between])
    peak = closer if closer.value > peak.value else peak
    low, high = _beside(depths, peak.z)
    peak = _summit(peak, low, high, lambda z: at(surface, peak.x, peak.y, z, **given).peak(criterion))
    other = below(surface, peak.z, margin=0.0, **given).peak(criterion)  # the largest element may be another there
    if other.value > peak.value and (other.x, other.y) != (peak.x, peak.y):
        return _summit(other, low, high, lambda z: at(surface, other.x, other.y, z, **given).peak(criterion))
    return peak


def _beside(depths: Array, z: float) -> tuple[float, float]:
    """Return the depths before and after that of `depths` which is `z`; itself at an end."""
    k = int(np.argmin(np.abs(depths - z)))
    return float(depths[max(k - 1, 0)]), float(depths[min(k + 1, depths.size - 1)])


def _summit(peak: Peak, low: float, high: float, found_at: Callable[[float], Peak]) -> Peak:
    """Return the largest value between two depths around that of `peak`, by parabolas through three depths."""
    left, right = found_at(low), found_at(high)
    for _ in range(_REFINEMENTS):
        before, after = peak.z - left.z, right.z - peak.z
        fall_before, fall_after = peak.value - left.value, peak.value - right.value
        curvature = fall_before * after + fall_after * before
        z = peak.z
        if before > 0.0 and after > 0.0 and curvature > 0.0:
            z += 0.5 * (fall_before * after**2 - fall_after * before**2) / curvature
        if not left.z < z < right.z or abs(z - peak.z) < 0.01 * (right.z - left.z):
            z = 0.5 * (peak.z + (right.z if after > before else left.z))
        found = found_at(z)
        if found.value > peak.value:
            left, right, peak = (peak, right, found) if z > peak.z else (left, peak, found)
        elif z > peak.z:
            right = found
        else:
            left = found
    return peak


def _prepared(load: Solution | SurfaceLoad, body: str, poisson_ratio: float | None) -> tuple[SurfaceLoad, float, float]:
    """Return the load, the Poisson ratio of the body and the sign of the traction on it."""
    if body not in BODIES:
        raise ContactError(f"body = {body!r} is unknown; allowed: {', '.join(BODIES)}")
    if isinstance(load, Solution):
        surface, nu = SurfaceLoad.of(load), load.material.poisson_ratio
        if poisson_ratio is None:
            doubt_combined(load.material.coupling)
    elif isinstance(load, SurfaceLoad):
        surface, nu = load, STEEL.poisson_ratio
    else:
        raise ContactError(f"load = {load!r} is neither a contact.Solution nor a contact.stress.SurfaceLoad")
    if poisson_ratio is not None:
        nu = require_number("poisson_ratio", poisson_ratio, 0.0, 0.5)
    return surface, nu, BODIES[body]


def _points(x: ArrayLike, y: ArrayLike, z: ArrayLike) -> tuple[Array, Array, Array]:
    """Return the coordinates [m] of points, broadcast and checked."""
    checked = {"x": require_numbers("x", x), "y": require_numbers("y", y), "z": require_numbers("z", z, 0.0)}
    x, y, z = broadcast(checked)
    return x, y, z


def _depths(z: ArrayLike) -> Array:
    depths = np.atleast_1d(_points(0.0, 0.0, z)[2])
    if depths.ndim != 1:
        raise ContactError(f"z has shape {depths.shape}; (nz,) is needed")
    return depths


def _field(points: tuple[Array, Array, Array], stresses: Array, body: str) -> StressField:
    """Return the field in the axes of the solution, whose z points out of the wheel."""
    xx, yy, zz, xy, xz, yz = stresses
    turn = -1.0 if body == "wheel" else 1.0
    return StressField(*points, xx, yy, zz, xy, turn * xz, turn * yz, body)
