"""One patch of a solution as a mesh for drawing: outline, fields up to the edge, and the stick/slip boundary."""

from __future__ import annotations

import numpy as np

from contact.arrays import Array
from contact.plot.style import MM
from contact.results import Solution


class PatchMesh:
    """Patch `k` of a solution, lengths in millimetres. Arrays contain only the strips of this patch.

    Elements of a half space outside the patch are moved onto its outline. If the tangential method gives forces only, the
    mesh has only outline and pressure.
    """

    def __init__(self, solution: Solution, k: int) -> None:
        mask = solution.strips.patch == k
        self.y = MM * solution.strips.y[mask]
        self.centre, self.a = MM * solution.strips.x_c[mask], MM * solution.strips.a[mask]
        self.edges = MM * solution.patch_edges[k]
        back, front = (self.centre + sign * self.a for sign in (-1.0, 1.0))
        self.x = np.clip(MM * solution.x[mask], back[:, None], front[:, None])
        self.inside = solution.p[mask] > 0.0
        self.dA = np.where(self.inside, solution.dA[mask], 0.0)
        self.has_fields = solution.has_fields
        self._mask = mask
        if not self.has_fields:
            return
        self.stick = solution.stick[mask]
        self.qx, self.qy = solution.qx[mask], solution.qy[mask]
        self._slip = np.hypot(solution.sx[mask], solution.sy[mask])
        bound = solution.friction * solution.p[mask]
        self._reserve = np.maximum(1.0 - np.hypot(self.qx, self.qy) / np.where(bound > 0.0, bound, 1.0), 0.0)

    def of(self, field: Array) -> Array:
        """Return the part of a field of the solution that belongs to this patch."""
        return field[self._mask]

    def outline(self) -> tuple[Array, Array]:
        """Return the closed outline (y, x) [mm] through the ends of the strips and the edges of the patch."""
        y = np.r_[self.edges[0], self.y, self.edges[1]]
        centre, a = np.pad(self.centre, 1, mode="edge"), np.pad(self.a, 1)
        return np.r_[y, y[::-1]], np.r_[centre + a, (centre - a)[::-1]]

    def closed(self, values: Array, edge: float | None = None) -> tuple[Array, Array, Array]:
        """Return y, x and `values` with the outline added. The value there is `edge`, or the nearest value for None."""
        x = np.pad(self.x, 1, mode="edge")
        x[1:-1, 0], x[1:-1, -1] = self.centre + self.a, self.centre - self.a
        x[0], x[-1] = self.centre[0], self.centre[-1]
        y = np.repeat(np.r_[self.edges[0], self.y, self.edges[1]][:, None], x.shape[1], axis=1)
        return y, x, np.pad(values, 1, mode="edge") if edge is None else np.pad(values, 1, constant_values=edge)

    def slip_distance(self) -> Array:
        """Return the distance [mm] of each element from the stick/slip boundary along its strip, negative in the stick zone.

        On a strip without boundary it is the distance from the leading edge (all slip) or the trailing edge (all stick). The
        boundary moves there as the other zone vanishes.
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
        # elements outside the patch have the state of the nearest element inside
        n = self.x.shape[1]
        first, last = np.argmax(self.inside, axis=1), n - 1 - np.argmax(self.inside[:, ::-1], axis=1)
        nearest = np.clip(np.arange(n), first[:, None], last[:, None])
        return np.where(np.take_along_axis(self.stick, nearest, axis=1), -distance, distance)

    def _boundary(self, i: int, j: int) -> float:
        """Return x [mm] of the boundary between the centres of elements j and j + 1 of strip i.

        The squares of the slip and of the friction reserve 1 - |q|/(mu p) vanish linearly at the boundary (theory.md 2.4,
        4.3). Each is extrapolated from its two nearest elements, and the mean is returned.
        """
        x, zeros = self.x[i], []
        for near, beyond in ((j, j - 1), (j + 1, j + 2)):
            square = (self._reserve if self.stick[i, near] else self._slip)[i] ** 2
            if 0 <= beyond < x.size and square[beyond] > square[near]:
                zero = x[near] - square[near] * (x[beyond] - x[near]) / (square[beyond] - square[near])
                zeros.append(np.clip(zero, x[j + 1], x[j]))
        return float(np.mean(zeros)) if zeros else 0.5 * float(x[j] + x[j + 1])

    def labels(self, least_room: float = 0.0, least_share: float = 0.15) -> dict[str, tuple[float, float]]:
        """Return the positions (y, x) [mm] of the labels "stick" and "slip", at the widest place of each zone.

        A zone gets no label if its share of the area is below `least_share`, or if no point is further than `least_room`
        [mm] from its edge.
        """
        points = np.stack([np.repeat(self.y, self.x.shape[1]), self.x.ravel()])
        few = slice(None, None, 1 + points.shape[1] // 1000)
        stick, inside, dA = self.stick.ravel(), self.inside.ravel(), self.dA.ravel()
        places = {}
        for name, zone in (("stick", stick & inside), ("slip", ~stick & inside)):
            if dA[zone].sum() > least_share * dA.sum():
                candidates = points[:, zone][:, few]
                around = np.hstack([points[:, ~zone][:, few], self.outline()])
                room = np.hypot(*(candidates[:, :, None] - around[:, None, :])).min(axis=1)
                if room.max() >= least_room:
                    y, x = candidates[:, room.argmax()].tolist()
                    places[name] = (y, x)
        return places

    def arrows(self, spacing: float) -> Array:
        """Return rows y [mm], x [mm], q_y [Pa], q_x [Pa] on a square raster inside the patch."""
        columns = []
        for y in _raster(self.edges[0], self.edges[1], spacing):
            # interpolate between two strips at the same relative position along x
            i = int(np.clip(np.searchsorted(self.y, y) - 1, 0, self.y.size - 2))
            w = np.clip((y - self.y[i]) / (self.y[i + 1] - self.y[i]), 0.0, 1.0)
            along, qx, qy = ((1.0 - w) * f[i, ::-1] + w * f[i + 1, ::-1] for f in (self.x, self.qx, self.qy))
            x = _raster(along[0], along[-1], spacing)
            columns.append(np.stack([np.full(x.size, y), x, np.interp(x, along, qy), np.interp(x, along, qx)]))
        return np.hstack(columns)


def _raster(low: float, high: float, spacing: float) -> Array:
    """Return the points of an interval at multiples of `spacing` from its middle."""
    n = int(0.5 * (high - low) / spacing)
    return 0.5 * (low + high) + spacing * np.arange(-n, n + 1, dtype=np.float64)
