"""Variables of the FMU `Wheelset`. Inputs: creep forces. Outputs: motion; geometry, creepages and load of each side.

Variables that connect to a contact have the names of `WheelRailContact` after the side: `right.geometry.g[1]` goes to
`geometry.g[1]`, and `force.x` to `right.force.x`.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Unpack

from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import POINTS, REACTION, SIDES
from ..variables import Attributes, Limits, Table, Variable, output, parameter, signal

#: Parameter of the FMU, keyword of `WheelsetParameters`, unit, description, key of _RANGE.
_PARAMETERS = (
    ("speed", "speed", "m/s", "Constant forward speed", "positive"),
    ("mass", "mass", "kg", "Mass", "positive"),
    ("yaw_inertia", "yaw_inertia", "kg.m2", "Moment of inertia about the vertical axis", "positive"),
    ("spin_inertia", "spin_inertia", "kg.m2", "Moment of inertia about the axle", "positive"),
    ("axle_load", "axle_load", "N", "Vertical force that both rails carry together", "positive"),
    ("suspension.lateral_stiffness", "lateral_stiffness", "N/m", "Primary suspension, lateral", "not negative"),
    ("suspension.yaw_stiffness", "yaw_stiffness", "N.m/rad", "Primary suspension, yaw", "not negative"),
    ("suspension.lateral_damping", "lateral_damping", "N.s/m", "Primary suspension, lateral", "not negative"),
    ("suspension.yaw_damping", "yaw_damping", "N.m.s/rad", "Primary suspension, yaw", "not negative"),
    ("initial.lateral", "lateral", "m", "Lateral position at the start, positive to the right", "any"),
    ("initial.yaw", "yaw", "rad", "Yaw angle at the start, clockwise seen from above", "any"),
    ("initial.lateral_velocity", "lateral_velocity", "m/s", "Lateral velocity at the start", "any"),
    ("initial.yaw_rate", "yaw_rate", "rad/s", "Yaw rate at the start", "any"),
    ("initial.approach", "approach", "m", "Approach of wheel and rail that is assumed at the start", "positive"),
    ("wheel.radius", "radius", "m", "Nominal rolling radius", "radius"),
    ("wheel.flange_back", "flange_back", "m", "Distance between the backs of the flanges", "gauge"),
    ("track.gauge", "gauge", "m", "Track gauge", "gauge"),
    (
        "geometry.y0",
        "window_start",
        "m",
        "Lateral position of the first sample of the separations; must equal geometry.y0 of the contacts",
        "any",
    ),
    ("geometry.dy", "window_step", "m", "Distance between samples; must equal geometry.dy of the contacts", "positive"),
)
_RANGE: dict[str, Limits] = {
    "any": {},
    "not negative": {"minimum": 0.0},
    "positive": {"minimum": 0.0, "open_minimum": True},
    "radius": {"minimum": 0.05, "maximum": 2.0},  # same range as in `contact.geometry.wheelset.Pair`
    "gauge": {"minimum": 0.1, "maximum": 3.0},
}
#: Parameter of the FMU → keyword of `WheelsetParameters`
KEYWORDS = {name: keyword for name, keyword, *_ in _PARAMETERS}


@cache
def table() -> Table:
    """Return the table of the FMU."""
    return Table(
        "Wheelset",
        "One wheelset with S1002 wheels on straight 60E1 rails, with primary suspension, at constant speed. The contact "
        "forces are inputs. Track frame: x forward, y to the right, z down.",
        [*_parameters(), *_inputs(), *_outputs()],
        step_size=1e-3,
    )


def _parameters() -> Iterable[Variable]:
    defaults = WheelsetParameters()
    for name, keyword, unit, description, sign in _PARAMETERS:
        yield parameter(name, description, unit=unit, start=getattr(defaults, keyword), **_RANGE[sign])
    yield parameter("rail.inclination", "Tangent of the rails' inclination", start=1.0 / 40.0, minimum=0.0, maximum=0.1)
    yield parameter(
        "resolution.substeps",
        "Integration steps in one communication step",
        integer=True,
        start=defaults.substeps,
        minimum=1,
        maximum=1000,
    )


def _inputs() -> Iterable[Variable]:
    for side in SIDES:
        yield signal(f"{side}.force.x", f"Longitudinal force on the {side} wheel, contact axes", unit="N", start=0.0)
        yield signal(f"{side}.force.y", f"Lateral force on the {side} wheel, contact axes", unit="N", start=0.0)
        yield signal(f"{side}.moment.z", f"Spin moment on the {side} wheel, contact axes", unit="N.m", start=0.0)
        yield signal(
            f"{side}.approach",
            f"Approach of the {side} wheel and its rail",
            unit="m",
            start=WheelsetParameters().approach,
            nominal=1e-4,
        )
    yield signal("irregularity.lateral", "Lateral position of the track's centre line", unit="m", start=0.0)
    yield signal("irregularity.slope", "Slope dy/dx of the track's centre line", start=0.0)


#: Dependencies in model exchange. In co-simulation all outputs belong to the end of the step and follow the inputs one step
#: late.
_STATES = ("lateral", "yaw", "lateral_velocity", "yaw_rate", "spin")
_GEOMETRY = ("lateral", "yaw", "irregularity.lateral", "irregularity.slope", *(f"{side}.approach" for side in SIDES))
_KINEMATICS = (*_GEOMETRY, "lateral_velocity", "yaw_rate", "spin")
_LOADS = (*_GEOMETRY, *(f"{side}.force.y" for side in SIDES))
_FORCES = tuple(f"{side}.{name}" for side in SIDES for name in REACTION)


def _outputs() -> Iterable[Variable]:
    parameters = tuple(row.name for row in _parameters())

    def result(
        name: str, description: str, unit: str, follows: tuple[str, ...], /, **attributes: Unpack[Attributes]
    ) -> Variable:
        attributes["unit"], attributes["depends"] = unit, tuple(dict.fromkeys((*parameters, *follows)))
        return output(name, description, **attributes)

    def state(name: str, description: str, unit: str, /, **attributes: Unpack[Attributes]) -> Variable:
        return result(name, description, unit, (name,), **attributes)

    yield state("lateral", "Lateral position of the centre, positive to the right", "m", nominal=1e-3)
    yield state("yaw", "Yaw angle, clockwise seen from above", "rad", nominal=1e-3)
    yield state("lateral_velocity", "Lateral velocity of the centre", "m/s", derivative_of="lateral", nominal=0.1)
    yield state("yaw_rate", "Yaw rate", "rad/s", derivative_of="yaw", nominal=0.1)
    yield state("spin", "Angular velocity about the axle, positive when rolling forward", "rad/s", nominal=100.0)
    yield result("vertical", "Height of the centre, positive down", "m", _GEOMETRY, nominal=1e-3)
    yield result("roll", "Roll angle", "rad", _GEOMETRY, nominal=1e-3)
    yield state(
        "energy.interface", "Energy that left the wheelset through the contacts since the start", "J", nominal=1e3
    )
    yield state(
        "energy.drive", "Energy delivered by the drive since the start to keep the speed constant", "J", nominal=1e3
    )
    yield state("energy.damper", "Energy dissipated in the suspension since the start", "J", nominal=1e3)
    yield result("energy.mechanical", "Kinetic and potential energy", "J", (*_GEOMETRY, *_STATES), nominal=1e5)
    for of, name, description, unit in (
        ("lateral_velocity", "lateral_acceleration", "Lateral acceleration of the centre", "m/s2"),
        ("yaw_rate", "yaw_acceleration", "Yaw acceleration", "rad/s2"),
        ("spin", "spin_acceleration", "Angular acceleration about the axle", "rad/s2"),
        ("energy.interface", "power.interface", "Power that leaves through the contacts", "W"),
        ("energy.drive", "power.drive", "Power of the drive", "W"),
        ("energy.damper", "power.damper", "Power dissipated in the suspension", "W"),
    ):
        yield result(name, description, unit, (*_FORCES, *_KINEMATICS), derivative_of=of)
    for side in SIDES:
        yield result(f"{side}.geometry.g", f"Undeformed gap, {side}", "m", _GEOMETRY, shape=(POINTS,), nominal=1e-4)
        yield result(f"{side}.geometry.A", f"Half curvature along the rail, {side}", "1/m", _GEOMETRY, shape=(POINTS,))
        yield result(f"{side}.creepage.longitudinal", f"Longitudinal creepage, {side}", "1", _KINEMATICS, nominal=1e-3)
        yield result(f"{side}.creepage.lateral", f"Lateral creepage, {side}", "1", _KINEMATICS, nominal=1e-3)
        yield result(f"{side}.creepage.spin", f"Spin creepage, {side}", "rad/m", _KINEMATICS, nominal=0.1)
        yield result(f"{side}.load.normal_force", f"Normal force, {side}", "N", _LOADS, minimum=0.0, nominal=1e5)
        for axis in "xyz":
            origin = f"Origin of the {side} contact frame relative to the centre, track coordinates, {axis}"
            yield result(f"{side}.contact.{axis}", origin, "m", _GEOMETRY)
        yield result(f"{side}.contact.angle", f"Contact angle, {side}", "rad", _GEOMETRY, nominal=0.1)
