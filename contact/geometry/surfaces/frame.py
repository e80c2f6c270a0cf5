"""Surfaces at a pose, and their heights over the plane of a contact frame."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from contact.geometry.records import Irregularity, Pose
from contact.geometry.surfaces.surface import RailSurface, WheelSurface

Array = NDArray[np.float64]

_STEPS, _TOLERANCE = (
    8,
    1e-11,
)  # Newton's iteration for a point of a surface over the plane: largest number of steps, [m]
_ACCEPTED = 1e-7  # [m] error in the plane up to which a point counts
_LONGEST = 4.0  # largest step across, in paths


@dataclass(frozen=True, eq=False)
class Frame:
    """Contact frame in track coordinates: `origin` [m] and rows x (forward), y (across), z (from the wheel into the rail)."""

    origin: Array
    axes: Array

    @classmethod
    def about_x(cls, origin: Array, angle: float) -> Frame:
        """Return the track frame moved to `origin` and turned about x by `angle` [rad], as CONTACT's frames are."""
        c, s = math.cos(angle), math.sin(angle)
        return cls(origin, np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]]))

    @classmethod
    def along_normal(cls, origin: Array, normal: Array) -> Frame:
        """Return the frame whose z axis is `normal` and whose x axis is the forward direction within the plane."""
        n = normal / np.linalg.norm(normal)
        x = np.array([1.0, 0.0, 0.0]) - n[0] * n
        x /= np.linalg.norm(x)
        return cls(origin, np.stack((x, np.cross(n, x), n)))

    def local(self, points: Array) -> Array:
        """Return `points` of the track, shape (3, …), in this frame."""
        return np.asarray(np.tensordot(self.axes, points - self.origin.reshape((3,) + (1,) * (points.ndim - 1)), 1))

    def turned(self, vectors: Array) -> Array:
        """Return vectors of the track, shape (3, …), in this frame."""
        return np.asarray(np.tensordot(self.axes, vectors, 1))


class Placed(Protocol):
    """A surface in track coordinates."""

    def start(self, frame: Frame, x: Array) -> Array:
        """Return the u of cross-sections near the positions `x` [m] of the frame."""

    def nodes(self, u: Array) -> Array:
        """Return the nodes of the cross-sections `u`, shape (3, k, m) [m]; NaN where absent."""

    def points(self, u: Array, v: Array) -> tuple[Array, Array, Array]:
        """Return points and their derivatives along u and v, each of shape (3, k)."""


class PlacedRail:
    """A rail whose profile origin lies at (y, z) of the track [m]; the wheelset stands at `station` [m] of the slices."""

    def __init__(self, surface: RailSurface, origin: tuple[float, float], station: float, moved: Irregularity) -> None:
        self.surface, self.station, self.moved = surface, station, moved
        self._origin = np.array([origin[0] + moved.y, origin[1] + moved.z])
        c, s = math.cos(moved.roll), math.sin(moved.roll)
        self._turn = np.array([[c, -s], [s, c]])

    def start(self, frame: Frame, x: Array) -> Array:
        """Return the positions of the slices at `x`."""
        return np.asarray(self.station + frame.origin[0] + frame.axes[0, 0] * x)

    def nodes(self, u: Array) -> Array:
        """See `Placed`."""
        f = np.tensordot(self._turn, self.surface.curves(u), 1) + self._origin[:, None, None]
        return np.concatenate((np.broadcast_to((u - self.station)[:, None], f.shape[1:])[None], f))

    def points(self, u: Array, v: Array) -> tuple[Array, Array, Array]:
        """See `Placed`."""
        p = self.surface.at(u, v)
        f = self._turn @ p.f + self._origin[:, None]
        ones = np.ones((1, u.size))
        return (
            np.concatenate(((u - self.station)[None], f)),
            np.concatenate((ones, self._turn @ p.along)),
            np.concatenate((0.0 * ones, self._turn @ p.across)),
        )


class PlacedWheel:
    """A wheel of a wheelset at `pose`, turned by `rotation` [rad] about its axle; `tape` from the wheelset's centre [m]."""

    def __init__(self, surface: WheelSurface, radius: float, tape: float, pose: Pose, rotation: float) -> None:
        self.surface, self.radius, self.tape, self.pose, self.rotation = surface, radius, tape, pose, rotation
        self.centre = np.array([0.0, pose.y, pose.z - radius])
        cr, sr, cy, sy = math.cos(pose.roll), math.sin(pose.roll), math.cos(pose.yaw), math.sin(pose.yaw)
        roll = np.array([[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]])
        self.axes = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]]) @ roll

    def start(self, frame: Frame, x: Array) -> Array:
        """Return the angles of the meridians near `x`."""
        origin, forward = self.axes.T @ (frame.origin - self.centre), self.axes.T @ frame.axes[0]
        at = origin[:, None] + forward[:, None] * x
        reach = math.hypot(origin[0], origin[2])
        return np.asarray(np.arcsin(np.clip(at[0] / reach, -0.9, 0.9)) - self.rotation)

    def nodes(self, u: Array) -> Array:
        """See `Placed`."""
        y, z = self.surface.curves(u)
        r, turned = self.radius + z, (u + self.rotation)[:, None]
        body = np.stack((r * np.sin(turned), self.tape + y, r * np.cos(turned)))
        return np.asarray(np.tensordot(self.axes, body, 1) + self.centre[:, None, None])

    def points(self, u: Array, v: Array) -> tuple[Array, Array, Array]:
        """See `Placed`."""
        p = self.surface.at(u, v)
        r, sine, cosine = self.radius + p.f[1], np.sin(u + self.rotation), np.cos(u + self.rotation)
        body = np.stack((r * sine, self.tape + p.f[0], r * cosine))
        along = np.stack((p.along[1] * sine + r * cosine, p.along[0], p.along[1] * cosine - r * sine))
        across = np.stack((p.across[1] * sine, p.across[0], p.across[1] * cosine))
        return self.axes @ body + self.centre[:, None], self.axes @ along, self.axes @ across


