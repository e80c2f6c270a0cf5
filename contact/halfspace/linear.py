"""Linear theory on the patch itself: slopes of the forces at vanishing creepage, where every particle sticks (theory.md 6).

Elements of constant traction end at the edges of their strip. Their displacement difference follows the rigid creep,

    u(x) - u(x + dx) = -w dx,

which is a dense linear system. Kalker's coefficients are these slopes on an ellipse. On any other patch the slopes replace
his coefficients.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from contact.arrays import Array
from contact.halfspace import influence
from contact.inputs.material import Material
from contact.results import Strips

_STATES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def slopes(strips: Strips, material: Material, n_elements: int) -> Array:
    """Return the forces per unit creepage at vanishing creepage.

    Parameters
    ----------
    strips : Strips
        The patch.
    material : Material
    n_elements : int
        Elements along each strip. The computing time grows with the cube of their number.

    Returns
    -------
    ndarray, shape (3, 3)
        Rows: longitudinal [-], lateral [-] and spin [1/m] creepage. Columns: Fx [N], Fy [N], Mz [N m] on the wheel. The
        error is of first order in the size of strips and elements.
    """
    unit = (np.arange(n_elements) + 0.5) * 2.0 / n_elements - 1.0
    x = (strips.x_c[:, None] + strips.a[:, None] * unit).ravel()
    y, dy, dx = (np.repeat(v, n_elements) for v in (strips.y, strips.dy, 2.0 * strips.a / n_elements))
    X, Y = x[:, None] - x[None, :], y[:, None] - y[None, :]
    here = influence.tangential(X, Y, dx, dy, material)
    ahead = influence.tangential(X + dx[:, None], Y, dx, dy, material)
    xx, yy, xy = (a - b for a, b in zip(here, ahead, strict=True))
    # the creep of spin varies along x; it is taken half-way between the two positions
    w = np.array([np.r_[vx - phi * y, vy + phi * (x + dx / 2)] for vx, vy, phi in _STATES])
    q = np.linalg.solve(np.block([[xx, xy], [xy, yy]]), -(w * np.r_[dx, dx]).T)
    Qx, Qy = q[: x.size] * (dx * dy)[:, None], q[x.size :] * (dx * dy)[:, None]
    return np.stack([Qx.sum(axis=0), Qy.sum(axis=0), x @ Qy - y @ Qx], axis=1)


def flexibilities(strips: Strips, material: Material, n_elements: int) -> Array:
    """Return L1, L2, L3 [m/Pa] with which FASTSIM has the `slopes` Fx/ξ, Fy/η and Fy/φ on this patch.

    In full adhesion, simplified theory has the slopes ∑ 2a² dy/L1, ∑ 2a² dy/L2 and ∑ (2a² (x_c - X) + 2/3 a³) dy/L3. The
    last is for spin about X, the mean of x_c with the weights 2a² dy.
    """
    a, moment = strips.a, 2.0 * strips.a**2 * strips.dy
    slope = -slopes(strips, material, n_elements)
    middle = strips.x_c @ moment / moment.sum()
    of_spin = (strips.x_c - middle) @ moment + 2.0 / 3.0 * (a**3) @ strips.dy
    stiff = slope[0, 0], slope[1, 1], slope[2, 1] - middle * slope[1, 1]
    return np.array([moment.sum(), moment.sum(), of_spin]) / stiff


def coefficients(flexibility: Array, strips: Strips, material: Material) -> tuple[float, float, float]:
    """Return C11, C22, C23 that correspond to L1, L2, L3 on the equivalent ellipse of each patch (`tangential.ellipses`).

    All patches share one set. With it the slopes of the total forces are those of the `flexibility`.
    """
    L1, L2, L3 = flexibility
    G = material.shear_modulus
    moment = 2.0 * strips.a**2 * strips.dy
    middle = strips.x_c @ moment / moment.sum()
    of_spin = (strips.x_c - middle) * moment + 2.0 / 3.0 * strips.a**3 * strips.dy
    patches, length, square_length = np.unique(strips.patch), 0.0, 0.0
    for mask in (strips.patch == k for k in patches):
        a = float(strips.a[mask].max())
        b = 2.0 * float(strips.a[mask] @ strips.dy[mask]) / (math.pi * a)
        if patches.size == 1:
            length, square_length = a, a**2 / math.sqrt(a * b)
            break
        length += moment[mask].sum() / moment.sum() / a
        square_length += of_spin[mask].sum() / of_spin.sum() * math.sqrt(a * b) / a**2
    if patches.size > 1:
        length, square_length = 1.0 / length, 1.0 / square_length
    return 8.0 * length / (3.0 * G * L1), 8.0 * length / (3.0 * G * L2), math.pi * square_length / (4.0 * G * L3)


def extrapolated(at: Callable[[int], Array], coarse: int = 12, fine: int = 18) -> Array:
    """Return the limit of at(n) for n → ∞ strips and elements. The error of at(n) is proportional to 1/n."""
    first, second = at(coarse), at(fine)
    return second + (second - first) * (coarse / (fine - coarse))
