"""Surfaces as the arrays that compiled kernels read."""

from __future__ import annotations

import math

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from contact.geometry.surfaces.surface import RailSurface, WheelSurface
from contact.instance import workspace
from contact.kernels import arrays
from contact.kernels.geometry.regions import FARTHEST

_FIRST, _LEAST, _ERROR = 5e-3, 1e-6, 1e-10  # [rad] first and least interval of a wheel's table; [m] its error
_WINDOW, _STEP = 0.5, 0.125e-3  # [m] table of a rail: reach to both sides of the station, and interval


def sheet(surface: WheelSurface | RailSurface) -> arrays.Sheet:
    """Return the arrays of a surface. The table of deviations of a rail is empty until `follow` fills it."""
    s = surface.sheet
    m = s.paths
    rows = []
    for f, start, end in ((s._f, s._start, s._end), (s._f_u, s._start_u, s._end_u)):
        for part in (f, start, end):
            rows += [
                np.pad(part[0], ((0, 0), (0, m - part.shape[2]))),
                np.pad(part[1], ((0, 0), (0, m - part.shape[2]))),
            ]
    runs = np.stack((s.active.argmax(axis=1), m - s.active[:, ::-1].argmax(axis=1)), axis=1).astype(np.float64)
    if isinstance(surface, WheelSurface):
        fold = surface.middle
        table = _tabulated(surface, fold - math.pi, fold + math.pi)
    else:
        fold = math.nan
        table = np.zeros((3, 1 + round(2.0 * _WINDOW / _STEP) if surface.deviations else 1))
    return workspace.sheet(s.u, np.stack(rows, axis=1), runs, (s.period or 0.0, fold), table)


def numbers(surface: WheelSurface | RailSurface, origin: tuple[float, float] = (0.0, 0.0)) -> Array:
    """Return a surface as one array, as wheelrail.h and the FMU `WheelRailSurfaces` read it.

    Parameters
    ----------
    surface : WheelSurface or RailSurface
    origin : (float, float)
        Place (y, z) of the origin of a rail's points [m], as `SurfacePair.rail_origin`.

    Raises
    ------
    ContactError
        For a rail with deviations, which have no end.
    """
    if isinstance(surface, RailSurface) and surface.deviations:
        raise ContactError(f"rail = {surface!r} has deviations, which have no end; add them to the slices")
    made = sheet(surface)
    period = made.period if isinstance(surface, WheelSurface) else np.zeros(2)
    head = (made.u.size, made.nodes.shape[2], made.deviation.shape[1], *origin)
    return np.concatenate([array.ravel() for array in (np.array(head), *made._replace(period=period))])


def follow(made: arrays.Sheet, surface: RailSurface, station: float) -> None:
    """Fill the table of deviations around `station` [m], unless it serves."""
    if not surface.deviations:
        return
    u = made.deviation[0]
    if u[0] < u[-1] and u[0] <= station - FARTHEST and station + FARTHEST <= u[-1]:
        return
    at = station + np.linspace(-_WINDOW, _WINDOW, u.size)
    made.deviation[:] = at, *_deviation(surface, at)


def _deviation(surface: WheelSurface | RailSurface, u: Array) -> tuple[Array, Array]:
    value, slope = np.zeros_like(u), np.zeros_like(u)
    for deviation in surface.deviations:
        more, steeper = deviation.at(u)
        value, slope = value + more, slope + steeper
    return value, slope


def _tabulated(surface: WheelSurface, low: float, high: float) -> Array:
    """Return u, value and slope of the deviations. Intervals are halved until a cubic through their ends serves."""
    if not surface.deviations:
        return np.zeros((3, 1))
    u = np.linspace(low, high, math.ceil((high - low) / _FIRST) + 1)
    while True:
        f, m = _deviation(surface, u)
        h, middle = np.diff(u), 0.5 * (u[:-1] + u[1:])
        there = _deviation(surface, middle)[0]
        miss = np.abs(0.5 * (f[:-1] + f[1:]) + 0.125 * h * (m[:-1] - m[1:]) - there)
        wrong = (miss > _ERROR) & (h > _LEAST)
        if not wrong.any():
            return np.stack((u, f, m))
        u = np.sort(np.concatenate((u, middle[wrong])))
