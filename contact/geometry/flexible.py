"""The displacement of a wheel against its wheelset. `contact.kernels.flexible` applies it (other_wheels.md)."""

from __future__ import annotations

from dataclasses import astuple, dataclass, fields

from contact.inputs.options import MEMBERS


@dataclass(frozen=True, slots=True)
class WheelOffset:
    """Displacement [m] and rotation [rad] of a wheel against its rigid wheelset, in track coordinates, and their rates.

    Parameters
    ----------
    x, y, z : float
        Displacement of the wheel's datum, on the axle at the tape circle [m].
    roll, pitch, yaw : float
        Rotation of the wheel [rad], within ±0.1. Pitch adds to the `rotation` of a wheel that changes along its
        circumference; a wheel of revolution has the same contact at any pitch.
    x_rate, y_rate, z_rate, roll_rate, pitch_rate, yaw_rate : float
        Rates [m/s], [rad/s].

    Raises
    ------
    ContactError
        For a number outside its range.
    """

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0
    x_rate: float = 0.0
    y_rate: float = 0.0
    z_rate: float = 0.0
    roll_rate: float = 0.0
    pitch_rate: float = 0.0
    yaw_rate: float = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            MEMBERS["wheel_offset"][field.name].require(f"offset.{field.name}", getattr(self, field.name))

    def record(self) -> tuple[float, ...]:
        """Return the numbers in the order of the record WHEEL_OFFSET of `contact.kernels.records`."""
        return astuple(self)
