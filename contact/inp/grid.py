"""Grid, undeformed gap and bodies of a case of module 3."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.halfspace import Gap
from contact.inp.case import Case
from contact.inp.reasons import refuse
from contact.inputs.material import Material
from contact.kernels.hertz import coefficients
from contact.theory.hertz import hertz

#: Gap of elements that are excluded [m]: they never touch.
FAR = 1.0


class Bed(NamedTuple):
    """Grid and gap of a case.

    Attributes
    ----------
    x, y, h : as in the file [m], h of shape (ny, nx)
    excluded : elements that never touch
    curvatures : A, B [1/m] and semi-axes a, b [m] of a Hertz contact; None for a gap
    """

    x: Array
    y: Array
    dx: float
    dy: float
    h: Array
    excluded: NDArray[np.bool_]
    curvatures: tuple[float, float, float, float] | None = None

    def gap(self, backwards: bool) -> Gap:
        """Return the gap with a ring of excluded elements around it, so that contact may reach the end of the grid.

        A grid with one row is solved as it is: the rows beside it never touch. `backwards` turns it by 180 degrees.
        """
        h = np.pad(np.where(self.excluded, FAR, self.h), 1, constant_values=FAR)
        x, y = (
            np.concatenate(([v[0] - step], v, [v[-1] + step])) for v, step in ((self.x, self.dx), (self.y, self.dy))
        )
        return Gap(-x[::-1], -y[::-1], h[::-1, ::-1]) if backwards else Gap(x, y, h)


def material(case: Case) -> Material:
    """Return the combined material; body 1 is the rail."""
    nu1, nu2, G1, G2 = case["POISS1"], case["POISS2"], case["GG1"], case["GG2"]
    found = Material.from_pair(2.0 * G1 * (1.0 + nu1), nu1, 2.0 * G2 * (1.0 + nu2), nu2)
    if abs(found.coupling) < 1e-4:
        return Material(found.shear_modulus, found.poisson_ratio)
    return found


def bed(case: Case, material: Material) -> Bed:
    """Return grid and gap of a case of module 3."""
    kind, mx, my = case["IPOTCN"], case["MX"], case["MY"]
    if kind in (-4, -5, -6):
        raise refuse(case, "hertz line", f"IPOTCN = {kind}")
    if kind < 0:
        A, B, a, b = _ellipse(case, material)
        scale = case["SCALE"]
        dx, dy = 2.0 * scale * a / mx, 2.0 * scale * b / my
        x, y = (np.arange(mx) + 0.5) * dx - scale * a, (np.arange(my) + 0.5) * dy - scale * b
        h = A * x**2 + B * y[:, None] ** 2
        return Bed(x, y, dx, dy, h, np.zeros(h.shape, dtype=bool), (A, B, a, b))
    x, dx = _along(case, "X", kind, mx)
    y, dy = _along(case, "Y", kind, my)
    h = _undeformed(case, x, y)
    return Bed(x, y, dx, dy, h, _excluded(case, x, y))


def _along(case: Case, axis: str, kind: int, n: int) -> tuple[Array, float]:
    """Return centres and step along an axis [m]."""
    if kind in (1, 3):
        step = case["D" + axis]
        first = case[axis + "L"] + 0.5 * step if kind == 1 else case[axis + "C1"]
    elif kind == 2:
        step = (case[axis + "H"] - case[axis + "L"]) / n
        first = case[axis + "L"] + 0.5 * step
    else:
        if n == 1:
            raise refuse(case, "input", f"M{axis} = 1 with IPOTCN = 4 has no step")
        first = case[axis + "C1"]
        step = (case[axis + "CM"] - first) / (n - 1)
    if not step > 0.0:
        raise refuse(case, "input", f"the step of the grid along {axis.lower()} is {step:g} m")
    return first + np.arange(n) * step, step


def _ellipse(case: Case, material: Material) -> tuple[float, float, float, float]:
    """Return A, B [1/m] and the semi-axes a, b [m] of a Hertz contact."""
    kind = case["IPOTCN"]
    load = case["FN"] if case.digits["N"] == 1 else None
    approach = case["PEN"] if load is None else None
    given = "PEN" if load is None else "FN"
    if case[given] <= 0.0:
        raise refuse(case, "input", f"{given} = {case[given]:g} with a Hertz grid")
    if kind == -3:
        a, b = case["AA"], case["BB"]
        m, _, r = coefficients(*_shares(a / b))
        E = material.contact_modulus
        both = case["PEN"] * m**2 / (r * a**2) if load is None else 0.75 * load * m**3 / (E * a**3)
        A, B = (both * share for share in _shares(a / b))
        return A, B, a, b
    A = case["A1"]
    if kind == -1:
        B = case["B1"]
    else:
        share_a, share_b = _shares(case["AOB"])
        B = A * share_b / share_a
    found = hertz(A, B, load=load, approach=approach, material=material)
    return A, B, found.a, found.b


def _shares(ratio: float) -> tuple[float, float]:
    """Return A and B over A + B of the ellipse with a/b = `ratio`; a/b falls as A/B rises."""
    low, high = -40.0, 40.0  # of log(A/B)
    for _ in range(100):
        middle = 0.5 * (low + high)
        share = 1.0 / (1.0 + math.exp(-middle))
        m, n, _ = coefficients(share, 1.0 - share)
        low, high = (middle, high) if m / n > ratio else (low, middle)
    return share, 1.0 / (1.0 + math.exp(middle))


def _undeformed(case: Case, x: Array, y: Array) -> Array:
    kind, B = case["IBASE"], np.asarray(case["UDB"])
    Y = y[:, None]
    if kind == 1:
        return B[0] * x**2 + B[1] * x * Y + B[2] * Y**2 + B[3] * x + B[4] * Y + B[5]
    if kind == 2:
        at = (y - case["Y1"]) / case["DY1"]
        k = np.clip(np.floor(at).astype(np.int64), 0, B.size - 2)
        profile = B[k] + (at - k) * (B[k + 1] - B[k])
        return profile[:, None] + (x - case["XM"]) ** 2 / (2.0 * case["RM"])
    if kind == 3:
        waves = B[0] * np.sin(B[1] * (x - B[2])) - B[3] * np.sin(B[4] * (x - B[5]))
        return waves + x**2 / B[6] + Y**2 / B[7]
    if B.size != x.size * y.size:
        raise refuse(case, "input", f"the gap has {B.size} numbers, the grid {x.size * y.size} elements")
    return B.reshape(y.size, x.size)


def _excluded(case: Case, x: Array, y: Array) -> NDArray[np.bool_]:
    kind, Y = case["IPLAN"], y[:, None]
    if kind == 1:
        return np.zeros((y.size, x.size), dtype=bool)
    if kind == 2:
        c = case["PLANFORM"]
        return np.asarray(c[0] * x**2 + c[1] * x * Y + c[2] * Y**2 + c[3] * x + c[4] * Y + c[5] >= 0.0)
    if kind == 3:
        numbers = case["PLANFORM"]
    else:
        numbers = case["XYLIM"]
        if any(factor != 1.0 for factor in case.get("FAC", ())) and case["NPATCH"] > 1:
            raise refuse(case, "factors", "IPLAN = 4")
    inside = np.zeros((y.size, x.size), dtype=bool)
    for k in range(0, len(numbers), 4):
        left, right, low, high = (numbers[k], numbers[k + 1], numbers[k + 2], numbers[k + 3])
        inside |= (x >= left) & (x <= right) & (low <= Y) & (high >= Y)
    return ~inside


def direction(case: Case) -> bool:
    """Return whether the contact rolls towards negative x."""
    if case.digits["T"] not in (2, 3):
        return False
    chi = math.remainder(case["CHI"], 2.0 * math.pi)
    if abs(chi) < 1e-6:
        return False
    if abs(abs(chi) - math.pi) < 1e-3:
        return True
    raise refuse(case, "direction", f"CHI = {case['CHI']:g} rad")
