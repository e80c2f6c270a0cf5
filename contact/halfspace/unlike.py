"""Coupling of pressure and traction between bodies of unlike material (other_contacts.md).

With K = [(1 - 2nu_r)/G_r - (1 - 2nu_w)/G_w] G/4 of rail and wheel, a pressure p displaces the wheel's surface against the
rail's along the plane, and a traction q opens or closes the gap (Kalker 1990; signs for traction on the wheel, checked
against CONTACT by this project),

    u_x = K/(pi G) J5 p,   u_y = K/(pi G) J6 p,   u_z = -K/(pi G) (J5 q_x + J6 q_y),

    J5 = ∬X/r² = [Y ln r + X atan(Y/X)],   J6 = ∬Y/r² = [X ln r + Y atan(X/Y)].
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import Array
from contact.halfspace.influence import fast_length
from contact.inputs.material import Material


def integrals(X: ArrayLike, Y: ArrayLike, dx: float, dy: float) -> tuple[Array, Array]:
    """Return J5, J6 [m] at the distances (X, Y) [m] from the centre of an element dx × dy. `X` and `Y` broadcast."""
    J5, J6 = (np.zeros(np.broadcast_shapes(np.shape(X), np.shape(Y))) for _ in range(2))
    for sign_x in (1, -1):
        for sign_y in (1, -1):
            x, y = np.asarray(X) + 0.5 * sign_x * dx, np.asarray(Y) + 0.5 * sign_y * dy
            log = np.log(np.maximum(np.hypot(x, y), 1e-300))
            # atan of the quotient, not of the quadrant; where its factor is zero, its value does not matter
            along = np.arctan(y / np.where(x == 0.0, 1.0, x))
            across = np.arctan(x / np.where(y == 0.0, 1.0, y))
            J5 += sign_x * sign_y * (y * log + x * along)
            J6 += sign_x * sign_y * (x * log + y * across)
    return J5, J6


class Coupling:
    """The coupling on a grid of `shape` (ny, nx) of elements dx × dy."""

    def __init__(self, shape: tuple[int, ...], dx: float, dy: float, material: Material) -> None:
        self._shape, self._dx = shape, dx
        ny, nx = shape
        self._padded = fast_length(2 * ny), fast_length(2 * nx + 2)
        self._dy, self._scale = dy, material.coupling / (math.pi * material.shear_modulus)
        self._x, self._y = self._transfers(0.0)
        ahead = np.exp(2j * math.pi / self._padded[1] * np.arange(self._padded[1] // 2 + 1))
        self._difference = (1.0 - ahead) / dx

    def _transfers(self, ahead: float) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Return the transforms of J5 and J6 at x + `ahead` [m]."""
        steps = self._dx, self._dy
        X, Y = (np.fft.fftfreq(m, 1.0 / m) * step for m, step in zip(self._padded[::-1], steps, strict=True))
        x, y = (np.fft.rfft2(self._scale * J) for J in integrals(X + ahead, Y[:, None], *steps))
        return x, y

    def _forward(self, field: Array) -> NDArray[np.complex128]:
        return np.fft.rfft2(field, self._padded)

    def _back(self, transform: NDArray[np.complex128]) -> Array:
        ny, nx = self._shape
        return np.fft.irfft2(transform, self._padded)[..., :ny, :nx]

    def displacement(self, p: Array, ahead: float = 0.0) -> Array:
        """Return u_x, u_y [m] at x + `ahead` [m], wheel against rail, of the pressure `p` [Pa], shape (2, ny, nx)."""
        transform = self._forward(p)
        x, y = (self._x, self._y) if ahead == 0.0 else self._transfers(ahead)
        return self._back(np.stack((x * transform, y * transform)))

    def slip(self, p: Array, qx: Array, qy: Array) -> Array:
        """Return the slip over V in steady rolling, [u(x) - u(x + dx)]/dx, shape (2, ny, nx); the traction adds nothing."""
        transform = self._difference * self._forward(p)
        return self._back(np.stack((self._x * transform, self._y * transform)))

    def opening(self, qx: Array, qy: Array) -> Array:
        """Return the distance [m] by which the traction on the wheel opens the gap."""
        return -self._back(self._x * self._forward(qx) + self._y * self._forward(qy))
