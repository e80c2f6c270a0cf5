"""Wheel, rail and motion of the tests of surfaces."""

import numpy as np

from contact.geometry import profile
from contact.geometry.surfaces import RailSurface
from contact.geometry.wheelset import Velocity

R0 = 0.460
WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
FREE = Velocity(2.0, spin=-2.0 / R0)


def crest(rate):
    """Return a crowned rail that rises by `rate` along the track."""
    arc, s = profile.rail_arc(0.3), np.linspace(-0.1, 0.1, 5)
    return RailSurface(s, [np.stack((arc.y, arc.z - rate * at), axis=1) for at in s])
