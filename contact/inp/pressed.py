"""Given and approximate pressures (B = 2, 3, 5, 6) of module 3, and contacts by simplified theory (M = 2, 3, 5)."""

from __future__ import annotations

import math

import numpy as np

from contact.halfspace import Gap, GridSolution, Normal, norm
from contact.halfspace.bent import Bent
from contact.halfspace.solution import PressedRecord, assemble
from contact.halfspace.tang import Tangential
from contact.inp import approximate, simplified
from contact.inp.case import Case
from contact.inp.grid import Bed
from contact.inp.reasons import refuse
from contact.inp.results import PatchResult, Result
from contact.inputs.creepage import Creepage
from contact.inputs.material import Material
from contact.results import Status
from contact.theory.hertz import hertz

#: Values of M that are simplified theory on the grid.
SIMPLIFIED = (2, 3, 5)


def normal(case: Case, ground: Bed, bodies: Material) -> Normal:
    """Return the normal solution of B = 0, 2, 3, 5, 6 on the grid of the file, without a ring around it."""
    kind = case.digits["B"]
    amount = {"load": case["FN"]} if case.digits["N"] == 1 else {"approach": case["PEN"]}
    if kind in (0, 5, 6):
        grid = ground.gap(False)
        if kind == 0:
            found = norm(grid.h, grid.dx, grid.dy, bodies, **amount)
            return Normal(found.p[1:-1, 1:-1], found.approach, found.stiffness, found.iterations, found.converged)
        if case.digits["N"] == 1:
            raise refuse(case, "input", f"B = {kind} with N = 1; allowed: N = 0")
        p = approximate.pressure(kind, grid, case["PEN"], bodies)
        return Normal(p[1:-1, 1:-1], case["PEN"], 0.0, 0, True)
    if ground.curvatures is None:
        raise refuse(case, "input", f"B = {kind} without the ellipse of IPOTCN = -1, -2, -3")
    A, B, a, b = ground.curvatures
    whole = hertz(A, B, material=bodies, **amount)
    inside = np.maximum(1.0 - (ground.x / a) ** 2 - (ground.y[:, None] / b) ** 2, 0.0)
    scale = whole.N / (math.pi * a * b)
    return Normal(1.5 * scale * np.sqrt(inside) if kind == 2 else 2.0 * scale * inside, whole.approach, 0.0, 0, True)


def solve(case: Case, ground: Bed, bodies: Material, backwards: bool) -> Result:
    """Return the result of a case by simplified theory: no friction or steady rolling, in CONTACT's signs."""
    digits = case.digits
    if digits["T"] not in (0, 3) or digits["F"] or bodies.coupling != 0.0:
        raise refuse(case, "simplified theory", f"M = {digits['M']} with T = {digits['T']}, F = {digits['F']}")
    found = normal(case, ground, bodies)
    p, element = found.p, ground.dx * ground.dy
    load = case["FN"] if digits["N"] == 1 else float(p.sum()) * element
    values = {"FN": load, "APPROACH": found.approach, "PMAX": float(p.max(initial=0.0))}
    inside = p > 0.0
    values |= {"FX": 0.0, "FY": 0.0, "MZ": 0.0, "NCON": float(inside.sum()), "NADH": float(inside.sum())}
    if digits["T"] == 0 or not inside.any():
        return Result(case, (PatchResult(values),) if inside.any() else (), {}, "ok" if inside.any() else "no contact")
    spin = case["CPHI"]
    motion = simplified.Motion(
        case["CKSI"] + spin * case["SPINYO"], case["CETA"] - spin * case["SPINXO"], spin, case["VELOC"]
    )
    Creepage(motion.xi, motion.eta, motion.phi)  # refuses what is out of range
    axes = None if ground.curvatures is None else ground.curvatures[2:]
    made = simplified.Ground(ground.x, ground.y, ground.dx, ground.dy, p, axes)
    q, slip, slips, _ = simplified.traction(case, made, motion, bodies, backwards)
    values |= {
        "FX": float(q[0].sum()) * element,
        "FY": float(q[1].sum()) * element,
        "MZ": float((ground.x * q[1] - ground.y[:, None] * q[0]).sum()) * element,
        "CKSI": case["CKSI"],
        "CETA": case["CETA"],
        "CPHI": spin,
        "NADH": float((inside & ~slips).sum()),
        "NSLIP": float((inside & slips).sum()),
        "FRIC.POWER": float((q * slip).sum()) * element * case["VELOC"],
    }
    return Result(case, (PatchResult(values),))


def on_patch(case: Case, gap: Gap, found: Normal, creepage: Creepage, speed: float, bodies: Material) -> GridSolution:
    """Return the solution of a patch of a wheel and a rail by simplified theory, in our signs."""
    p, status, friction = found.p, Status.NO_CONTACT, 0.0
    q = slip = np.zeros((2, *p.shape))
    sticks = p > 0.0
    if p.any():
        status = Status.OUT_OF_RANGE if p[[0, -1]].any() or p[:, [0, -1]].any() else Status.OK
        ground = simplified.Ground(gap.x, gap.y, gap.dx, gap.dy, p)
        motion = simplified.Motion(-creepage.longitudinal, -creepage.lateral, -creepage.spin, speed)
        q, slip, slips, friction = simplified.traction(case, ground, motion, bodies, False)
        sticks = sticks & ~slips
    rolling = Tangential(-q[0], -q[1], -slip[0], -slip[1], sticks, 0, 0, 0.0, True)
    return assemble(
        gap.x,
        gap.y,
        p,
        rolling,
        Bent.plane(creepage, gap.y),
        PressedRecord(found.approach, found.stiffness, found.iterations, status),
        creepage=creepage,
        friction=friction,
        material=bodies,
        speed=speed,
        tangential="fastrip" if case.digits["M"] == 5 else "fastsim",
    )
