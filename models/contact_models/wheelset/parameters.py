"""Parameters of the wheelset and its track."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

from contact.errors import ContactError, require_number
from contact.geometry import profile
from contact.geometry.profile import Profile
from contact.inputs.options import FLANGE_BACK, GAUGE, GAUGE_POINT, RADIUS

_NOT_NEGATIVE = ("lateral_stiffness", "yaw_stiffness", "lateral_damping", "yaw_damping")
_FREE = ("lateral", "yaw", "lateral_velocity", "yaw_rate", "window_start")


@dataclass(frozen=True, slots=True, kw_only=True)
class WheelsetParameters:
    """Constants of the wheelset, in SI units.

    Masses and axle load are those of the Manchester benchmark's passenger vehicle (constants.md 13.4). The suspension is
    softer than the primary suspension of its bogie, so that a single wheelset becomes unstable at an ordinary speed.

    Parameters
    ----------
    speed : float
        Constant forward speed V [m/s].
    mass, yaw_inertia, spin_inertia : float
        Mass [kg], moments of inertia about z and about the axle [kg m²].
    axle_load : float
        Vertical force that both rails carry together [N].
    lateral_stiffness, yaw_stiffness, lateral_damping, yaw_damping : float
        Primary suspension between the wheelset's centre and a frame on the ideal centre line
        [N/m], [N m/rad], [N s/m], [N m s/rad].
    lateral, yaw, lateral_velocity, yaw_rate : float
        Initial motion [m], [rad], [m/s], [rad/s]. The initial spin is V over the mean of both rolling radii.
    wheel, rail : Profile
        Profiles of the right side. The left side is the mirror image.
    radius, gauge, gauge_point, flange_back : float
        Nominal rolling radius, track gauge, depth below the top of the rail at which the gauge is measured, distance of
        the backs of the flanges [m].
    window_start, window_step : float
        First sample of a separation and distance of samples [m]: `geometry.y0` and `geometry.dy` of the contact's FMU.
    approach : float
        Approach of wheel and rail [m] that is assumed until the contacts return theirs.
    substeps : int
        Integration steps in a communication step.

    Raises
    ------
    ContactError
        For a constant outside its range.
    """

    speed: float = 28.0
    mass: float = 1813.0
    yaw_inertia: float = 1120.0
    spin_inertia: float = 112.0
    axle_load: float = 109.1e3
    lateral_stiffness: float = 2e5
    yaw_stiffness: float = 4e5
    lateral_damping: float = 0.0
    yaw_damping: float = 0.0
    lateral: float = 3e-3
    yaw: float = 0.0
    lateral_velocity: float = 0.0
    yaw_rate: float = 0.0
    wheel: Profile = field(default_factory=profile.s1002)
    rail: Profile = field(default_factory=profile.rail_60e1)
    radius: float = RADIUS.usual
    gauge: float = GAUGE.usual
    gauge_point: float = GAUGE_POINT.usual
    flange_back: float = FLANGE_BACK.usual
    window_start: float = -0.02
    window_step: float = 1e-3
    approach: float = 6e-5
    substeps: int = 1

    def __post_init__(self) -> None:
        for entry in fields(self):
            value = getattr(self, entry.name)
            if entry.name in _FREE:
                require_number(entry.name, value)
            elif entry.name in _NOT_NEGATIVE:
                require_number(entry.name, value, 0.0)
            elif entry.name not in ("wheel", "rail"):
                require_number(entry.name, value, 0.0, open_minimum=True)
        if not isinstance(self.substeps, int) or self.substeps > 1000:
            raise ContactError(f"substeps = {self.substeps!r} is not an integer in [1, 1000]")
