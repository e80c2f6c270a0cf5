"""Variables of the FMU `WheelRailContact`. Inputs: separation, creepages, load. Outputs: forces, moment, damage."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from typing import Any, Unpack

from contact.inputs.options import APPROACH, CURVATURE, LEAST_STEP, LENGTH, LOAD, RADIUS, TILT
from contact.kernels.records import MAX_PATCHES
from ..rows import Attributes, output, parameter, signal
from ..variables import Enumeration, Table, Variable
from . import solver

GEOMETRY_KIND = Enumeration(
    "GeometryKind",
    (
        ("Separation", "geometry.g and geometry.A at equidistant y"),
        ("Curvatures", "geometry.A0 and geometry.B0: an elliptic contact"),
    ),
)
LOAD_KIND = Enumeration(
    "LoadKind", (("NormalForce", "load.normal_force is given"), ("Approach", "load.approach is given"))
)
#: Rows on which the solution of the normal problem depends. Forces depend on all rows.
_NORMAL_PROBLEM = (
    *(f"geometry.{name}" for name in ("kind", "y0", "dy", "g", "A", "A0", "B0")),
    *("load.kind", "load.normal_force", "load.approach", "method.normal", "method.max_iterations"),
    *("material.shear_modulus", "material.poisson_ratio", "material.pressure_limit", "resolution.n_strips"),
)
#: Least half curvature [1/m]. Masters that start every connector at 0 give 0 (and no load).
FLATTEST = CURVATURE.least
_SAMPLES = {"geometry.kind": ("Separation",)}
_CONFORMAL = {**_SAMPLES, "geometry.surface": ("Conformal",)}
_CURVATURES = {"geometry.kind": ("Curvatures",)}
_HALF_WIDTH = 0.02  # half width of the default separation [m]
#: Samples of the default separation.
POINTS = 41
#: Inputs that pose the problem, and the outputs that answer it, without the indices of samples.
PROBLEM = (
    *("geometry.g", "geometry.A", "creepage.longitudinal", "creepage.lateral", "creepage.spin"),
    *("load.normal_force",),
)
REACTION = ("force.x", "force.y", "moment.z", "approach")
#: Rows and columns of the derivatives that kernels know (`contact.kernels.jacobian`).
DERIVED = ("force.x", "force.y", "moment.z", "force.n", "approach", "power.friction")
DERIVED_BY = (
    *(f"creepage.{name}" for name in ("longitudinal", "lateral", "spin")),
    *("load.normal_force", "load.approach", "friction.coefficient"),
)


#: Rows that `EllipticContact` does not show.
_OF_SAMPLES = frozenset(f"geometry.{name}" for name in ("kind", "y0", "dy", "surface", "g", "A", "tilt", "rolling"))


@cache
def table(points: int = POINTS, elliptic: bool = False) -> Table:
    """Return the table for a separation of `points` samples across the track (at least 3).

    With `elliptic` it is that of `EllipticContact`: the same model, with constant curvatures only and few inputs.
    """
    if points < 3:
        raise ValueError(f"points = {points}: a separation has at least 3 points")
    rows = [*_parameters(points), *_inputs(points), *_outputs()]
    if elliptic:
        rows = [replace(row, start="Curvatures") if row.name == "geometry.kind" else row for row in rows]
    return Table(
        "EllipticContact" if elliptic else "WheelRailContact",
        f"Elastic wheel-rail contact: {'elliptic' if elliptic else 'non-elliptic'} patch and pressure, creep forces, spin "
        "moment and damage. "
        "Forces act on the wheel. Frame: x in the rolling direction, y lateral, z from wheel into rail. As co-simulation has "
        "no feedthrough, the outputs after a step belong to the inputs before it: one communication step late.",
        rows,
        step_size=1e-3,
        fields=list(_fields()),
        hidden=_OF_SAMPLES if elliptic else frozenset(),
    )


def _parameters(points: int) -> Iterable[Variable]:
    yield parameter("geometry.kind", "How the geometry is given", enumeration=GEOMETRY_KIND, start="Separation")
    length: dict[str, Any] = {"minimum": LENGTH.least, "maximum": LENGTH.most}
    yield parameter(
        "geometry.y0", "Lateral position of geometry.g[1]", unit="m", start=-_HALF_WIDTH, **length, used=_SAMPLES
    )
    dy: dict[str, Any] = {"start": 2.0 * _HALF_WIDTH / (points - 1), "minimum": LEAST_STEP, "maximum": LENGTH.most}
    yield parameter("geometry.dy", "Lateral distance between samples", unit="m", **dy, used=_SAMPLES)
    about = "Surface of the patch; Conformal uses geometry.tilt and geometry.rolling; not used when geometry.kind = Curvatures"
    surface: dict[str, Any] = {"enumeration": solver.SURFACE, "start": "Plane", "member": "case.conformal"}
    yield parameter("geometry.surface", about, **surface, used=_SAMPLES)
    yield parameter("load.kind", "How the load is given", enumeration=LOAD_KIND, start="NormalForce")
    yield from solver.parameters()
    radius: dict[str, Any] = {"start": RADIUS.usual, "minimum": 0.0, "open_minimum": True}
    about = "Rolling radius (damage per revolution)"
    yield parameter("wheel.radius", about, **radius, member="damage_parameters.wheel_radius")


def _inputs(points: int) -> Iterable[Variable]:
    of_samples: dict[str, Any] = {"shape": (points,), "used": _SAMPLES}
    length: dict[str, Any] = {"minimum": LENGTH.least, "maximum": LENGTH.most}
    gap = tuple(y * y for y in (_HALF_WIDTH * (2.0 * i / (points - 1) - 1.0) for i in range(points)))
    yield signal(
        "geometry.g", "Undeformed gap on the contact locus", unit="m", start=gap, nominal=1e-4, **length, **of_samples
    )
    about = f"Half curvature in the rolling direction; values below {FLATTEST:g} are replaced by {FLATTEST:g}"
    yield signal(
        "geometry.A", about, unit="1/m", start=0.5 / RADIUS.usual, minimum=0.0, maximum=CURVATURE.most, **of_samples
    )
    conformal = "used when geometry.surface = Conformal"
    about = f"Slope dz/dy of the contact surface relative to the contact plane, {conformal}"
    tilt: dict[str, Any] = {"start": 0.0, "minimum": TILT.least, "maximum": TILT.most, "nominal": 0.1}
    yield signal("geometry.tilt", about, **tilt, shape=(points,), used=_CONFORMAL)
    about = f"Rotation about y per metre rolled, cos(contact angle)/rolling radius, {conformal}"
    yield signal("geometry.rolling", about, start=1.0 / RADIUS.usual, member="case.rolling", used=_CONFORMAL)
    for letter, axis, start in (("A", "in the rolling direction", 0.5 / RADIUS.usual), ("B", "across", 1.0)):
        about = f"Half curvature {axis}, used when geometry.kind = Curvatures; less than {FLATTEST:g} counts as {FLATTEST:g}"
        limits: dict[str, Any] = {"minimum": 0.0, "maximum": CURVATURE.most, "used": _CURVATURES}
        yield signal(f"geometry.{letter}0", about, unit="1/m", start=start, **limits)
    for name, member, nominal in (("longitudinal", "vx", 1e-3), ("lateral", "vy", 1e-3), ("spin", "phi", 0.1)):
        about = f"{name.title()} creepage, wheel minus rail"
        yield signal(f"creepage.{name}", about, nominal=nominal, member=f"case.{member}")
    about = f"Normal force, used when load.kind = NormalForce; {solver.NO_LOAD}"
    by_load: dict[str, Any] = {"nominal": 1e5, "used": {"load.kind": ("NormalForce",)}}
    limits = {"minimum": solver.LEAST_LOAD, "maximum": LOAD.most}
    yield signal("load.normal_force", about, unit="N", start=80e3, **limits, **by_load)
    about = "Rigid approach from first touch, used when load.kind = Approach; negative: apart"
    limits = {"minimum": APPROACH.least, "maximum": APPROACH.most, "used": {"load.kind": ("Approach",)}}
    yield signal("load.approach", about, unit="m", start=8e-5, nominal=1e-4, **limits)
    about = "Rolling speed; without speed-dependent friction it scales only rates; at standstill these are 0"
    yield signal("speed", about, nominal=10.0, member="case.speed")
    yield signal("friction.coefficient", "Coefficient of friction", member="case.mu")


def _outputs() -> Iterable[Variable]:
    normal: dict[str, Any] = {"depends": _NORMAL_PROBLEM}
    yield output("force.x", "Longitudinal creep force on the wheel", nominal=1e4, member="result.Fx")
    yield output("force.y", "Lateral creep force on the wheel", nominal=1e4, member="result.Fy")
    yield output("force.n", "Normal force", minimum=0.0, nominal=1e5, **normal, member="result.N")
    yield output("moment.z", "Spin moment on the wheel about the origin of y", nominal=100.0, member="result.Mz")
    yield output("approach", "Rigid approach from first touch", nominal=1e-4, **normal, member="result.approach")
    for name, member, about, nominal in (
        ("pressure.max", "pmax", "Greatest contact pressure", 1e9),
        ("patch.area", "area", "Contact area", 1e-4),
        ("patch.length", "length", "Extent of the patch in the rolling direction", 1e-2),
        ("patch.width", "width", "Extent of the patch across", 1e-2),
    ):
        yield output(name, about, minimum=0.0, nominal=nominal, **normal, member=f"result.{member}")
    about = "Number of separate patches"
    yield output("patch.count", about, integer=True, minimum=0, **normal, member="result.n_patches")
    yield output("slip.ratio", "Slip area over contact area", minimum=0.0, maximum=1.0)
    yield output("power.friction", "Frictional power", unit="W", minimum=0.0, nominal=1e3)
    yield from solver.damage("damage")
    about = "dN/d(approach)"
    yield output("stiffness.normal", about, minimum=0.0, nominal=1e9, **normal, member="result.stiffness")
    yield output(
        "creep_stiffness",
        "d(force.x, force.y, moment.z)/d(longitudinal, lateral, spin creepage); computed only when it is read, which takes "
        "about one step",
        unit=("N", "N", "N.m", "N", "N", "N.m", "N.m", "N.m", "N.m2"),
        shape=(3, 3),
        nominal=1e6,
    )
    yield from solver.status_and_totals("result", "speed")
    yield solver.gap_error("result", depends=_NORMAL_PROBLEM)
    yield solver.bend("result", depends=(*_NORMAL_PROBLEM, "geometry.surface", "geometry.tilt"))
    yield solver.beyond("result")


def _fields() -> Iterable[Variable]:
    """Yield the fields: values for every element of every strip.

    The strips of all patches follow each other. The rows after the last strip are zero.
    """

    def field(name: str, description: str, **attributes: Unpack[Attributes]) -> Variable:
        attributes["shape"] = (MAX_PATCHES, "resolution.n_strips", "resolution.n_elements")
        return output(name, description, **attributes)

    normal = (*_NORMAL_PROBLEM, "resolution.n_elements")
    about = "Number of the patch; 0: this strip is not used"
    yield field("field.patch", about, integer=True, minimum=0, depends=normal)
    about = "Position in the rolling direction, from the leading edge on"
    yield field("field.x", about, unit="m", nominal=1e-3, depends=normal)
    yield field("field.y", "Lateral position", unit="m", nominal=1e-3, depends=normal)
    yield field("field.area", "Area of the element", unit="m2", minimum=0.0, nominal=1e-7, depends=normal)
    yield field("field.pressure", "Contact pressure", unit="Pa", minimum=0.0, nominal=1e9, depends=normal)
    for axis, where in (("x", "in the rolling direction"), ("y", "lateral")):
        yield field(f"field.traction_{axis}", f"Traction on the wheel, {where}", unit="Pa", nominal=1e8)
    for axis, where in (("x", "in the rolling direction"), ("y", "lateral")):
        yield field(f"field.slip_{axis}", f"Slip velocity over speed, wheel minus rail, {where}", nominal=1e-3)
    yield field("field.stick", "Whether the element sticks", boolean=True)
