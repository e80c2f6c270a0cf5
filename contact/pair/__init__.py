"""A wheel on a rail, on a roller or between switch and crossing: pairs, motions in time and over a distance.

`WheelRailPair` takes a pose and a velocity and returns the forces of all its patches by a strip method. `HalfspacePair`
does so by the half space, `RollerRig` on a roller, `drive` with a given torque. `over_poses` takes arrays of poses,
`over_time` a motion, `passage` a way over a switch or crossing.
"""

from contact.pair.contact_damping import ContactDamping
from contact.pair.driven import Driven, drive
from contact.pair.elastic_rail import ElasticRail
from contact.pair.friction_memory import FrictionMemory
from contact.pair.halfspace import HalfspacePair, SurfaceContact, SurfaceSolution
from contact.pair.in_time import over_time
from contact.pair.passage import Passage, passage
from contact.pair.poses import PoseForces, over_poses
from contact.pair.roller import RigSolution, RollerRig
from contact.pair.wheel_rail import Contact, PairArchard, PairDamage, PairSolution, WheelRailPair

__all__ = [
    "Contact",
    "ContactDamping",
    "Driven",
    "ElasticRail",
    "FrictionMemory",
    "HalfspacePair",
    "PairArchard",
    "PairDamage",
    "PairSolution",
    "Passage",
    "PoseForces",
    "RigSolution",
    "RollerRig",
    "SurfaceContact",
    "SurfaceSolution",
    "WheelRailPair",
    "drive",
    "over_poses",
    "over_time",
    "passage",
]
