"""Run cases of module 1: a wheel on a rail, by the half space on the file's elements, or by strips."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from contact.friction import Friction
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.shape import Profile
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.halfspace import GridSolution
from contact.inp import bodies, fast
from contact.inp.case import Case
from contact.inp.grid import material
from contact.inp.mesh import Wheel, flattened, turned
from contact.inp.reasons import refuse, require_digits
from contact.inp.results import PatchResult, Result
from contact.inp.single import layer
from contact.inputs.creepage import Creepage
from contact.pair.halfspace import HalfspacePair
from contact.pair.solution import Contact, PairSolution, Solved
from contact.pair.wheel_rail import WheelRailPair
from contact.solve import solve as solve_contact

_LAWS = {2: ("linear", "FLIN"), 3: ("rational", "FRAT"), 4: ("exponential", "FEXP")}


def require_supported(case: Case, by_strips: bool) -> None:
    """Raise a `RefusedError` for what cannot run on a wheel and a rail."""
    require_digits(case, by_strips)
    digits = case.digits
    for reason, wrong, what in (
        ("flexible wheel", any(case.get(name) for name in _FLEXIBLE), "deviations of E = 4, 5"),
        ("layer on a pair", digits["M"] == 4 and by_strips, "M = 4"),
        ("damping", digits["M2"] == 2 and any(case[name] for name in ("CDAMPN", "CDAMPT")), "M2 = 2"),
        ("curve", case["CURV"] != 0.0, "CURV"),
        ("unlike bodies in a pair", material(case).coupling != 0.0, "K"),
        ("friction along the profile", case["ROWS"] == 1 and by_strips and _varies(case), "V = 1"),
    ):
        if wrong:
            raise refuse(case, reason, what)


_FLEXIBLE = ("DXWHL", "DYWHL", "DZWHL", "DROLLW", "DYAWW", "DPITCHW")


def _varies(case: Case) -> bool:
    names = ("FSTAT", "FKIN", "FLIN1", "FRAT1", "FEXP1")
    return any(isinstance(case.get(name), tuple) and len(set(case[name])) > 1 for name in names)


class _FilePair(HalfspacePair):
    """A pair that takes friction and creepages of a patch as the file gives them."""

    case: Case
    pose: Pose
    wheel: Wheel | None = None  # of revolution

    def _solved(self, patch: SurfacePatch, velocity: Velocity, friction: float | Friction) -> Solved:
        case = self.case
        if self.wheel is not None:
            patch = flattened(patch, self.pair, self.pose, self.wheel, case["DS"])
        c, ratio = patch.creepage, velocity.forward / _mean_speed(patch, velocity)
        creepage = Creepage(c.longitudinal * ratio, c.lateral * ratio, c.spin * ratio)
        found = solve_contact(
            patch.gap,
            creepage,
            approach=patch.approach,
            friction=_friction(case, patch, self.pair.side) if case.digits["T"] else 0.0,
            material=self.pair.material,
            layer=layer(case) if case.digits["T"] else None,
            speed=velocity.forward / ratio,
            throw=False,
            normal="halfspace",
            tangential="halfspace",
        )
        return Solved(patch, found, patch.frame.axes)


def _mean_speed(patch: Any, velocity: Velocity) -> float:
    """Return V to which CONTACT refers creepages [m/s]: the mean of the speeds of both surfaces."""
    spin = velocity.spin if velocity.spin is not None else -velocity.forward / patch.rolling_radius
    mean = 0.5 * (math.hypot(velocity.forward, velocity.y) + abs(spin) * patch.rolling_radius)
    return mean if mean > 0.0 else 1.0


def _friction(case: Case, patch: Any, side: str) -> Friction:
    """Return the friction of a patch; over the inclination, that at its contact angle in wheel axes of the right side."""
    rows = case["ROWS"]

    def value(name: str) -> float:
        given = case[name]
        if rows == 0:
            return float(given)
        if rows == 2:
            return float(np.interp(case["S_WS"], case["SVF"], given))
        mirror = 1.0 if side == "right" else -1.0
        angle = mirror * (patch.angle - case["ROLL"])
        return float(np.interp(angle, case["ALPHA"], given))

    kind = case["LAW"]
    if kind == 0:
        return Friction(value("FSTAT"))
    name, prefix = _LAWS[kind]
    two = np.any(np.asarray(case[f"{prefix}2"]) != 0.0)
    if two or case["MEMDST"] > 0.0:
        raise refuse(case, "law on a pair", f"L = {kind}")
    first, kinetic = value(f"{prefix}1"), value("FKIN")
    return Friction(kinetic + first, kinetic, value("SABSH1"), name, velocity="local")


class PairRunner:
    """Runs cases of a wheel on a rail."""

    def __init__(self, fast: bool, memory: float) -> None:
        self._fast, self._memory = fast, memory
        self._key: Any = None
        self._pair: HalfspacePair | WheelRailPair | None = None

    def solve(self, case: Case) -> Result:
        """Return the result of a case."""
        require_supported(case, self._fast)
        pair = self._prepared(case)
        pose = Pose(case["Y_WS"], case.get("Z_WS", 0.0) if case.digits["N"] == 0 else 0.0, case["ROLL"], case["YAW"])
        velocity = Velocity(*(case[name] for name in ("VS", "VY", "VZ", "VROLL", "VYAW", "VPITCH")))
        if not velocity.forward > 0.0:
            raise refuse(case, "input", f"VS = {velocity.forward:g}; allowed: positive")
        if isinstance(pair, _FilePair):
            pair.case, pair.pose = case, pose
        rail = Irregularity(*(case[name] for name in _DEVIATIONS))
        amount: dict[str, Any] = {}
        if case.digits["N"] == 1:
            if case["FZ"] <= 0.0:
                return Result(case, status="no contact")
            amount["vertical"] = case["FZ"]
        friction: Any = 0.0 if not case.digits["T"] else _first_friction(case)
        found = pair.solve(
            pose,
            velocity,
            station=case["S_WS"],
            rotation=case["PITCH"],
            irregularity=rail,
            friction=friction,
            **amount,
        )
        result = _result(case, found, velocity)
        if self._fast and bodies.has_slices(case) and result.status in ("ok", "saturated"):
            return replace(
                result, status="doubtful gap"
            )  # the edge of a flat is no parabola, and gap_error misses some
        return result

    def _prepared(self, case: Case) -> HalfspacePair | WheelRailPair:
        key = bodies.key(case)
        if self._pair is None or key != self._key:
            made: SurfacePair = bodies.pair(case)
            if self._fast:
                self._pair = WheelRailPair(made, material=made.material)
            else:
                self._pair = _FilePair(made)
                self._pair.pair.division = bodies.Centred(*made.division)
                profile = bodies.body(case, "W")
                self._pair.wheel = Wheel.of(profile, case["NOMRADW"]) if isinstance(profile, Profile) else None
            self._key = key
        return self._pair


_DEVIATIONS = ("DYRAIL", "DZRAIL", "DROLLR", "VYRAIL", "VZRAIL", "VROLLR")


def _first_friction(case: Case) -> Friction:
    """Return the friction of strips; on the half space each patch has its own."""

    class Middle:
        angle = 0.0

    return _friction(case, Middle, "right")


def _result(case: Case, found: PairSolution, velocity: Velocity) -> Result:
    """Return the result in CONTACT's signs."""
    force = -np.asarray(found.force)  # on the rail
    roll, yaw = case["ROLL"], case["YAW"]
    in_wheelset = turned(roll, yaw).T @ force
    values = dict(zip(("FX(TR)", "FY(TR)", "FZ(TR)"), map(float, force), strict=True))
    values |= dict(zip(("FX(WS)", "FY(WS)", "FZ(WS)"), map(float, in_wheelset), strict=True))
    values["Z_WS"] = found.z
    mirror = 1.0 if case.digits["C1"] in (1, 5) else -1.0
    patches = tuple(_patch(case, each, velocity, mirror) for each in found.contacts if each.N > 0.0)
    return Result(case, patches, values, fast.in_words(found.status, found.gap_error))


