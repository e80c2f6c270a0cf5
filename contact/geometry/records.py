"""Input and output records of the contact search. For the conventions see `contact.geometry.wheelset`."""

from __future__ import annotations

import math
from dataclasses import dataclass

from contact.errors import require_number
from contact.inputs.creepage import Creepage
from contact.inputs.options import MEMBERS
from contact.inputs.separation import Separation
from contact.view.notebook import beside, table

#: Ranges of a motion.
_GIVEN = MEMBERS["given"]


@dataclass(frozen=True, slots=True)
class Pose:
    """Position of the wheelset: lateral and vertical displacement [m], roll and yaw [rad, within ±0.1]."""

    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    yaw: float = 0.0

    def __post_init__(self) -> None:
        for name in ("y", "z", "roll", "yaw"):
            _GIVEN[name].require(f"pose.{name}", getattr(self, name))


@dataclass(frozen=True, slots=True)
class Velocity:
    """Velocity of the wheelset: forward, y, z [m/s]; rates of roll, yaw and spin [rad/s]. It rolls backwards if forward < 0.

    Spin is the rotation about the axle. None means free rolling at the nominal radius, -forward/nominal_radius.
    """

    forward: float = 1.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    yaw: float = 0.0
    spin: float | None = None

    def __post_init__(self) -> None:
        require_number("velocity.forward", self.forward)
        for name in ("y", "z", "roll", "yaw"):
            require_number(f"velocity.{name}", getattr(self, name))
        if self.spin is not None:
            require_number("velocity.spin", self.spin)


@dataclass(frozen=True, slots=True)
class Irregularity:
    """Displacement of one rail [m], its roll [rad, within ±0.05] and their rates [m/s, rad/s], in track coordinates."""

    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    y_rate: float = 0.0
    z_rate: float = 0.0
    roll_rate: float = 0.0

    def __post_init__(self) -> None:
        for name in ("y", "z", "y_rate", "z_rate", "roll_rate"):
            require_number(f"irregularity.{name}", getattr(self, name))
        _GIVEN["rail_roll"].require("irregularity.roll", self.roll)


def contact_angle(angle: float, y: float) -> float:
    """Return an angle of the contact frame at `y` [m] in the track as contact angle, positive towards the track's centre."""
    return -angle if y > 0.0 else angle


@dataclass(frozen=True, slots=True)
class Patch:
    """One contact patch. Vectors are in track coordinates; signs are those of the actual side.

    Attributes
    ----------
    separation : Separation
        Gap in the contact plane, y measured from the reference point; min g = 0.
    creepage : Creepage
        Wheel minus rail over the forward speed, in the contact frame, at `wheel_position`.
    angle : float
        Contact angle [rad]. The contact frame is the track frame turned by it about x.
    position : tuple of float
        Reference point (x, y, z) on the rail [m]: mean over the interpenetration of the undeformed profiles.
    wheel_position : tuple of float
        Point (x, y, z) of the wheel opposite the reference point [m], deeper by `approach`: where the reference point lies
        between two lobes, this is the depth of the lobes, as in CONTACT. The forces act on the wheel at this point. With
        creepages and forces at the same point, the power of the forces on the motion is force times creepage.
    on_rail, on_wheel : tuple of float
        (y, z) of the reference point in the rail's and of the wheel's point in the wheel's profile coordinates (right-side
        convention) [m].
    rolling_radius : float
        Distance of `wheel_position` from the axle [m].
    approach : float
        Depth of the interpenetration along the normal of the contact plane [m]: the approach that corresponds to pose.z.
    edges : tuple of float
        Start and end of the interpenetration along the separation's y [m].
    load : float or None
        Normal force [N], if z was found from a load.
    share : float
        Weight of the patch [-], normally 1. In the transition of two lobes from a common plane to separate planes
        (`wheelset.Pair`), the list contains the common patch and both separate patches. Forces and wear of each patch are
        then multiplied by its share.
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

    @property
    def contact_angle(self) -> float:
        """Contact angle [rad], positive if the rail pushes the wheel to the track's centre, on either side.

        `angle` turns the track frame into the contact frame, so its sign differs from side to side.
        """
        return contact_angle(self.angle, self.position[1])

    def _repr_html_(self) -> str:
        """Return HTML with the main numbers and a sketch of the gap, for a notebook."""
        c = self.creepage
        rows = (
            ("contact angle", f"{math.degrees(self.contact_angle):.4g}°"),
            ("position x, y, z", ", ".join(f"{1e3 * at:.4g}" for at in self.position) + " mm"),
            ("approach", f"{1e6 * self.approach:.4g} µm"),
            ("rolling radius", f"{1e3 * self.rolling_radius:.6g} mm"),
            ("creepages", f"{c.longitudinal:.3g}, {c.lateral:.3g}; spin {c.spin:.3g} 1/m"),
            *(() if self.load is None else (("normal force", f"{self.load:.6g} N"),)),
            *(() if self.share == 1.0 else (("share", f"{self.share:.3g}"),)),
        )
        return beside(table((), rows, "patch"), self.separation._repr_html_())
