"""Hertz contact by complete elliptic integrals, exact for all aspect ratios (theory.md 1.1; thesis Eqs. 2.10-2.12)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from contact.errors import ContactError, require_number
from contact.inputs.material import STEEL, Material
from contact.inputs.options import CURVATURE
from contact.kernels.hertz import coefficients, local_factors

__all__ = ["HertzContact", "hertz", "local_factors"]


@dataclass(frozen=True, slots=True)
class HertzContact:
    """Elliptic contact.

    Attributes
    ----------
    a, b : semi-axes along x and y [m]
    approach : rigid approach of the bodies [m]
    N : normal force [N]
    p0 : peak pressure [Pa]

    Examples
    --------
    >>> import contact
    >>> contact.hertz(1.1, 0.8, approach=80e-6).N > 79e3
    True
    """

    a: float
    b: float
    approach: float
    N: float
    p0: float


def hertz(
    A: float, B: float, *, load: float | None = None, approach: float | None = None, material: Material = STEEL
) -> HertzContact:
    """Solve the Hertz contact of the gap z = A x² + B y² (thesis Eqs. 2.10-2.12; Johnson 1985, ch. 4).

    Parameters
    ----------
    A, B : float
        Half curvatures along x and y [1/m], positive.
    load, approach : float
        Normal force [N] or rigid approach [m], positive. Give exactly one of them.
    material : Material
        Elastic constants; default steel.

    Returns
    -------
    HertzContact

    Raises
    ------
    ContactError
        If a value is outside its range, or if not exactly one of load and approach is given.

    Examples
    --------
    >>> import contact
    >>> ellipse = contact.hertz(1.1, 0.8, load=80e3)
    >>> round(ellipse.p0 / 1e6), round(1e3 * ellipse.a, 2), round(1e3 * ellipse.b, 2)  # MPa, mm, mm
    (893, 5.88, 7.27)
    """
    A, B = CURVATURE.require("A", A), CURVATURE.require("B", B)
    if (load is None) == (approach is None):
        raise ContactError(f"exactly one of load and approach is needed; load = {load}, approach = {approach}")
    m, n, r = coefficients(A, B)
    E = material.contact_modulus
    if load is None:
        delta = require_number("approach", approach, 0.0, open_minimum=True)
        N = 4.0 * E / 3.0 * (delta / r) ** 1.5 / math.sqrt(A + B)
    else:
        N = require_number("load", load, 0.0, open_minimum=True)
        delta = r * ((0.75 * N / E) ** 2 * (A + B)) ** (1.0 / 3.0)
    scale = math.sqrt(delta / (r * (A + B)))
    a, b = m * scale, n * scale
    return HertzContact(a, b, delta, N, 1.5 * N / (math.pi * a * b))
