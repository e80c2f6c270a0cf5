"""Entries of stresses below the surface: `wr_contact_surface_load` and `wr_stress` of wheelrail.h."""

from __future__ import annotations

from contact.core import arranging
from contact.kernels import block
from contact.kernels.arrays import LoadGrid, PatchFields, PatchStrips
from contact.kernels.entries.layout import Entries, size_of
from contact.kernels.records import MAX_PATCHES, RESULT
from contact.kernels.rows import Field, Strip
from contact.kernels.stress.below import N_LOADS, N_STRESSES, stresses_at
from contact.kernels.stress.load import add_load, place_centres, scale_load
from contact.kernels.tangential.ellipses import end_of_patch


@arranging
def _grid(nx, ny, x, y, p, qx, qy):
    """Return the load on `ny` × `nx` elements."""
    return LoadGrid(
        block.vector(x, 0, nx)[0],
        block.vector(y, 0, ny)[0],
        block.matrix(p, 0, ny, nx)[0],
        block.matrix(qx, 0, ny, nx)[0],
        block.matrix(qy, 0, ny, nx)[0],
    )


def load_fill(sizes, strips, n, limit, result, nx, ny, x, y, p, qx, qy, given):
    """Put the `n` strips of a solution on a grid over its patches. Return 1, or 0 if no element lies inside a patch.

    The fields follow the strips.
    """
    size = size_of(sizes)
    capacity, m = MAX_PATCHES * size.n_strips, size.n_elements
    rows, end = block.matrix(strips, 0, len(Strip), capacity)
    fields, _ = block.cube(strips, end, len(Field), capacity, m)
    record = block.records(result, 0, 1, RESULT)[0][0]
    grid = _grid(nx, ny, x, y, p, qx, qy)
    back, front = rows[Strip.XC, 0] - rows[Strip.A, 0], rows[Strip.XC, 0] + rows[Strip.A, 0]
    for i in range(n):
        back = min(back, rows[Strip.XC, i] - rows[Strip.A, i])
        front = max(front, rows[Strip.XC, i] + rows[Strip.A, i])
    low, high, count = record.edges[0], record.edges[1], min(record.n_patches, MAX_PATCHES)
    for k in range(count):
        low, high = min(low, record.edges[2 * k]), max(high, record.edges[2 * k + 1])
    place_centres(back, front, grid.x)
    place_centres(low, high, grid.y)
    grid.p[:, :] = 0.0
    grid.qx[:, :] = 0.0
    grid.qy[:, :] = 0.0
    first = 0
    for k in range(count):
        if first >= n:
            break
        last = end_of_patch(rows, n, first)
        part = PatchStrips(
            rows[Strip.Y, first:last], rows[Strip.XC, first:last], rows[Strip.A, first:last], rows[Strip.P0, first:last]
        )
        of_patch = PatchFields(
            fields[Field.X, first:last],
            fields[Field.P, first:last],
            fields[Field.QX, first:last],
            fields[Field.QY, first:last],
        )
        add_load(part, of_patch, record.edges[2 * k], record.edges[2 * k + 1], limit, grid)
        first = last
    return 1 if scale_load(grid, record.N) else 0


def stress_at(sizes, nx, ny, x, y, p, qx, qy, sign, poisson_ratio, n, px, py, pz, one, stress, given):
    """Fill the stresses of `n` points. `one` is scratch."""
    stresses_at(
        _grid(nx, ny, x, y, p, qx, qy),
        sign,
        poisson_ratio,
        block.vector(px, 0, n)[0],
        block.vector(py, 0, n)[0],
        block.vector(pz, 0, n)[0],
        block.matrix(one, 0, N_LOADS, N_STRESSES)[0],
        block.matrix(stress, 0, n, N_STRESSES)[0],
    )
    return 0


ENTRIES: Entries = {
    "load_fill": (load_fill, "i64", ("ptr", "ptr", "i64", "f64", "ptr", "i64", "i64", *("ptr",) * 5)),
    "stress_at": (stress_at, "i64", ("ptr", "i64", "i64", *("ptr",) * 5, "f64", "f64", "i64", *("ptr",) * 5)),
}
