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

#: Steps of Newton's iterations, a distance below which they are at rest, and one above which they have missed [m].
_STEPS, _REST, _MISSED = 20, 1e-13, 1e-9
#: Points of a spline for each point of a profile.
_FINE = 20


class Outline(NamedTuple):
    """A profile as a spline through its points over the chord length [m]."""

    s: Array
    points: Array
    rates: Array

    @classmethod
    def of(cls, profile: Profile) -> Outline:
        """Return the outline of a profile."""
        points = np.stack((profile.y, profile.z), axis=1)
        s = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
        return cls(s, points, slopes(s, points))

    def at(self, s: Array) -> tuple[Array, Array]:
        """Return (y, z) at the lengths `s`, and their derivatives, each of shape (2, ...)."""
        k = np.clip(np.searchsorted(self.s, s, side="right") - 1, 0, self.s.size - 2)
        h = self.s[k + 1] - self.s[k]
        t, f, m = ((s - self.s[k]) / h)[..., None], self.points, self.rates
        h = h[..., None]
        rise = f[k + 1] - f[k]
        a, b = h * (m[k] + m[k + 1]) - 2.0 * rise, 3.0 * rise - h * (2.0 * m[k] + m[k + 1])
        place, rate = f[k] + t * (h * m[k] + t * (b + t * a)), m[k] + t * (2.0 * b + 3.0 * t * a) / h
        return np.moveaxis(place, -1, 0), np.moveaxis(rate, -1, 0)

    def length(self, y: float, z: float) -> float:
        """Return the length s at the lateral position `y`, near the height `z` [m]."""
        s = np.array(self.s[int(np.hypot(*(self.points - (y, z)).T).argmin())])
        for _ in range(_STEPS):
            place, rate = self.at(s)
            s = np.clip(
                s + np.clip((y - place[0]) / (rate[0] if abs(rate[0]) > 1e-3 else 1e-3), -1e-3, 1e-3), 0.0, self.s[-1]
            )
        return float(s)


class Outlines(NamedTuple):
    """Outlines of a wheel of revolution and of a straight rail; None for a roller and for a rail that changes on its way."""

    wheel: Outline
    rail: Outline | None


def with_distance(patch: SurfacePatch, h: Array) -> SurfacePatch:
    """Return a patch with another distance `h` of the bodies [m], negative where they overlap."""
    approach = -float(h.min())
    return replace(patch, gap=Gap(patch.gap.x, patch.gap.y, h + approach), approach=approach)


def flattened(patch: SurfacePatch, pair: SurfacePair, pose: Pose, bodies: Outlines, step: float) -> SurfacePatch:
    """Return a patch with CONTACT's distance between the rail and the mesh of the wheel.

    Parameters
    ----------
    patch : SurfacePatch
        With the distance of surfaces whose paths lie .25 mm apart, which alters waves of profiles that are shorter than about
        1 mm. It remains where the outlines do not reach.
    pair, pose : SurfacePair, Pose
        Where the wheel stands; z is that of the last search.
    bodies : Outlines
    step : float
        Step along the profile [m]; that around the wheel is the length of the elements.
    """
    right = pair.side == "right"
    gap, frame = patch.gap, patch.frame if right else patch.frame.mirrored
    order = slice(None) if right else slice(None, None, -1)
    x, y = np.meshgrid(gap.x, gap.y if right else -gap.y[order])
    mesh = _Mesh.of(pair, pose, bodies.wheel, frame, (gap.dx, step), (x[0, 0], y[0, 0]))
    h = mesh.distance(pair, bodies.rail, frame, x, y, (gap.h - patch.approach)[order])[order]
    return with_distance(patch, h)


