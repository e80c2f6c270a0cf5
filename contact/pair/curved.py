"""Elements on the true surfaces of a wheel and a rail: on a curved contact surface, and how they slide there.

The curved surface lies halfway between both bodies. Points of equal arc length from the reference point on the rail and on
the wheel, whose section is that at the reference point, have their middle on it; its normal is the mean of theirs. Rows of
elements have equal widths along the rail. The gap is the distance of the bodies along the normal of each row.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from contact.arrays import Array, connected
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.geometry.surfaces.frame import Frame
from contact.geometry.surfaces.slices import SliceCurve
from contact.halfspace.lattice import CurvedGap
from contact.instance.ownership import within
from contact.kernels.geometry.section import AWAY

#: Points of a section for each of its nodes, and for each row of elements; rows beyond the overlap on either side.
_FINE, _PER_ROW, _BEYOND = 20, 8, 3
_ABSENT = 1e-3  # [m] by which elements without a surface lie above the highest other one
_NEAR = 0.5  # [m] gap of elements that belong to the patch
_STEEPEST = math.radians(85.0)
_MIRROR = np.array([1.0, -1.0, 1.0])


class Elements(NamedTuple):
    """The elements of a patch, in true track coordinates.

    Attributes
    ----------
    gap : distance of the bodies along the normal of each row; its least value is 0
    approach : depth of the interpenetration [m]
    on_rail, on_wheel : points of the bodies at each element, shape (ny, nx, 3) [m]
    axes : axes x, y, z of each row, shape (ny, 3, 3)
    angle : contact angle of each row [rad]
    """

    gap: CurvedGap
    approach: float
    on_rail: Array
    on_wheel: Array
    axes: Array
    angle: Array

    @property
    def mirrored(self) -> Elements:
        """The same on the other side of the track."""
        back, gap = slice(None, None, -1), self.gap
        turned = CurvedGap(gap.x, -gap.y[back], gap.h[back], -gap.place[back], -gap.tilt[back])
        on_rail, on_wheel = (points[back] * _MIRROR for points in (self.on_rail, self.on_wheel))
        axes = _MIRROR[:, None] * self.axes[back] * _MIRROR
        return Elements(turned, self.approach, on_rail, on_wheel, axes, -self.angle[back])


def elements(pair: SurfacePair, patch: SurfacePatch, bent: bool) -> Elements:
    """Return the elements of a patch of the last search: on the curved surface if `bent`, else on its plane."""
    left = pair.side == "left"
    frame = patch.frame.mirrored if left else patch.frame
    gap, motion = patch.gap, pair.space.motion[0]
    rows = -gap.y[::-1] if left else gap.y
    y, r = _section(pair, frame, float(motion.station))
    if not bent:
        height = np.interp(rows, y, r)
        points = np.stack((0.0 * rows, rows, height), axis=1) @ frame.axes + frame.origin
        h = (gap.h[::-1] if left else gap.h) - patch.approach
        axes = np.repeat(frame.axes[None], rows.size, axis=0)
        return _finished(gap.x, rows, rows, np.zeros(rows.size), h, points, axes, frame, left)
    near = gap.h[::-1] < _NEAR if left else gap.h < _NEAR  # elsewhere the contact cannot be
    old, (rows, middle, tilt, half) = rows, _middle(pair, frame, rows, gap.dy, y, r)
    row = np.clip(np.rint((rows - old[0]) / gap.dy).astype(np.int64), 0, old.size - 1)
    h, axes = np.empty((rows.size, gap.x.size)), np.empty((rows.size, 3, 3))
    on_rail = np.empty((rows.size, 3))
    turn, pitch = frame.turn
    for k in range(rows.size):
        origin = np.array([0.0, *middle[k]]) @ frame.axes + frame.origin
        own = Frame.turned(origin, turn + float(tilt[k]), pitch)
        h[k] = within(pair.distance)(own, gap.x, np.zeros(1))[0]
        axes[k] = own.axes
        on_rail[k] = origin + half[k] * own.axes[2]
    there = (h < AWAY) & near[row]
    h = np.where(there, h, h[there].max() + _ABSENT)
    return _finished(gap.x, rows, middle[:, 0], tilt, h, on_rail, axes, frame, left)


def _section(pair: SurfacePair, frame: Frame, station: float) -> tuple[Array, Array]:
    """Return y and height of the rail's section in a frame [m], where it faces the plane."""
    motion = pair.space.motion[0]
    y, z = pair.rail.curves(np.array([station + float(frame.origin[0])]))[:, 0]
    known = np.isfinite(y) & np.isfinite(z)
    c, s = math.cos(motion.rail_roll), math.sin(motion.rail_roll)
    placed = np.stack((motion.rail_y + c * y - s * z, motion.rail_z + s * y + c * z))[:, known]
    across = (placed - frame.origin[1:, None]).T @ frame.axes[1:, 1:].T
    new = np.concatenate(([True], np.hypot(*np.diff(across, axis=0).T) > 0.0))
    curve = SliceCurve(across[new], "section")
    curve.connect(np.empty(0))
    v, r = curve.at(np.linspace(0.0, curve.length, _FINE * int(new.sum())))
    rising = (np.diff(v) > 0.0) & (np.abs(np.diff(r)) < math.tan(_STEEPEST) * np.diff(v))
    part = connected(rising, int(np.argmin(np.abs(v) + np.abs(r))))
    return v[part], r[part]


