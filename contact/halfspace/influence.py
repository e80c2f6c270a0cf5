"""Displacement of a half space by elements of constant traction, and the convolution with fields on a grid by FFT.

A unit traction on an element dx × dy displaces body 1 against body 2 at distance (X, Y) by (theory.md 6; Kalker 1990)

    C_zz = (1 - nu)(I1 + I2)/(pi G),   C_xx = C_zz + nu I1/(pi G),   C_yy = C_zz + nu I2/(pi G),   C_xy = nu I3/(pi G),

    I1 = ∬X²/rho³ = [Y asinh(X/|Y|)],  I2 = ∬Y²/rho³ = [X asinh(Y/|X|)],  I3 = ∬XY/rho³ = -[rho],

where [F] is the difference of F over the corners of the element.
"""

from __future__ import annotations

import functools
import math
from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import Array
from contact.core import Shape, entry, kernel
from contact.inputs.material import Material
from contact.kernels.arrays import Matrix

ComplexMatrix = Annotated[Any, Shape(np.complex128, 2)]
ComplexCube = Annotated[Any, Shape(np.complex128, 3)]
#: Transfer functions xx, yy, xy; real for even influence numbers.
Transfer = tuple[NDArray[Any], NDArray[Any], NDArray[Any]]


def integrals(X: ArrayLike, Y: ArrayLike, dx: ArrayLike, dy: ArrayLike) -> tuple[Array, Array, Array]:
    """Return I1, I2, I3 [m] at the distances (X, Y) from the centre of an element dx × dy. All arguments broadcast."""
    I1, I2, I3 = (np.zeros(np.broadcast_shapes(*map(np.shape, (X, Y, dx, dy)))) for _ in range(3))
    for sign_x in (1, -1):
        for sign_y in (1, -1):
            x, y = np.asarray(X) + 0.5 * sign_x * np.asarray(dx), np.asarray(Y) + 0.5 * sign_y * np.asarray(dy)
            size_x, size_y = (np.maximum(np.abs(v), 1e-300) for v in (x, y))
            sign = sign_x * sign_y
            I1 += sign * y * np.arcsinh(x / size_y)
            I2 += sign * x * np.arcsinh(y / size_x)
            I3 -= sign * np.hypot(x, y)
    return I1, I2, I3


def tangential(
    X: ArrayLike, Y: ArrayLike, dx: ArrayLike, dy: ArrayLike, material: Material
) -> tuple[Array, Array, Array]:
    """Return C_xx, C_yy, C_xy [m/Pa] at the distances (X, Y) from elements dx × dy."""
    I1, I2, I3 = integrals(X, Y, dx, dy)
    nu, scale = material.poisson_ratio, 1.0 / (math.pi * material.shear_modulus)
    common = (1.0 - nu) * (I1 + I2)
    return scale * (common + nu * I1), scale * (common + nu * I2), scale * nu * I3


