"""Contact search over surfaces: first touch, lobes of interpenetration, and the gap of each patch in its own frame.

The search compares heights on grids. A coarse grid of the track plane over all of the wheel finds where the bodies are close;
finer grids around these places give first touch and lobes. No assumption is made on where a surface is touched, so contact
may lie ahead of or behind the axle, at several places, and at the beginning of a nose.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.geometry.surfaces.frame import Frame, Heights, Placed, heights
from contact.halfspace.gap import Division, Gap

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Index = NDArray[np.int64]

_COARSE_X, _COARSE_Y = 2e-3, 0.5e-3  # [m] steps of the coarse grid
_SLACK = 60e-6  # [m] by which heights on the coarse grid may miss a lobe
_FINE = 61  # points along each side of a fine grid
_POWER = 2.0  # weight of a point: its depth to this power (search.lobes: depth^(5/2) when integrated along x)
_ZOOMS, _ZOOMED = 5, 15  # refinements of the least gap, and points along each side of their grids
_ABSENT = 1e-3  # [m] by which elements without a surface lie above the highest other one


@dataclass(frozen=True, eq=False)
class Lobe:
    """One region of interpenetration in track coordinates.

    Attributes
    ----------
    weight : sum of depth² times area [m⁴]
    moment, normal : the same sum of position (x, y) and of the rail's normal, shape (2,) and (3,)
    x, y : points of the region [m], shape (k,)
    z : height of the rail there [m]
    """

    weight: float
    moment: Array
    normal: Array
    x: Array
    y: Array
    z: Array

    def joined(self, other: Lobe) -> Lobe:
        """Return both lobes as one."""
        points = (np.concatenate((getattr(self, k), getattr(other, k))) for k in "xyz")
        return Lobe(self.weight + other.weight, self.moment + other.moment, self.normal + other.normal, *points)

    @property
    def angle(self) -> float:
        """Contact angle [rad]."""
        return math.atan2(-self.normal[1], self.normal[2])

    def apart(self, other: Lobe) -> tuple[float, float]:
        """Return the distance of the nearest points of two lobes [m], and the difference of their angles [rad]."""
        square = sum((getattr(self, k)[:, None] - getattr(other, k)) ** 2 for k in "xyz")
        return math.sqrt(float(np.min(square))), abs(self.angle - other.angle)


class Scene:
    """Wheel and rail at a pose with z = 0. Lowering the wheel by z changes the vertical gap by -z everywhere.

    Parameters
    ----------
    wheel, rail : Placed
        The wheel at z = 0.
    box : tuple of float
        x_low, x_high, y_low, y_high of the part of the track plane that is searched [m].
    """

    def __init__(self, wheel: Placed, rail: Placed, box: tuple[float, float, float, float]) -> None:
        self.wheel, self.rail = wheel, rail
        middle = 0.5 * (box[2] + box[3])
        self._frame = Frame.about_x(np.array([0.0, middle, 0.0]), 0.0)
        self._middle = middle
        self.x = _steps(box[0], box[1], _COARSE_X)
        self.y = _steps(box[2], box[3], _COARSE_Y)
        self.gap = self._heights(self.x, self.y)[0]
        self._grids: dict[tuple[float, float, float, float], tuple[Array, Array, Array, Heights]] = {}
        self.overlaps = bool(np.isfinite(self.gap).any())

    @property
    def reaches_out(self) -> bool:
        """Whether the gap still falls towards the front or the back of the box, so that contact may lie beyond."""
        least = self.gap.min(axis=0)
        return bool(least[0] < least[2] or least[-1] < least[-3])

    def _heights(self, x: Array, y: Array) -> tuple[Array, Heights]:
        """Return the vertical gap [m] on a grid of the track plane, infinite where a body is absent, and the rail."""
        rail = heights(self.rail, self._frame, x, y - self._middle, deepest=False)
        wheel = heights(self.wheel, self._frame, x, y - self._middle, deepest=True)
        gap = rail.z - wheel.z
        return np.where(np.isfinite(gap), gap, np.inf), rail

    def _fine(self, box: tuple[float, float, float, float]) -> tuple[Array, Array, Array, Heights]:
        """Return x, y, gap and rail on a fine grid over a box. They do not depend on z, so grids are kept."""
        if box not in self._grids:
            x, y = np.linspace(*box[:2], _FINE), np.linspace(*box[2:], _FINE)
            self._grids[box] = (x, y, *self._heights(x, y))
        return self._grids[box]

    def touch(self) -> float:
        """Return z [m] at which the rigid wheel just touches."""
        least = math.inf
        bound = float(self.gap.min()) + _SLACK
        for rows, columns in _regions(self.gap < bound):
            k = int(np.argmin(self.gap[rows, columns]))
            x, y, reach = float(self.x[columns[k]]), float(self.y[rows[k]]), (2.0 * _COARSE_X, 2.0 * _COARSE_Y)
            for _ in range(_ZOOMS):
                grid = (np.linspace(at - r, at + r, _ZOOMED) for at, r in zip((x, y), reach, strict=True))
                fine_x, fine_y = grid
                gap = self._heights(fine_x, fine_y)[0]
                if not np.isfinite(gap).any():
                    break
                i, j = np.unravel_index(int(np.argmin(gap)), gap.shape)
                least = min(least, float(gap[i, j]))
                x, y, reach = float(fine_x[j]), float(fine_y[i]), (reach[0] / 5.0, reach[1] / 5.0)
        return least

    def lobes(self, z: float) -> list[Lobe]:
        """Return the regions in which the wheel, lowered by z [m], lies inside the rail, from the field side to the flange."""
        found = []
        for rows, columns in _regions(self.gap < z + _SLACK):
            box = (
                float(self.x[columns.min()]) - _COARSE_X,
                float(self.x[columns.max()]) + _COARSE_X,
                float(self.y[rows.min()]) - _COARSE_Y,
                float(self.y[rows.max()]) + _COARSE_Y,
            )
            fine_x, fine_y, gap, _ = self._fine(box)
            for i, j in _regions(gap < z):
                found += self._measured(fine_x, fine_y, i, j, z)
        return sorted(found, key=lambda lobe: -lobe.moment[1] / lobe.weight)

    def _measured(self, x: Array, y: Array, i: Index, j: Index, z: float) -> list[Lobe]:
        """Return the lobe at the points (i, j) of a grid, measured on a grid of its own."""
        dx, dy = float(x[1] - x[0]), float(y[1] - y[0])
        box = (float(x[j.min()]) - dx, float(x[j.max()]) + dx, float(y[i.min()]) - dy, float(y[i.max()]) + dy)
        fine_x, fine_y, gap, rail = self._fine(box)
        regions = _regions(gap < z)
        if not regions:
            return []
        rows, columns = max(regions, key=lambda region: region[0].size)
        weight = (z - gap[rows, columns]) ** _POWER * (fine_x[1] - fine_x[0]) * (fine_y[1] - fine_y[0])
        at = fine_x[columns], fine_y[rows]
        return [
            Lobe(
                float(weight.sum()),
                np.array([at[0] @ weight, at[1] @ weight]),
                rail.normal[:, rows, columns] @ weight,
                *at,
                rail.z[rows, columns],
            )
        ]

    def frame(self, lobe: Lobe, tilted: bool) -> Frame:
        """Return the contact frame of a lobe. Its origin is the point of the rail at the weighted mean of the lobe."""
        x, y = lobe.moment / lobe.weight
        z = self._heights(np.array([x]), np.array([y]))[1].z[0, 0]
        if not math.isfinite(z):  # in a notch of the surface
            z = float(lobe.z.mean())
        origin = np.array([x, y, z])
        return Frame.along_normal(origin, lobe.normal) if tilted else Frame.about_x(origin, lobe.angle)


def combined(lobes: list[Lobe], distance: float, angle: float) -> list[Lobe]:
    """Return the lobes, joined where they are no further apart than `distance` [m] and differ by no more than `angle` [rad]."""
    joined = list(lobes)
    k = 1
    while k < len(joined):
        between, turn = joined[k - 1].apart(joined[k])
        if between > distance or turn > angle:
            k += 1
            continue
        joined[k - 1 : k + 1] = [joined[k - 1].joined(joined[k])]
        k = 1
    return joined


def sample(wheel: Placed, rail: Placed, frame: Frame, lobe: Lobe, division: Division) -> tuple[Gap, float] | None:
    """Return the gap of a patch with its least value at 0, and the approach [m] at the pose; None without overlap.

    `wheel` is at its true height. The grid covers the overlap. Elements where a body is absent get a gap above all others.
    """
    x, y, _ = frame.local(np.stack((lobe.x, lobe.y, lobe.z)))
    box = (float(x.min()), float(x.max()), float(y.min()), float(y.max()))
    if division.spacing is None:
        division = division._replace(spacing=(_step(box[0], box[1], division.columns), _step(*box[2:], division.rows)))
    centres = division.centres(box)
    gap = heights(rail, frame, *centres, deepest=False).z - heights(wheel, frame, *centres, deepest=True).z
    present = np.isfinite(gap)
    if not present.any() or not gap[present].min() < 0.0:
        return None
    approach = -float(gap[present].min())
    gap = np.where(present, gap, gap[present].max() + _ABSENT) + approach
    return Gap(*centres, gap), approach


def _step(low: float, high: float, n: int) -> float:
    """Return a size of elements [m] of which about `n` cover low … high: a power of 2^(1/4).

    So the elements keep their places in the frame when the overlap grows a little, and forces do not jump.
    """
    return float(2.0 ** (0.25 * math.floor(4.0 * math.log2(max(high - low, 1e-7) / n))))


def _steps(low: float, high: float, step: float) -> Array:
    return np.linspace(low, high, max(math.ceil((high - low) / step), 2) + 1)


def _regions(mask: Mask) -> list[tuple[Index, Index]]:
    """Return rows and columns of the connected regions of true values; neighbours may be diagonal."""
    if not mask.any():
        return []
    i, j = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    part = mask[i[0] : i[-1] + 1, j[0] : j[-1] + 1]
    label = np.where(part, np.arange(1, part.size + 1).reshape(part.shape), 0)
    while True:
        wide = np.pad(label, 1)
        rows = np.maximum(np.maximum(wide[:-2], wide[1:-1]), wide[2:])
        spread = np.where(part, np.maximum(np.maximum(rows[:, :-2], rows[:, 1:-1]), rows[:, 2:]), 0)
        if (spread == label).all():
            break
        label = spread
    found = (np.nonzero(label == k) for k in np.unique(label[part]))
    return [(rows + i[0], columns + j[0]) for rows, columns in found]
