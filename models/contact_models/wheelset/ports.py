"""Data exchanged between the wheelset and a wheel-rail contact: order and FMU names.

The wheelset's outputs of one side have the names of the contact's inputs after the prefix "right." or "left.". Its inputs
have the names of the contact's outputs after the same prefix.
"""

from __future__ import annotations

import math

from contact.geometry.wheelset import Side

#: Sides in the order of every array.
SIDES: tuple[Side, Side] = ("right", "left")
#: Factor that shows an angle of a side's contact frame [rad] in degrees, positive if the rail pushes to the track's centre.
INWARDS: dict[Side, float] = {"right": -math.degrees(1.0), "left": math.degrees(1.0)}
#: Number of samples of the separation, a build option of `WheelRailContact`.
POINTS = 41

#: Inputs of a contact: gap [m], half curvature [1/m], creepages [-], [-], [rad/m], normal force [N].
PROBLEM = (
    *(f"geometry.g[{i}]" for i in range(1, POINTS + 1)),
    *(f"geometry.A[{i}]" for i in range(1, POINTS + 1)),
    "creepage.longitudinal",
    "creepage.lateral",
    "creepage.spin",
    "load.normal_force",
)
GAP, CURVATURE = slice(0, POINTS), slice(POINTS, 2 * POINTS)
CREEPAGE = slice(2 * POINTS, 2 * POINTS + 3)
LOAD = 2 * POINTS + 3

#: Outputs of a contact that act on the wheelset [N], [N], [N m], [m].
REACTION = ("force.x", "force.y", "moment.z", "approach")
#: Further outputs of a contact that are recorded [W], [Pa], [-], [-], [N].
REPORT = ("power.friction", "pressure.max", "slip.ratio", "status", "damage.T_gamma")

#: Motion of the wheelset: m, rad, m/s, rad/s, rad/s, m, rad.
MOTION = ("lateral", "yaw", "lateral_velocity", "yaw_rate", "spin", "vertical", "roll")
#: Energies of the wheelset since the start [J].
ENERGY = ("energy.interface", "energy.drive", "energy.damper", "energy.mechanical")
#: Accelerations and powers: m/s², rad/s², rad/s², W, W, W.
CHANGE = (
    *("lateral_acceleration", "yaw_acceleration", "spin_acceleration"),
    *("power.interface", "power.drive", "power.damper"),
)
#: Contact frame of one side relative to the wheelset's centre [m], [m], [m], [rad].
FRAME = ("contact.x", "contact.y", "contact.z", "contact.angle")
#: Lateral position of the track's centre line [m] and its slope along the track [-].
IRREGULARITY = ("irregularity.lateral", "irregularity.slope")

CONTACT_PORTS = {"problem": PROBLEM, "reaction": REACTION, "report": REPORT}
WHEELSET_PORTS = {"motion": MOTION, "energy": ENERGY, "change": CHANGE, "irregularity": IRREGULARITY} | {
    f"{side}.{port}": tuple(f"{side}.{name}" for name in names)
    for side in SIDES
    for port, names in (("problem", PROBLEM), ("reaction", REACTION), ("frame", FRAME))
}
