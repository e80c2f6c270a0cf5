"""The undeformed distance of a patch as CONTACT forms it: the wheel is a mesh of flat pieces.

CONTACT divides the wheel's profile into steps DS, turns it about the axle in steps DX, and interpolates the heights of these
points bilinearly on the elements. Without yaw the points lie on the elements, and nothing is lost. With yaw they lie between
them, and the flats are up to DS²/8 over the profile's radius off the wheel: a hundredth of the approach at a flange root.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.geometry.records import Pose
from contact.geometry.shape import Profile
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.geometry.surfaces.frame import Frame
from contact.geometry.surfaces.slices import SliceCurve
from contact.geometry.surfaces.spline import slopes
from contact.halfspace import Gap
from contact.halfspace.lattice import CurvedGap
from contact.pair.curved import Elements

#: Steps of Newton's iteration for the place of an element on the wheel and in the mesh; it moves by less than 1e-12 m.
_STEPS = 12
#: Points of a spline for each point of a profile.
_FINE = 20


class Wheel(NamedTuple):
    """The profile of a wheel of revolution as a spline over its chord length, and its radius at z = 0 [m]."""

    s: Array
    points: Array
    rates: Array
    radius: float

    @classmethod
    def of(cls, profile: Profile, radius: float) -> Wheel:
        """Return the wheel with a profile."""
        points = np.stack((profile.y, profile.z), axis=1)
        s = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
        return cls(s, points, slopes(s, points), radius)

    def at(self, s: Array) -> tuple[Array, Array]:
        """Return y, z at the lengths `s`, and their derivatives, each of shape (..., 2)."""
        k = np.clip(np.searchsorted(self.s, s, side="right") - 1, 0, self.s.size - 2)
        h = self.s[k + 1] - self.s[k]
        t, f, m = ((s - self.s[k]) / h)[..., None], self.points, self.rates
        h = h[..., None]
        rise = f[k + 1] - f[k]
        a, b = h * (m[k] + m[k + 1]) - 2.0 * rise, 3.0 * rise - h * (2.0 * m[k] + m[k + 1])
        return f[k] + t * (h * m[k] + t * (b + t * a)), m[k] + t * (2.0 * b + 3.0 * t * a) / h

    def length(self, y: float) -> float:
        """Return the length s at which the profile has the lateral position `y` [m]."""
        k = int(np.clip(np.searchsorted(self.points[:, 0], y) - 1, 0, self.s.size - 2))
        low, high = float(self.s[k]), float(self.s[k + 1])
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.at(np.array(middle))[0][0] < y else (low, middle)
        return middle


def flattened(patch: SurfacePatch, pair: SurfacePair, pose: Pose, wheel: Wheel, step: float) -> SurfacePatch:
    """Return a patch with CONTACT's distance between the rail and the mesh of the wheel.

    Parameters
    ----------
    patch : SurfacePatch
        With the exact distance.
    pair, pose : SurfacePair, Pose
        Where the wheel stands; z is that of the last search.
    wheel : Wheel
    step : float
        Step along the profile [m]; that around the wheel is the length of the elements.
    """
    right = pair.side == "right"
    gap, frame = patch.gap, patch.frame if right else patch.frame.mirrored
    order = slice(None) if right else slice(None, None, -1)
    x, y = np.meshgrid(gap.x, gap.y if right else -gap.y[order])
    mesh = _Mesh.of(pair, pose, wheel, frame, (gap.dx, step), (x[0, 0], y[0, 0]))
    h = gap.h - patch.approach - mesh.sag(frame, x, y)[order]
    approach = -float(h.min())
    return replace(patch, gap=Gap(gap.x, gap.y, h + approach), approach=approach)


def flattened_rows(
    rows: Elements, patch: SurfacePatch, pair: SurfacePair, pose: Pose, wheel: Wheel, step: float
) -> Elements:
    """Return elements on a curved surface with CONTACT's distance, as `flattened` does for a plane."""
    right, gap = pair.side == "right", rows.gap
    frame = patch.frame if right else patch.frame.mirrored
    first = gap.y[0] if right else -gap.y[-1]
    mesh = _Mesh.of(pair, pose, wheel, frame, (gap.dx, step), (gap.x[0], first))
    h, mirror = gap.h - rows.approach, np.array([1.0, 1.0 if right else -1.0, 1.0])
    for k in range(gap.y.size):
        if h[k].min() < 0.0:
            origin = (rows.on_rail[k, 0] - gap.x[0] * rows.axes[k, 0]) * mirror
            row = Frame.turned(origin, float(rows.angle[k] * mirror[1]))
            h[k] -= mesh.sag(row, gap.x[None, :], np.zeros((1, gap.x.size)))[0]
    approach = -float(h.min())
    return rows._replace(gap=CurvedGap(gap.x, gap.y, h + approach, gap.place, gap.tilt), approach=approach)


