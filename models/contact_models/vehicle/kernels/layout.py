"""Arrays of a vehicle's kernels: bodies, force elements, track, state. The equations are those of vehicle.md.

A body has six coordinates in the frame of the track at its own place: x forward, y to the right, z down from the plane of the
rails, all relative to its place at rest, and small angles about these axes. Its velocities are absolute, resolved along the
axes of that frame. The pitch rate of a wheelset is its spin, negative when it rolls forward.
"""

from __future__ import annotations

from enum import IntEnum
from typing import Annotated, Any, NamedTuple

import numpy as np

from contact.core import Shape, group
from contact.kernels.arrays import Cube, Givens, Integers, Matrix, Numbers
from contact.kernels.block import layout


class Axis(IntEnum):
    """Coordinates of a body."""

    X = 0
    Y = 1
    Z = 2
    ROLL = 3
    PITCH = 4
    YAW = 5


class TrackFrame(IntEnum):
    """The track frame at a body: place of its origin in the plan [m], direction, cant and their rates."""

    X = 0
    Y = 1
    COS = 2  # of the direction
    SIN = 3
    COS_CANT = 4
    SIN_CANT = 5
    RATE_X = 6  # angular velocity of the frame along its own axes [rad/s]
    RATE_Y = 7
    RATE_Z = 8
    DIRECTION = 9  # [rad], clockwise seen from above
    CANT = 10  # [rad], positive where the left rail is higher
    CANT_SLOPE = 11  # [rad/m]


class TrackRow(IntEnum):
    """Rows of a track over equally spaced places. Those of the right rail come before those of the left one."""

    X = 0
    Y = 1
    DIRECTION = 2
    CURVATURE = 3  # [1/m], positive to the right
    CANT = 4  # [rad]
    CANT_SLOPE = 5  # [rad/m]
    SPEED = 6  # [m/s]
    RIGHT_Y = 7  # irregularity of the right rail [m]
    RIGHT_Y_SLOPE = 8
    RIGHT_Z = 9
    RIGHT_Z_SLOPE = 10
    RIGHT_FRICTION = 11  # factor on the coefficient of friction
    LEFT_Y = 12
    LEFT_Y_SLOPE = 13
    LEFT_Z = 14
    LEFT_Z_SLOPE = 15
    LEFT_FRICTION = 16
    PLACE = 17  # distance along the track [m], equally spaced


#: Rows between those of the right and of the left rail.
TO_LEFT = TrackRow.LEFT_Y - TrackRow.RIGHT_Y


#: Length of track that is kept before the start and after the end [m], for bodies ahead of and behind the reference.
BEYOND = 40.0
#: Largest distance [m] and angle [rad] of a body from its place; a vehicle that is further is lost.
FARTHEST = 5.0
#: Share of load times approach that a contact stores: exact for an elliptic one.
ELASTIC = 0.4


class Kind(IntEnum):
    """Kinds of force elements."""

    PARALLEL = 0  # springs and dampers side by side along three axes, and springs about them
    SERIES = 1  # springs in series with dampers along three axes
    STOP = 2  # a force over the deformation along y, from a table


class Book(IntEnum):
    """Energies since the start [J], and counts."""

    WEIGHT = 0  # work of gravity
    DRIVE = 1  # work of what holds coordinates: that of the given speed among them
    TORQUE = 2  # work of torques on axles
    DAMPER = 3  # spent in dampers and under the rails
    DISSIPATED = 4  # creep forces times creepages
    STORED = 5  # kinetic, elastic and contact energy now
    STORED_FIRST = 6
    RESIDUAL = 7
    ELASTIC = 8  # energy of springs and contacts at the last step
    IMPACTS = 9
    LIFTED = 10
    UNTRUSTED = 11
    STEPS = 12
    TIME = 13
    DISTANCE = 14


class Sum(IntEnum):
    """Sums of a wheel over steps, which divided by the number of steps are means, and extremes."""

    STEPS = 0
    LATERAL = 1  # [N]
    VERTICAL = 2
    LONGITUDINAL = 3
    T_GAMMA = 4
    DISSIPATION = 5
    LEAST_LATERAL = 6  # extremes, not sums
    LARGEST_LATERAL = 7
    LEAST_VERTICAL = 8
    LARGEST_VERTICAL = 9