def flattened_rows(
    rows: Elements, patch: SurfacePatch, pair: SurfacePair, pose: Pose, bodies: Outlines, step: float
) -> Elements:
    """Return elements on a curved surface with CONTACT's distance, as `flattened` does for a plane."""
    right, gap = pair.side == "right", rows.gap
    frame = patch.frame if right else patch.frame.mirrored
    first = gap.y[0] if right else -gap.y[-1]
    mesh = _Mesh.of(pair, pose, bodies.wheel, frame, (gap.dx, step), (gap.x[0], first))
    h, mirror = gap.h - rows.approach, np.array([1.0, 1.0 if right else -1.0, 1.0])
    for k in range(gap.y.size):
        if h[k].min() < 0.0:
            origin = (rows.on_rail[k, 0] - gap.x[0] * rows.axes[k, 0]) * mirror
            row = Frame.turned(origin, float(rows.angle[k] * mirror[1]))
            h[k] = mesh.distance(pair, bodies.rail, row, gap.x[None, :], np.zeros((1, gap.x.size)), h[k : k + 1])[0]
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
    return with_distance(patch, h)


def _over(rail: Outline, y: Array, frame: Frame, place: tuple[float, float, float]) -> Array:
    """Return the height of a straight rail over rows `y` of a frame [m], NaN beyond its ends. `place`: y, z and roll."""
    c, s = math.cos(place[2]), math.sin(place[2])
    turn = np.array([[c, -s], [s, c]])
    axes, to = frame.axes[1:, 1:] @ turn, frame.axes[1:, 1:] @ (np.array(place[:2]) - frame.origin[1:])
    here = turn.T @ (frame.origin[1:] - np.array(place[:2]))
    at = rail.length(float(here[0]), float(here[1])) + y
    for _ in range(_STEPS):
        at = np.clip(at, 0.0, rail.s[-1])
        points, rates = rail.at(at)
        miss = y - (axes[0] @ points + to[0])
        if float(np.abs(miss).max()) < _REST:
            break
        rate = axes[0] @ rates
        at = at + np.clip(miss / np.where(np.abs(rate) > 1e-3, rate, 1e-3), -2e-3, 2e-3)
    return np.asarray(np.where(np.abs(miss) < _MISSED, axes[1] @ points + to[1], np.nan))


def to_track(roll: float, yaw: float) -> Array:
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

    wheel: Outline
    radius: float
    frame: Frame
    turn: Array
    origin: Array

    def heights(self, s: Array, u: Array) -> Array:
        """Return the places x, y, z in the frame of the points at the length `s` of the profile and `u` along x [m]."""
        (y, z), _ = self.wheel.at(s)
        points = np.stack(np.broadcast_arrays(u, y, np.sqrt((self.radius + z) ** 2 - u**2) - self.radius), axis=-1)
        return np.asarray((points @ self.turn.T + (self.origin - self.frame.origin)) @ self.frame.axes.T)

    def under(self, x: Array, y: Array, start: tuple[float, float]) -> tuple[Array, Array]:
        """Return s and u of the points of the wheel at the places x, y of the frame."""
        s, u = start[0] + y, start[1] + x
        axes = (self.frame.axes @ self.turn)[:2]
        for _ in range(_STEPS):
            (_, z), (ys, zs) = self.wheel.at(s)
            down = np.sqrt((self.radius + z) ** 2 - u**2)
            by_s = axes[:, 1, None, None] * ys + axes[:, 2, None, None] * ((self.radius + z) * zs / down)
            by_u = axes[:, 0, None, None] - axes[:, 2, None, None] * (u / down)
            miss = np.stack((x, y)) - np.moveaxis(self.heights(s, u)[..., :2], -1, 0)
            if float(np.abs(miss).max()) < _REST:
                break
            step_s, step_u = _solved(by_s, by_u, miss)
            s, u = np.clip(s + np.clip(step_s, -2e-3, 2e-3), 0.0, self.wheel.s[-1]), u + np.clip(step_u, -2e-3, 2e-3)
        return s, u


