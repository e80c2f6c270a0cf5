"""The included wheelset on straight track: the system of the demo, of the FMU `Wheelset` and of coupled.ssp."""

from __future__ import annotations

import numpy as np

from contact.arrays import Array
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Side
from contact.pair import WheelRailPair
from ..runs.scenario import Declaration, Methods, Scenario
from ..vehicle.declared import SIDES, read
from ..vehicle.kernels.layout import BEYOND, Axis, TrackRow
from ..vehicle.simulation import ContactOptions, Simulation
from .contacts import InPython

SPEED, LATERAL = 28.0, 3e-3  # [m/s], at the start [m]
LENGTH = 10e3  # of the track [m]


def scenario(speed: float = SPEED, friction: float = 0.3) -> Scenario:
    """Return the wheelset with S1002 wheels on straight 60E1 rails at `speed` [m/s]."""
    declared = Declaration(
        name="wheelset on straight track", length=LENGTH, speed=speed, friction=friction, methods=Methods(pace=1)
    )
    return Scenario(declared, profile.s1002(), profile.rail_60e1(), read(declared.vehicle))


def track(speed: float = SPEED) -> Array:
    """Return the rows of straight ideal track (`contact_models.vehicle.course.lay`). It needs few places."""
    rows = np.zeros((len(TrackRow), 4))
    rows[TrackRow.PLACE] = np.linspace(-BEYOND, LENGTH + BEYOND, rows.shape[1])
    rows[TrackRow.X] = rows[TrackRow.PLACE] + BEYOND
    rows[TrackRow.SPEED] = speed
    rows[TrackRow.RIGHT_FRICTION] = rows[TrackRow.LEFT_FRICTION] = 1.0
    return rows


def simulation(given: Scenario, lateral: float = LATERAL) -> Simulation:
    """Return the wheelset of a scenario, on both rails `lateral` [m] to the right of the centre."""
    made = Simulation(
        given.vehicle, track(given.speed(0.0)), given.wheel, given.rail, given.friction, ContactOptions(pace=1)
    )
    made.stand_aside(lateral)
    return made


def at_start(made: Simulation) -> dict[str, float]:
    """Return the parameters of the FMU `Wheelset` with which it starts as this simulation does."""
    (i,), state = made.model.wheelsets, made.state
    pose = {f"initial.{axis.name.lower()}[1]": float(state.q[i, axis]) for axis in (Axis.Y, Axis.Z, Axis.ROLL)}
    return pose | {"initial.radius[1]": float(-state.u[i, Axis.X] / state.u[i, Axis.PITCH])}


def pair(given: Scenario, side: Side) -> Pair:
    """Return the geometry of one wheel of a scenario on its rail."""
    return Pair(given.wheel, given.rail, side=side, **given.vehicle.sizes)


def python_contacts(given: Scenario) -> list[InPython]:
    """Return the contacts of both wheels as Python objects."""
    return [InPython(WheelRailPair(pair(given, side))) for side in SIDES]
