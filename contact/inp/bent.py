"""Elements on the curved surface between both bodies as CONTACT lays them with D = 4.

Points of equal arc length on the outlines of rail and wheel have their middle on the surface; its normal is the mean of theirs.
On the wheel the length counts from the point beside the reference point, at the same place along the axle. The distance, and
the points that slide on each other, are those along the normal of the plane at the reference point.
"""

from __future__ import annotations

import numpy as np

from contact.arrays import Array, connected
from contact.geometry.records import Pose
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.geometry.surfaces.frame import Frame
from contact.halfspace.lattice import CurvedGap
from contact.inp.mesh import distance
from contact.inp.outline import Outline, Outlines, in_frame, standing
from contact.inp.rail import Rail
from contact.pair.curved import Elements

#: Steps that turn points of the wheel to the plane of the reference point, and rows beyond the elements of the plane.
_TURNS, _BEYOND = 3, 3
_ABSENT = 1e-3  # [m] by which elements without a surface lie above the highest other one


def elements(pair: SurfacePair, patch: SurfacePatch, pose: Pose, bodies: Outlines, step: float) -> Elements | None:
    """Return the elements of a patch; None if it has no rows. `step` is that of the wheel's mesh along its profile [m]."""
    if bodies.wheel is None or bodies.rail is None or bodies.roller is not None:
        return None
    left = pair.side == "left"
    frame = patch.frame.mirrored if left else patch.frame
    gap, dy = patch.gap, patch.gap.dy
    plane = -gap.y[::-1] if left else gap.y
    rail = Rail(pair, bodies)
    s = plane[0] + dy * np.arange(-plane.size, 2 * plane.size, dtype=np.float64)
    of_rail, of_wheel = _on_rail(rail, bodies.rail, frame, s), _on_wheel(pair, pose, bodies.wheel, frame, s)
    middle, normal = 0.5 * (of_rail[0] + of_wheel[0]), 0.5 * (of_rail[1] + of_wheel[1])
    tilt = np.arctan2(normal[:, 0], -normal[:, 1])
    low, high = plane[0] - _BEYOND * dy, plane[-1] + _BEYOND * dy
    known = np.isfinite(middle).all(axis=1) & (middle[:, 0] >= low) & (middle[:, 0] <= high)
    first = int(np.abs(s).argmin())
    rows = connected(known[:-1] & known[1:], first)
    if rows.stop - rows.start < 2:
        return None
    s, y, tilt = s[rows], middle[rows, 0], tilt[rows]
    h = distance(pair, pose, bodies, frame, gap.x, y, s, step)
    cosine, there = np.cos(tilt), np.isfinite(h)
    if not there.any():
        return None
    h = np.where(there, h, h[there].max() + _ABSENT)
    ground = np.nan_to_num(rail.heights(frame, gap.x, y))
    places = [
        frame.origin + np.stack(np.broadcast_arrays(gap.x, y[:, None], height), axis=-1) @ frame.axes
        for height in (ground, ground - h)
    ]
    axes = np.stack([Frame.turned(frame.origin, frame.turn[0] + one).axes for one in tilt.tolist()])
    h = h * cosine[:, None]
    approach = -float(h.min())
    angle = frame.turn[0] + tilt
    curved = CurvedGap(gap.x, s, h + approach, y, np.tan(tilt))
    found = Elements(curved, approach, places[0], places[1], axes, angle)
    return found.mirrored if left else found


def _on_rail(rail: Rail, outline: Outline, frame: Frame, s: Array) -> tuple[Array, Array]:
    """Return places and upward normals (y, z) in a frame at the lengths `s` from its origin; NaN beyond the ends."""
    turn, to = in_frame(frame, rail.place)
    axes = frame.axes[1:, 1:] @ turn
    here = turn.T @ (frame.origin[1:] - np.array(rail.place[:2]))
    at = outline.length(float(here[0]), float(here[1])) + s
    inside = (at >= 0.0) & (at <= outline.s[-1])
    points, rates = outline.at(np.clip(at, 0.0, outline.s[-1]))
    rates = rates / np.hypot(*rates)
    normal = axes @ np.stack((rates[1], -rates[0]))
    return np.where(inside[:, None], (axes @ points).T + to, np.nan), normal.T


def _on_wheel(pair: SurfacePair, pose: Pose, wheel: Outline, frame: Frame, s: Array) -> tuple[Array, Array]:
    """Return the same of a wheel, on the plane of the origin across the track."""
    turn, origin = standing(pair, pose)
    radius = pair.nominal_radius
    here = turn.T @ (frame.origin - origin)
    at = wheel.length(float(here[1]), float(here[2])) + s
    inside = (at >= 0.0) & (at <= wheel.s[-1])
    (y, z), rates = wheel.at(np.clip(at, 0.0, wheel.s[-1]))
    rates = rates / np.hypot(*rates)
    u = np.full_like(y, here[0])
    for _ in range(_TURNS):
        points = np.stack((u, y, np.sqrt((radius + z) ** 2 - u**2) - radius), axis=-1) @ turn.T + origin
        u = u + (frame.origin[0] - points[:, 0])
    normal = np.stack((np.zeros_like(y), rates[1], -rates[0]), axis=-1) @ turn.T
    placed = (points - frame.origin) @ frame.axes.T
    return np.where(inside[:, None], placed[:, 1:], np.nan), (normal @ frame.axes.T)[:, 1:]