class _Mesh(NamedTuple):
    """The mesh of a wheel that stands in the track: a node at `reference`, the steps along the profile and around."""

    wheel: Outline
    radius: float
    turn: Array
    origin: Array
    reference: tuple[float, float]
    steps: tuple[float, float]

    @classmethod
    def of(
        cls,
        pair: SurfacePair,
        pose: Pose,
        wheel: Outline,
        frame: Frame,
        steps: tuple[float, float],
        element: tuple[float, float],
    ) -> _Mesh:
        """Return the mesh with a node at the reference point of a frame, moved to the nearest `element` of the grid [m].

        `steps` are those around the wheel and along its profile [m].
        """
        mirror = 1.0 if pair.side == "right" else -1.0
        turn = to_track(mirror * pose.roll, mirror * pose.yaw)
        middle = np.array([0.0, mirror * pose.y, pair.z - pair.nominal_radius])
        origin = middle + turn @ np.array([0.0, pair.tape, pair.nominal_radius])
        here = turn.T @ (frame.origin - origin)  # the reference point, as the wheel's profile has it
        reference = (
            wheel.length(float(here[1]), float(here[2])) + _rest(element[1], steps[1]),
            float(here[0]) + _rest(element[0], steps[0]),
        )
        return cls(wheel, pair.nominal_radius, turn, origin, reference, steps)

    def distance(
        self, pair: SurfacePair, rail: Outline | None, frame: Frame, x: Array, y: Array, before: Array
    ) -> Array:
        """Return the distance of the rail from the mesh along the normal of a frame [m], `before` where they do not reach."""
        placed = _Placed(self.wheel, self.radius, frame, self.turn, self.origin)
        (s0, u0), (dx, step) = self.reference, self.steps
        s, u = placed.under(x, y, self.reference)
        i, j = (s - s0) / step, (u - u0) / dx
        rows, columns = (math.ceil(float(np.abs(k).max())) + 2 for k in (i, j))
        along, around = np.arange(-rows, rows + 1.0)[:, None], np.arange(-columns, columns + 1.0)
        nodes = placed.heights(s0 + step * along, u0 + dx * around)
        flat = _bilinear(nodes, x, y, i + rows, j + columns)
        if rail is None:
            h = before + placed.heights(s, u)[..., 2] - flat
        else:
            motion = pair.space.motion[0]
            h = _over(rail, y[:, 0], frame, (motion.rail_y, motion.rail_z, motion.rail_roll))[:, None] - flat
        return np.where(np.isfinite(h), h, before)


def _solved(first: Array, second: Array, right: Array) -> tuple[Array, Array]:
    """Return a and b with a·first + b·second = right."""
    across = first[0] * second[1] - first[1] * second[0]
    return (
        (right[0] * second[1] - right[1] * second[0]) / across,
        (first[0] * right[1] - first[1] * right[0]) / across,
    )


def _bilinear(nodes: Array, x: Array, y: Array, i: Array, j: Array) -> Array:
    """Return the heights at x, y between the nodes of a mesh, NaN where they are not found.

    `i` and `j` are about the places there, counted in nodes.
    """
    last = nodes.shape[0] - 2, nodes.shape[1] - 2
    for _ in range(_STEPS):
        a, b = (np.clip(np.floor(k).astype(np.int64), 0, most) for k, most in zip((i, j), last, strict=True))
        t, r = (i - a)[..., None], (j - b)[..., None]
        low, high = (1.0 - r) * nodes[a, b] + r * nodes[a, b + 1], (1.0 - r) * nodes[a + 1, b] + r * nodes[a + 1, b + 1]
        here, by_i = (1.0 - t) * low + t * high, high - low
        by_j = (1.0 - t) * (nodes[a, b + 1] - nodes[a, b]) + t * (nodes[a + 1, b + 1] - nodes[a + 1, b])
        miss = np.stack((x, y)) - np.moveaxis(here[..., :2], -1, 0)
        if float(np.abs(miss).max()) < _REST:
            break
        di, dj = _solved(np.moveaxis(by_i[..., :2], -1, 0), np.moveaxis(by_j[..., :2], -1, 0), miss)
        i, j = i + np.clip(di, -1.0, 1.0), j + np.clip(dj, -1.0, 1.0)
    return np.asarray(np.where(np.abs(miss).max(axis=0) < _MISSED, here[..., 2], np.nan))
