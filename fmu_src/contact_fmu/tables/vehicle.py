"""Variables of the FMU `Vehicle`: speed in, forces and damage of every wheel out. The track is a file in resources/.

Rows of wheels are arrays over the wheels: wheelset by wheelset, the right one before the left one. Rows of bodies are arrays
in the order of the vehicle's file, wheelsets last.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import cache

from contact.inputs.options import FRICTION
from contact_models.vehicle.declared import VehicleDeclaration, read
from contact_models.vehicle.kernels.between import LONGEST_PACE, PACE
from ..rows import Attributes, output, parameter, signal, taken
from ..variables import Table, Variable
from . import solver, wheel_rail_pair

#: Name of a row → its start, a tuple for an array (`contact_fmu.starts`).
Starts = tuple[tuple[str, float | str | tuple[float, ...]], ...]
#: File of the track in resources/ (`contact_fmu.track`), after those of the profiles.
TRACK = "track.rows"
#: Parameters of the pair that the vehicle itself gives.
_HIDDEN = ("side", "load.kind", "wheel.radius", "wheel.flange_back", "track.gauge_point")
_HIDDEN_PAIR = (
    *_HIDDEN,
    *(f"accumulation.{name}" for name in ("wear_law", "first", "width")),
    *(
        f"rail.{name}" for name in ("ky", "kz", "preload_y", "preload_z")
    ),  # the vehicle has rails of its own, with masses
)
FASTEST = 150.0  # [m/s]
START = -12.0  # place of the vehicle's reference at the start [m]

#: Motion of a body in the ideal track's frame, in the order of `contact_models.vehicle.kernels.layout.Axis`: unit and meaning.
COORDINATES = (
    ("x", "m", "Displacement along the track"),
    ("y", "m", "Lateral displacement, positive to the right"),
    ("z", "m", "Vertical displacement, positive down"),
    ("roll", "rad", "Roll"),
    ("pitch", "rad", "Pitch, 0 for a wheelset"),
    ("yaw", "rad", "Yaw, clockwise seen from above"),
)
#: Rows of the wheels ← outputs of the pair.
WHEEL = {
    f"wheel[].{name.removeprefix('wheel.')}": name
    for name in (
        *("wheel.Q", "wheel.Y", "wheel.Y_over_Q", "pressure.max", "patches.count", "status"),
        *(row.name for row in solver.damage("total")),
    )
}
#: Totals of a wheel: unit, meaning, and the output of the pair that is its rate per metre, which a solution has for the steps
#: around it; empty for a sum over all steps.
TOTALS = {
    "energy": ("J", "Frictional energy since start", ""),
    "worn_volume": ("m3", "Volume worn off since start, Archard's law", "damage.archard_volume"),
    "T_gamma": ("J", "Wear number times distance since start", ""),
    "burstow": ("m", "Burstow's index times distance since start", "damage.index_burstow"),
}


@cache
def table(vehicle: str, inclination: float = 1.0 / 40.0, starts: Starts = ()) -> Table:
    """Return the table for a vehicle as `contact_models.vehicle.declared.read` finds it, with the `starts` of a scenario.

    `inclination` is as in `wheel_rail_pair`.
    """
    declared = read(vehicle)
    return Table(
        "Vehicle",
        f"{declared.name} on elastic contacts, on the track and with the profiles in resources. The speed is an input. Outputs "
        "are forces, motion and damage of every wheel: wheelset by wheelset, right before left. Bodies: "
        f"{', '.join(names(declared))}. Track frame: x forward, y to the right, z down.",
        started([*_parameters(declared, inclination), *inputs(), *_outputs(declared, inclination)], starts),
        step_size=1e-3,
        hidden=frozenset(_HIDDEN_PAIR),
    )


def started(rows: Iterable[Variable], starts: Starts) -> list[Variable]:
    """Return the rows with other starts.

    Raises
    ------
    ContactError
        If a start is outside the range of its row.
    """
    given = dict(starts)
    made = [replace(row, start=given.pop(row.name, row.start)) for row in rows]
    if given:
        raise ValueError(f"there is no row {', '.join(given)}")
    for row in made:
        if row.name in dict(starts):
            for scalar in row.scalars():
                scalar.check(scalar.first)
    return made


def names(declared: VehicleDeclaration) -> list[str]:
    """Return the names of all bodies, in the order of the kernels."""
    return [*(body.name for body in declared.bodies), *(axle.name for axle in declared.wheelsets)]


def sizes(declared: VehicleDeclaration) -> dict[str, float]:
    """Return parameter of the pair → the length that the vehicle gives it [m]."""
    return {
        "wheel.radius": declared.radius,
        "wheel.flange_back": declared.flange_back,
        "track.gauge": declared.gauge,
        "track.gauge_point": declared.gauge_point,
    }


def _parameters(declared: VehicleDeclaration, inclination: float) -> Iterable[Variable]:
    """Yield the parameters. Those of the pair come first and have its value references, as the pair's entries read them."""
    starts: dict[str, float | str] = {"load.kind": "Position", **sizes(declared)}
    for row in wheel_rail_pair.parameters(inclination):
        yield replace(row, start=starts.get(row.name, row.start), tunable=False)  # tested only of one contact
    yield initial_distance()
    about = "Longest step of the integration; a communication step is divided evenly"
    yield parameter("resolution.step", about, unit="s", start=2e-4, minimum=1e-6, maximum=1e-3, nominal=1e-4)
    about = (
        "Most steps of the integration from one solution of a contact to the next; 1: every step solves all contacts"
    )
    yield parameter("resolution.pace", about, integer=True, start=PACE, minimum=1, maximum=LONGEST_PACE)


