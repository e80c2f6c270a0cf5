"""Vehicles and tracks of the tests."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from contact.geometry import profile
from contact.geometry.profile import Profile
from contact.geometry.surfaces import WheelSurface
from contact_models.runs import result
from contact_models.runs.run import VehicleRun
from contact_models.runs.scenario import Declaration, Methods, Profiles, Recording, Scenario
from contact_models.runs.trust import StepError
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import VehicleDeclaration, read
from contact_models.vehicle.sections import RailSection
from contact_models.vehicle.simulation import PACE, ContactOptions, Simulation
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Track

#: Methods that are solved fast, at every step.
FAST = ContactOptions(normal="analyn", tangential="fastrip", n_strips=20, n_elements=12, pace=1)
#: The same, solved anew only where a contact has changed (`test_between.py`): where a vehicle is tested, not its contacts.
PACED = replace(FAST, pace=PACE)


def simulation(
    vehicle: str | VehicleDeclaration = "wheelset",
    track: Track | None = None,
    *,
    speed: float = 20.0,
    length: float = 10.0,
    wheel: Profile | None = None,
    friction: float = 0.3,
    seed: int = 1,
    settling: float = 0.0,
    options: ContactOptions = FAST,
    uneven: Mapping[int, WheelSurface] | None = None,
    sections: Sequence[RailSection] = (),
) -> Simulation:
    """Return a vehicle at the start of a track, straight and ideal unless another one is given."""
    declared = read(vehicle) if isinstance(vehicle, str) else vehicle
    rows = lay(track or Track(), length, lambda s: speed, (seed,), settling)
    both = wheel or profile.s1002(), profile.rail_60e1()
    return Simulation(declared, rows, *both, friction, options, uneven=uneven, sections=sections)


def scenario(**changes) -> Scenario:
    given = {
        "name": "short",
        "length": 6.0,
        "speed": 20.0,
        "vehicle": "wheelset",
        "recording": Recording(settling=1.0, spacing=0.25),
        "track": Track(alignment=Irregularities(spectrum="ERRI B176 low")),
        "methods": Methods(normal="analyn", tangential="fastrip", strips=20, elements=12),
    }
    declared = Declaration(**(given | changes))
    return Scenario(declared, *Profiles().load(Path()), read(declared.vehicle))


def interrupted(run: VehicleRun) -> None:
    """Complete a run, and another one from the state that it has now. Assert that both have the same results.

    The error of the step, for which each would be run twice more, is left out.
    """
    other = VehicleRun(run.scenario)
    other.restore(run.save())
    for one in (run, other):
        vars(one)["step_error"] = StepError(0.0, 0.0, 1.0)
    assert result.dataset(completed(other)).identical(result.dataset(completed(run)))


def completed(run: VehicleRun) -> VehicleRun:
    while not run.done:
        run.advance()
    return run
