"""Variables of the FMU `OpenVehicle`, a vehicle without contacts: it asks FMUs `WheelRailPair`, one for each wheel.

`wheel[k].` and a name of `WheelRailPair` connect to the pair of wheel k: the motion to its inputs, its forces back.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import cache

from contact.inputs.options import RADIUS
from contact_models.vehicle.coupling import QUESTION
from contact_models.vehicle.declared import VehicleDeclaration, read
from contact_models.vehicle.kernels.layout import FARTHEST
from ..rows import output, parameter, signal, taken
from ..variables import Table, Variable
from . import vehicle as of_vehicle
from .vehicle import Starts, started
from .wheel_rail_pair import inputs, parameters

#: What a pair answers.
ANSWER = tuple(f"{kind}.{axis}" for kind in ("force", "moment") for axis in "xyz")
#: Unit of an output → usual size.
_NOMINAL = {"m": 1e-3, "rad": 1e-3, "m/s": 1.0, "rad/s": 1.0, "1": 0.1}
#: Why a step is discarded.
ENDED = "the vehicle is not on the track: it ends here (contact_fmu.exchange), or initial.distance is not on it"
ASTRAY = f"a body is more than {FARTHEST:g} m or rad from its place, or has no finite motion"
LOST = f"{ASTRAY}: the step is too long, or forces do not belong to the motion"


@cache
def table(vehicle: str, starts: Starts = (), name: str = "OpenVehicle") -> Table:
    """Return the table for a vehicle as `contact_models.vehicle.declared.read` finds it, with the `starts` of a scenario.

    `name` is that of the FMU.
    """
    declared = read(vehicle)
    return Table(
        name,
        f"{declared.name[0].upper()}{declared.name[1:]} without contacts, on the track in resources. For each wheel, "
        "wheelset by wheelset, right before left, it tells the motion that WheelRailPair takes, and takes its forces. "
        "Step the pairs before the vehicle: then nothing is late.",
        started([*_parameters(declared), *_inputs(declared), *_outputs(declared)], starts),
        step_size=2e-4,
    )


def _parameters(declared: VehicleDeclaration) -> Iterable[Variable]:
    n = len(declared.wheelsets)
    yield of_vehicle.initial_distance()
    of = "of each wheelset at the start"
    yield parameter("initial.y", f"pose.y {of}", unit="m", shape=(n,), start=0.0, nominal=1e-3)
    about = f"pose.z {of}, at which its wheels carry their load (WheelRailPair with NormalForce)"
    yield parameter("initial.z", about, unit="m", shape=(n,), start=1e-4, nominal=1e-4)
    yield parameter("initial.roll", f"pose.roll {of}", unit="rad", shape=(n,), start=0.0, nominal=1e-4)
    about, usual = f"Rolling radius {of}: velocity.spin is the speed over it", RADIUS._replace(usual=declared.radius)
    yield parameter("initial.radius", about, unit="m", shape=(n,), **taken(usual))
    about = "Distance of the origin of the rail's profile from the centre line"
    yield parameter("rail.origin_y", about, unit="m", start=0.5 * declared.gauge)
    yield parameter("rail.origin_z", "Height of this origin, positive down from the rail's top", unit="m", start=0.0)
    yield replace(next(row for row in parameters(1.0 / 40.0) if row.name == "reference_speed"), tunable=False)


def _inputs(declared: VehicleDeclaration) -> Iterable[Variable]:
    yield from of_vehicle.inputs()
    for name in ANSWER:
        kind, axis = name.split(".")
        about = f"{kind.title()} of the rail on each wheel, track coordinates, {axis}"
        unit = "N" if kind == "force" else "N.m"
        yield signal(f"wheel[].{name}", about, unit=unit, shape=(2 * len(declared.wheelsets),), start=0.0, nominal=1e4)


def _outputs(declared: VehicleDeclaration) -> Iterable[Variable]:
    given = (*(row.name for row in _parameters(declared)), *(row.name for row in of_vehicle.inputs()))
    n = 2 * len(declared.wheelsets)
    asked = {row.name: row for row in inputs()}
    for row in (asked[name] for name in QUESTION):
        about, nominal = f"{row.description}, to each pair", _NOMINAL[str(row.unit)]
        yield output(f"wheel[].{row.name}", about, unit=row.unit, shape=(n,), nominal=nominal, depends=given)
    yield from of_vehicle.motion(declared, given)
