"""Runs by which FMUs are compared function by function: Python against native ones, FMI 3.0 against 2.0."""

import math

import pair_case
from contact_case import CREEPAGES

#: FMU → inputs and parameters of a run, and one that ends it. The strips of the pair start from the last step.
RUNS = {
    "WheelRailContact": ({**CREEPAGES, "method.normal": 2, "friction.law": 3}, ("creepage.spin", math.nan)),
    "EllipticContact": (CREEPAGES, ("geometry.A0", -1.0)),
    "WheelRailPair": (pair_case.MOTION, ("pose.yaw", 0.5)),
    "Wheelset": ({"initial.y[1]": 4e-3, "wheel[1].force.y": 1e3}, ("wheel[1].force.y", math.inf)),
}