def initial_distance() -> Variable:
    """Return the row of the place at the start."""
    about = "Place of the vehicle's reference at the start, on the track's stations"
    return parameter("initial.distance", about, unit="m", start=START)


def inputs() -> Iterable[Variable]:
    """Yield speed and friction."""
    about = "Speed along the track, negative when rolling backwards; to stop set reference_speed to 10 m/s with steps of 0.2 ms"
    yield signal("speed", about, unit="m/s", start=15.0, minimum=-FASTEST, maximum=FASTEST)
    yield signal(
        "friction.coefficient", "Coefficient of friction, which the track's factors multiply", **taken(FRICTION)
    )


def motion(declared: VehicleDeclaration, depends: tuple[str, ...]) -> Iterable[Variable]:
    """Yield the rows of the motion of all bodies."""
    n = len(names(declared))
    about = "Place of the vehicle's reference on the track's stations"
    yield output("distance", about, unit="m", nominal=1e2, depends=depends)
    for name, unit, meaning in COORDINATES:
        about = f"{meaning}, of each body in the frame of the ideal track"
        yield output(f"body[].{name}", about, unit=unit, shape=(n,), nominal=1e-3, depends=depends)


def _outputs(declared: VehicleDeclaration, inclination: float) -> Iterable[Variable]:
    n = 2 * len(declared.wheelsets)
    given = tuple(row.name for row in (*_parameters(declared, inclination), *inputs()))
    pair = wheel_rail_pair.table()
    yield from motion(declared, given)
    for name, of_pair in WHEEL.items():
        row = pair.row[of_pair]
        attributes: Attributes = {"unit": row.unit, "nominal": row.nominal, "shape": (n,), "depends": given}
        about = row.description
        if row.enumeration is not None:
            about += ": " + ", ".join(f"{i} {item}" for i, (item, _) in enumerate(row.enumeration.items, 1))
        yield output(name, about, **attributes)
    for axis in "xyz":
        about = f"Force of the rail on the wheel, track coordinates, {axis}"
        yield output(f"wheel[].force.{axis}", about, unit="N", shape=(n,), nominal=1e4, depends=given)
    yield output("energy.dissipated", "Dissipation in all contacts since start", unit="J", depends=given, nominal=1e3)
    yield output("energy.residual", "Energy that the integration has lost since start", unit="J", depends=given)
    yield output("impacts", "Rises of a normal force above twice the static one, since start", depends=given)
    yield output("lifted", "Times that a wheel has lifted since start", depends=given)
    for name, (unit, about, _) in TOTALS.items():
        yield output(f"wheel[].total.{name}", about, unit=unit, shape=(n,), depends=given)
