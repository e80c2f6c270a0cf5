"""Conical wheels on circular rails, for which the geometry has a closed form."""

import math

from contact.geometry import profile
from contact_models.wheelset.parameters import WheelsetParameters

RAIL_RADIUS = 0.3


def on_cones(conicity: float, **changes) -> WheelsetParameters:
    """Return parameters of straight cones on circular rails. Rail crowns and tape circles are 1.5 m apart."""
    depth = 1e-3
    crown_from_gauge_point = math.sqrt(RAIL_RADIUS**2 - (RAIL_RADIUS - depth) ** 2)
    return WheelsetParameters(
        wheel=profile.cone(conicity),
        rail=profile.rail_arc(RAIL_RADIUS),
        gauge=1.5 - 2.0 * crown_from_gauge_point,
        gauge_point=depth,
        **changes,
    )
