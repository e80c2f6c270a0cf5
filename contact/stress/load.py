"""`SurfaceLoad`: pressure and traction on equal rectangles, given or taken from a solution."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, as_array, brief
from contact.errors import ContactError, require_integer
from contact.halfspace.gap import even
from contact.halfspace.solution import GridSolution
from contact.kernels.arrays import LoadGrid, PatchFields
from contact.kernels.stress.load import add_load, place_centres, scale_load
from contact.results import Solution
from contact.results.pressure import limit_of, strips_of

#: Elements along each side of the box around the patch onto which a solution on strips is put.
N_SIDE = 64


@dataclass(frozen=True, slots=True, eq=False)
class SurfaceLoad:
    """Uniform pressure and traction on every element of a grid of equal rectangles.

    Parameters
    ----------
    x, y : array_like, shape (nx,), (ny,)
        Centres of the elements [m], increasing in equal steps.
    p : array_like, shape (ny, nx)
        Pressure [Pa].
    qx, qy : array_like, shape (ny, nx) or float
        Traction on the wheel [Pa]; the opposite acts on the rail.

    Raises
    ------
    ContactError
        For wrong shapes, values that are not finite, or steps that are not equal.
    """

    x: Array
    y: Array
    p: Array
    qx: Array
    qy: Array

    __repr__ = brief

    def __init__(self, x: ArrayLike, y: ArrayLike, p: ArrayLike, qx: ArrayLike = 0.0, qy: ArrayLike = 0.0) -> None:
        put = object.__setattr__
        put(self, "x", even("x", x)[0])
        put(self, "y", even("y", y)[0])
        shape = self.y.size, self.x.size
        for name, values in (("p", p), ("qx", qx), ("qy", qy)):
            field = as_array(name, values)
            if field.ndim == 0:
                field = np.full(shape, float(field))
            if field.shape != shape:
                raise ContactError(f"{name} has shape {field.shape}; {shape} is needed")
            if not np.isfinite(field).all():
                i, j = (int(k) for k in np.argwhere(~np.isfinite(field))[0])
                raise ContactError(f"{name}[{i}, {j}] = {field[i, j]} is not finite")
            put(self, name, field)

    @property
    def steps(self) -> tuple[float, float]:
        """Size (dx, dy) of an element [m]."""
        return float(self.x[-1] - self.x[0]) / (self.x.size - 1), float(self.y[-1] - self.y[0]) / (self.y.size - 1)

    @property
    def radius(self) -> float:
        """Radius [m] of the circle that has the area of the loaded elements, a measure of the depths of interest."""
        dx, dy = self.steps
        return math.sqrt(np.count_nonzero((self.p != 0.0) | (self.qx != 0.0) | (self.qy != 0.0)) * dx * dy / math.pi)

    def padded(self, margin: float) -> SurfaceLoad:
        """Return the load on a grid that is wider by the share `margin` of its size on every side, without load there."""
        nx, ny = (math.ceil(margin * n) for n in (self.x.size, self.y.size))
        dx, dy = self.steps
        x = self.x[0] + dx * np.arange(-nx, self.x.size + nx)
        y = self.y[0] + dy * np.arange(-ny, self.y.size + ny)
        return SurfaceLoad(x, y, *(np.pad(f, ((ny, ny), (nx, nx))) for f in (self.p, self.qx, self.qy)))

    @classmethod
    def of(cls, solution: Solution, n: int = N_SIDE) -> SurfaceLoad:
        """Return the load of a solution.

        The element-wise half space has equal elements; they are taken as they are. Strips are put on `n` × `n` elements
        over the patches: the pressure is that of `Solution.pressure`, scaled to carry N. The traction over the pressure is
        interpolated linearly between the centres of the strips' elements, so it stays within the friction limit.

        Raises
        ------
        ContactError
            Without contact, or if the tangential method gives forces only.
        """
        if solution.N <= 0.0:
            raise ContactError(f"solution.status = {solution.status.name}: there is no contact, so no stress")
        if isinstance(solution, GridSolution):
            return _of_elements(solution)
        return _of_strips(solution, require_integer("n", n, 4, 1000))


def _of_elements(solution: GridSolution) -> SurfaceLoad:
    x, y, p = solution.grid
    first = solution.strips
    dx = float(solution.dA[0, 0] / first.dy[0])
    dy = float(first.dy[0] * (1.0 if first.tilt is None else np.hypot(1.0, first.tilt[0])))
    row, column = (
        np.rint((solution.along(solution.y) - y[0]) / dy).astype(int),
        np.rint((solution.x - x[0]) / dx).astype(int),
    )
    qx, qy = np.zeros(p.shape), np.zeros(p.shape)
    qx[row, column], qy[row, column] = solution.qx, solution.qy
    # a border without load, so that a single row or column of elements is a grid too
    wide = (centres[0] + step * np.arange(-1, centres.size + 1) for centres, step in ((x, dx), (y, dy)))
    return SurfaceLoad(*wide, *(np.pad(field, 1) for field in (p, qx, qy)))


def _of_strips(solution: Solution, n: int) -> SurfaceLoad:
    strips, limit = solution.strips, limit_of(solution)
    grid = LoadGrid(np.empty(n), np.empty(n), *np.zeros((3, n, n)))
    place_centres(float((strips.x_c - strips.a).min()), float((strips.x_c + strips.a).max()), grid.x)
    place_centres(float(solution.patch_edges.min()), float(solution.patch_edges.max()), grid.y)
    for k, (low, high) in enumerate(solution.patch_edges):
        inside = strips.patch == k
        fields = PatchFields(solution.x[inside], solution.p[inside], solution.qx[inside], solution.qy[inside])
        add_load(strips_of(solution, k), fields, low, high, limit, grid)
    if not scale_load(grid, solution.N):
        raise ContactError(f"n = {n} leaves no element inside the patch")
    return SurfaceLoad(*grid)
