"""Run cases of module 1: a wheel on a rail or a roller, by the half space on the file's elements, or by strips."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError, require_number
from contact.geometry.flexible import WheelOffset
from contact.geometry.records import Pose, Velocity
from contact.geometry.surfaces import SurfacePatch
from contact.given_force import depth_under
from contact.halfspace import GridSolution, Normal
from contact.halfspace.lattice import Lattice
from contact.halfspace.parts import norm_of_parts
from contact.inp import approximate, bent, bodies, fast, lobes, pressed, single
from contact.inp.case import Case
from contact.inp.grid import material
from contact.inp.laws import of_strips
from contact.inp.mesh import flattened
from contact.inp.outline import Outlines, to_track
from contact.inp.reasons import refuse, require_digits
from contact.inp.results import PatchResult, Result
from contact.inp.search import Search
from contact.inputs.creepage import Creepage
from contact.instance.ownership import within
from contact.kernels.enumerations import Height
from contact.kernels.records import LARGEST_ANGLE
from contact.pair.curved import Elements
from contact.pair.elastic_rail import ElasticRail
from contact.pair.halfspace import Instant
from contact.pair.sliding import Bodies, Roller
from contact.pair.solution import Contact, PairSolution, Solved
from contact.pair.transient import TransientPair
from contact.pair.wheel_rail import WheelRailPair
from contact.results import Status

#: Largest roll [rad], more than a wheelset has. The limit of yaw stays: beyond it the search misses contacts.
_LARGEST_ROLL = 0.3
#: Search of a height: tolerance over the force, and relative error above which the status tells of it.
_TOLERANCE, _MISSED = 3e-5, 1e-3


class _Pose(Pose):
    """A pose with a larger roll, as single wheels have it."""

    def __post_init__(self) -> None:
        require_number("ROLL", self.roll, -_LARGEST_ROLL, _LARGEST_ROLL)
        require_number("YAW", self.yaw, -LARGEST_ANGLE, LARGEST_ANGLE)


def require_supported(case: Case, by_strips: bool) -> None:
    """Raise a `RefusedError` for what cannot run on a wheel and a rail."""
    require_digits(case, by_strips)
    digits = case.digits
    for reason, wrong, what in (
        ("strips", by_strips and digits["T"] in (1, 2), f"T = {digits['T']}"),
        ("strips", by_strips and bodies.is_roller(case), f"C = {digits['C1']}"),
        ("strips", by_strips and case["LAW"] == 6, "L = 6"),
        ("strips", by_strips and case["CURV"] != 0.0, "CURV"),
        ("layer on strips", digits["M"] == 4 and by_strips, "M = 4"),
        (
            "simplified theory",
            digits["M"] in pressed.SIMPLIFIED and not by_strips and digits["T"] in (1, 2),
            "T = 1, 2",
        ),
        ("damping", digits["M2"] == 2 and any(case[name] for name in ("CDAMPN", "CDAMPT")), "M2 = 2"),
        ("unlike bodies on strips", by_strips and material(case).coupling != 0.0, "K"),
        ("friction along the profile", case["ROWS"] == 1 and by_strips and _varies(case), "V = 1"),
        ("force in a shift", digits["T"] == 1 and digits["F"] == 1, "F = 1 with T = 1"),
    ):
        if wrong:
            raise refuse(case, reason, what)


def _varies(case: Case) -> bool:
    names = ("FSTAT", "FKIN", "FLIN1", "FRAT1", "FEXP1")
    return any(isinstance(case.get(name), tuple) and len(set(case[name])) > 1 for name in names)


class _FilePair(TransientPair):
    """A pair that takes friction, creepages and places of elements as the file and CONTACT give them."""

    case: Case
    outlines: Outlines

    def take(self, case: Case) -> None:
        """Take what is given besides the motion."""
        self.case = case
        self.layer = single.layer(case) if case.digits["T"] else None
        self.conformal, self.true_slip = case["SEARCH"] == 4, case["SEARCH"] == 3
        self.turns = case["MAXOUT"] if self.pair.material.coupling != 0.0 else 1

    def _lattice(self, at: Instant) -> Lattice:
        if self.case.digits["T"] in (1, 2):
            return super()._lattice(at)
        return Lattice.centred(self._spacing)

    def _moving(self, at: Instant, **options: Any) -> Bodies:
        case = self.case
        if self.pair.rail.roller_radius is not None:
            options["roller"] = Roller(case["NOMRADR"], case["NOMRADR"], -at.station)
        return super()._moving(at, curvature=case["CURV"], own_axis=False, **options)

    def _rolling(self, patch: SurfacePatch, at: Instant) -> tuple[Creepage, float]:
        one = self._slide(patch, at)
        shift = self.case.digits["T"] == 1
        speed = one.mean if one.mean > 0.0 and not shift else 1.0
        return Creepage(one.x / speed, one.y / speed, one.spin / speed), speed

    def _backwards(self, patch: SurfacePatch, at: Instant) -> bool:
        return self.case.digits["T"] in (2, 3) and not self._slide(patch, at).forwards

    def _place(self, at: Instant) -> None:  # the search needs no velocity
        super()._place(at._replace(velocity=Velocity()))

    def _law(self, patch: SurfacePatch, at: Instant, rows: Elements | None) -> Any:
        case, side = self.case, self.pair.side
        if not case.digits["T"]:
            return 0.0
        if rows is None or not self.conformal or case["ROWS"] != 1:
            return single.law(_at_patch(case, patch.angle, side), 1, False)
        inner = rows.angle[1:-1] * (1.0 if side == "right" else -1.0)
        values: dict[str, Any] = {
            name: tuple(np.interp(inner, case["ALPHA"], case[name]).tolist())
            for name in _CONSTANTS
            if isinstance(case.get(name), tuple)
        }
        return single.law(case.changed(**values), inner.size, False)

    def _solved(self, patch: SurfacePatch, at: Instant) -> Solved:
        if not self.conformal:
            patch = flattened(patch, self.pair, self._pose, self.outlines, patch.gap.dy)
        if not (self.case.digits["M"] in pressed.SIMPLIFIED and self.case.digits["T"]):
            return super()._solved(patch, at)
        if self._backwards(patch, at):
            raise refuse(self.case, "direction", f"M = {self.case.digits['M']} that rolls towards negative x")
        creepage, speed = self._rolling(patch, at)
        case, gap, bodies = _at_patch(self.case, patch.angle, self.pair.side), patch.gap, self.pair.material
        normal = self._normal(patch)(gap.h, gap.dx, gap.dy, bodies, approach=patch.approach)
        return Solved(patch, pressed.on_patch(case, gap, normal, creepage, speed, bodies), patch.frame.axes)

    def _normal(self, patch: SurfacePatch) -> Callable[..., Normal]:
        """Return what solves the normal problem of a patch: B = 5, 6, or lobes that act on each other in shares."""
        kind = self.case.digits["B"]
        if kind in (5, 6):
            return partial(approximate.normal, kind, patch.gap)
        parts = lobes.parts(patch.gap, patch.approach, self.case["D_COMB"], self.case["D_SEP"])
        return super()._normal(patch) if parts is None else partial(norm_of_parts, parts=parts)

    def _solution(self, patches: Sequence[SurfacePatch], at: Instant) -> PairSolution:
        """Return the solution of patches as CONTACT separates them: beyond D_SEP each counts for itself, and fully."""
        search = Search(self.pair, self._pose, self.outlines, self.case)
        return super()._solution(search.patches(patches), at)

    def _under(self, vertical: float, at: Instant) -> PairSolution:
        """Return the solution under a vertical force, from whole solutions at heights, of which few are needed.

        The force of KPEC, and that of lobes at the limits of their distance, jumps; then the height is the best of those that
        were tried.
        """
        found: PairSolution | None = None
        last = 0.0
        within(self.pair.found)(Height.PENETRATION, 0.0)
        touch = self.pair.z

        def force(depth: float) -> float:
            nonlocal found, last
            self.pair.space.motion[0].z, last = touch + depth, depth
            found = self._solution(within(self.pair.found)(), at)
            return found.Q

        best = depth_under(force, vertical, self._depth if self.case.continues else None, _TOLERANCE)
        if best is not None and best[1] != last:
            force(best[1])
        if found is None or best is None:
            raise ContactError(f"FZ = {vertical:g}: no height was found at which the wheel carries it on this rail")
        missed, self._depth = best
        return replace(found, status=Status.NOT_CONVERGED) if missed > _MISSED else found

    def _true(self, patch: SurfacePatch) -> Elements:
        rows = bent.elements(self.pair, patch, self._pose, self.outlines, patch.gap.dy) if self.conformal else None
        return super()._true(patch) if rows is None else rows

    def _slip(self, rows: Elements, at: Instant) -> Array:
        """Return the slip in the plane halfway between the directions in which both surfaces move, as CONTACT does."""
        case, speed = self.case, abs(at.velocity.forward)
        if case.digits["T"] == 1 or speed == 0.0:
            return super()._slip(rows, at)
        ahead, moving = np.array([self._moved[0], 0.0, 0.0]), self._moving(at)
        back = -1.0 if at.velocity.forward < 0.0 else 1.0
        wheel, rail = (
            np.einsum("rai,rci->arc", rows.axes, body.at(place + ahead))
            for body, place in ((moving.wheel, rows.on_wheel), (moving.rail, rows.on_rail))
        )
        stiffness = [case[f"GG{k}"] / (1.0 - case[f"POISS{k}"]) for k in (1, 2)]
        share = stiffness[1] / sum(stiffness)
        middle = share * rail + (1.0 - share) * wheel
        # a roller moves under the contact, a rail with it
        along, up = middle[0] - (0.0 if self.outlines.roller is not None else back * speed), middle[2]
        slip = wheel - rail
        x = -back * (slip[0] * along + slip[2] * up) / np.hypot(along, up)
        return np.stack((x, slip[1]))

    def _pull(self, found: PairSolution) -> float:
        return float(to_track(self.case["ROLL"], self.case["YAW"])[:, 0] @ np.asarray(found.force))


def _at_patch(case: Case, angle: float, side: str) -> Case:
    """Return the case with one set of friction constants: over the inclination that at the contact angle in wheel axes."""
    rows = case["ROWS"]
    if rows == 0:
        return case
    if rows == 2:
        where, known = case["S_WS"], case["SVF"]
    else:
        rolled = case["ROLL"] + case.get("DROLLW", 0.0)
        where, known = (angle - rolled) * (1.0 if side == "right" else -1.0), case["ALPHA"]
    values: dict[str, Any] = {
        name: float(np.interp(where, known, case[name])) for name in _CONSTANTS if isinstance(case.get(name), tuple)
    }
    return case.changed(ROWS=0, **values)


_CONSTANTS = (
    *("FSTAT", "FKIN", "FREF", "TREF", "DFHEAT", "DTHEAT", "SABSH1", "SABSH2"),
    *(f"F{law}{k}" for law in ("LIN", "RAT", "EXP") for k in "12"),
)


class PairRunner:
    """Runs cases of a wheel on a rail in order, with what they leave behind."""

    def __init__(self, fast: bool, memory: float) -> None:
        self._fast, self._memory = fast, memory
        self._key: Any = None
        self._pair: _FilePair | WheelRailPair | None = None
        self._before: Any = ()

    def solve(self, case: Case) -> Result:
        """Return the result of a case."""
        require_supported(case, self._fast)
        pair, digits = self._prepared(case), case.digits
        roller = bodies.is_roller(case)
        forward = case["RPITCH"] * case["NOMRADR"] if roller else case["VS"]
        spin = None if digits["F"] == 1 else case["VPITCH"]
        velocity = Velocity(forward, case["VY"], case["VZ"], case["VROLL"], case["VYAW"], spin)
        if self._fast and not forward > 0.0:
            raise refuse(case, "strips", f"VS = {forward:g} m/s")
        given: dict[str, Any] = {"irregularity": bodies.irregularity(case)}
        if not self._fast or bodies.has_slices(case):
            given |= {"station": 0.0 if roller else case["S_WS"], "rotation": case["PITCH"]}  # X_WS has no effect
        if any(case.get(name) for name in _OFFSET):
            given["offset"] = _offset(case)
        if digits["N"] == 1:
            if case["FZ"] <= 0.0:
                return Result(case, status="no contact")
            given["vertical"] = case["FZ"]
        if digits["F"] == 3:
            ky, kz = (case[f"K{axis}RAIL"] or math.inf for axis in "YZ")
            given["rail"] = ElasticRail(ky, kz, case["FYRAIL"], case["FZRAIL"])
        pose = _Pose(case["Y_WS"], case.get("Z_WS", 0.0) if digits["N"] == 0 else 0.0, case["ROLL"], case["YAW"])
        if isinstance(pair, _FilePair):
            found = self._stepped(case, pair, pose, velocity, given)
        else:
            given["friction"] = of_strips(_at_patch(case, 0.0, "right")) if digits["T"] else 0.0
            found = pair.solve(pose, velocity, force=-case["FX_WS"] if digits["F"] == 1 else None, **given)
        result = _result(case, found)
        if self._fast and bodies.has_slices(case) and result.status in ("ok", "saturated"):
            return replace(result, status="doubtful gap")  # flats end in edges, and gap_error misses some
        return result

    def _stepped(
        self, case: Case, pair: _FilePair, pose: Pose, velocity: Velocity, given: dict[str, Any]
    ) -> PairSolution:
        """Return the solution of the case's step, from what the case before has left."""
        digits = case.digits
        pair.take(case)
        if not case.continues:
            pair.forget()
        elif digits["P"] == 3:
            pair.restore(self._before)
        elif digits["P"] == 1:
            pair.forget(keep_pressure=True)
        self._before = pair.state
        if digits["T"] == 1:
            return pair.shift(pose, velocity, **given)
        if digits["F"] == 1:
            given["force"] = -case["FX_WS"]
        if digits["T"] == 2:
            sliding = digits["G"] in (2, 3, 4) and case["INISLP"] < 0
            return pair.roll(pose, velocity, distance=case["DQREL"] * case["DX"], sliding=sliding, **given)
        return pair.roll_on(pose, velocity, **given)

    def _prepared(self, case: Case) -> _FilePair | WheelRailPair:
        key = bodies.key(case)
        if self._pair is None or key != self._key:
            last = self._pair
            if self._fast:
                profiles = bodies.profiles(case)
                self._pair = WheelRailPair(bodies.pair(case) if profiles is None else profiles, material=material(case))
            else:
                made = bodies.pair(case)
                self._pair = _FilePair(made)
                self._pair.outlines = bodies.outlines(case)
                if isinstance(last, _FilePair) and last.pair.division.spacing == made.division.spacing:
                    self._pair.restore(last.state)
            self._key = key
        return self._pair


