"""The undeformed distance of a wheel with slices as CONTACT forms it: from a mesh that is interpolated bicubically.

The mesh has the paths of the slices, and steps of about DX around the axle.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.geometry.records import Pose
from contact.geometry.surfaces import SurfacePair, WheelSurface
from contact.geometry.surfaces.frame import Frame
from contact.inp.nodes import bicubic
from contact.inp.outline import standing
from contact.inp.rail import Rail

#: [m] by which the mesh reaches beyond the elements, and how far off the plane of the contact its paths may lie.
BESIDE, _OFF = 5e-3, 0.03


class SlicedWheel(NamedTuple):
    """A wheel with slices that stands in the track. All in right-side form."""

    wheel: WheelSurface
    radius: float
    rotation: float
    turn: Array
    origin: Array

    @classmethod
    def of(cls, pair: SurfacePair, pose: Pose) -> SlicedWheel:
        """Return the wheel of a pair where the last search has left it."""
        return cls(pair.wheel, pair.nominal_radius, float(pair.space.motion[0].rotation), *standing(pair, pose))

    def nodes(self, theta: Array, frame: Frame) -> Array:
        """Return x, y, z in a frame of the points at the angles `theta` ahead of the lowest line [rad].

        The shape is (path, angle, 3).
        """
        y, rise = self.wheel.curves(theta - self.rotation)
        r, at = self.radius + rise, theta[:, None]
        points = np.stack((r * np.sin(at), y, r * np.cos(at) - self.radius), axis=-1)
        placed = (points @ self.turn.T + (self.origin - frame.origin)) @ frame.axes.T
        return np.asarray(np.moveaxis(placed, 0, 1))

    def heights(self, frame: Frame, x: Array, y: Array) -> Array:
        """Return the heights at the centres of elements of a frame [m], NaN where the mesh does not reach."""
        dx, dy = float(x[1] - x[0]), float(y[1] - y[0])
        corners = np.array(
            [
                frame.origin + a * frame.axes[0] + b * frame.axes[1]
                for a in (x[0] - 0.5 * dx, x[-1] + 0.5 * dx)
                for b in (y[0] - 0.5 * dy, y[-1] + 0.5 * dy)
            ]
        )
        local = (corners - self.origin) @ self.turn
        lowest = self.radius + local[:, 2].min() - dy * abs(frame.axes[1, 2])
        start = math.atan((local[:, 0].min() - 2.0 * dx) / lowest)
        end = math.atan((local[:, 0].max() + 2.0 * dx) / lowest)
        count = odd(math.floor((end - start) * self.radius / dx + 0.5) + 2.0)
        nodes = near(self.nodes(np.linspace(start, end, count), frame), y)
        grid_x, grid_y = np.meshgrid(x, y)
        return bicubic(nodes, grid_x, grid_y, *about(nodes, x, y))


def distance(pair: SurfacePair, pose: Pose, rail: Rail, frame: Frame, x: Array, y: Array) -> Array:
    """Return the distance of a rail from the mesh of a wheel with slices along the normal of a frame [m]."""
    return rail.heights(frame, x, y) - SlicedWheel.of(pair, pose).heights(frame, x, y)


def near(nodes: Array, y: Array) -> Array:
    """Return the rows of a mesh, of shape (row, column, 3), that lie near the places `y` across, and one beyond."""
    middle = nodes[:, nodes.shape[1] // 2]
    kept = np.flatnonzero((middle[:, 1] > y[0] - BESIDE) & (middle[:, 1] < y[-1] + BESIDE) & (abs(middle[:, 2]) < _OFF))
    return nodes[kept[0] : kept[-1] + 1]


def about(nodes: Array, x: Array, y: Array) -> tuple[Array, Array]:
    """Return about at which row and column of a mesh the places of a grid lie, each of shape (y, x)."""
    rows, columns = nodes[:, nodes.shape[1] // 2, 1], nodes[nodes.shape[0] // 2, :, 0]
    order = np.argsort(rows)
    i = np.interp(y, rows[order], order.astype(np.float64))
    j = np.interp(x, columns, np.arange(columns.size, dtype=np.float64))
    return np.broadcast_to(i[:, None], (y.size, x.size)), np.broadcast_to(j, (y.size, x.size))


def odd(count: float) -> int:
    """Return the nearest number, made odd."""
    n = math.floor(count + 0.5)
    return n + 1 if n % 2 == 0 else n
