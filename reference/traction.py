"""Traction of a locomotive wheel with friction that falls with temperature: CONTACT's Eurosprinter example, ours beside it."""

from __future__ import annotations

import math

import numpy as np

import contact
from contact.damage.temperature import flash_temperature
from contact.friction import Friction
from contact.inputs.material import Thermal

#: Slip [%] of the columns.
SLIPS = (0.2, 4.0, 15.0, 25.0)
#: Fall of the coefficient [-] and the rise of temperature over which it falls [K] → Fx/N [-] by CONTACT. Read by an earlier
#: session of this project in the open test bank of CONTACT, noted in issue 35.
FORCES = {
    (0.0, 1200.0): (0.2908, 0.3300, 0.3300, 0.3300),
    (0.19, 1200.0): (0.2906, 0.3194, 0.2930, 0.2724),
    (0.19, 400.0): (0.2901, 0.3000, 0.2390, 0.2016),
}
#: Largest rise of temperature with constant friction [K] by CONTACT, from the same source.
RISES = (6.5, 111.0, 413.0, 688.0)
#: Read in testbank/examples_temp/euro_tractcurv.inp of github eve70a/CONTACT, commit 424e4e6: load [N], friction, speed [m/s],
#: A [1/m], and a/b = .5. Its thermal constants (450 J/(kg K), 50 W/(m K), 7850 kg/m³) are those of our steel.
LOAD, FRICTION, SPEED, A = 106.7e3, 0.33, 10.0, 0.8
#: Elements along the patch in that example.
ELEMENTS = 40
#: B/A of Hertz for a/b = .5: (K - E)/(E/.25 - K), with the complete elliptic integrals K, E of the modulus √.75.
B_OVER_A = (2.156515647 - 1.211056028) / (1.211056028 / 0.25 - 2.156515647)
#: CONTACT counts the heat of an element itself twice, which on its elements makes the rise 11 % larger. With this heat
#: capacity instead of 450 J/(kg K) the rise at 25 % is that of CONTACT.
FITTED = Thermal(heat_capacity=450.0 / 1.1187**2)


def column(slip: float, fall: float, over: float, thermal: Thermal) -> tuple[float, float]:
    """Return Fx/N and the largest rise of temperature [K] at a slip [%]."""
    friction = Friction(FRICTION, hot_factor=1.0 - fall / FRICTION, temperature_range=over, thermal=thermal)
    separation = contact.Separation.hertzian(A, A * B_OVER_A)
    solution = contact.solve(
        separation, contact.Creepage(0.01 * slip), load=LOAD, friction=friction, speed=SPEED, n_elements=100
    )
    return abs(solution.Fx) / solution.N, float(flash_temperature(solution, thermal).max())


def forces(thermal: Thermal) -> dict[tuple[float, float], list[float]]:
    """Return our Fx/N in the order of `FORCES`."""
    return {law: [column(slip, *law, thermal)[0] for slip in SLIPS] for law in FORCES}


def rises(thermal: Thermal) -> list[float]:
    """Return our largest rises of temperature with constant friction [K]."""
    return [column(slip, 0.0, 1200.0, thermal)[1] for slip in SLIPS]


def counted_twice() -> list[float]:
    """Return the largest rises [K] of our half space on CONTACT's elements, each element's own heat counted twice as there."""
    separation, thermal, found = contact.Separation.hertzian(A, A * B_OVER_A), Thermal(), []
    patch = contact.solve(separation, contact.Creepage(), load=LOAD, normal="hertz", tangential="fastsim")
    size = 2.0 * float(patch.strips.a.max()) / ELEMENTS
    for slip in SLIPS:
        solution = contact.solve(
            separation, contact.Creepage(0.01 * slip), load=LOAD, friction=FRICTION, speed=SPEED, normal="halfspace",
            tangential="halfspace", spacing=size,
        )  # fmt: skip
        heat = np.hypot(solution.qx, solution.qy) * np.hypot(solution.sx, solution.sy) * SPEED
        own = thermal.heating / math.sqrt(SPEED) * 2.0 * math.sqrt(0.5 * size) * heat
        found.append(float((flash_temperature(solution, thermal) + own).max()))
    return found