BODY = np.dtype(
    [
        ("mass", "f8"),
        ("inertia", "f8", (3,)),
        ("place", "f8"),  # of its frame ahead of the vehicle's reference [m]
        ("height", "f8"),  # of its centre of gravity above the plane of the rails [m]
        ("held", "i8", (6,)),  # coordinates that stand still in the frame
        ("wheelset", "i8"),
        ("torque", "f8"),  # about the axle, positive when it drives forward [N m]
        ("load", "f8"),  # static load of each wheel of a wheelset [N]
    ],
    align=True,
)
#: The frame of body `b` seen from that of body `a`: rotation and place of its origin. Elements share links.
LINK = np.dtype([("a", "i8"), ("b", "i8"), ("turn", "f8", (3, 3)), ("offset", "f8", (3,))], align=True)
ELEMENT = np.dtype(
    [
        ("kind", "i8"),
        ("link", "i8"),
        ("on_a", "f8", (3,)),  # its place from the centre of gravity of each body [m]
        ("on_b", "f8", (3,)),
        ("stiffness", "f8", (3,)),
        ("damping", "f8", (3,)),
        ("turning", "f8", (3,)),  # stiffness about the axes [N m/rad]
        ("preload", "f8", (3,)),
        ("table", "i8"),  # first and end of its rows in the table of forces
        ("table_end", "i8"),
    ],
    align=True,
)
#: What one wheel does at one step. Forces act on the wheel, y to the right.
WHEEL = np.dtype(
    [
        ("longitudinal", "f8"),  # along the track [N]
        ("lateral", "f8"),
        ("vertical", "f8"),  # of the wheel on the rail, downwards
        ("normal", "f8"),  # sum of the normal forces
        ("dissipation", "f8"),  # creep forces times creepages [N]
        ("T_gamma", "f8"),
        ("pmax", "f8"),
        ("angle", "f8"),  # of the patch with the largest normal force [rad]
        ("creep_x", "f8"),  # and its creepages
        ("creep_y", "f8"),
        ("spin", "f8"),
        ("patches", "f8"),
        ("status", "f8"),
        ("moment_x", "f8"),  # about the wheelset's centre, track coordinates [N m]
        ("moment_y", "f8"),
        ("moment_z", "f8"),
        ("elastic", "f8"),  # energy stored in the contacts [J]
    ],
    align=True,
)
#: The rail under one wheel: slopes of its irregularities [-], coefficients of friction at rest and kinetic [-].
SEAT = np.dtype([("along_y", "f8"), ("along_z", "f8"), ("friction", "f8"), ("kinetic", "f8")], align=True)


#: Arrays of these records, and single ones.
Bodies = Annotated[Any, Shape(BODY, 1)]
Body = Annotated[Any, Shape(BODY, 0)]
Links = Annotated[Any, Shape(LINK, 1)]
Elements = Annotated[Any, Shape(ELEMENT, 1)]
Wheels = Annotated[Any, Shape(WHEEL, 1)]
Wheel = Annotated[Any, Shape(WHEEL, 0)]
Seats = Annotated[Any, Shape(SEAT, 1)]
Seat = Annotated[Any, Shape(SEAT, 0)]


@group
class Model(NamedTuple):
    """Constants of a vehicle on a track."""

    bodies: Bodies
    links: Links
    elements: Elements
    table: Matrix  # deformation [m] and force [N] of stops, shape (2, n)
    wheelsets: Integers  # numbers of the bodies that are wheelsets
    track: Matrix  # shape (len(Row), n)
    rail: Numbers  # mass, lateral stiffness and damping, vertical stiffness and damping; mass 0: rigid
    surface: Numbers  # coefficient of friction, at rest and kinetic


@group
class State(NamedTuple):
    """What carries over from one step to the next."""

    q: Annotated[Matrix, "n_bodies, 6"]  # coordinates
    u: Annotated[Matrix, "n_bodies, 6"]  # velocities
    inner: Annotated[Matrix, "n_elements, 3"]  # elongation of the dampers of series elements [m]
    rails: Annotated[Cube, "n_axles, 2, 4"]  # y, z and their rates under each wheel
    loads: Annotated[Matrix, "n_axles, 2"]  # normal forces of the last step [N]
    sums: Annotated[Matrix, "2 * n_axles, len(Sum)"]  # over the steps since it was cleared
    books: Annotated[Numbers, "len(Book)"]
    gains: Annotated[Matrix, "n_axles, 6"]  # by how much the velocities of the wheelsets grew in the last step


@group
class Scratch(NamedTuple):
    """Arrays of one step. Forces and wheels are those of the last step for the next one."""

    frames: Annotated[Matrix, "n_bodies, len(TrackFrame)"]
    forces: Annotated[Matrix, "n_bodies, 6"]  # generalised
    given: Annotated[Givens, "n_wheels"]  # what the contact of each wheel is asked, in the order of `wheels`
    seats: Annotated[Seats, "n_wheels"]  # the rail under each wheel
    wheels: Annotated[Wheels, "n_wheels"]  # one for each wheel: axle by axle, right before left
    power: Annotated[Numbers, "3"]  # damper, dissipation, elastic energy of this step


lay_state = layout(State, "n_bodies, n_elements, n_axles", globals())
lay_scratch = layout(Scratch, "n_bodies, n_wheels", globals())
