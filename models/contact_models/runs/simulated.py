"""What a scenario is for the simulation of its vehicle: contact methods, track, and the vehicle on it."""

from __future__ import annotations

from typing import Any

from contact.arrays import Array
from ..vehicle.course import lay
from ..vehicle.simulation import ContactOptions, Simulation
from ..vehicle.track import Track
from .scenario import Scenario


def options(given: Scenario) -> ContactOptions:
    """Return the contact methods of all wheels."""
    methods = given.declared.methods
    return ContactOptions(
        normal=methods.normal,
        tangential=methods.tangential,
        n_strips=methods.strips,
        n_elements=methods.elements,
        material=methods.material,
        damage=given.declared.damage,
        pace=methods.pace,
    )


def track(given: Scenario) -> Array:
    """Return the rows of the track (`contact_models.vehicle.course.lay`)."""
    d = given.declared
    return lay(d.track, d.length, given.speed, (d.seed, *given.draw), d.recording.settling)


def simulation(given: Scenario, track: Array, **others: Any) -> Simulation:
    """Return the vehicle with its profiles on a track; `others` are further arguments of `Simulation`."""
    rails = given.rails * len(given.vehicle.wheelsets)
    return Simulation(given.vehicle, track, given.wheels, rails, given.friction, options(given), **others)


def on_straight(given: Scenario, speed: float) -> Simulation:
    """Return the vehicle on ideal straight track at a speed [m/s]."""
    return simulation(given, lay(Track(), 1.0, lambda s: speed, (0,), 0.0))
