"""Interface of the FMU `Wheelset`: creep forces in; motion, geometry, creepages and load of each side out.

What a wheel-rail contact needs and gives has the names of `WheelRailContact` behind the side, so connections are obvious:
`right.geometry.g[1]` to `geometry.g[1]`, `force.x` to `right.force.x`.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

from fmu_src.variables import Table, Variable, output, parameter, signal
from models.wheelset.parameters import WheelsetParameters
from models.wheelset.ports import POINTS, SIDES

#: Parameter of the FMU → keyword of `WheelsetParameters`, unit, what it is, and whether it may be negative or zero.
_PARAMETERS = (
    ("speed", "speed", "m/s", "Constant forward speed", "positive"),
    ("mass", "mass", "kg", "Mass", "positive"),
    ("yaw_inertia", "yaw_inertia", "kg.m2", "Moment of inertia about the vertical", "positive"),
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
    ("initial.approach", "approach", "m", "Approach of wheel and rail assumed at the start", "positive"),
    ("wheel.radius", "radius", "m", "Nominal rolling radius", "positive"),
    ("wheel.flange_back", "flange_back", "m", "Distance of the backs of the flanges", "positive"),
    ("track.gauge", "gauge", "m", "Track gauge", "positive"),
    (
        "geometry.y0",
        "window_start",
        "m",
        "First sample of the separations; the same as geometry.y0 of the contacts",
        "any",
    ),
    ("geometry.dy", "window_step", "m", "Distance of samples; the same as geometry.dy of the contacts", "positive"),
)
_RANGE = {
    "any": {},
    "not negative": {"minimum": 0.0},
    "positive": {"minimum": 0.0, "open_minimum": True},
}
#: Parameter of the FMU → keyword of `WheelsetParameters`
KEYWORDS = {name: keyword for name, keyword, *_ in _PARAMETERS}


@cache
def table() -> Table:
    """Table of the FMU."""
    return Table(
        "Wheelset",
        "One wheelset with S1002 wheels on straight 60E1 rails, with primary suspension, at constant speed; the contact "
        "forces come from outside. Track frame: x forward, y to the right, z down.",
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
        "Steps of integration in a communication step",
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


def _outputs() -> Iterable[Variable]:
    """All are of the end of the step: they depend on no input, and at the start on parameters alone."""
    knowns = tuple(row.name for row in _parameters())

    def state(name: str, description: str, unit: str, **attributes: object) -> Variable:
        return output(name, description, unit=unit, depends=knowns, **attributes)

    yield state("lateral", "Lateral position of the centre, positive to the right", "m", nominal=1e-3)
    yield state("yaw", "Yaw angle, clockwise seen from above", "rad", nominal=1e-3)
    yield state("lateral_velocity", "Lateral velocity of the centre", "m/s", nominal=0.1)
    yield state("yaw_rate", "Yaw rate", "rad/s", nominal=0.1)
    yield state("spin", "Angular velocity about the axle, positive when rolling forward", "rad/s", nominal=100.0)
    yield state("vertical", "Height of the centre, positive down", "m", nominal=1e-3)
    yield state("roll", "Roll angle", "rad", nominal=1e-3)
    yield state("energy.interface", "Energy that left through the contacts since the start", "J", nominal=1e3)
    yield state("energy.drive", "Energy that the drive delivered to keep the speed since the start", "J", nominal=1e3)
    yield state("energy.damper", "Energy dissipated in the suspension since the start", "J", nominal=1e3)
    yield state("energy.mechanical", "Kinetic and potential energy", "J", nominal=1e5)
    for side in SIDES:
        yield state(f"{side}.geometry.g", f"Undeformed gap, {side}", "m", shape=(POINTS,), nominal=1e-4)
        yield state(f"{side}.geometry.A", f"Half curvature along the rail, {side}", "1/m", shape=(POINTS,))
        yield state(f"{side}.creepage.longitudinal", f"Longitudinal creepage, {side}", "1", nominal=1e-3)
        yield state(f"{side}.creepage.lateral", f"Lateral creepage, {side}", "1", nominal=1e-3)
        yield state(f"{side}.creepage.spin", f"Spin creepage, {side}", "rad/m", nominal=0.1)
        yield state(f"{side}.load.normal_force", f"Normal force, {side}", "N", minimum=0.0, nominal=1e5)
        for axis in "xyz":
            yield state(
                f"{side}.contact.{axis}",
                f"Origin of the {side} contact frame from the centre, {axis} of the track",
                "m",
            )
        yield state(f"{side}.contact.angle", f"Contact angle, {side}", "rad", nominal=0.1)