def _middle(
    pair: SurfacePair, frame: Frame, rows: Array, step: float, y: Array, r: Array
) -> tuple[Array, Array, Array, Array]:
    """Return the rows [m], their points (y, z) in the frame, their angles against it, and half the distance of the bodies."""
    fine = np.arange(max(y[0], rows[0] - _BEYOND * step), min(y[-1], rows[-1] + _BEYOND * step), step / _PER_ROW)
    rail = np.interp(fine, y, r)
    apart = within(pair.distance)(frame, np.zeros(1), fine)[:, 0]
    there = apart < AWAY
    fine, rail, apart = fine[there], rail[there], apart[there]
    arcs, slopes = [], []
    for height in (rail, rail - apart):
        slope = np.gradient(height, fine)
        along = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(fine), np.diff(height)))))
        arcs.append(along - np.interp(0.0, fine, along))
        slopes.append(slope)
    # the rows of the plane, and as many more as the arc is longer
    first = min(math.floor((arcs[0][0] - rows[0]) / step) + 1, 0)
    last = max(math.ceil((arcs[0][-1] - rows[0]) / step) - 1, rows.size - 1)
    s = rows[0] + step * np.arange(first, last + 1)
    s = s[(s >= max(arc[0] for arc in arcs)) & (s <= min(arc[-1] for arc in arcs))]
    of_rail, of_wheel = (
        np.stack((np.interp(s, arc, fine), np.interp(s, arc, height)), axis=1)
        for arc, height in zip(arcs, (rail, rail - apart), strict=True)
    )
    angles = [np.arctan(np.interp(s, arc, slope)) for arc, slope in zip(arcs, slopes, strict=True)]
    normal = [np.stack((-np.sin(a), np.cos(a)), axis=1) for a in angles]
    tilt = np.arctan2(-(normal[0] + normal[1])[:, 0], (normal[0] + normal[1])[:, 1])
    half = 0.5 * ((of_rail - of_wheel) * np.stack((-np.sin(tilt), np.cos(tilt)), axis=1)).sum(axis=1)
    return s, 0.5 * (of_rail + of_wheel), tilt, half


def _finished(
    x: Array,
    rows: Array,
    place: Array,
    tilt: Array,
    h: Array,
    on_rail: Array,
    axes: Array,
    frame: Frame,
    left: bool,
) -> Elements:
    """Return the elements of rows of the right side; `on_rail` are the points at x = 0."""
    rail = on_rail[:, None, :] + x[:, None] * frame.axes[0]
    wheel = rail - h[..., None] * axes[:, None, 2]
    approach = -float(h.min())
    gap = CurvedGap(x, rows, h + approach, place, np.tan(tilt))
    found = Elements(gap, approach, rail, wheel, axes, frame.turn[0] + tilt)
    return found.mirrored if left else found
