"""Named sets of wheelset parameters, and the loads of a curve on a wheelset."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from contact.errors import ContactError, require_number, suggestion
from contact.geometry.profile import Profile
from models.wheelset.parameters import WheelsetParameters

GRAVITY = 9.81  # [m/s²]

#: Height of the vehicle's centre of gravity above the axle [m]: 8 t of body at 1.80 m, 1.31 t of bogie frame at 0.60 m and
#: 1.81 t of wheelset at 0.46 m for each axle of the Manchester benchmark's vehicle 1 (constants.md 13.4).
_MANCHESTER_HEIGHT = 0.98
#: Name → parameters that differ from those of `WheelsetParameters`.
SETS: dict[str, dict[str, float]] = {
    # a single wheelset with a soft suspension
    "single": {"centre_of_gravity": _MANCHESTER_HEIGHT, "semi_wheelbase": 0.0},
    # Manchester vehicle 1 (constants.md 13.4): two axle boxes with kx 31.391, ky 3.884 MN/m, cx 15, cy 2 kN s/m, 2.0 m apart
    "manchester": {
        "mass": 1813.0,
        "yaw_inertia": 1120.0,
        "spin_inertia": 112.0,
        "axle_load": 109.1e3,
        "lateral_stiffness": 2.0 * 3.884e6,
        "yaw_stiffness": 2.0 * 31.391e6 * 1.0**2,
        "lateral_damping": 2.0 * 2e3,
        "yaw_damping": 2.0 * 15e3 * 1.0**2,
        "centre_of_gravity": _MANCHESTER_HEIGHT,
        "semi_wheelbase": 1.28,
    },
}


@dataclass(frozen=True, kw_only=True)
class Vehicle:
    """A wheelset suspended in a frame that follows the track. Parameters that are not given are those of a named set.

    Parameters
    ----------
    set : str
        "single", or "manchester": the wheelset of the Manchester benchmark's vehicle 1 with its primary suspension.
    semi_wheelbase : float
        Distance of the axle ahead of the bogie's centre [m], -5 to 5. The frame lies along the track's tangent at its
        centre. Relative to the track at the axle it is yawed to the outside by semi_wheelbase times curvature. 0 is radial.
    centre_of_gravity : float
        Height above the axle at which the unbalanced lateral acceleration of the whole axle load acts [m], 0 to 3.
    lateral, yaw, … :
        As in `models.wheelset.parameters.WheelsetParameters`.
    """

    set: str = "single"
    semi_wheelbase: float | None = None
    centre_of_gravity: float | None = None
    mass: float | None = None
    yaw_inertia: float | None = None
    spin_inertia: float | None = None
    axle_load: float | None = None
    lateral_stiffness: float | None = None
    yaw_stiffness: float | None = None
    lateral_damping: float | None = None
    yaw_damping: float | None = None
    lateral: float = 0.0
    yaw: float = 0.0
    radius: float | None = None
    gauge: float | None = None
    gauge_point: float | None = None
    flange_back: float | None = None

    def __post_init__(self) -> None:
        if self.set not in SETS:
            raise ContactError(f"set = {self.set!r} is unknown{suggestion(self.set, SETS)}; they are {', '.join(SETS)}")
        require_number("semi_wheelbase", self.value("semi_wheelbase"), -5.0, 5.0)
        require_number("centre_of_gravity", self.value("centre_of_gravity"), 0.0, 3.0)
        WheelsetParameters(**self._given())

    def value(self, name: str) -> float:
        """Return the given value of a parameter, or the value of the set."""
        given = getattr(self, name)
        return SETS[self.set][name] if given is None else given

    def parameters(self, wheel: Profile, rail: Profile, speed: float) -> WheelsetParameters:
        """Return the parameters of the wheelset on these profiles, at `speed` [m/s]."""
        return WheelsetParameters(wheel=wheel, rail=rail, speed=speed, **self._given())

    def loads(self, p: WheelsetParameters, speed: float, curvature: float, cant: float) -> dict[str, float]:
        """Return the external loads in a curve, for `WheelsetModel.set_running` (models/wheelset/readme.md, Curves).

        `speed` is in m/s, `curvature` in 1/m, `cant` in rad. The loads are in N and N m.
        """
        unbalanced = p.axle_load * (cant - speed * speed * curvature / GRAVITY)
        return {
            "lateral_load": unbalanced,
            "roll_load": unbalanced * self.value("centre_of_gravity"),
            "yaw_load": -p.yaw_stiffness * self.value("semi_wheelbase") * curvature,
        }

    def _given(self) -> dict[str, Any]:
        """Return the members of `WheelsetParameters` that the set or the user gives, by name."""
        own = ("set", "semi_wheelbase", "centre_of_gravity")
        given = {entry.name: getattr(self, entry.name) for entry in fields(self) if entry.name not in own}
        of_the_set = {name: value for name, value in SETS[self.set].items() if name not in own}
        return of_the_set | {name: value for name, value in given.items() if value is not None}