#: Displacements and velocities of a flexible wheel.
_OFFSET = tuple(f"{first}{name}" for first in "DV" for name in ("XWHL", "YWHL", "ZWHL", "ROLLW", "PITCHW", "YAWW"))


def _offset(case: Case) -> WheelOffset:
    """Return the displacement of a flexible wheel at its datum on the axle.

    CONTACT gives it in the axes of the wheelset, at the lowest point of the wheel, about which it turns.
    """
    turn, own = to_track(case["ROLL"], case["YAW"]), to_track(case["DROLLW"], case["DYAWW"])
    place, rate = (np.array([case[f"{first}{axis}WHL"] for axis in "XYZ"]) for first in "DV")
    angles, turning = ([case[f"{first}{name}W"] for name in ("ROLL", "PITCH", "YAW")] for first in "DV")
    up = np.array([0.0, 0.0, -case["NOMRADW"]])  # from the lowest point to the datum
    place = turn @ (place + own @ up - up)
    rate = turn @ (rate + np.cross(turning, own @ up))
    return WheelOffset(*map(float, place), *angles, *map(float, rate), *turning)


def _result(case: Case, found: PairSolution) -> Result:
    """Return the result in CONTACT's signs."""
    force = -np.asarray(found.force)  # on the rail
    roll, yaw = case["ROLL"], case["YAW"]
    in_wheelset = to_track(roll, yaw).T @ force
    values = dict(zip(("FX(TR)", "FY(TR)", "FZ(TR)"), map(float, force), strict=True))
    values |= dict(zip(("FX(WS)", "FY(WS)", "FZ(WS)"), map(float, in_wheelset), strict=True))
    values["Z_WS"] = found.z
    patches = tuple(_patch(case, each) for each in found.contacts if each.N > 0.0)
    return Result(case, patches, values, fast.in_words(found.status, found.gap_error))


def _patch(case: Case, c: Contact) -> PatchResult:
    solution, mirror = c.solution, bodies.mirror_of(case)
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
    cant = -bodies.turn_of_rail(case)  # the file's profile is upright
    y, z = (float(at) for at in c.on_rail)
    values["YCP(R)"] = mirror * (math.cos(cant) * y - math.sin(cant) * z)
    values["ZCP(R)"] = math.sin(cant) * y + math.cos(cant) * z
    creepage = c.creepage if solution is None else solution.creepage
    values |= {"CKSI": -creepage.longitudinal, "CETA": -creepage.lateral, "CPHI": -creepage.spin}
    where = c.position if c.patch is None else c.patch.position
    values |= dict(zip(("XCP(TR)", "YCP(TR)", "ZCP(TR)"), map(float, where), strict=True))
    if isinstance(solution, GridSolution):
        values |= single.counts(case, solution)
        values["FRIC.POWER"] = -single.work(solution) * solution.speed
        if case.digits["H"]:
            values |= single.temperature(case, solution)
    return PatchResult(values, solution)