def _patch(case: Case, c: Contact, velocity: Velocity, mirror: float) -> PatchResult:
    solution = c.solution
    values = {
        "FN": c.N,
        "FX": -c.Fx,
        "FY": -c.Fy,
        "MZ": -c.Mz,
        "APPROACH": c.approach,
        "PMAX": c.max_pressure,
        "DELTCP(TR)": c.angle,
        "YCP(W)": mirror * c.on_wheel[0],
    }
    cant = case.get("CANT", 0.0)  # the file's profile is upright
    y, z = (float(at) for at in c.on_rail)
    values["YCP(R)"] = mirror * (math.cos(cant) * y - math.sin(cant) * z)
    values["ZCP(R)"] = math.sin(cant) * y + math.cos(cant) * z
    creepage = c.creepage if solution is None else solution.creepage
    values |= {"CKSI": -creepage.longitudinal, "CETA": -creepage.lateral, "CPHI": -creepage.spin}
    where = c.position if c.patch is None else c.patch.position
    values |= dict(zip(("XCP(TR)", "YCP(TR)", "ZCP(TR)"), map(float, where), strict=True))
    if isinstance(solution, GridSolution):
        inside = solution.p > 0.0
        sticks = int((solution.stick & inside).sum()) if case.digits["T"] else int(inside.sum())
        values |= {"NCON": float(inside.sum()), "NADH": float(sticks), "NSLIP": float(inside.sum() - sticks)}
        values["FRIC.POWER"] = -solution.power_per_metre * solution.speed
    return PatchResult(values, solution)
