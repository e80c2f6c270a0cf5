"""One patch of a solution as a mesh for drawing: its outline, its fields up to the edge, the line between stick and slip."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact.plot.style import MM
from contact.solution import Solution

Array = NDArray[np.float64]


class PatchMesh:
    """Patch `k` of a solution, lengths in millimetres; arrays have the strips of this patch alone.

    Elements of a half space that lie outside the patch are drawn onto its outline. Of a tangential method that gives forces
    alone there are the outline and the pressure.
    """

    def __init__(self, solution: Solution, k: int) -> None:
        own = solution.strips.patch == k
        self.y = MM * solution.strips.y[own]
        self.centre, self.a = MM * solution.strips.x_c[own], MM * solution.strips.a[own]
        self.edges = MM * solution.patch_edges[k]
        back, front = (self.centre + sign * self.a for sign in (-1.0, 1.0))
        self.x = np.clip(MM * solution.x[own], back[:, None], front[:, None])
        self.inside = solution.p[own] > 0.0
        self.dA = np.where(self.inside, solution.dA[own], 0.0)
        self.has_fields = solution.has_fields
        self._own = own
        if not self.has_fields:
            return
        self.stick = solution.stick[own]
        self.qx, self.qy = solution.qx[own], solution.qy[own]
        self._slip = np.hypot(solution.sx[own], solution.sy[own])
        bound = solution.friction * solution.p[own]
        self._reserve = np.maximum(1.0 - np.hypot(self.qx, self.qy) / np.where(bound > 0.0, bound, 1.0), 0.0)

    def of(self, field: Array) -> Array:
        """The part of a field of the solution that belongs to this patch."""
        return field[self._own]

    def outline(self) -> tuple[Array, Array]:
        """Closed outline (y, x): half lengths of the strips, and the edges, where they vanish."""
        y = np.r_[self.edges[0], self.y, self.edges[1]]
        centre, a = np.pad(self.centre, 1, mode="edge"), np.pad(self.a, 1)
        return np.r_[y, y[::-1]], np.r_[centre + a, (centre - a)[::-1]]

    def closed(self, values: Array, edge: float | None = None) -> tuple[Array, Array, Array]:
        """y, x and `values` with the outline added, where the value is `edge` (None: the nearest one)."""
        x = np.pad(self.x, 1, mode="edge")
        x[1:-1, 0], x[1:-1, -1] = self.centre + self.a, self.centre - self.a
        x[0], x[-1] = self.centre[0], self.centre[-1]
        y = np.repeat(np.r_[self.edges[0], self.y, self.edges[1]][:, None], x.shape[1], axis=1)
        return y, x, np.pad(values, 1, mode="edge") if edge is None else np.pad(values, 1, constant_values=edge)

    def slip_distance(self) -> Array:
        """Distance of each element from the stick/slip boundary along its strip, negative in the stick zone.

        On a strip without boundary it is that from the leading edge (all slip) or the trailing edge (all stick), to which
        the boundary moves as either zone vanishes.
        """
        distance = np.empty(self.x.shape)
        for i, (x, stick, inside) in enumerate(zip(self.x, self.stick, self.inside, strict=True)):
            changes = np.flatnonzero((stick[1:] != stick[:-1]) & inside[1:] & inside[:-1])
            if changes.size:
                boundaries = np.array([self._boundary(i, int(j)) for j in changes])
            else:
                sticks = bool(stick[inside].any())
                boundaries = np.array([self.centre[i] + (-self.a[i] if sticks else self.a[i])])
            distance[i] = np.abs(x[:, None] - boundaries).min(axis=1)
        # elements outside go with the nearest one inside
        n = self.x.shape[1]
        first, last = np.argmax(self.inside, axis=1), n - 1 - np.argmax(self.inside[:, ::-1], axis=1)
        nearest = np.clip(np.arange(n), first[:, None], last[:, None])
        return np.where(np.take_along_axis(self.stick, nearest, axis=1), -distance, distance)

    def _boundary(self, i: int, j: int) -> float:
        """Where the boundary lies between the centres of elements j and j + 1 of strip i.

        Squared, both the slip and the reserve of friction 1 - |q|/(mu p) vanish there linearly (theory.md 2.4, 4.3):
        either is extrapolated from its two nearest elements and the mean is taken.
        """
        x, found = self.x[i], []
        for near, beyond in ((j, j - 1), (j + 1, j + 2)):
            square = (self._reserve if self.stick[i, near] else self._slip)[i] ** 2
            if 0 <= beyond < x.size and square[beyond] > square[near]:
                zero = x[near] - square[near] * (x[beyond] - x[near]) / (square[beyond] - square[near])
                found.append(np.clip(zero, x[j + 1], x[j]))
        return float(np.mean(found)) if found else 0.5 * float(x[j] + x[j + 1])

    def labels(self, least_room: float = 0.0, least_share: float = 0.15) -> dict[str, tuple[float, float]]:
        """Where (y, x) to write "stick" and "slip": the widest place of each zone.

        Zones with less than `least_share` of the area, or nowhere further than `least_room` from their edge, get none.
        """
        points = np.stack([np.repeat(self.y, self.x.shape[1]), self.x.ravel()])
        few = slice(None, None, 1 + points.shape[1] // 1000)
        stick, inside, dA = self.stick.ravel(), self.inside.ravel(), self.dA.ravel()
        places = {}
        for name, zone in (("stick", stick & inside), ("slip", ~stick & inside)):
            if dA[zone].sum() > least_share * dA.sum():
                own = points[:, zone][:, few]
                around = np.hstack([points[:, ~zone][:, few], self.outline()])
                room = np.hypot(*(own[:, :, None] - around[:, None, :])).min(axis=1)
                if room.max() >= least_room:
                    y, x = own[:, room.argmax()].tolist()
                    places[name] = (y, x)
        return places

    def arrows(self, spacing: float) -> Array:
        """Rows y, x, q_y, q_x on a square raster inside the patch."""
        columns = []
        for y in _raster(self.edges[0], self.edges[1], spacing):
            # between two strips at the same relative place along x
            i = int(np.clip(np.searchsorted(self.y, y) - 1, 0, self.y.size - 2))
            w = np.clip((y - self.y[i]) / (self.y[i + 1] - self.y[i]), 0.0, 1.0)
            along, qx, qy = ((1.0 - w) * f[i, ::-1] + w * f[i + 1, ::-1] for f in (self.x, self.qx, self.qy))
            x = _raster(along[0], along[-1], spacing)
            columns.append(np.stack([np.full(x.size, y), x, np.interp(x, along, qy), np.interp(x, along, qx)]))
        return np.hstack(columns)


def _raster(low: float, high: float, spacing: float) -> Array:
    """Points at multiples of `spacing` from the middle of an interval, inside it."""
    n = int(0.5 * (high - low) / spacing)
    return 0.5 * (low + high) + spacing * np.arange(-n, n + 1, dtype=np.float64)
