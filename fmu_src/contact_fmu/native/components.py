"""What each FMU has beside its variables: files in resources/, messages and numbers of its own. No kernels."""

from __future__ import annotations

import numpy as np

from contact import Status
from contact.kernels.geometry.settle import DEEPEST
from contact.kernels.records import LARGEST_ANGLE
from contact_models.vehicle.assembly import assemble
from contact_models.vehicle.declared import read
from .. import surfaces, track
from ..profiles import MAGIC, ROWS
from ..tables import open_vehicle, vehicle, wheel_rail_contact, wheel_rail_pair, wheel_rail_surfaces
from ..tables.open_vehicle import ASTRAY, ENDED, LOST
from ..tables.vehicle import Starts
from .component import Component, Resource, numbers
from .failures import Failure, OpenFailure

WARNINGS: dict[int, str] = {s: f"status {s.name}: {s.message}" for s in (Status.OUT_OF_RANGE, Status.NOT_CONVERGED)}
_FAILURES: dict[int, str] = {
    Failure.NO_OVERLAP: "pose.y: the profiles of wheel and rail do not overlap, with irregularity and offset",
    Failure.NOT_SETTLED: "load.normal_force: no height was found at which the wheel carries this load on this rail",
    Failure.TOO_DEEP: f"pose.z: the wheel lies more than {DEEPEST:g} m inside its rail",
    Failure.ENDLESS: "the accumulated damage has no finite value for these inputs",
    Failure.TURNED: f"offset: with the wheelset's roll and yaw the wheel is turned by more than {LARGEST_ANGLE:g} rad",
}
_OF_PROFILES: dict[int, str] = {
    **_FAILURES,
    Failure.GAUGE_POINT: "track.gauge_point: the rail reaches no deeper on its gauge side",
    Failure.STEEP: "rail.inclination: the rail is steep at its top",
}
_PROFILES = (Resource(wheel_rail_pair.WHEEL, MAGIC["wheel"], ROWS), Resource(wheel_rail_pair.RAIL, MAGIC["rail"], ROWS))
_TRACK = Resource(vehicle.TRACK, track.MAGIC, track.ROWS)


def contact(points: int, elliptic: bool = False) -> Component:
    """Return the FMU for separations of `points` samples, or the one that shows only constant curvatures."""
    table = wheel_rail_contact.table(points, elliptic)
    return Component(
        kind="contact",
        table=table,
        own=numbers(table, points=points),
        lazy=("creep_stiffness",),
        derived=wheel_rail_contact.DERIVED,
        derived_by=wheel_rail_contact.DERIVED_BY,
        warnings=WARNINGS,
    )


def pair(inclination: float, accumulation: bool = False) -> Component:
    """Return the FMU. `inclination` is the default of `rail.inclination` (tangent); `accumulation` shows the bins."""
    return Component(
        kind="pair",
        derived=wheel_rail_pair.DERIVED,
        derived_by=wheel_rail_pair.DERIVED_BY,
        table=wheel_rail_pair.table(inclination, accumulation),
        resources=_PROFILES,
        accumulated=wheel_rail_pair.ACCUMULATED,
        accumulates="accumulation.wear_law",
        warnings=WARNINGS,
        failures=_OF_PROFILES,
    )


def surface_pair() -> Component:
    """Return the FMU of a pair whose wheel and rail change along the way."""
    of = wheel_rail_surfaces
    wrong = "its slices are not in order, or its numbers do not belong together"
    return Component(
        kind="surfaces",
        derived=wheel_rail_pair.DERIVED,
        derived_by=wheel_rail_pair.DERIVED_BY,
        table=of.table(),
        resources=(
            Resource(of.WHEEL, surfaces.MAGIC["wheel"], 1, of.MOST_NUMBERS),
            Resource(of.RAIL, surfaces.MAGIC["rail"], 1, of.MOST_NUMBERS),
        ),
        warnings=WARNINGS,
        failures={
            **_FAILURES,
            Failure.NO_OVERLAP: "pose.y: the wheel does not lie above its rail",
            Failure.WHEEL: f"resource {of.WHEEL}: {wrong}",
            Failure.RAIL: f"resource {of.RAIL}: {wrong}",
        },
    )


def whole_vehicle(vehicle: str, inclination: float, starts: Starts = ()) -> Component:
    """Return the FMU of a vehicle. `inclination` is the default of `rail.inclination` (tangent)."""
    from ..tables.vehicle import table

    its = table(vehicle, inclination, starts)
    return Component(
        kind="vehicle",
        table=its,
        own=_of_vehicle(vehicle, its),
        resources=(*_PROFILES, _TRACK),
        warnings=WARNINGS,
        failures={**_OF_PROFILES, Failure.ENDED: ENDED, Failure.LOST: f"{ASTRAY}: resolution.step is too long"},
        exchange=False,
    )


def vehicle_alone(vehicle: str, starts: Starts = (), name: str = "OpenVehicle") -> Component:
    """Return the FMU of a vehicle that asks for the forces at its wheels."""
    table = open_vehicle.table(vehicle, starts, name)
    return Component(
        kind="open_vehicle",
        table=table,
        own=_of_vehicle(vehicle, table),
        resources=(_TRACK,),
        failures={OpenFailure.ENDED: ENDED, OpenFailure.LOST: LOST},
        exchange=False,
    )


def _of_vehicle(name: str, table: wheel_rail_pair.Table) -> np.ndarray:
    """Return the numbers of a vehicle: sizes, value references, then its arrays and the wheels' radius."""
    declared = read(name)
    made = assemble(declared)
    arrays = (
        made.bodies,
        made.links,
        made.elements,
        made.table,
        made.wheelsets,
        made.rail,
        np.array([declared.radius]),
    )
    sizes = {
        "n_bodies": len(made.names),
        "n_links": made.links.size,
        "n_elements": made.elements.size,
        "n_axles": made.wheelsets.size,
        "n_table": made.table.shape[1],
    }
    words = [np.ascontiguousarray(part).view(np.int64).ravel() for part in arrays]
    return np.concatenate([numbers(table, **sizes), *words])
