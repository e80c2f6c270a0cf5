"""The run of a scenario: that of its vehicle, or of the quasi-static wheelset."""

from __future__ import annotations

from models.life.run import Run
from models.life.scenario import Scenario
from models.vehicle.run import VehicleRun


def start(scenario: Scenario) -> Run | VehicleRun:
    """Return the run of a scenario at its start."""
    return Run(scenario) if scenario.vehicle is None else VehicleRun(scenario)