class Heights(NamedTuple):
    """Heights of a surface over a plane, shape (ny, nx) [m], and its normals in the frame, shape (3, ny, nx).

    Both are NaN where the surface is absent. Normals are of unit length and point along +z of the frame.
    """

    z: Array
    normal: Array


def heights(placed: Placed, frame: Frame, x: Array, y: Array, deepest: bool) -> Heights:
    """Return heights and normals of a surface over the grid `x`, `y` [m] of a frame.

    Where several branches of the surface lie over a point, the one with the largest z counts if `deepest` (a wheel), else the
    one with the smallest (a rail).
    """
    u = placed.start(frame, x)
    nodes = frame.local(placed.nodes(u))
    guess = _crossings(nodes[1], nodes[2], y, -1.0 if deepest else 1.0)
    rows, columns = np.nonzero(np.isfinite(guess))
    z, normal = np.full(guess.shape, np.nan), np.full((3, *guess.shape), np.nan)
    if rows.size == 0:
        return Heights(z, normal)
    found, tangents = _newton(placed, frame, np.stack((x[columns], y[rows])), u[columns], guess[rows, columns])
    across = np.cross(tangents[0], tangents[1], axis=0)
    across *= np.where(across[2] < 0.0, -1.0, 1.0) / np.linalg.norm(across, axis=0)
    z[rows, columns], normal[:, rows, columns] = found, np.where(np.isfinite(found), across, np.nan)
    return Heights(z, normal)


def _newton(placed: Placed, frame: Frame, target: Array, u: Array, v: Array) -> tuple[Array, tuple[Array, Array]]:
    """Return z of the points of the surface over `target`, shape (2, k), and their tangents, starting from u, v."""
    u, v = u.copy(), v.copy()
    z, error = np.empty(u.size), np.full(u.size, np.inf)
    along, across = np.empty((3, u.size)), np.empty((3, u.size))
    last = placed.nodes(u[:1]).shape[2] - 1.0
    open_ = np.arange(u.size)
    for _ in range(_STEPS):
        point, du, dv = placed.points(u[open_], v[open_])
        p, a, b = frame.local(point), frame.turned(du), frame.turned(dv)
        miss = target[:, open_] - p[:2]
        z[open_], error[open_], along[:, open_], across[:, open_] = p[2], np.hypot(*miss), a, b
        determinant = a[0] * b[1] - a[1] * b[0]
        with np.errstate(divide="ignore", invalid="ignore"):
            step_u = (miss[0] * b[1] - miss[1] * b[0]) / determinant
            step_v = (a[0] * miss[1] - a[1] * miss[0]) / determinant
        step_v = np.clip(step_v, -_LONGEST, _LONGEST)
        going = (error[open_] > _TOLERANCE) & np.isfinite(step_u + step_v)
        u[open_] += np.where(going, step_u, 0.0)
        v[open_] = np.clip(v[open_] + np.where(going, step_v, 0.0), 0.0, last)
        open_ = open_[going]
        if open_.size == 0:
            break
    return np.where(error <= _ACCEPTED, z, np.nan), (along, across)


def _crossings(s: Array, n: Array, y: Array, sign: float) -> Array:
    """Return where the polylines (s, n), shape (k, m), cross the increasing positions `y`, as index v, shape (ny, k).

    Of several crossings the one with the least sign·n counts; NaN if there is none.
    """
    k, m = s.shape
    whole = np.isfinite(s[:, :-1] + s[:, 1:])
    begin, stop = np.where(whole, s[:, :-1], 0.0), np.where(whole, s[:, 1:], 0.0)
    first, end = np.searchsorted(y, np.minimum(begin, stop)), np.searchsorted(y, np.maximum(begin, stop), side="right")
    count = np.where(whole, end - first, 0)
    segment = np.repeat(np.arange(k * (m - 1)), count.ravel())
    column, j = np.divmod(segment, m - 1)
    begins = np.cumsum(count.ravel()) - count.ravel()
    i = first.ravel()[segment] + np.arange(segment.size) - begins[segment]
    width = s[column, j + 1] - s[column, j]
    t = np.where(width != 0.0, (y[i] - s[column, j]) / np.where(width != 0.0, width, 1.0), 0.5)
    height = sign * (n[column, j] + t * (n[column, j + 1] - n[column, j]))
    order = np.argsort(-height, kind="stable")  # the least comes last and overwrites the others
    v = np.full((y.size, k), np.nan)
    v[i[order], column[order]] = (j + t)[order]
    return v
