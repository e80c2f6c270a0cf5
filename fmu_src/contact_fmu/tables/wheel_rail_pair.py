"""Variables of the FMU `WheelRailPair`. Inputs: motion of a wheelset. Outputs: forces in track coordinates, patches, damage."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Any

from contact.accumulation import MAXIMA, SUMS
from contact.inputs.options import (
    COMBINE_ANGLE,
    COMBINE_DISTANCE,
    FLANGE_BACK,
    GAUGE,
    GAUGE_POINT,
    LOAD,
    MOTION_INPUTS,
    RADIUS,
    REFERENCE_SPEED,
    SAMPLES,
)
from contact.kernels.records import GIVEN, WHEEL_OFFSET
from ..rows import output, parameter, signal, taken
from ..variables import Enumeration, Table, Variable
from . import solver

SIDE = Enumeration("Side", (("Left", "the left wheel and rail"), ("Right", "the right wheel and rail")))
LOAD_KIND = Enumeration(
    "LoadKind",
    (
        ("NormalForce", "load.normal_force is carried by the normal forces alone, the height of the wheelset follows"),
        ("Position", "pose.z is given, the normal force follows"),
        ("VerticalForce", "load.normal_force is carried by normal and friction forces together, the height follows"),
    ),
)
ACCUMULATE = Enumeration(
    "Accumulate",  # Off, then the laws in the order of contact.damage.WEAR_LAWS
    (
        ("Off", "nothing accumulates; costs no time"),
        *zip(
            ("Archard", "Usfd", "UsfdLocal", "PearceSherratt"),
            (
                "wear depth by Archard's law with the map of KTH",
                "wear depth by Sheffield's rate for each patch, spread evenly over its area",
                "wear depth by Sheffield's rate for each element",
                "wear depth by the area of Pearce and Sherratt, spread evenly over the area of each patch",
            ),
            strict=True,
        ),
    ),
)
PATCHES = 3
BINS = 100  # over each profile
BODIES = ("wheel", "rail")
#: Rows that accumulate: first of the wheel, then of the rail, in the order of `contact.kernels.damage.deposit`.
ACCUMULATED = tuple(f"accumulated.{body}.{name}" for body in BODIES for name in SUMS | MAXIMA)
#: Rows and columns of the derivatives that kernels know: members of `contact.kernels.rows.Moved`.
DERIVED = (*(f"{kind}.{axis}" for kind in ("force", "moment") for axis in "xyz"), "wheelset.z")
DERIVED_BY = (*MOTION_INPUTS, "load.normal_force", "friction.coefficient")
#: File names of the profiles in resources/ (`contact_fmu.profiles`). They show the right side and serve both sides.
WHEEL, RAIL = "wheel.profile", "rail.profile"
RESOURCES = (WHEEL, RAIL)

#: Inputs in the order of the record WHEEL_OFFSET.
OFFSET = tuple(f"offset.{name}" for name in WHEEL_OFFSET.names or ())
_WAYS = {"y": "Lateral", "z": "Vertical"}
_SPEED = 20.0
_STARTS = {"velocity.x": _SPEED, "velocity.spin": -_SPEED / RADIUS.usual}

#: Outputs of a patch: member of the record CONTACT → usual size.
PATCH = {
    **{
        "N": 1e5,
        "Fx": 1e4,
        "Fy": 1e4,
        "Mx": 10.0,
        "My": 10.0,
        "Mz": 100.0,
        "x": 1e-3,
        "y": 1.0,
        "z": 1e-2,
        "angle": 0.1,
    },
    **{"area": 1e-4, "pmax": 1e9, "longitudinal": 1e-3, "lateral": 1e-3, "spin": 0.1, "approach": 1e-4},
    **{"rail_y": 1e-2, "rail_z": 1e-2, "wheel_y": 1e-2, "wheel_z": 1e-2, "used_friction": 0.1},
}


#: Rows of the damage that accumulates.
OF_ACCUMULATION = frozenset((*ACCUMULATED, *(f"accumulation.{name}" for name in ("wear_law", "first", "width"))))


@cache
def table(inclination: float = 1.0 / 40.0, accumulation: bool = False) -> Table:
    """Return the table. `inclination` is the default of `rail.inclination` (tangent).

    Only with `accumulation` hosts see the damage that accumulates: it has 1500 outputs.
    """
    return Table(
        "WheelRailPair",
        "One wheel of a wheelset on one rail, with the profiles in resources: contact search, every patch, creep forces "
        "and damage. T_gamma, the area of Pearce and Sherratt and the worn volume are sums over the patches. Other indices are "
        "the greatest of all patches. Damage accumulates in bins over the arc length of both profiles. Forces act on the "
        "wheel. Track frame: x forward, y to the right, z down. As co-simulation has no feedthrough, the outputs after a step "
        "belong to the inputs before it: one communication step late.",
        [*parameters(inclination), *inputs(), *outputs()],
        step_size=1e-3,
        hidden=frozenset() if accumulation else OF_ACCUMULATION,
    )


def parameters(inclination: float) -> Iterable[Variable]:
    """Yield the parameters, which the FMU `Vehicle` has too. `inclination` is a default, as in `table`."""
    yield parameter("side", "Which wheel and rail; the left side is the mirror image", enumeration=SIDE, start="Right")
    yield parameter("load.kind", "How the load is given", enumeration=LOAD_KIND, start="NormalForce")
    yield parameter("wheel.radius", "Nominal radius, at the tape circle", **taken(RADIUS), member="motion.radius")
    yield parameter("wheel.flange_back", "Distance between the backs of the flanges", unit="m", **taken(FLANGE_BACK))
    yield parameter("track.gauge", "Track gauge", unit="m", **taken(GAUGE))
    about = "Depth below the top of the rail at which the gauge is measured"
    yield parameter("track.gauge_point", about, unit="m", **taken(GAUGE_POINT), nominal=1e-2)
    about = "Tangent of the angle by which the rail's profile is turned towards the track"
    yield parameter("rail.inclination", about, start=inclination, minimum=0.0, maximum=0.1)
    surface: dict[str, Any] = {"enumeration": solver.SURFACE, "start": "Plane", "member": "case.conformal"}
    yield parameter("patches.surface", "Surface of each patch", **surface)
    about = "Greatest number of patches with their own plane; further patches share the plane of the last"
    most: dict[str, Any] = {"start": PATCHES, "minimum": 1, "maximum": PATCHES, "member": "motion.most_patches"}
    yield parameter("patches.max", about, integer=True, **most)
    about = "Neighbouring patches closer than this share one plane"
    apart: dict[str, Any] = {"nominal": 1e-2, "member": "motion.combine_distance"}
    yield parameter("patches.combine_distance", about, **taken(COMBINE_DISTANCE), **apart)
    about = "Neighbouring patches whose contact angles differ by less than this share one plane"
    yield parameter("patches.combine_angle", about, **taken(COMBINE_ANGLE), member="motion.combine_angle")
    yield from solver.parameters()
    yield parameter("resolution.n_samples", "Samples of each separation", **taken(SAMPLES))
    about = (
        "Wear law of the damage that accumulates on both profiles at each doStep; nothing accumulates in model exchange"
    )
    yield parameter("accumulation.wear_law", about, enumeration=ACCUMULATE, start="Off")
    about = "Arc length at which the first bin begins; 0 is the profile's point nearest to y = 0, positive to the field side"
    yield parameter("accumulation.first", about, unit="m", start=-0.06, minimum=-1.0, maximum=1.0)
    width: dict[str, Any] = {"start": 1e-3, "minimum": 1e-5, "maximum": 1e-2, "nominal": 1e-3, "member": "ledger.width"}
    yield parameter("accumulation.width", "Width of a bin", **width)
    for axis, way in _WAYS.items():
        about = f"{way} stiffness of the springs under this rail, which has no mass; 0 is rigid"
        yield parameter(f"rail.k{axis}", about, nominal=1e7, member=f"elastic_rail.k{axis}")
    for axis, way in _WAYS.items():
        about = f"{way} external force on the rail on springs"
        yield parameter(f"rail.preload_{axis}", about, nominal=1e3, member=f"elastic_rail.preload_{axis}")
    slow = "Speed below which creepages refer to it; there a wheel resists sliding like a damper, so an axle can stop and stand"
    yield parameter("reference_speed", slow, **taken(REFERENCE_SPEED), member="motion.slowest")


def inputs() -> Iterable[Variable]:
    """Yield the inputs, which the FMU `WheelRailSurfaces` has too, as the outputs."""
    for name, member in zip(MOTION_INPUTS, GIVEN.names or (), strict=True):
        used = {"load.kind": ("Position",)} if name == "pose.z" else {}
        start: dict[str, Any] = {"start": _STARTS[name]} if name in _STARTS else {}
        nominal = 10.0 if name == "velocity.x" else None
        yield signal(name, nominal=nominal, used=used, member=f"given.{member}", **start)
    about = (
        "Vertical force on the wheel; load.kind says whether friction carries a part of it; not used with Position; "
        + solver.NO_LOAD
    )
    by_load: dict[str, Any] = {"nominal": 1e5, "used": {"load.kind": ("NormalForce", "VerticalForce")}}
    limits: dict[str, Any] = {"minimum": solver.LEAST_LOAD, "maximum": LOAD.most}
    yield signal("load.normal_force", about, unit="N", start=80e3, **limits, **by_load)
    yield signal("friction.coefficient", "Coefficient of friction", member="case.mu")
    for name in OFFSET:
        yield signal(name, member=f"wheel_{name}")


def outputs() -> Iterable[Variable]:
    """Yield the outputs. Those that accumulate come last."""
    for axis in "xyz":
        about = f"Force on the wheel, track coordinates, {axis}"
        yield output(f"force.{axis}", about, nominal=1e4, member=f"total.F{axis}")
    for axis in "xyz":
        about = f"Moment on the wheel about the wheelset's centre (0, pose.y, wheelset.z - wheel.radius), {axis}"
        yield output(f"moment.{axis}", about, nominal=1e4, member=f"total.M{axis}")
    about = "Height pose.z of the solution: as given, or as found for the load"
    yield output("wheelset.z", about, nominal=1e-3, member="total.z")
    yield output("pressure.max", "Greatest contact pressure", minimum=0.0, nominal=1e9, member="total.pmax")
    yield output(
        "patches.count", "Number of patches", integer=True, minimum=0, maximum=PATCHES, member="total.n_patches"
    )
    yield output("patches.area", "Contact area of all patches", minimum=0.0, nominal=1e-4, member="total.area")
    for member, nominal in PATCH.items():
        yield output(f"patch[].{member.lower()}", nominal=nominal, shape=(PATCHES,), member=f"contact.{member}")
    yield output("slip.ratio", "Slip area over contact area", minimum=0.0, maximum=1.0)
    yield output("power.friction", "Frictional power", unit="W", minimum=0.0, nominal=1e3)
    yield from solver.damage("total")
    yield from solver.status_and_totals("total", "velocity.x")
    yield solver.total("distance", "Distance rolled since start, forwards and backwards", "m", (None, "velocity.x"))
    yield solver.total("T_gamma", "Wear number times distance since start", "J", ("damage.T_gamma", "velocity.x"))
    yield solver.gap_error("total")
    yield output("wheel.Q", "Vertical force of the wheel on the rail, positive down", nominal=1e5, member="total.Q")
    about = "Lateral force of the wheel on the rail, positive outwards: flange contact"
    yield output("wheel.Y", about, nominal=1e4, member="total.Y")
    about = "wheel.Y over wheel.Q; 0 without vertical force"
    yield output("wheel.Y_over_Q", about, nominal=0.1, member="total.Y_over_Q")
    about = "Sum of the creep forces of all patches over that of the normal forces"
    yield output("used_friction", about, nominal=0.1, member="total.used_friction")
    for axis, way in _WAYS.items():
        about = f"{way} deflection of the rail on springs, in balance"
        yield output(f"rail.deflection_{axis}", about, nominal=1e-3, member=f"elastic_rail.d{axis}")
    yield solver.bend("total")
    yield solver.beyond("total")
    yield from _accumulated()


def _accumulated() -> Iterable[Variable]:
    """Yield the bins. They come last, since the native packaging stores them separately."""
    for name in ACCUMULATED:
        _, body, quantity = name.split(".")
        unit, meaning = (SUMS | MAXIMA)[quantity]
        if (body, quantity) == ("rail", "wear"):
            unit = "m2"
        about = f"Accumulated since start on the profile of the {body}: {meaning}"
        yield output(name, about, unit=unit.replace(" ", "."), shape=(BINS,), depends=())