def cornered(patch: SurfacePatch, side: str, roller: Profile) -> SurfacePatch:
    """Return a patch with CONTACT's roller, which is made of cones between the points of its profile.

    `roller` is the profile in its right-side form, as the pair has it.
    """
    mirror = 1.0 if side == "right" else -1.0
    cosine = math.cos(patch.angle)
    across = patch.on_rail[0] + mirror * patch.gap.y * cosine
    exact = SliceCurve(roller, "roller")
    exact.connect(np.empty(0))
    fine = exact.at(np.linspace(0.0, exact.length, _FINE * roller.y.size))
    rising = np.concatenate(([True], np.diff(np.maximum.accumulate(fine[0])) > 0.0))
    points = np.concatenate(([True], np.diff(np.maximum.accumulate(roller.y)) > 0.0))
    chord = np.interp(across, roller.y[points], roller.z[points]) - np.interp(across, *fine[:, rising])
    h = patch.gap.h - patch.approach + cosine * chord[:, None]
    approach = -float(h.min())
    return replace(patch, gap=Gap(patch.gap.x, patch.gap.y, h + approach), approach=approach)


def turned(roll: float, yaw: float) -> Array:
    """Return the matrix from wheelset to track axes: roll about x, then yaw about z."""
    cr, sr, cy, sy = math.cos(roll), math.sin(roll), math.cos(yaw), math.sin(yaw)
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]])
    about_z = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
    return about_z @ about_x


def _rest(at: float, step: float) -> float:
    """Return by how much a place lies beyond the nearest multiple of a step [m]: the mesh has nodes at the elements."""
    rest = at - round(at / step) * step
    return rest if abs(rest) > 1e-9 * step else 0.0


class _Placed(NamedTuple):
    """A wheel that stands in the track, seen in the frame of a patch."""

    wheel: Wheel
    frame: Frame
    turn: Array
    origin: Array

    def heights(self, s: Array, u: Array) -> Array:
        """Return the places x, y, z in the frame of the points at the length `s` of the profile and `u` along x [m]."""
        (y, z), _ = np.moveaxis(np.stack(self.wheel.at(s)), -1, 1)
        R = self.wheel.radius
        points = np.stack(np.broadcast_arrays(u, y, np.sqrt((R + z) ** 2 - u**2) - R), axis=-1)
        return np.asarray((points @ self.turn.T + (self.origin - self.frame.origin)) @ self.frame.axes.T)

    def under(self, x: Array, y: Array, start: tuple[float, float]) -> tuple[Array, Array]:
        """Return s and u of the points of the wheel at the places x, y of the frame."""
        s, u = np.full_like(x, start[0]), start[1] + x
        R, axes = self.wheel.radius, self.frame.axes @ self.turn
        for _ in range(_STEPS):
            (_, z), (ys, zs) = np.moveaxis(np.stack(self.wheel.at(s)), -1, 1)
            down = np.sqrt((R + z) ** 2 - u**2)
            by_s = axes[:2, 1, None, None] * ys + axes[:2, 2, None, None] * ((R + z) * zs / down)
            by_u = axes[:2, 0, None, None] - axes[:2, 2, None, None] * (u / down)
            miss = np.stack((x, y)) - np.moveaxis(self.heights(s, u)[..., :2], -1, 0)
            step_s, step_u = _solved(by_s, by_u, miss)
            s, u = np.clip(s + step_s, 0.0, self.wheel.s[-1]), u + step_u
        return s, u


