"""Starts of the FMUs of a vehicle: what its scenario gives of their variables."""

from __future__ import annotations

from contact.damage import DamageParameters
from contact.errors import ContactError
from contact.friction import LAWS, VELOCITIES, Friction
from contact.geometry.profile import Kind, Profile
from contact_models.runs import simulated
from contact_models.runs.scenario import WEAR_LAW, Methods, Profiles, Scenario
from contact_models.vehicle.kernels.layout import Axis
from contact_models.vehicle.simulation import Simulation
from .tables.solver import FRICTION, FRICTION_LAW, FRICTION_VELOCITY, THERMAL
from .tables.vehicle import Starts


def profiles(given: Scenario) -> dict[Kind, Profile]:
    """Return the profiles of a scenario that names other ones than the default pair."""
    if given.declared.profiles == Profiles():
        return {}
    return {"wheel": given.wheel, "rail": given.rail}


def vehicle(given: Scenario, start: float) -> Starts:
    """Return the starts of the FMU `Vehicle` at the place `start` [m].

    Raises
    ------
    ContactError
        If the scenario has what the FMUs of a vehicle have not: torques, or different rails.
    """
    _require_known(given)
    methods: Methods = given.declared.methods
    found: dict[str, float | str | tuple[float, ...]] = {
        **inputs(given, start),
        **_friction(given.friction),
        "method.normal": methods.normal,
        "method.tangential": methods.tangential,
        "resolution.n_strips": methods.strips,
        "resolution.n_elements": methods.elements,
        "resolution.pace": methods.pace,
        "material.pressure_limit": methods.pressure_limit or 0.0,
    }
    if given.declared.recording.step is not None:
        found["resolution.step"] = min(given.declared.recording.step, 1e-3)
    return tuple(sorted(found.items()))


def inputs(given: Scenario, start: float) -> dict[str, float]:
    """Return the starts of the inputs of both FMUs: a scenario's speed at a place, and its friction."""
    return {"speed": given.speed(start), "friction.coefficient": given.friction.static}


def open_vehicle(given: Scenario, start: float) -> Starts:
    """Return the starts of the FMU `OpenVehicle` at the place `start` [m]: poses of its wheelsets and place of the rails."""
    return of_simulation(given, simulated.simulation(given, simulated.track(given), start=start), start)


def of_simulation(given: Scenario, simulation: Simulation, start: float) -> Starts:
    """Return the same from the scenario's vehicle at its start."""
    origin = simulation.wheel_arrays.motions[0]
    wheelsets = simulation.model.wheelsets
    pose, spin = simulation.state.q[wheelsets], simulation.state.u[wheelsets, Axis.PITCH]
    found: dict[str, float | str | tuple[float, ...]] = {
        **inputs(given, start),
        "initial.distance": start,
        **{f"initial.{axis.name.lower()}": tuple(pose[:, axis].tolist()) for axis in (Axis.Y, Axis.Z, Axis.ROLL)},
        "initial.radius": tuple((-given.speed(start) / spin).tolist()),
        "rail.origin_y": float(origin["origin_y"]),
        "rail.origin_z": float(origin["origin_z"]),
    }
    return tuple(sorted(found.items()))


def left_out(given: Scenario) -> list[str]:
    """Return what a scenario gives that the FMUs of its vehicle have no variable for."""
    found = []
    if given.declared.damage != DamageParameters(wear_law=WEAR_LAW):
        found.append("damage (the FMUs have the default constants)")
    if not isinstance(given.declared.speed, float):
        found.append("the speed along the track (an input, which starts at the speed of the first station)")
    return found


def _friction(given: Friction) -> dict[str, float | str]:
    return {
        "friction.law": FRICTION_LAW.item(LAWS.index(given.law) + 1),
        "friction.velocity": FRICTION_VELOCITY.item(VELOCITIES.index(given.velocity) + 1),
        **{f"friction.{name}": getattr(given, name) for name in FRICTION},
        "friction.kinetic": given.static if given.kinetic is None else given.kinetic,
        **{f"thermal.{name}": getattr(given.thermal, name) for name in THERMAL},
    }


def _require_known(given: Scenario) -> None:
    if given.declared.torque:
        raise ContactError("torque: the FMUs of a vehicle have no torques of axles; leave out these tables")
    if given.both_rails:
        raise ContactError("profiles.left_rail: the FMUs of a vehicle have one profile of both rails; leave it out")
