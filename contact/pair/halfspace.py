"""`HalfspacePair`: one wheel on one rail that change along the way, by the element-wise half space.

It is the reference for `contact.pair.WheelRailPair`, which solves the same surfaces on strips, as the FMU
`WheelRailSurfaces` does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from contact.errors import ContactError, require_kind, require_number
from contact.friction import Friction
from contact.geometry.flexible import WheelOffset
from contact.geometry.posed import require_motion
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.halfspace.third_body import ThirdBody
from contact.inputs.creepage import Creepage
from contact.inputs.options import LOAD
from contact.instance.ownership import one_thread, within
from contact.kernels.enumerations import Height
from contact.pair.driven import drive
from contact.pair.elastic_rail import ElasticRail, balanced
from contact.pair.motion import AnyPair
from contact.pair.sliding import Bodies, Roller, Sliding, displaced
from contact.pair.solution import PairSolution, Solved, of_patches
from contact.pair.wheel_rail import WheelRailPair
from contact.registry import DEFAULT_TANGENTIAL
from contact.results.solution import Status
from contact.solve import solve

#: Iteration for a vertical force with friction: largest number of steps, and tolerances relative to the force. On rough
#: surfaces the force jumps with z when the grid takes in another row, so after half of the steps the wider one counts.
_MOST_STEPS, _TOLERANCE, _WIDER = 16, 1e-4, 2e-3
_MISSED = 1e-3  # relative error of a load above which the status tells of it, as for strips
_IDEAL, _STRAIGHT = Irregularity(), WheelOffset()


class Instant(NamedTuple):
    """What is given at one instant.

    Attributes
    ----------
    pose, velocity : of the wheelset
    station, rotation : of the wheelset along the rail [m], of the wheel about its axle [rad]
    irregularity, offset : of the rail, and of the wheel against its wheelset
    friction : coefficient [-] or law
    """

    pose: Pose
    velocity: Velocity
    station: float
    rotation: float
    irregularity: Irregularity
    offset: WheelOffset
    friction: Any

    @classmethod
    def of(
        cls,
        pose: Pose,
        velocity: Velocity | None = None,
        station: float = 0.0,
        rotation: float = 0.0,
        irregularity: Irregularity | None = None,
        offset: WheelOffset | None = None,
        friction: Any = 0.3,
    ) -> Instant:
        """Return the instant, with what is missing at rest and in place."""
        velocity = Velocity() if velocity is None else velocity
        irregularity = _IDEAL if irregularity is None else irregularity
        require_motion(pose, velocity, irregularity)
        station, rotation = require_number("station", station), require_number("rotation", rotation)
        return cls(pose, velocity, station, rotation, irregularity, _STRAIGHT if offset is None else offset, friction)


class Given(NamedTuple):
    """What is given of height, forces and springs, as arguments of `HalfspacePair.solve`."""

    load: float | None = None
    penetration: float | None = None
    vertical: float | None = None
    force: float | None = None
    torque: float | None = None
    rail: ElasticRail | None = None


class HalfspacePair(AnyPair):
    """One wheel rolling on one rail, or on a roller, that may both change along the way.

    Parameters
    ----------
    pair : SurfacePair
        Surfaces, side, gauge, elements and material. Each patch is solved on its own gap, by NORM and TANG.
    layer : contact.ThirdBody
        Layer between wheel and rail.

    Notes
    -----
    Rolling is steady: what has happened before the present pose does not count; with `contact.pair.TransientPair` it does.
    On a roller (`RailSurface.roller`) `velocity.forward` is the speed of the roller's surface at its radius, `station` the
    distance of the wheelset ahead of the roller's axis, and creepages refer to the mean speed of both surfaces.

    Raises
    ------
    ContactError
        If `pair` is no SurfacePair or `layer` no ThirdBody.
    """

    pair: SurfacePair

    def __init__(self, pair: SurfacePair, *, layer: ThirdBody | None = None) -> None:
        if not isinstance(pair, SurfacePair):
            raise ContactError(f"pair = {pair!r} is not a contact.geometry.surfaces.SurfacePair")
        if not isinstance(layer, ThirdBody | None):
            raise ContactError(f"layer = {layer!r} is not a contact.ThirdBody")
        self.pair, self.layer = pair.again(), layer
        self.take_turns_with(self.pair)
        self._depth: float | None = None
        self._share = 1.0

    @one_thread
    def solve(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        station: float = 0.0,
        rotation: float = 0.0,
        load: float | None = None,
        penetration: float | None = None,
        vertical: float | None = None,
        force: float | None = None,
        torque: float | None = None,
        irregularity: Irregularity | None = None,
        friction: float | Friction = 0.3,
        rail: ElasticRail | None = None,
        offset: WheelOffset | None = None,
    ) -> PairSolution:
        """Find and solve all patches at one instant.

        Parameters
        ----------
        pose, velocity, station, rotation, load, penetration, irregularity :
            As for `SurfacePair.contacts`. The normal forces alone carry `load`.
        vertical : float
            Vertical force on the wheel [N] ≥ 0 that normal and friction forces carry together, instead of `load` and
            `penetration`.
        force, torque, rail, offset :
            As for `contact.pair.WheelRailPair.solve`.
        friction : float or contact.friction.Friction
            Coulomb's coefficient mu ≥ 0 [-], or a friction law.

        Raises
        ------
        ContactError
            For input outside its range, if the wheel does not lie above the rail, or if no z gives the force. Where the
            force jumps over a `load`, the status is NOT_CONVERGED instead.
        """
        at = Instant.of(pose, velocity, station, rotation, irregularity, offset, friction)
        return self._given(at, Given(load, penetration, vertical, force, torque, rail))

    def _given(self, at: Instant, given: Given) -> PairSolution:
        """Return the solution for what is given of height, forces and springs."""
        self._begin()
        amounts, rail = given._asdict(), given.rail
        amounts = {name: amounts[name] for name in ("load", "penetration", "vertical")}
        if sum(amount is not None for amount in amounts.values()) > 1:
            raise ContactError(f"of {amounts} only one may be given")
        require_kind("rail", rail, ElasticRail | None)
        require_kind("offset", at.offset, WheelOffset)

        def placed(dy: float, dz: float, now: Instant) -> PairSolution:
            moved = replace(now.irregularity, y=now.irregularity.y + dy, z=now.irregularity.z + dz)
            return self._at(now._replace(irregularity=moved), **amounts)

        def turning(velocity: Velocity) -> PairSolution:
            now = at._replace(velocity=velocity)
            if rail is None:
                return self._at(now, **amounts)
            fixed = all(amount is None for amount in amounts.values())
            return balanced(lambda dy, dz: placed(dy, dz, now), rail, fixed)

        if given.force is None and given.torque is None:
            return turning(at.velocity)
        modulus = self.pair.material.shear_modulus
        return drive(turning, at.velocity, self.pair.nominal_radius, modulus, given.force, given.torque, self._pull)

    def _begin(self) -> None:
        """Forget where the searches of the last call have ended: penetration [m], and share of the normal forces."""
        self._depth, self._share = None, 1.0

    def _pull(self, found: PairSolution) -> float:
        """Return the longitudinal force on the wheel [N]."""
        return float(found.force[0])

    def _at(self, at: Instant, load: float | None, penetration: float | None, vertical: float | None) -> PairSolution:
        """Return the solution at a height, or under a force."""
        if vertical is not None:
            LOAD.require("vertical", vertical)
        mode, amount = self.pair.prescribed(load, penetration)
        self._place(at)
        self._doubt(at, *((load, "load") if vertical is None else (vertical, "vertical")))
        if vertical is not None:
            return self._under(vertical, at)
        if mode != Height.LOAD:
            return self._solution(within(self.pair.found)(mode, amount), at)
        missed = within(self.pair.settle)(amount)
        found = self._solution(within(self.pair.found)(), at)
        return replace(found, status=Status.NOT_CONVERGED) if missed > _MISSED else found

    def _place(self, at: Instant) -> None:
        """Place wheel and rail for a search; a displaced wheel as that of the rigid wheelset that has it."""
        pose, moved = (at.pose, np.zeros(3)) if at.offset is _STRAIGHT else displaced(at.pose, at.offset, self._datum)
        self._pose, self._moved = pose, moved  # of the last search
        within(self.pair.place)(
            pose,
            at.velocity,
            station=at.station + float(moved[0]),
            rotation=at.rotation + at.offset.pitch,
            irregularity=at.irregularity,
        )

    def _doubt(self, at: Instant, load: float | None, name: str) -> None:
        """Warn of what no wheelset has; `contact.solve` doubts the friction."""
        self.pair.doubt(at.pose, at.velocity, load, name)

    @property
    def _datum(self) -> float:
        """Distance of the wheel's tape circle from the wheelset's centre, to the right [m]."""
        return self.pair.tape if self.pair.side == "right" else -self.pair.tape

    @property
    def _height(self) -> float:
        """pose.z of the wheelset after the last search [m]."""
        return self.pair.z - float(self._moved[2])

    def _moving(self, at: Instant, **options: Any) -> Bodies:
        """Return wheel and rail in motion, as the last search has left them. `options` are those of `Bodies`."""
        pair, rail = self.pair, at.irregularity
        y, z = pair.rail_origin
        origin = (y if pair.side == "right" else -y) + rail.y, z + rail.z
        radius = pair.rail.roller_radius
        if radius is not None and "roller" not in options:
            options["roller"] = Roller(radius, origin[1] + radius, -at.station)
        pose = replace(at.pose, z=self._height)
        return Bodies(pose, at.velocity, pair.nominal_radius, rail, origin, at.offset, self._datum, **options)

    def _solution(self, patches: Sequence[SurfacePatch], at: Instant) -> PairSolution:
        """Return the solution of patches, which the last search has found."""
        radius, velocity = self.pair.nominal_radius, at.velocity
        spin = -velocity.forward / radius if velocity.spin is None else velocity.spin
        found = [self._solved(patch, at) for patch in patches]
        z = self._height
        return of_patches(found, at.pose, z, self.pair.side, radius, spin, ahead=float(self._moved[0]))

    def _under(self, vertical: float, at: Instant) -> PairSolution:
        """Return the solution under a vertical force.

        The normal forces carry it less the vertical part of friction, which is found by the secant method, from the force
        with friction over that without.
        """
        carried, before = vertical * self._share, None
        for step in range(_MOST_STEPS):
            within(self.pair.settle)(carried, self._depth)
            self._depth = self.pair.depth
            found = self._solution(within(self.pair.found)(), at)
            miss = vertical - found.Q
            if abs(miss) <= (_TOLERANCE if step < _MOST_STEPS // 2 else _WIDER) * vertical:
                self._share = carried / vertical if vertical > 0.0 else 1.0
                return found
            change = 0.0 if before is None else before[1] - miss
            slope = 1.0 if before is None or change == 0.0 else (carried - before[0]) / change
            before = carried, miss
            carried = max(carried + miss * (slope if 0.2 < slope < 5.0 else 1.0), 1e-3 * vertical)
        raise ContactError(
            f"vertical = {vertical:g}: no z was found at which normal and friction forces carry it together"
        )

    def _rolling(self, patch: SurfacePatch, at: Instant) -> tuple[Creepage, float]:
        """Return the creepages of a patch, and the speed to which they refer [m/s]."""
        if at.offset is _STRAIGHT and self.pair.rail.roller_radius is None:
            return patch.creepage, at.velocity.forward
        one = self._slide(patch, at)
        reference = abs(at.velocity.forward) if self.pair.rail.roller_radius is None else one.mean
        speed = max(reference, self.pair.reference_speed)
        return Creepage(one.x / speed, one.y / speed, one.spin / speed), speed

    def _slide(self, patch: SurfacePatch, at: Instant) -> Sliding:
        """Return how the wheel slides over the rail at a patch, as rigid bodies."""
        ahead = np.array([self._moved[0], 0.0, 0.0])
        points = np.array(patch.position) + ahead, np.array(patch.wheel_position) + ahead
        return self._moving(at).at(*points, patch.frame.axes)

    def _solved(self, patch: SurfacePatch, at: Instant) -> Solved:
        """Return the patch with its solution."""
        creepage, speed = self._rolling(patch, at)
        found = solve(
            patch.gap,
            creepage,
            approach=patch.approach,
            friction=at.friction,
            material=self.pair.material,
            layer=self.layer,
            speed=speed,
            throw=False,
            normal="halfspace",
            tangential="halfspace",
        )
        return Solved(patch, found, patch.frame.axes)


def solver_for(
    pair: SurfacePair, normal: str = "halfspace", tangential: str | None = None
) -> WheelRailPair | HalfspacePair:
    """Return the element-wise reference for "halfspace", else a solver on strips, with `fastrip_mapped` by default."""
    if normal == "halfspace":
        if tangential not in (None, "halfspace"):
            raise ContactError(f"tangential = {tangential!r} is on strips; normal = 'halfspace' is not")
        return HalfspacePair(pair)
    return WheelRailPair(pair, material=pair.material, normal=normal, tangential=tangential or DEFAULT_TANGENTIAL)
