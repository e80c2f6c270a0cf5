"""A wheel that is displaced and turned against its wheelset by the flexibility of axle and web.

The datum Q of a wheel lies on the axle, at its tape circle. Without flexibility Q = C + t l, with the wheelset's centre C, the
direction l of the axle and t = ± the distance of the tape circle. The flexible wheel has Q' = Q + d and the axle direction l'
of the angles roll + δroll and yaw + δyaw. A wheel is a body of revolution, so it has the same contact as the wheel of a rigid
wheelset with the centre C' = Q + d - t l' and these angles.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from contact.errors import require_number
from contact.geometry.records import Pose, Velocity
from contact.kernels.geometry.search import axle

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class WheelOffset:
    """Displacement [m] and rotation [rad] of a wheel against its rigid wheelset, in track coordinates, and their rates.

    Parameters
    ----------
    x, y, z : float
        Displacement of the wheel's datum, on the axle at the tape circle [m].
    roll, pitch, yaw : float
        Rotation of the wheel [rad], within ±0.1. The pitch itself has no effect, because a wheel is round.
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
            limit = 0.1 if field.name in ("roll", "pitch", "yaw") else math.inf
            require_number(f"offset.{field.name}", getattr(self, field.name), -limit, limit)

    def moved(self, pose: Pose, velocity: Velocity, tape: float, radius: float) -> tuple[Pose, Velocity, Array]:
        """Return pose and velocity of the rigid wheelset that has this wheel, and C' - C [m].

        `tape` is the distance of the tape circle from the centre [m], negative for the left wheel, and `radius` the nominal
        radius [m].
        """
        spin = -velocity.forward / radius if velocity.spin is None else velocity.spin
        roll, yaw = pose.roll + self.roll, pose.yaw + self.yaw
        rates = velocity.roll + self.roll_rate, velocity.yaw + self.yaw_rate
        shift = np.array([self.x, self.y, self.z])
        shift += tape * (np.array(axle(pose.roll, pose.yaw)) - np.array(axle(roll, yaw)))
        speed = np.array([self.x_rate, self.y_rate, self.z_rate])
        speed += tape * (_turning(pose.roll, pose.yaw, velocity.roll, velocity.yaw) - _turning(roll, yaw, *rates))
        return (
            Pose(pose.y + shift[1], pose.z + shift[2], roll, yaw),
            Velocity(
                velocity.forward + speed[0],
                velocity.y + speed[1],
                velocity.z + speed[2],
                *rates,
                spin=spin + self.pitch_rate,
            ),
            shift,
        )


def _turning(roll: float, yaw: float, roll_rate: float, yaw_rate: float) -> Array:
    """Return the rate of the direction of the axle [1/s], the derivative of `axle`."""
    sine, cosine = math.sin(roll), math.cos(roll)
    by_roll = np.array([math.sin(yaw) * sine, -math.cos(yaw) * sine, cosine])
    by_yaw = np.array([-math.cos(yaw) * cosine, -math.sin(yaw) * cosine, 0.0])
    return by_roll * roll_rate + by_yaw * yaw_rate
