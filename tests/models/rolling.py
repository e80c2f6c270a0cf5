"""Conical wheels on circular rails, for which the geometry has a closed form."""

import math
from dataclasses import replace

from contact.geometry import profile
from contact_models.runs.scenario import Scenario
from contact_models.vehicle.declared import Rail
from contact_models.wheelset import system

RAIL_RADIUS, HALF_BASE, RADIUS = 0.3, 0.75, 0.46


def on_cones(conicity: float, speed: float, *, free: bool = False) -> Scenario:
    """Return the included wheelset with straight cones on circular rails that do not give way.

    Rail crowns and tape circles are 1.5 m apart. A `free` wheelset has no springs along and across the track.
    """
    depth = 1e-3
    crown_from_gauge_point = math.sqrt(RAIL_RADIUS**2 - (RAIL_RADIUS - depth) ** 2)
    given = system.scenario(speed)
    (spring,) = given.vehicle.springs
    if free:
        spring = replace(spring, stiffness=(0.0, 0.0, spring.stiffness[2]))
    vehicle = replace(
        given.vehicle,
        springs=(spring,),
        rail=Rail(mass=0.0),
        gauge=1.5 - 2.0 * crown_from_gauge_point,
        gauge_point=depth,
    )
    return replace(given, wheel=profile.cone(conicity), rail=profile.rail_arc(RAIL_RADIUS), vehicle=vehicle)
