"""The functions through which the tests of refused input go: each does its work with what is usual, but for what is given."""

from dataclasses import replace

import contact
from contact.friction import Friction
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import RollerRig, WheelRailPair

ELLIPSE, CREEPAGE = contact.Separation.hertzian(1.0, 2.0), contact.Creepage()
WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
PAIR, LAW = Pair(WHEEL, RAIL), Friction(0.4, 0.1, half_speed=0.05, law="exponential")
REST = Pose()
HALF = {"normal": "halfspace", "tangential": "halfspace"}


def solve(separation=ELLIPSE, creepage=CREEPAGE, **given):
    return contact.solve(separation, creepage, **given)


def rolled(pose=REST, **given):
    return WheelRailPair(PAIR).solve(pose, **{"load": 8e4, **given})


def on_rollers(velocity=1.0, **given):
    return RollerRig(PAIR, 0.6).solve(Pose(), Velocity(velocity), **given)


def law(**given):
    return Friction(0.3, **given)


def steel(**given):
    return replace(contact.STEEL, **given)
