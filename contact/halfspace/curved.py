"""Influence numbers of a bent contact surface (theory.md 8.6; CONTACT's variant 4, checked against it by this project).

A load at J, where the surface has the angle α_J against the plane, acts on a point I, where it has α_I. With α = α_J - α_I,
distances along the surface, and the numbers A of the plane half space,

    B_ss = M + P cos α,   B_nn = -M + P cos α,   B_ns = -B_sn = P sin α,   P, M = (A_ss ± A_nn)/2,
    B_xx = A_xx,   B_xs = B_sx = A_xs cos α/2,   B_nx = -B_xn = A_xs sin α/2.

So a pressure displaces the surfaces sideways, and a traction opens or closes the gap. All products are convolutions, because
cos α and sin α are sums of products of a factor of I and a factor of J. The signs below are those of traction on the wheel.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.halfspace.influence import Influence
from contact.inputs.material import Material


class _Angles:
    """Cosine and sine of the angles of the rows, for products with cos(α_J - α_I) and sin(α_J - α_I)."""

    def __init__(self, influence: Influence, angle: Array) -> None:
        self._influence = influence
        self.cosine, self.sine = np.cos(angle)[:, None], np.sin(angle)[:, None]

    def products(
        self, transfer: Array, field: Array, ahead: NDArray[np.complex128] | float = 1.0
    ) -> tuple[Array, Array]:
        """Return the sums over J of transfer·cos(α_J - α_I)·field and of transfer·sin(α_J - α_I)·field."""
        h, c, s = self._influence, self.cosine, self.sine
        by_cosine, by_sine = h.back(transfer * ahead * h.forward(np.stack((c * field, s * field))))
        return c * by_cosine + s * by_sine, c * by_sine - s * by_cosine


class Curved(Influence):
    """The normal problem of a bent surface in the form of a plane one.

    Pressures and displacements are those along the normal of the plane: with c = cos(angle) of a row, the pressure is c p and
    the displacement is that along the local normal over c. Then the approach is the same for all rows, the load is the sum of
    the pressures, and the matrix is symmetric.
    """

    def __init__(self, shape: tuple[int, ...], dx: float, dy: float, material: Material, angle: Array) -> None:
        super().__init__(shape, dx, dy, material)
        self._angles = _Angles(self, angle)

    def normal(self, p: Array) -> Array:
        """Return the displacement [m] from the pressure `p` [Pa]."""
        c = self._angles.cosine
        by_cosine, _ = self._angles.products(0.5 * (self.yy + self.zz), p / c)
        return (by_cosine - self.back(0.5 * (self.yy - self.zz) * self.forward(p / c))) / c

    def normal_inverse(self, u: Array) -> Array:
        """Return approximately the pressure [Pa] of the displacement `u` [m], as a preconditioner."""
        c = self._angles.cosine
        return c * super().normal_inverse(c * u)


class BentCoupling:
    """Terms of a bent surface that the plane half space lacks: slip from pressure and traction, and gap from traction.

    Parameters
    ----------
    shape, dx, dy, material
        Of the grid, as for `contact.halfspace.influence.Influence`.
    angle : ndarray, shape (ny,)
        Angle of each row [rad].
    """

    def __init__(self, shape: tuple[int, ...], dx: float, dy: float, material: Material, angle: Array) -> None:
        h = self._influence = Influence(shape, dx, dy, material)
        self._whole, self._half = _Angles(h, angle), _Angles(h, 0.5 * angle)
        self._P = 0.5 * (h.yy + h.zz)
        self._difference = (1.0 - h.ahead) / dx

    def slip(self, p: Array, qx: Array, qy: Array) -> Array:
        """Return the slip over V in steady rolling besides that of a plane, [u(x) - u(x + dx)]/dx, shape (2, ny, nx)."""
        h, ahead = self._influence, self._difference
        _, from_pressure = self._half.products(h.xy, p, ahead)
        to_x, _ = self._half.products(h.xy, qy, ahead)
        to_y, _ = self._half.products(h.xy, qx, ahead)
        plane = h.back(ahead * np.stack((h.xy * h.forward(qy), h.xy * h.forward(qx) + self._P * h.forward(qy))))
        turned, _ = self._whole.products(self._P, qy, ahead)
        _, sideways = self._whole.products(self._P, p, ahead)
        return np.stack((to_x + from_pressure, to_y + turned + sideways)) - plane

    def opening(self, qx: Array, qy: Array) -> Array:
        """Return the distance [m] along the normal of the plane by which the traction on the wheel opens the gap."""
        _, from_x = self._half.products(self._influence.xy, qx)
        _, from_y = self._whole.products(self._P, qy)
        return -(from_x + from_y) / self._whole.cosine
