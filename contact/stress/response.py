"""Transforms of the stresses in a plane below a grid, per unit load on one element.

Each stress of a unit load is even or odd in x and in y. So a quarter of the plane has all values. With its origin at the first
element, a field that is even or odd in both directions has a real transform, the others an imaginary one. So the transform of
the sum of two fields, one of each kind, has both.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.kernels.stress.below import N_LOADS, N_STRESSES, fill_corners

#: Signs of the stresses xx, yy, zz, xy, xz, yz at (-x, y) and at (x, -y) for pressure, traction along x and along y.
_SIGNS = (
    ((1, 1), (1, 1), (1, 1), (-1, -1), (-1, 1), (1, -1)),
    ((-1, 1), (-1, 1), (-1, 1), (1, -1), (1, 1), (-1, -1)),
    ((1, -1), (1, -1), (1, -1), (-1, 1), (-1, -1), (1, 1)),
)
_ALL = [(load, stress) for load in range(3) for stress in range(6)]
_REAL = [at for at in _ALL if _SIGNS[at[0]][at[1]][0] == _SIGNS[at[0]][at[1]][1]]
_IMAGINARY = [at for at in _ALL if at not in _REAL]


class Grid(NamedTuple):
    """Elements along x and y, their size [m], and the numbers of rows and columns of the periodic grid, at least twice."""

    nx: int
    ny: int
    dx: float
    dy: float
    padded: tuple[int, int]


def stresses(transforms: NDArray[np.complex128], grid: Grid, z: float, poisson_ratio: float) -> Array:
    """Return the stresses at depth `z` [m], shape (6, ny, nx).

    `transforms`, shape (3, …), are those of pressure, traction along x and traction along y on the periodic grid.
    """
    X, Y = (np.asarray(np.arange(-1, n) + 0.5) * step for n, step in ((grid.nx, grid.dx), (grid.ny, grid.dy)))
    functions = np.empty((N_LOADS, N_STRESSES, Y.size, X.size))
    fill_corners(X, Y, z, poisson_ratio, np.empty((N_LOADS, N_STRESSES)), functions)
    quarter = np.diff(np.diff(functions, axis=-1), axis=-2)
    product = np.zeros((N_STRESSES, *transforms.shape[1:]), dtype=np.complex128)
    turned = 1j * transforms
    whole = np.zeros(grid.padded)
    for k, (load, stress) in enumerate(_IMAGINARY):
        _unfold(quarter[load, stress], _SIGNS[load][stress], whole, add=False)
        if k < len(_REAL):
            other_load, other_stress = _REAL[k]
            _unfold(quarter[other_load, other_stress], _SIGNS[other_load][other_stress], whole, add=True)
        response = np.fft.rfft2(whole)
        product[stress] += response.imag * turned[load]
        if k < len(_REAL):
            product[other_stress] += response.real * transforms[other_load]
    rows = np.fft.ifft(product, axis=-2)[..., : grid.ny, :]
    return np.asarray(np.fft.irfft(rows, grid.padded[1], axis=-1)[..., : grid.nx])


def _unfold(quarter: Array, signs: tuple[int, int], whole: Array, add: bool) -> None:
    """Write the field of which `quarter` has the values at x, y >= 0 into the periodic grid `whole`, or add it."""
    ny, nx = quarter.shape
    along, across = signs
    right, left = whole[:, :nx], whole[:, -nx + 1 :]
    for part, values in ((right, quarter), (left, along * quarter[:, :0:-1])):
        top, bottom = part[:ny], part[-ny + 1 :]
        if add:
            top += values
            bottom += across * values[:0:-1]
        else:
            top[:] = values
            bottom[:] = across * values[:0:-1]
