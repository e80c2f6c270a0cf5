"""Where CONTACT puts the patches that the search of the surfaces has found: its reference points are not quite theirs.

They are means over the overlap, weighted with the vertical depth squared, and so are contact angles, for which the outline of
the rail at the wheelset counts. CONTACT takes the largest depth of each row, and the wheel's curvature for that of the depth
along the track. With D = 5, 6 and 9, and for wheels with slices, it looks at a coarse mesh: the wheel is sampled at the points
of its profile and every 1.5 DX along, or at the paths of its slices and every 4 DX around, and interpolated bilinearly on a
grid with steps of 3/4 DS across. The points are some hundredths of a millimetre off those of the surfaces, and at the edge of a
flat the elements see another pressure.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.geometry.records import Pose
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.geometry.surfaces.frame import Frame
from contact.halfspace import Gap
from contact.halfspace.lattice import Lattice
from contact.inp.case import Case
from contact.inp.lobes import reaches_over, zero
from contact.inp.nodes import bilinear
from contact.inp.outline import Outlines, standing
from contact.inp.rail import Rail
from contact.inp.sliced import SlicedWheel, about, near, odd
from contact.inputs.creepage import Creepage
from contact.instance.ownership import within
from contact.kernels.geometry.section import AWAY

#: A wheel with slices: half of the angle that is searched [rad], and the steps around it over DX.
_HALF, _AROUND = 0.2, 4.0
#: A round wheel: half of the length that is searched over its radius, that for steep slopes and small wheels, and the radius
#: of these [m]; steps along it over DX.
_LENGTH, _LONG, _SMALL, _ALONG = 0.125, 0.242, 0.0305, 1.5
#: Steps across over DS: of the mesh, the same for steep slopes, and without a mesh.
_ACROSS, _STEEP, _FINE = 0.75, 0.3, 0.3
#: [m] by which the search of a mesh looks beyond a patch; least weight of a place [m²].
_BEYOND, _LEAST = 3e-3, 1e-16
_ABSENT = 1e-3  # [m] by which elements without a rail lie above the highest other one


#: Number of elements along a side that is not made less, and most doublings.
_FEW, _DOUBLED = 10, 20
Box = tuple[float, float, float, float]


class Found(NamedTuple):
    """Where CONTACT puts a patch.

    Attributes
    ----------
    at : reference point in the track, on the rail [m]
    angle : contact angle [rad]
    weight : of the overlap, for means over patches
    along : range of x [m]
    ends : places (y, z) on the rail where the overlap begins and ends across, shape (2, 2) [m]
    """

    at: Array
    angle: float
    weight: float
    along: tuple[float, float]
    ends: Array


class Search:
    """CONTACT's search at the height of the last one. All in right-side form."""

    def __init__(self, pair: SurfacePair, pose: Pose, bodies: Outlines, case: Case) -> None:
        self.pair, self.pose, self.wheel, self.case = pair, pose, bodies.wheel, case
        self.rail = Rail(pair, bodies)
        self.on_mesh = bodies.wheel is None or case["SEARCH"] in (5, 6, 9)
        self.steps: tuple[float, float] = case["DX"], case["DS"]

    @property
    def by_lobe(self) -> bool:
        """Whether each lobe counts for itself until it is joined with others; else those of a patch are one."""
        return not self.on_mesh and self.rail.straight

    def patches(self, patches: Sequence[SurfacePatch]) -> list[SurfacePatch]:
        """Return the patches of CONTACT on its elements; `patches` are those that the library's search has found."""
        limits = self.case["D_SEP"], self.case["D_TURN"], self.case["A_SEP"]
        if not self.by_lobe:  # parts of a patch that lie further apart than D_SEP stand among the patches, too
            patches = [p for p in patches if p.share == 1.0 or not reaches_over(p.gap, p.approach, limits[0])]
        found = [one for patch in patches for one in self._found(patch)]
        if self.by_lobe:
            found = joined(found, (limits[0], limits[2]), self._height)
        placed = (
            self._placed(one._replace(angle=angle)) for one, angle in zip(found, turned(found, limits), strict=True)
        )
        return [patch for patch in placed if patch is not None]

    def _found(self, patch: SurfacePatch) -> list[Found]:
        """Return where the search puts a patch, or each of its lobes; none if it misses it."""
        mirror = 1.0 if self.pair.side == "right" else -1.0
        seen = patch.frame if mirror > 0.0 else patch.frame.mirrored
        inside = (patch.gap.h < patch.approach).any(axis=1)
        rows = np.sort(mirror * patch.gap.y[inside])
        heights = np.nan_to_num(self._heights(seen, rows))
        rows = rows * seen.axes[1, 1] + heights * seen.axes[2, 1]
        view = Frame.turned(seen.origin * [0.0, 1.0, 1.0], 0.0)
        beyond = _BEYOND if self.on_mesh else 2.0 * self.steps[1]
        box = float(rows.min()) - beyond, float(rows.max()) + beyond
        columns = seen.origin[0] + patch.gap.x
        x, y, depth = self._by_mesh(view, box, columns) if self.on_mesh else self._by_surfaces(view, box, columns)
        touching = depth > 0.0
        runs = np.flatnonzero(touching.any(axis=1))
        if runs.size == 0:
            return []
        power = 1.0 if self.case.digits["WEIGHTING"] == 1 else 2.0
        slopes = np.nan_to_num(self.rail.slopes(view, y))
        found = []
        for i in np.split(runs, np.flatnonzero(np.diff(runs) > 1) + 1) if self.by_lobe else [runs]:
            if self.on_mesh:
                weight = np.where(touching[i], np.maximum(depth[i] ** power, _LEAST), 0.0)
                k, by_row, means = np.flatnonzero(touching[i].any(axis=0)), weight.sum(axis=1), weight @ x
                along = float(x[max(k[0] - 1, 0)]), float(x[min(k[-1] + 1, x.size - 1)])
                across = y[[max(i[0] - 1, 0), min(i[-1] + 1, y.size - 1)]]
            else:
                at, most = _highest(x, depth)
                half = np.sqrt(np.maximum(most[i], 0.0) / self._curvature)
                by_row = np.maximum(most[i], 0.0) ** power * half  # the integral over x of a parabola, or of its square
                means = by_row * at[i]
                along = float((at[i] - half).min()), float((at[i] + half).max())
                across = np.array([zero(y, -most, i[0] - 1, i[0]), zero(y, -most, i[-1] + 1, i[-1])])
            total = float(by_row.sum())
            mean = float(means.sum()) / total, float((by_row * y[i]).sum()) / total
            one = self._finished(view, mean, float((by_row * slopes[i]).sum()) / total, total, along, across)
            found += [] if one is None else [one]
        return found

    @property
    def _curvature(self) -> float:
        """Half the curvature along the track, which CONTACT takes for that of the depth [1/m]."""
        return 0.5 / self.pair.nominal_radius + (0.0 if self.rail.roller is None else 0.5 / self.rail.roller)

    def _by_surfaces(self, view: Frame, box: tuple[float, float], columns: Array) -> tuple[Array, Array, Array]:
        """Return x, y of a grid in a view and the depth there, that of the surfaces [m]."""
        y = _multiples(self.rail.first(view, 0), _FINE * self.steps[1], box)
        step = _ALONG * self.steps[0]
        x = _multiples(0.0, step, (columns[0] - step, columns[-1] + step))
        return x, y, -within(self.pair.distance)(view, x, y)

    def _heights(self, frame: Frame, y: Array) -> Array:
        """Return the heights of the rail over the axis x = 0 of a frame [m]."""
        return self.rail.heights(frame, np.zeros(1), y)[:, 0]

    def _height(self, x: float, y: float) -> float:
        """Return the height of the rail at a place of the track [m]."""
        whole = Frame(np.array([x, *self.rail.place[:2]]), np.eye(3))
        crown = np.interp(y - whole.origin[1], *self.rail.top(whole))
        view = Frame(np.array([x, y, whole.origin[2] + float(crown)]), np.eye(3))
        return float(view.origin[2] + self._heights(view, np.zeros(1))[0])

    def _finished(
        self,
        view: Frame,
        at: tuple[float, float],
        angle: float,
        weight: float,
        along: tuple[float, float],
        across: Array,
    ) -> Found | None:
        """Return what was found from places of a view; None where the rail ends."""
        over = Frame(np.array([at[0], *view.origin[1:]]), view.axes)
        z = self._heights(over, np.array([at[1], *across]))
        if not np.isfinite(z).all():
            return None
        ends = np.stack((across, z[1:]), axis=1) + view.origin[1:]
        return Found(over.origin + np.array([0.0, at[1], z[0]]), angle, weight, along, ends)

    def _by_mesh(self, view: Frame, box: tuple[float, float], columns: Array) -> tuple[Array, Array, Array]:
        """Return the same of a mesh of the wheel."""
        steep = self.case["SEARCH"] == 6
        y = _multiples(self.rail.first(view, 1), (_STEEP if steep else _ACROSS) * self.steps[1], box)
        whole = self._nodes(view, steep)
        x = np.linspace(float(whole[..., 0].min()), float(whole[..., 0].max()), whole.shape[1])
        more = 3.0 * (x[1] - x[0]) + _BEYOND
        x = x[(x > columns[0] - more) & (x < columns[-1] + more)]
        nodes = near(whole, y)
        grid_x, grid_y = np.meshgrid(x, y)
        depth = bilinear(nodes, grid_x, grid_y, *about(nodes, x, y)) - self.rail.heights(view, x, y)
        return x, y, np.where(np.isfinite(depth), depth, 0.0)

    def _nodes(self, view: Frame, steep: bool) -> Array:
        """Return the nodes of the wheel's mesh in a view, shape (row, column, 3) [m]."""
        radius, dx = self.pair.nominal_radius, self.steps[0]
        if self.wheel is None:
            angles = np.linspace(-_HALF, _HALF, odd(2.0 * _HALF * radius / (_AROUND * dx) + 2.0))
            return SlicedWheel.of(self.pair, self.pose).nodes(angles, view)
        half = (_LONG if steep or radius < _SMALL else _LENGTH) * radius
        turn, origin = standing(self.pair, self.pose)
        u = np.linspace(-half, half, odd(2.0 * half / (_ALONG * dx) + 2.0))
        y, z = self.wheel.points.T[..., None]
        points = np.stack(np.broadcast_arrays(u, y, np.sqrt((radius + z) ** 2 - u**2) - radius), axis=-1)
        return np.asarray((points @ turn.T + (origin - view.origin)) @ view.axes.T)

    def _placed(self, found: Found) -> SurfacePatch | None:
        """Return a patch on CONTACT's elements where it was found; None without overlap."""
        frame = Frame.turned(found.at, found.angle)
        across = np.sort((found.ends - frame.origin[1:]) @ frame.axes[1, 1:])
        (back, front), (low, high) = np.array(found.along) - found.at[0], across
        edges = float(back), float(front), float(low), float(high)
        division, box = self._division(found, edges)
        x, y = division.centres(box)
        h = within(self.pair.distance)(frame, x, y)
        far = division.clear(box, x, y, h, AWAY)
        if not h.min() < 0.0:
            return None
        present = h < AWAY
        gap = Gap(x, y, np.where(present, h, AWAY if far else h[present].max() + _ABSENT))
        approach, right = -float(gap.h.min()), self.pair.side == "right"
        h = gap.h + approach
        seen = frame if right else frame.mirrored
        place = seen.origin + approach * seen.axes[2]
        on_rail = self._on_rail(found)
        turn, origin = standing(self.pair, self.pose)
        local = turn.T @ (frame.origin + approach * frame.axes[2] - origin)
        radius = math.hypot(local[0], local[2] + self.pair.nominal_radius)
        return SurfacePatch(
            gap=Gap(gap.x, gap.y, h) if right else Gap(gap.x, -gap.y[::-1], h[::-1]),
            approach=approach,
            frame=seen,
            angle=frame.turn[0] if right else -frame.turn[0],
            position=(float(seen.origin[0]), float(seen.origin[1]), float(seen.origin[2])),
            wheel_position=(float(place[0]), float(place[1]), float(place[2])),
            on_rail=on_rail,
            on_wheel=(float(local[1]), radius - self.pair.nominal_radius),
            rolling_radius=radius,
            share=1.0,
            creepage=Creepage(),
        )

    def _division(self, found: Found, edges: Box) -> tuple[Lattice, Box]:
        """Return the elements, and the range that they cover: one element more than the overlap on each side.

        In steps they are those of the last one, else one lies at the reference point. There elements are doubled until there
        are less than NPOT_MAX.
        """
        division, (dx, ds) = self.pair.division, self.steps
        if isinstance(division, Lattice) and self.case.digits["T"] in (1, 2):
            station = float(self.pair.space.motion[0].station)
            placed = division.placed(station + float(found.at[0]), self._on_rail(found)[0])
            return placed, _wider(edges, dx, ds)
        for _ in range(_DOUBLED):
            lattice, box = Lattice.centred((dx, ds)), _wider(edges, dx, ds)
            columns, rows = (
                math.ceil(box[k + 1] / step) - math.floor(box[k] / step) + 1 for k, step in ((0, dx), (2, ds))
            )
            if columns * rows < self.case["NPOT_MAX"] or max(columns, rows) <= _FEW:
                break
            dx, ds = dx * (2.0 if columns > _FEW else 1.0), ds * (2.0 if rows > _FEW else 1.0)
        return lattice, box

    def _on_rail(self, found: Found) -> tuple[float, float]:
        """Return the reference point in the rail's profile [m]."""
        rail_y, rail_z, roll = self.rail.place
        y, z = found.at[1] - rail_y, found.at[2] - rail_z
        return y * math.cos(roll) + z * math.sin(roll), z * math.cos(roll) - y * math.sin(roll)


