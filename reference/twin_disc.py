"""Flash temperature of dry twin discs from the published heat (Lewis and Dwyer-Joyce 2004)."""

from __future__ import annotations

import math

import numpy as np

from contact.damage.temperature import heating
from contact.inputs.material import STEEL, Thermal

#: Slip [%], frictional heat [W] and largest flash temperature [K]; read by an earlier session, noted in issue 35.
PUBLISHED = (
    (0.2, 1.3, 0.19),
    (0.5, 9.2, 1.3),
    (1.0, 25.7, 3.7),
    (3.0, 102.6, 15.1),
    (7.5, 246.0, 36.7),
    (10.0, 327.8, 49.2),
    (15.0, 492.1, 74.8),
    (20.0, 728.4, 112.5),
)
#: Recalled: disc radius [m], width of the line contact [m], peak pressure [Pa], revolutions per second [1/s].
RADIUS, WIDTH, PEAK, REVOLUTIONS = 23.5e-3, 10e-3, 1.5e9, 400.0 / 60.0
SPEED = 2.0 * math.pi * REVOLUTIONS * RADIUS
#: Half length of Hertz's line contact of two equal discs, a = 2 p0 (R/2)/E*.
HALF_LENGTH = PEAK * RADIUS / STEEL.contact_modulus


def largest_rise(heat: float) -> float:
    """Return the largest temperature rise [K] when `heat` [W] is released in proportion to Hertz's pressure."""
    edges = HALF_LENGTH * np.cos(np.arange(401) * math.pi / 400)
    middle = 0.5 * (edges[:-1] + edges[1:]) / HALF_LENGTH
    flux = heat / (0.5 * math.pi * HALF_LENGTH * WIDTH) * np.sqrt(1.0 - middle**2)
    return float(heating(flux, edges, SPEED, Thermal()).max())


def rows() -> list[tuple[float, float, float, float]]:
    """Return slip [%], published heat [W], published rise [K] and our rise [K] of every case."""
    return [(slip, heat, rise, largest_rise(heat)) for slip, heat, rise in PUBLISHED]
