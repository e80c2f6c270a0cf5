"""How wheel and rail move against each other at a contact, as rigid bodies (other_wheels.md).

Each body has a velocity v of one of its points o, and a turning ω; its point p moves with v + ω × (p - o). All are in track
coordinates of the actual side.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.geometry.flexible import WheelOffset
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.kernels.geometry.search import axle


class Twist(NamedTuple):
    """Motion of a rigid body: a point `o` of it [m], its velocity `v` [m/s] and the turning `w` [rad/s]."""

    o: Array
    v: Array
    w: Array

    def at(self, p: Array) -> Array:
        """Return the velocity of the point `p`, or of points, shape (…, 3) [m/s]."""
        return np.asarray(self.v + np.cross(self.w, p - self.o))


class Sliding(NamedTuple):
    """Wheel minus rail at a contact, in its frame.

    Attributes
    ----------
    x, y : velocity [m/s]
    spin : turning about the normal [rad/s]
    mean : mean of the speeds with which both surfaces run through the contact [m/s], the reference of CONTACT's creepages
    forwards : whether the contact rolls towards +x
    """

    x: float
    y: float
    spin: float
    mean: float
    forwards: bool


class Roller(NamedTuple):
    """Radius of a roller where its profile has z = 0, height of its axis in the track, down, and its place along it [m]."""

    radius: float
    axis: float
    ahead: float = 0.0


class Bodies:
    """A wheel and its rail, or its roller, in motion.

    Parameters
    ----------
    pose, velocity : of the wheelset
    radius : nominal radius of the wheel [m]
    rail : motion of the rail
    origin : place (y, z) of the origin of the rail's profile, with the rail's displacement [m]
    offset : motion of the wheel against its wheelset
    datum : distance of the wheel's tape circle from the wheelset's centre, to the right [m]
    roller : instead of a rail; `velocity.forward` is then the speed of its surface at its radius
    curvature : of the track [1/m], positive to the right
    own_axis : whether a displaced wheel turns about its own axis; else about that of the wheelset, as in CONTACT
    """

    def __init__(
        self,
        pose: Pose,
        velocity: Velocity,
        radius: float,
        rail: Irregularity,
        origin: tuple[float, float],
        offset: WheelOffset,
        datum: float,
        *,
        roller: Roller | None = None,
        curvature: float = 0.0,
        own_axis: bool = True,
    ) -> None:
        l = np.array(axle(pose.roll, pose.yaw))
        yawed = np.array([math.cos(pose.yaw), math.sin(pose.yaw), 0.0])
        spin = -velocity.forward / radius if velocity.spin is None else velocity.spin
        centre, down = np.array([0.0, pose.y, pose.z - radius]), np.array([0.0, 0.0, 1.0])
        forward = np.array([velocity.forward if roller is None else 0.0, velocity.y, velocity.z])
        turning = velocity.roll * yawed + velocity.yaw * down
        moved = np.array(axle(pose.roll + offset.roll, pose.yaw + offset.yaw)) if own_axis else l
        self._centre, self._pitch = centre, spin * moved
        own = Twist(
            centre + datum * l + np.array([offset.x, offset.y, offset.z]),
            np.array([offset.x_rate, offset.y_rate, offset.z_rate]),
            offset.roll_rate * yawed + offset.yaw_rate * down + offset.pitch_rate * moved,
        )
        carried = turning if own_axis else turning + self._pitch
        self.wheel = Twist(own.o, forward + np.cross(carried, own.o - centre) + own.v, turning + self._pitch + own.w)
        y, z = origin
        rates = np.array([0.0, rail.y_rate, rail.z_rate]), np.array([rail.roll_rate, 0.0, 0.0])
        self.rail = Twist(np.array([0.0, y, z]), *rates)
        self._roller = roller is not None
        if roller is not None:
            turns = np.array([0.0, velocity.forward / roller.radius, 0.0])
            arm = np.array([0.0, 0.0, z - roller.axis])
            place = self.rail.o + np.array([roller.ahead, 0.0, 0.0])
            self.rail = Twist(place, rates[0] + np.cross(turns, arm), rates[1] + turns)
        elif curvature:
            turns = np.array([0.0, 0.0, -velocity.forward * curvature])
            self.rail = Twist(self.rail.o, rates[0] + np.cross(turns, self.rail.o), rates[1] + turns)

    def at(self, on_rail: Array, on_wheel: Array, axes: Array) -> Sliding:
        """Return how the wheel's point slides over the rail's; `axes` are the rows of the contact's frame."""
        of_rail, of_wheel = self.rail.at(on_rail), self.wheel.at(on_wheel)
        x, y, _ = axes @ (of_wheel - of_rail)
        spin = float(axes[2] @ (self.wheel.w - self.rail.w))
        if self._roller:
            rail, wheel = float(axes[0] @ of_rail), float(axes[0] @ of_wheel)
            mean, forwards = 0.5 * abs(rail + wheel), (rail if abs(rail) >= abs(wheel) else wheel) <= 0.0
        else:
            round_axle = float(np.cross(self._pitch, on_wheel - self._centre)[0])
            along = float(of_wheel[0]) - round_axle
            mean = 0.5 * (abs(along) + abs(round_axle))
            forwards = along >= 0.0 if abs(along) >= abs(round_axle) else round_axle <= 0.0
        return Sliding(float(x), float(y), spin, mean, forwards)


def displaced(pose: Pose, offset: WheelOffset, datum: float) -> tuple[Pose, Array]:
    """Return the pose of the rigid wheelset that has a displaced wheel, and the displacement of its centre [m].

    `datum` is as for `Bodies`. See `contact.kernels.flexible`.
    """
    moved = np.array([offset.x, offset.y, offset.z])
    roll, yaw = pose.roll + offset.roll, pose.yaw + offset.yaw
    moved = moved + datum * (np.array(axle(pose.roll, pose.yaw)) - np.array(axle(roll, yaw)))
    return type(pose)(pose.y + float(moved[1]), pose.z + float(moved[2]), roll, yaw), moved
