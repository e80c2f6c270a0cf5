"""Simplified theory on the file's grid: FASTSIM with Kalker's coefficients on a Hertz contact (M = 3, B = 2 or 3)."""

from __future__ import annotations

import math

import numpy as np

from contact.arrays import Array
from contact.inp.case import Case
from contact.inp.grid import Bed
from contact.inp.reasons import refuse
from contact.inp.results import PatchResult, Result
from contact.inputs.material import Material
from contact.theory.hertz import hertz
from contact.theory.kalker import coefficients, table

#: Position of the rigid slip ahead of an element's centre, over dx.
_OFFSET = 1.0 / 6.0


def solve(case: Case, ground: Bed, bodies: Material, backwards: bool) -> Result:
    """Return the result of steady rolling by FASTSIM (Kalker 1982), in CONTACT's signs.

    The displacement of an element is L times its traction, with L1, L2, L3 from Kalker's coefficients of the ellipse. The
    bound is friction times the given pressure: an ellipsoid (B = 2) or a paraboloid (B = 3).
    """
    if ground.curvatures is None or case.digits["B"] not in (2, 3):
        raise refuse(case, "simplified bodies", "B = 0, or no Hertz contact")
    if case["LAW"] != 0 or case["ROWS"] != 0:
        raise refuse(case, "simplified theory", "M = 3 with friction over the slip velocity")
    if (case["K0_MF"], case["ALFAMF"]) != (1.0, 1.0):
        raise refuse(case, "simplified theory", "M = 3 with a reduced slope")
    if case.digits["T"] != 3 or case.digits["F"] != 0 or bodies.coupling != 0.0:
        raise refuse(case, "simplified theory", "M = 3 with T other than 3, given forces or unlike bodies")
    A, B, a, b = ground.curvatures
    amount = {"load": case["FN"]} if case.digits["N"] == 1 else {"approach": case["PEN"]}
    found = hertz(A, B, material=bodies, **amount)
    p = _pressure(case, ground, found.N, a, b)
    L1, L2, L3 = flexibilities(a, b, bodies)
    friction, x, y, dx = case["FSTAT"], ground.x, ground.y, ground.dx
    xi = case["CKSI"] + case["CPHI"] * case["SPINYO"]
    eta = case["CETA"] - case["CPHI"] * case["SPINXO"]
    phi, ahead = case["CPHI"], -1.0 if backwards else 1.0
    q, slips, power = np.zeros((2, *p.shape)), np.zeros(p.shape, dtype=bool), 0.0
    last = np.zeros((2, y.size))
    for j in range(x.size) if backwards else range(x.size - 1, -1, -1):
        turn = phi * (x[j] + ahead * _OFFSET * dx)
        w = np.stack((xi - phi * L1 / L3 * y, np.full(y.size, eta + turn * L2 / L3)))
        free = last - dx * w / np.array([[L1], [L2]])
        size, bound = np.hypot(*free), friction * p[:, j]
        slips[:, j] = size > bound
        now = free * np.where(slips[:, j], bound / np.maximum(size, 1e-300), 1.0)
        slip = w + np.array([[L1], [L2]]) * (now - last) / dx
        power += float((now * slip)[:, p[:, j] > 0.0].sum())
        q[:, :, j] = last = now
    element = dx * ground.dy
    inside = p > 0.0
    values = {
        "FN": float(p.sum()) * element,
        "FX": float(q[0].sum()) * element,
        "FY": float(q[1].sum()) * element,
        "MZ": float((x * q[1] - y[:, None] * q[0]).sum()) * element,
        "CKSI": case["CKSI"],
        "CETA": case["CETA"],
        "CPHI": phi,
        "APPROACH": found.approach,
        "PMAX": float(p.max()),
        "NCON": float(inside.sum()),
        "NADH": float((inside & ~slips).sum()),
        "NSLIP": float((inside & slips).sum()),
        "FRIC.POWER": power * element * case["VELOC"],
    }
    return Result(case, (PatchResult(values),))


def flexibilities(a: float, b: float, bodies: Material) -> tuple[float, float, float]:
    """Return L1, L2, L3 [m/Pa] of an ellipse with the semi-axes a, b [m]."""
    c11, c22, c23, _ = coefficients(table(bodies.poisson_ratio), math.log(a / b))
    G = bodies.shear_modulus
    return 8.0 * a / (3.0 * c11 * G), 8.0 * a / (3.0 * c22 * G), math.pi * a * math.sqrt(a / b) / (4.0 * c23 * G)


def _pressure(case: Case, ground: Bed, load: float, a: float, b: float) -> Array:
    """Return the given pressure [Pa]."""
    inside = 1.0 - (ground.x / a) ** 2 - (ground.y[:, None] / b) ** 2
    scale = load / (math.pi * a * b)
    if case.digits["B"] == 2:
        return 1.5 * scale * np.sqrt(np.maximum(inside, 0.0))
    return 2.0 * scale * np.maximum(inside, 0.0)