def _wider(edges: Box, dx: float, ds: float) -> Box:
    """Return a range with a step more on each side."""
    return edges[0] - dx, edges[1] + dx, edges[2] - ds, edges[3] + ds


def _highest(x: Array, depth: Array) -> tuple[Array, Array]:
    """Return x and the depth of the vertex of the parabola through the largest depth of each row and its neighbours."""
    k = np.clip(depth.argmax(axis=1), 1, x.size - 2)
    before, here, behind = (depth[np.arange(k.size), k + n] for n in (-1, 0, 1))
    slope, bend = 0.5 * (behind - before), before - 2.0 * here + behind
    t = np.clip(np.where(bend < 0.0, -slope / np.where(bend < 0.0, bend, 1.0), 0.0), -1.0, 1.0)
    return x[k] + t * (x[1] - x[0]), here + t * slope + 0.5 * t * t * bend


def _multiples(first: float, step: float, box: tuple[float, float]) -> Array:
    """Return the places in a box that lie at multiples of a step from the first one."""
    k = np.arange(math.ceil((box[0] - first) / step), math.floor((box[1] - first) / step) + 1, dtype=np.float64)
    return first + step * k


def joined(found: Sequence[Found], limits: tuple[float, float], height: Callable[[float, float], float]) -> list[Found]:
    """Return patches of which those that lie near each other are one, as in CONTACT.

    `limits` are D_SEP, the least distance of two patches [m], and A_SEP, the most difference of the angles of one [rad];
    `height` returns that of the rail at x and y.
    """
    apart, steepest = limits
    out: list[Found] = []
    for one in sorted(found, key=lambda each: -float(each.at[1])):
        last = out[-1] if out else None
        if (
            last is None
            or abs(last.angle - one.angle) > steepest
            or float(np.linalg.norm(last.ends[0] - one.ends[1])) > apart
        ):
            out.append(one)
            continue
        total = last.weight + one.weight
        share = one.weight / total
        x, y = ((1.0 - share) * last.at + share * one.at)[:2].tolist()
        out[-1] = Found(
            np.array([x, y, height(x, y)]),
            (1.0 - share) * last.angle + share * one.angle,
            total,
            (min(last.along[0], one.along[0]), max(last.along[1], one.along[1])),
            np.stack((one.ends[0], last.ends[1])),
        )
    return out


def turned(found: Sequence[Found], limits: tuple[float, float, float]) -> list[float]:
    """Return the angles of patches, turned towards each other as CONTACT turns those that lie near each other.

    From the distance D_TURN to D_SEP [m] the angles of neighbours go from their own to their common mean. `limits` are D_SEP,
    D_TURN and A_SEP; angles that differ by more than A_SEP [rad] are kept.
    """
    apart, near, steepest = limits
    angles = [one.angle for one in found]
    order = sorted(range(len(found)), key=lambda k: float(found[k].at[1]))
    for a, b in itertools.pairwise(order):
        one, other = found[a], found[b]
        distance = float(np.linalg.norm(one.ends[1] - other.ends[0]))
        if near <= apart or not apart <= distance <= near or abs(one.angle - other.angle) > steepest:
            continue
        mean = (one.angle * one.weight + other.angle * other.weight) / (one.weight + other.weight)
        share = (near - distance) / (near - apart)
        angles[a] += share * (mean - one.angle)
        angles[b] += share * (mean - other.angle)
    return angles