class _Mesh(NamedTuple):
    """The mesh of a wheel that stands in the track: a node at `reference`, the steps along the profile and around."""

    wheel: Wheel
    turn: Array
    origin: Array
    reference: tuple[float, float]
    steps: tuple[float, float]

    @classmethod
    def of(
        cls,
        pair: SurfacePair,
        pose: Pose,
        wheel: Wheel,
        frame: Frame,
        steps: tuple[float, float],
        element: tuple[float, float],
    ) -> _Mesh:
        """Return the mesh with a node at the reference point of a frame, moved to the nearest `element` of the grid [m].

        `steps` are those around the wheel and along its profile [m].
        """
        mirror = 1.0 if pair.side == "right" else -1.0
        turn = turned(mirror * pose.roll, mirror * pose.yaw)
        middle = np.array([0.0, mirror * pose.y, pair.z - pair.nominal_radius])
        origin = middle + turn @ np.array([0.0, pair.tape, pair.nominal_radius])
        here = turn.T @ (frame.origin - origin)  # the reference point, as the wheel's profile has it
        reference = (
            wheel.length(float(here[1])) + _rest(element[1], steps[1]),
            float(here[0]) + _rest(element[0], steps[0]),
        )
        return cls(wheel, turn, origin, reference, steps)

    def sag(self, frame: Frame, x: Array, y: Array) -> Array:
        """Return by how much the mesh lies below the wheel along the normal of a frame [m]; 0 beyond it."""
        placed, (s0, u0), (dx, step) = _Placed(self.wheel, frame, self.turn, self.origin), self.reference, self.steps
        s, u = placed.under(x, y, self.reference)
        exact = placed.heights(s, u)[..., 2]
        i, j = (s - s0) / step, (u - u0) / dx
        rows, columns = (math.ceil(float(np.abs(k).max())) + 2 for k in (i, j))
        along, around = np.arange(-rows, rows + 1.0)[:, None], np.arange(-columns, columns + 1.0)
        nodes = placed.heights(s0 + step * along, u0 + dx * around)
        flat = _bilinear(nodes, x, y, i + rows, j + columns)
        return np.where(np.isfinite(flat), flat - exact, 0.0)


def _solved(first: Array, second: Array, right: Array) -> tuple[Array, Array]:
    """Return a and b with a·first + b·second = right."""
    across = first[0] * second[1] - first[1] * second[0]
    return (
        (right[0] * second[1] - right[1] * second[0]) / across,
        (first[0] * right[1] - first[1] * right[0]) / across,
    )


def _bilinear(nodes: Array, x: Array, y: Array, i: Array, j: Array) -> Array:
    """Return the heights at x, y between the nodes of a mesh. `i` and `j` are about the places there, counted in nodes."""
    last = nodes.shape[0] - 2, nodes.shape[1] - 2
    for _ in range(_STEPS):
        a, b = (np.clip(np.floor(k).astype(np.int64), 0, most) for k, most in zip((i, j), last, strict=True))
        t, r = (i - a)[..., None], (j - b)[..., None]
        low, high = (1.0 - r) * nodes[a, b] + r * nodes[a, b + 1], (1.0 - r) * nodes[a + 1, b] + r * nodes[a + 1, b + 1]
        here, by_i = (1.0 - t) * low + t * high, high - low
        by_j = (1.0 - t) * (nodes[a, b + 1] - nodes[a, b]) + t * (nodes[a + 1, b + 1] - nodes[a + 1, b])
        miss = np.stack((x, y)) - np.moveaxis(here[..., :2], -1, 0)
        di, dj = _solved(np.moveaxis(by_i[..., :2], -1, 0), np.moveaxis(by_j[..., :2], -1, 0), miss)
        i, j = i + np.clip(di, -1.0, 1.0), j + np.clip(dj, -1.0, 1.0)
    return np.asarray(here[..., 2])
