"""Run steady rolling of module 3 by the default methods on strips, without a grid (`--fast`)."""

from __future__ import annotations

from typing import Any

import numpy as np

from contact.arrays import Array
from contact.friction import Friction
from contact.inp.case import Case
from contact.inp.grid import bed, direction, material
from contact.inp.laws import of_strips
from contact.inp.reasons import refuse
from contact.inp.results import PatchResult, Result
from contact.inp.single import layer, require_supported
from contact.inputs.creepage import Creepage
from contact.inputs.separation import Separation
from contact.registry import DEFAULT_NORMAL, lookup
from contact.results import Solution, Status
from contact.solve import solve

#: Samples of a separation.
_SAMPLES = 201


class FastSingle:
    """Runs cases of one contact by strips; nothing is left behind."""

    def solve(self, case: Case) -> Result:
        """Return the result of a case."""
        require_supported(case, fast=True)
        digits, bodies = case.digits, material(case)
        if digits["T"] in (1, 2) or bodies.coupling != 0.0 or layer(case) is not None:
            raise refuse(case, "strips", "a step, unlike bodies or a third body")
        backwards = direction(case)
        sign = 1.0 if backwards else -1.0
        separation = _separation(case, bodies, backwards)
        spin = case["CPHI"]
        xi = case.get("CKSI", 0.0) + spin * case["SPINYO"]
        eta = case.get("CETA", 0.0) - spin * case["SPINXO"]
        friction = of_strips(case) if digits["T"] else Friction(0.0)
        force: Any = None
        if digits["F"] and digits["T"]:
            if digits["N"] == 0:
                raise refuse(case, "strips", "a given force with N = 0")
            scale = sign * friction.static * case["FN"]
            force = scale * case["FXREL"], (scale * case["FYREL"] if digits["F"] == 2 else None)
        amount = {"load": case["FN"]} if digits["N"] == 1 else {"approach": case["PEN"]}
        creepage = Creepage(sign * xi, sign * eta, -spin) if digits["T"] else Creepage()
        speed = case["VELOC"] if digits["T"] else 1.0
        found = solve(
            separation, creepage, friction=friction, material=bodies, speed=speed, force=force, throw=False, **amount
        )
        return Result(
            case,
            (strip_patch(case, found, sign),) if found.N > 0.0 else (),
            {},
            in_words(found.status, found.gap_error),
        )


def in_words(status: Status, gap_error: float) -> str:
    """Return the status in words: "doubtful gap" where strips are no good model of the gap."""
    if status in (Status.OK, Status.SATURATED) and gap_error > lookup("normal", DEFAULT_NORMAL).gap_limit:
        return "doubtful gap"
    return status.name.lower().replace("_", " ")


def strip_patch(case: Case, s: Solution, sign: float) -> PatchResult:
    """Return the numbers of a patch on strips; `sign` times our force is CONTACT's."""
    values = {
        "FN": s.N,
        "FX": sign * s.Fx,
        "FY": sign * s.Fy,
        "MZ": -s.Mz,
        "CKSI": sign * s.creepage.longitudinal,
        "CETA": sign * s.creepage.lateral,
        "CPHI": -s.creepage.spin,
        "APPROACH": s.approach,
        "PMAX": s.max_pressure,
        "FRIC.POWER": -s.power_per_metre * s.speed,
    }
    return PatchResult(values, s)


def _separation(case: Case, bodies: Any, backwards: bool) -> Separation:
    ground = bed(case, bodies)
    if ground.y.size == 1:
        raise refuse(case, "strips", "one row of elements")
    if ground.excluded.any():
        raise refuse(case, "strips", "IPLAN other than 1")
    low, high = ground.y[0] - 0.5 * ground.dy, ground.y[-1] + 0.5 * ground.dy
    y = np.linspace(low, high, _SAMPLES)
    A: Array | float
    centre: Array | float
    if ground.curvatures is not None:
        A, B, _, _ = ground.curvatures
        g, centre = B * y**2, 0.0 * y
    elif case["IBASE"] == 1:
        b = case["UDB"]
        A = b[0]
        if not A > 0.0:
            raise refuse(case, "strips", "B1 of the gap is not positive")
        slope = b[1] * y + b[3]
        centre = -slope / (2.0 * A)
        g = b[2] * y**2 + b[4] * y + b[5] - slope**2 / (4.0 * A)
    elif case["IBASE"] == 2:
        b = np.asarray(case["UDB"])
        at = (y - case["Y1"]) / case["DY1"]
        k = np.clip(np.floor(at).astype(np.int64), 0, b.size - 2)
        g, A, centre = b[k] + (at - k) * (b[k + 1] - b[k]), 0.5 / case["RM"], case["XM"] + 0.0 * y
    else:
        raise refuse(case, "strips", f"IBASE = {case['IBASE']}")
    if backwards:
        return Separation(-y[::-1], g[::-1], A, -np.asarray(centre)[::-1])
    return Separation(y, g, A, centre)
