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
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.geometry.surfaces.frame import Frame
from contact.halfspace import Gap
from contact.inp.nodes import REST, STEPS, bilinear, solved
from contact.inp.outline import Outline, Outlines, standing
from contact.inp.rail import Rail
from contact.inp.sliced import distance as sliced_distance

#: Points of a spline for each point of a profile.
_FINE = 20


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
    across, before = gap.y if right else -gap.y[order], (gap.h - patch.approach)[order]
    if bodies.wheel is None:
        h = sliced_distance(pair, pose, Rail(pair, bodies), frame, gap.x, across)
        return with_distance(patch, np.where(np.isfinite(h), h, before)[order])
    x, y = np.meshgrid(gap.x, across)
    mesh = _Mesh.of(pair, pose, bodies.wheel, frame, (gap.dx, step), (x[0, 0], y[0, 0]))
    return with_distance(patch, mesh.distance(pair, bodies, frame, x, y, before)[order])


def distance(
    pair: SurfacePair, pose: Pose, bodies: Outlines, frame: Frame, x: Array, y: Array, s: Array, step: float
) -> Array:
    """Return CONTACT's distance between the rail and the mesh of a round wheel over rows `y` of a frame of the right side [m].

    NaN where they do not reach. `s` are the lengths of the rows along the profile, `step` is as for `flattened`.
    """
    if bodies.wheel is None:
        return np.full((y.size, x.size), np.nan)
    mesh = _Mesh.of(pair, pose, bodies.wheel, frame, (float(x[1] - x[0]), step), (float(x[0]), float(s[0])))
    grid_x, grid_y = np.meshgrid(x, y)
    return mesh.distance(pair, bodies, frame, grid_x, grid_y, np.full(grid_x.shape, np.nan))


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
        """Return s and u of the points of the wheel at the places x, y of the frame, or near them where it has none."""
        s, u = start[0] + y, start[1] + x
        axes = (self.frame.axes @ self.turn)[:2]
        for _ in range(STEPS):
            (_, z), (ys, zs) = self.wheel.at(s)
            down = np.sqrt((self.radius + z) ** 2 - u**2)
            by_s = axes[:, 1, None, None] * ys + axes[:, 2, None, None] * ((self.radius + z) * zs / down)
            by_u = axes[:, 0, None, None] - axes[:, 2, None, None] * (u / down)
            miss = np.stack((x, y)) - np.moveaxis(self.heights(s, u)[..., :2], -1, 0)
            if float(np.abs(miss).max()) < REST:
                break
            step_s, step_u = solved(by_s, by_u, miss)
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
        turn, origin = standing(pair, pose)
        here = turn.T @ (frame.origin - origin)  # the reference point, as the wheel's profile has it
        reference = (
            wheel.length(float(here[1]), float(here[2])) + _rest(element[1], steps[1]),
            float(here[0]) + _rest(element[0], steps[0]),
        )
        return cls(wheel, pair.nominal_radius, turn, origin, reference, steps)

    def distance(self, pair: SurfacePair, bodies: Outlines, frame: Frame, x: Array, y: Array, before: Array) -> Array:
        """Return the distance of the rail from the mesh along the normal of a frame [m], `before` where they do not reach."""
        placed = _Placed(self.wheel, self.radius, frame, self.turn, self.origin)
        (s0, u0), (dx, step) = self.reference, self.steps
        s, u = placed.under(x, y, self.reference)
        i, j = (s - s0) / step, (u - u0) / dx
        rows, columns = (math.ceil(float(np.abs(k).max())) + 2 for k in (i, j))
        along, around = np.arange(-rows, rows + 1.0)[:, None], np.arange(-columns, columns + 1.0)
        nodes = placed.heights(s0 + step * along, u0 + dx * around)
        flat = bilinear(nodes, x, y, i + rows, j + columns)
        h = Rail(pair, bodies).ground(frame, x[0], y[:, 0]) - flat
        return np.where(np.isfinite(h), h, before)
