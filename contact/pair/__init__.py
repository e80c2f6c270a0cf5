"""A wheel on a rail, on a roller or between switch and crossing.

Three pairs have the same methods and the same result, `PairSolution`: `WheelRailPair` solves by a strip method,
`HalfspacePair` by the half space, `RollerRig` on a roller; `TransientPair` shifts and rolls in steps. `solve` takes a pose, a
velocity and what is given: a load, a penetration, a force, a torque. `run` takes a motion over time or along the way.
`over_poses` takes arrays of poses.
"""

from contact.pair.contact_damping import ContactDamping
from contact.pair.curving import Curving, in_curve
from contact.pair.elastic_rail import ElasticRail
from contact.pair.friction_memory import FrictionMemory
from contact.pair.halfspace import HalfspacePair, solver_for
from contact.pair.motion import PairRun
from contact.pair.poses import PoseForces, over_poses
from contact.pair.roller import RollerRig
from contact.pair.solution import Contact, PairArchard, PairDamage, PairSolution
from contact.pair.transient import TransientPair
from contact.pair.wheel_rail import WheelRailPair

__all__ = [
    "Contact",
    "ContactDamping",
    "Curving",
    "ElasticRail",
    "FrictionMemory",
    "HalfspacePair",
    "PairArchard",
    "PairDamage",
    "PairRun",
    "PairSolution",
    "PoseForces",
    "RollerRig",
    "TransientPair",
    "WheelRailPair",
    "in_curve",
    "over_poses",
    "solver_for",
]
