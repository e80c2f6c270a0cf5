"""What wheels on rails have in common, whatever their surfaces: side, motion, and how the height is prescribed."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from contact.errors import ContactError, require_number
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.inputs.options import LOAD, MEMBERS, RADIUS, REFERENCE_SPEED
from contact.inputs.plausibility import USUAL, doubt_value
from contact.instance.ownership import OwnsArrays, one_thread
from contact.kernels.enumerations import Height, NoAnswer
from contact.kernels.geometry.settle import DEEPEST
from contact.kernels.records import GIVEN, SLOWEST

Side = Literal["right", "left"]

MAX_PENETRATION = 2e-3  # [m] that of a wheel under 10 MN; a larger value has a wrong unit
_ROLLING, _IDEAL = Velocity(), Irregularity()
_Y, _TURNED, _LOAD, _SPEED, _SLIP, _FRICTION, _DRIFT, _TURNS = (
    USUAL[name]
    for name in ("pose.y", "pose.yaw", "wheel load", "speed", "slip", "friction", "velocity.y", "velocity.yaw")
)


def require_motion(pose: object, velocity: object, irregularity: object = _IDEAL) -> None:
    """Raise a ContactError for a pose, a velocity or an irregularity that is none."""
    for name, argument, kind in (
        ("pose", pose, Pose),
        ("velocity", velocity, Velocity),
        ("irregularity", irregularity, Irregularity),
    ):
        if not isinstance(argument, kind):
            raise ContactError(f"{name} = {argument!r} is not a contact.geometry.wheelset.{kind.__name__}")


class Posed(OwnsArrays):
    """A wheel of one side with its nominal radius [m], 0.05 to 2, and the speed below which creepages refer to it [m/s].

    Raises
    ------
    ContactError
        For another side or a radius outside its range.
    """

    rolls_back = True  # whether the forward speed may be negative
    space: Any  # arrays of the search: `Search` or `SurfaceSearch` of `contact.kernels.arrays`

    def __init__(self, side: Side, nominal_radius: float, reference_speed: float = REFERENCE_SPEED.usual) -> None:
        if side not in ("right", "left"):
            raise ContactError(f"side = {side!r} is neither 'right' nor 'left'")
        self.side: Side = side
        self._mirror = 1.0 if side == "right" else -1.0
        self.nominal_radius = RADIUS.require("nominal_radius", nominal_radius)
        doubt_value("wheel radius", self.nominal_radius, "nominal_radius")
        self.reference_speed = REFERENCE_SPEED.require("reference_speed", reference_speed)
        self._doubted: set[str] = set()  # names for which there was a PlausibilityWarning
        self.told: set[str] = set()  # for what there was a ModelWarning

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.side}, nominal_radius={self.nominal_radius:g})"

    @one_thread
    def given(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        irregularity: Irregularity | None = None,
        *,
        station: float = 0.0,
        rotation: float = 0.0,
    ) -> np.record:
        """Return the motion as the record GIVEN of `contact.kernels.records`. The default velocity is steady rolling.

        `station` and `rotation` go to the search itself. They are those of
        `contact.geometry.surfaces.SurfacePair.contacts`; profiles that are constant along the way do not depend on them.
        """
        numbers = self.motion_of(pose, velocity, irregularity)
        self.set_way(station, rotation)
        return np.array([numbers], GIVEN)[0]

    def motion_of(self, pose: Pose, velocity: Velocity | None, irregularity: Irregularity | None) -> tuple[float, ...]:
        """Return the members of the record GIVEN of a motion, in their order."""
        velocity = _ROLLING if velocity is None else velocity
        rail = _IDEAL if irregularity is None else irregularity
        if not (isinstance(pose, Pose) and isinstance(velocity, Velocity) and isinstance(rail, Irregularity)):
            require_motion(pose, velocity, rail)
        forward, spin = velocity.forward, velocity.spin
        if forward < 0.0 and not self.rolls_back:
            raise ContactError(
                f"velocity.forward = {forward:g} is negative: on surfaces that change along the way a wheel rolls "
                "forward only; turn the rail and the wheelset by 180 degrees"
            )
        return (
            *(pose.y, pose.z, pose.roll, pose.yaw),
            *(forward, velocity.y, velocity.z, velocity.roll, velocity.yaw),
            -forward / self.nominal_radius if spin is None else spin,
            *(rail.y, rail.z, rail.roll, rail.y_rate, rail.z_rate, rail.roll_rate),
        )

    def set_way(self, station: float, rotation: float) -> None:
        """Set the position along the rail [m] and the angle of the wheel [rad] for the search."""
        motion = self.space.motion
        motion["station"][0] = MEMBERS["pair_input"]["station"].require("station", station)
        motion["rotation"][0] = MEMBERS["pair_input"]["rotation"].require("rotation", rotation)

    def _is_usual(self, pose: Pose, velocity: Velocity | None, load: float | None, friction: float) -> bool:
        """Return whether `doubt` surely finds nothing. It asks all at once, since this is done at every call."""
        if abs(pose.y) > _Y.largest or abs(pose.roll) > _TURNED.largest or abs(pose.yaw) > _TURNED.largest:
            return False
        if friction > _FRICTION.largest or (load and not _LOAD.least <= load <= _LOAD.largest):
            return False
        if velocity is None:
            return True
        forward, spin = velocity.forward, velocity.spin
        rolls = spin is None or (
            abs(forward) > SLOWEST and abs(1.0 + spin * self.nominal_radius / forward) <= _SLIP.largest
        )
        drift, turns = max(abs(velocity.y), abs(velocity.z)), max(abs(velocity.roll), abs(velocity.yaw))
        return rolls and abs(forward) <= _SPEED.largest and drift <= _DRIFT.largest and turns <= _TURNS.largest

    def doubt(
        self, pose: Pose, velocity: Velocity | None, load: float | None, name: str = "load", friction: float = 0.0
    ) -> None:
        """Warn of a motion, a load [N] and a friction that no wheelset has. Call it in the function that the user calls.

        It warns once of each, because a run in time may have a small load in many steps.
        """
        if self._is_usual(pose, velocity, load, friction):
            return
        asked = [(f"pose.{coordinate}", getattr(pose, coordinate), "") for coordinate in ("y", "roll", "yaw")]
        asked.append(("friction", friction, ""))
        if load is not None:
            asked.append(("wheel load", load, name))
        if velocity is not None:
            asked.append(("speed", velocity.forward, "velocity.forward"))
            asked += [(f"velocity.{part}", getattr(velocity, part), "") for part in ("y", "z", "roll", "yaw")]
        if velocity is not None and velocity.spin is not None and abs(velocity.forward) > SLOWEST:
            slip = 1.0 + velocity.spin * self.nominal_radius / velocity.forward
            asked.append(("slip", slip, f"velocity.spin = {velocity.spin:g}: longitudinal creepage"))
        for usual, value, called in asked:
            if usual not in self._doubted and doubt_value(usual, value, called):
                self._doubted.add(usual)

    @staticmethod
    def prescribed(load: float | None, penetration: float | None) -> tuple[int, float]:
        """Return how z is prescribed: `mode` (a `Height`) and `amount` [N] or [m] of the kernel `settle`."""
        if load is not None and penetration is not None:
            raise ContactError(f"load = {load} and penetration = {penetration} exclude each other")
        if load is not None:
            return Height.LOAD, LOAD.require("load", load)
        if penetration is not None:
            return Height.PENETRATION, require_number("penetration", penetration, 0.0, MAX_PENETRATION)
        return Height.GIVEN, 0.0

    def require_found(self, code: int, pose: Pose, load: float | None) -> None:
        """Raise a ContactError if `code`, the result of `settle`, tells of a failure."""
        if code == NoAnswer.NO_OVERLAP:
            raise self._apart(pose)
        if code == NoAnswer.NOT_SETTLED:
            raise ContactError(
                f"load = {load:g}: no z was found at which the {self.side} wheel carries it on this rail"
            )
        if code == NoAnswer.TOO_DEEP:
            raise ContactError(
                f"pose.z = {pose.z:g}: the {self.side} wheel lies more than {DEEPEST:g} m inside its rail"
            )

    def _apart(self, pose: Pose) -> ContactError:
        raise NotImplementedError
