"""The arrays of a contact search over raw memory: what `workspace.allocate` is in Python; numba compiles it."""

from __future__ import annotations

from contact.kernels.layout import MAX_PATCHES, N_CASE, N_RES, N_STRIP_ROWS
from contact.kernels.layout import MAX_LOBES, N_LINE_ROWS, N_LOBE, N_MOTION, N_PATCH, N_SEP_ROWS
from contact.geometry.workspace import Search
from contact.kernels.normal.analyn import N_WORK_ROWS
from fmu_src.native.memory import compiled, cube, matrix, vector


@compiled
def lay_out(work, end, n_wheel, n_rail, prescribed, samples, n_strips):
    """Lay a search into `work` from `end` on, for curves of so many nodes; return it and where it ends.

    `prescribed` of the `samples` lie at given positions, all or none; without strips there is no search under a load.
    """
    wheel, end = matrix(work, end, 3, n_wheel)
    rail, end = matrix(work, end, 3, n_rail)
    motion, end = vector(work, end, N_MOTION)
    grid, end = vector(work, end, prescribed)
    patches, end = matrix(work, end, MAX_PATCHES, N_PATCH)
    separations, end = cube(work, end, MAX_PATCHES, N_SEP_ROWS, samples)
    line, end = matrix(work, end, N_LINE_ROWS, n_wheel)
    placed, end = matrix(work, end, 3, n_rail)
    lobe, end = matrix(work, end, MAX_LOBES, N_LOBE)
    wheel_plane, end = matrix(work, end, N_LINE_ROWS, n_wheel)
    rail_plane, end = matrix(work, end, 3, n_rail)
    case, end = vector(work, end, N_CASE)
    nodes, end = vector(work, end, n_strips)
    weights, end = vector(work, end, n_strips)
    grid_work, end = matrix(work, end, N_WORK_ROWS, samples)
    strips, end = matrix(work, end, N_STRIP_ROWS, MAX_PATCHES * n_strips)
    result, end = vector(work, end, N_RES)
    search = Search(
        wheel, rail, motion, grid, patches, separations, line, placed, lobe, wheel_plane, rail_plane, case, nodes, weights,
        grid_work, strips, result,
    )  # fmt: skip
    return search, end