@functools.lru_cache(maxsize=16)
def _transfers(mx: int, my: int, ratio: float) -> tuple[Array, Array, Array]:
    """Return the Fourier transforms of I1, I2 and I3 for dx = 1, dy = `ratio` on the periodic grid (my, mx), both even.

    All three are real, because I1 and I2 are even and I3 is odd in X and in Y. All distances are filled, also those that
    are never read. With zeros there, I1 + I2 would not be positive, and its inverse would not be a preconditioner.
    """
    transfers = []
    quarter = integrals(np.arange(mx // 2 + 1), ratio * np.arange(my // 2 + 1)[:, None], 1.0, ratio)
    for values, sign in zip(quarter, (1.0, 1.0, -1.0), strict=True):
        if sign < 0.0:  # odd: exactly zero on the axes and where the periodic images meet
            values[[0, -1], :] = values[:, [0, -1]] = 0.0
        left = np.concatenate((values, sign * values[:, -2:0:-1]), axis=1)
        transfer = np.fft.rfft2(np.concatenate((left, sign * left[-2:0:-1]))).real.copy()
        transfer.setflags(write=False)
        transfers.append(transfer)
    return tuple(transfers)  # type: ignore[return-value]


def fast_length(n: int) -> int:
    """Return the least even number >= `n` that has only the factors 2, 3 and 5."""
    n += n % 2
    while True:
        m = n
        for factor in (2, 3, 5):
            while m % factor == 0:
                m //= factor
        if m == 1:
            return n
        n += 2


class Influence:
    """The half space under a grid of `shape` (ny, nx): displacement difference [m] from tractions [Pa].

    The displacement is also exact in one more column, at the +x side of the grid. `layer` is the shear flexibility of a
    layer between the bodies [m/Pa].
    """

    def __init__(self, shape: tuple[int, ...], dx: float, dy: float, material: Material, layer: float = 0.0) -> None:
        ny, nx = shape
        self.shape = ny, nx
        self._padded = fast_length(2 * ny), fast_length(2 * nx + 2)
        I1, I2, I3 = _transfers(self._padded[1], self._padded[0], dy / dx)
        nu, scale = material.poisson_ratio, dx / (math.pi * material.shear_modulus)
        #: Transfer functions C_zz, C_xx, C_yy, C_xy [m/Pa]
        self.zz = scale * (1.0 - nu) * (I1 + I2)
        self.xx, self.yy, self.xy = self.zz + scale * nu * I1, self.zz + scale * nu * I2, scale * nu * I3
        if layer > 0.0:  # the traction of an element shears the layer there
            self.xx, self.yy = self.xx + layer, self.yy + layer
        self._inverse = 1.0 / self.zz
        #: C_zz of an element on itself [m/Pa]
        self.own = 2.0 * scale * (1.0 - nu) * (dy / dx * math.asinh(dx / dy) + math.asinh(dy / dx))
        #: Factor on a transform that shifts its field by one column, so that it is read at x + dx
        self.ahead = np.exp(2j * math.pi / self._padded[1] * np.arange(self._padded[1] // 2 + 1))

    def forward(self, field: Array) -> NDArray[np.complex128]:
        """Return the transform of fields (…, ny, nx) on the padded grid."""
        return np.fft.rfft2(field, self._padded)

    def back(self, transform: NDArray[np.complex128]) -> Array:
        """Return the inverse transform on the grid, shape (…, ny, nx)."""
        ny, nx = self.shape
        rows = np.fft.ifft(transform, axis=-2)[..., :ny, :]
        return np.ascontiguousarray(np.fft.irfft(rows, self._padded[1], axis=-1)[..., :nx])

    def times(self, transfer: Transfer, q: Array) -> Array:
        """Return the product of the transfer functions with a field of two components, shape (2, ny, nx)."""
        transform = self.forward(q)
        multiply = _multiply_complex if np.iscomplexobj(transfer[0]) else _multiply_real
        multiply(*transfer, transform)
        return self.back(transform)

    def normal(self, p: Array) -> Array:
        """Return the normal displacement [m], shape (ny, nx), from the pressure `p` [Pa]."""
        return self.back(self.zz * self.forward(p))

    def normal_inverse(self, u: Array) -> Array:
        """Return the pressure [Pa] of the periodic half space that has the displacement `u` [m], as a preconditioner."""
        return self.back(self._inverse * self.forward(u))


@kernel
def _product(xx, yy, xy, field):
    """Multiply the two components of `field` in place by the symmetric matrix of each wave number."""
    for i in range(xx.shape[0]):
        for j in range(xx.shape[1]):
            x, y = field[0, i, j], field[1, i, j]
            field[0, i, j] = xx[i, j] * x + xy[i, j] * y
            field[1, i, j] = xy[i, j] * x + yy[i, j] * y


@entry
def _multiply_real(xx: Matrix, yy: Matrix, xy: Matrix, field: ComplexCube) -> None:
    """As `_product`, by real transfer functions."""
    _product(xx, yy, xy, field)


@entry
def _multiply_complex(xx: ComplexMatrix, yy: ComplexMatrix, xy: ComplexMatrix, field: ComplexCube) -> None:
    """As `_product`, by complex transfer functions."""
    _product(xx, yy, xy, field)
