"""A solution on a grid of equal elements, whose rows are the strips."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, as_array, broadcast, require_numbers
from contact.halfspace.bent import Bent, Surface
from contact.halfspace.tang import Tangential
from contact.halfspace.third_body import Sheared
from contact.inputs.creepage import Creepage
from contact.inputs.material import Material
from contact.results import Solution, Status, Strips


@dataclass(frozen=True, repr=False, eq=False)
class GridSolution(Solution):
    """`Solution` of the element-wise half space.

    The strips are the rows of elements with contact. The peak pressure of a strip is the largest of its elements. Fields
    span the columns with contact; the pressure is zero outside the patch. `grid` holds x [m], y [m] and p [Pa] of the
    rectangle of elements around the contact. `layer` is the state of a third body, None without one.

    On the curved `surface` of a conformal contact (None for the plane), the rows are equally wide along the surface, and the y
    of `grid` is the arc length. As on strips, all other places and areas are those in the plane.
    """

    grid: tuple[Array, Array, Array] = field(repr=False)
    layer: Sheared | None = field(default=None, repr=False)
    surface: Surface | None = field(default=None, repr=False)

    def along(self, y: ArrayLike) -> Array:
        """Return the place on the grid [m] of a place in the plane [m]."""
        places = as_array("y", y)
        return places if self.surface is None else self.surface.along(places)

    def pressure(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return the contact pressure [Pa] at points `x`, `y` [m]; 0 outside. p² is bilinear between the elements."""
        x, y = broadcast({"x": require_numbers("x", x), "y": require_numbers("y", y)})
        grid_x, grid_y, p = self.grid
        if p.size == 0:
            return np.zeros(x.shape)
        square = np.pad(p**2, 1)
        u = (x - grid_x[0]) / (grid_x[1] - grid_x[0]) + 1.0
        v = (self.along(y) - grid_y[0]) / (grid_y[1] - grid_y[0]) + 1.0
        inside = (u >= 0) & (u < square.shape[1] - 1) & (v >= 0) & (v < square.shape[0] - 1)
        u, v = np.where(inside, u, 0.0), np.where(inside, v, 0.0)
        j, i = u.astype(np.int64), v.astype(np.int64)
        u, v = u - j, v - i
        low = (1.0 - u) * square[i, j] + u * square[i, j + 1]
        high = (1.0 - u) * square[i + 1, j] + u * square[i + 1, j + 1]
        return np.where(inside, np.sqrt((1.0 - v) * low + v * high), 0.0)


class PressedRecord(NamedTuple):
    """Result of the normal problem: approach [m], stiffness [N/m]."""

    approach: float
    stiffness: float
    iterations: int
    status: Status
    normal: str = "halfspace"


def assemble(
    x: Array,
    y: Array,
    p: Array,
    rolling: Tangential,
    row_geometry: Bent,
    record: PressedRecord,
    *,
    creepage: Creepage,
    friction: float,
    material: Material,
    speed: float,
    tangential: str = "halfspace",
    layer: Sheared | None = None,
    surface: Surface | None = None,
) -> GridSolution:
    """Return the solution from fields of shape (ny, nx) over increasing `x`, `y` [m], `y` along the surface.

    `row_geometry` holds place, creepages and slope of each row, `record` the normal problem, with the status of both.
    """
    touching = p > 0.0
    rows, columns = np.flatnonzero(touching.any(axis=1)), np.flatnonzero(touching.any(axis=0))
    dx, dy = float(x[1] - x[0]), float(y[1] - y[0])
    box = np.ix_(rows, columns[::-1])  # element 0 at the leading edge
    qx, qy, sx, sy = (f[box] for f in (rolling.qx, rolling.qy, rolling.sx, rolling.sy))
    slope, level = row_geometry.tilt[rows][:, None], 1.0 / np.sqrt(1.0 + row_geometry.tilt**2)[:, None]
    cosine = level[rows]
    grid_y = np.repeat(row_geometry.y[rows][:, None], columns.size, axis=1)
    grid_x = np.repeat(x[columns[::-1]][None, :], rows.size, axis=0)
    inside = touching[box]
    area = float((inside * cosine).sum()) * dx * dy
    label = np.cumsum(np.diff(rows, prepend=rows[:1]) > 1) if rows.size else rows
    first = x[np.argmax(touching[rows], axis=1)]
    last = x[x.size - 1 - np.argmax(touching[rows][:, ::-1], axis=1)]
    count = int(label[-1]) + 1 if rows.size else 0
    edges = np.array([(y[rows[label == k][0]] - 0.5 * dy, y[rows[label == k][-1]] + 0.5 * dy) for k in range(count)])
    if surface is not None:
        edges = surface.across(edges)
    length = columns.size * dx
    widths = np.array([edges[k, 1] - edges[k, 0] for k in range(count)])
    full = (
        slice(rows[0], rows[-1] + 1) if rows.size else slice(0),
        slice(columns[0], columns[-1] + 1) if rows.size else slice(0),
    )
    slips = inside & ~rolling.stick[box]
    force = dx * dy
    bent = bool(row_geometry.tilt.any())
    sideways = cosine * slope * p[box]
    fx, fy = qx, cosine * qy + sideways
    status = record.status
    if status is Status.OK and rows.size and friction > 0.0 and slips.sum() == inside.sum():
        status = Status.SATURATED
    return GridSolution(
        Fx=float(fx.sum()) * force,
        Fy=float(fy.sum()) * force,
        Mz=float((grid_x * fy - grid_y * fx).sum()) * force,
        N=float((p * level).sum() - (qy * cosine * slope).sum()) * force,
        approach=float(record.approach),
        max_pressure=float(p.max()),
        area=area,
        slip_area=float((slips * cosine).sum()) * force,
        power_per_metre=abs(float((qx * sx + qy * sy).sum())) * force,
        normal_stiffness=record.stiffness,
        length=length,
        width=float(edges[-1, 1] - edges[0, 0]) if count else 0.0,
        n_patches=count,
        iterations=record.iterations + rolling.iterations,
        status=status,
        strips=Strips(
            y=row_geometry.y[rows],
            dy=dy * cosine[:, 0],
            x_c=0.5 * (first + last),
            a=0.5 * (last - first + dx),
            p0=p[rows].max(axis=1, initial=0.0),
            aspect=length / widths[label] if count else np.zeros(0),
            patch=label.astype(np.int64),
            longitudinal=row_geometry.vx[rows] if bent else None,
            lateral=row_geometry.vy[rows] if bent else None,
            spin=row_geometry.phi[rows] if bent else None,
            tilt=row_geometry.tilt[rows] if bent else None,
        ),
        x=grid_x,
        y=grid_y,
        p=p[box],
        qx=qx,
        qy=qy,
        sx=sx,
        sy=sy,
        stick=rolling.stick[box],
        dA=np.full(inside.shape, dx * dy) * cosine,
        creepage=creepage,
        friction=friction,
        material=material,
        speed=speed,
        normal=record.normal,
        tangential=tangential,
        pressure_y=float(sideways.sum()) * force,
        bend=float(np.ptp(np.arctan(row_geometry.tilt[rows]))) if rows.size else 0.0,
        beyond=0.0,
        gap_error=0.0,  # the gap closes at every element, to the tolerance of the iteration
        patch_edges=edges.reshape(-1, 2),
        memory=np.zeros(0),
        grid=(x[full[1]], y[full[0]], p[full]),
        layer=None if layer is None else layer.part(box),
        surface=surface,
    )
