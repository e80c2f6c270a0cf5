"""What goes into and comes out of the contact search. Conventions: `contact.geometry.wheelset`."""

from __future__ import annotations

import math
from dataclasses import dataclass

from contact.creepage import Creepage
from contact.errors import require_number
from contact.separation import Separation

#: Roll and yaw of a wheelset and roll of a rail [rad] up to which the search is made to work.
LARGEST_ANGLE, LARGEST_RAIL_ROLL = 0.1, 0.05


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the wheelset is: lateral and vertical displacement [m], roll and yaw [rad, within ±0.1]."""

    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    yaw: float = 0.0

    def __post_init__(self) -> None:
        for name, limit in (("y", math.inf), ("z", math.inf), ("roll", LARGEST_ANGLE), ("yaw", LARGEST_ANGLE)):
            require_number(f"pose.{name}", getattr(self, name), -limit, limit)


@dataclass(frozen=True, slots=True)
class Velocity:
    """How the wheelset moves: forward > 0, y, z [m/s]; rates of roll, yaw and spin [rad/s].

    Spin is the rotation about the axle; None rolls freely at the nominal radius, -forward/nominal_radius.
    """

    forward: float = 1.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    yaw: float = 0.0
    spin: float | None = None

    def __post_init__(self) -> None:
        require_number("velocity.forward", self.forward, 0.0, open_minimum=True)
        for name in ("y", "z", "roll", "yaw"):
            require_number(f"velocity.{name}", getattr(self, name))
        if self.spin is not None:
            require_number("velocity.spin", self.spin)


@dataclass(frozen=True, slots=True)
class Irregularity:
    """Displacement of one rail from its place [m], its roll [rad, within ±0.05] and their rates, in track coordinates."""

    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    y_rate: float = 0.0
    z_rate: float = 0.0
    roll_rate: float = 0.0

    def __post_init__(self) -> None:
        for name in ("y", "z", "y_rate", "z_rate", "roll_rate"):
            require_number(f"irregularity.{name}", getattr(self, name))
        require_number("irregularity.roll", self.roll, -LARGEST_RAIL_ROLL, LARGEST_RAIL_ROLL)


@dataclass(frozen=True, slots=True)
class Patch:
    """One contact patch. Vectors are in track coordinates, signs are those of the actual side.

    Attributes
    ----------
    separation : Separation
        Gap in the contact plane, y from the reference point; min g = 0.
    creepage : Creepage
        Wheel minus rail at the wheel's point opposite the reference point, over the forward speed, in the contact frame.
    angle : float
        Contact angle [rad]; the contact frame is the track frame turned by it about x.
    position : tuple of float
        Reference point (x, y, z) on the rail [m]: mean over the interpenetration of the undeformed profiles.
    wheel_position : tuple of float
        The wheel's point (x, y, z) opposite it [m], deeper by the interpenetration there. Creepages are taken there, and the
        forces on the wheel act there: only so their power on the motion is that of force times creepage.
    on_rail, on_wheel : tuple of float
        (y, z) of the reference point in rail and of its opposite in wheel profile coordinates (right-side convention) [m].
    rolling_radius : float
        Distance of the wheel's point from the axle [m].
    approach : float
        Depth of the interpenetration along the normal of the contact plane [m]: the approach that belongs to pose.z.
    edges : tuple of float
        Where the interpenetration begins and ends along the separation's y [m].
    load : float or None
        Normal force [N], when z was found from a load.
    share : float
        With which the patch counts. 1, but while two lobes pass from one plane to planes of their own (`wheelset.Pair`): then
        the list has their common patch and both of their own, and forces and wear are those of each times its share.
    """

    separation: Separation
    creepage: Creepage
    angle: float
    position: tuple[float, float, float]
    wheel_position: tuple[float, float, float]
    on_rail: tuple[float, float]
    on_wheel: tuple[float, float]
    rolling_radius: float
    approach: float
    edges: tuple[float, float]
    load: float | None = None
    share: float = 1.0
