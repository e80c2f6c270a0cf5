"""What the page needs besides its code: the variables of `WheelRailPair` from their table, profiles, texts and numbers."""

from __future__ import annotations

import base64
from collections.abc import Iterable
from typing import Any

import numpy as np

import contact
from contact.geometry import files, inspection, profile, repair, scans
from contact.geometry.profile import Profile
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK
from contact.kernels.records import MAX_PATCHES
from contact_fmu.native import components
from contact_fmu.tables import wheel_rail_pair
from contact_fmu.units import DISPLAY_UNITS
from contact_fmu.variables import Causality, Table, Variable
from explorer.patch import FIELDS, STRIPS

WHEELS = ("S1002", "1/40", "EPS", "EN 15302 B", "EN 15302 H")
RAILS = ("60E1", "60E2", "56E1", "54E1", "50E1", "49E1")  # not inclined: `rail.inclination` turns them
#: Strips and elements up to which the page has room.
MOST = 40

#: Unit → the unit shown and how many of these are one. Small angles read better in milliradians.
UNITS = DISPLAY_UNITS | {
    "m2": ("mm²", 1e6),
    "N.m": ("N m", 1.0),
    "rad": ("mrad", 1e3),
    "W": ("kW", 1e-3),
    "rad/m": ("1/m", 1.0),
    "1": ("", 1.0),
}
#: Sliders: name, title, least, greatest and step in the unit shown. `creepage` is that of the wheelset [%]; the spin follows.
SLIDERS = (
    ("pose.y", "lateral shift", -8.0, 8.0, 0.02),
    ("pose.yaw", "yaw", -20.0, 20.0, 0.1),
    ("pose.roll", "roll", -10.0, 10.0, 0.1),
    ("load.normal_force", "wheel load", 5.0, 200.0, 1.0),
    ("creepage", "longitudinal creepage", -2.0, 2.0, 0.01),
    ("velocity.x", "speed", 1.0, 100.0, 1.0),
    ("friction.coefficient", "friction", 0.05, 0.7, 0.01),
    ("rail.inclination", "rail inclination", 0.0, 0.1, 0.0025),
    ("friction.kinetic", "friction ratio at speed", 0.1, 1.0, 0.01),
    ("friction.half_speed", "speed of half the fall", 0.1, 5.0, 0.1),
    ("resolution.n_strips", "strips per patch", 8.0, float(MOST), 1.0),
    ("resolution.n_elements", "elements per strip", 8.0, float(MOST), 1.0),
)
CHOICES = (
    ("method.normal", "normal problem"),
    ("method.tangential", "tangential problem"),
    ("patches.surface", "surface"),
    ("friction.law", "friction law"),
    ("friction.velocity", "sliding speed"),
)
#: Numbers shown for each method, and curves that can be chosen: name, title, explanation, and where its equations stand.
RESULTS = (
    (
        "force.x",
        "longitudinal force",
        "Along the track on the wheel, positive forward: the traction qx summed over the patches. It is not 0 at creepage 0 "
        "where the wheel rolls on another radius than its nominal one.",
        "understand/theory.html",
    ),
    (
        "force.y",
        "lateral force",
        "Across the track on the wheel, positive to the right: Fy cos δ + N sin δ of every patch with its contact angle δ.",
        "use/signs.html",
    ),
    (
        "force.z",
        "vertical force",
        "On the wheel, positive down, so the rail's force is negative: Fy sin δ − N cos δ of every patch. The normal forces "
        "alone carry the given load; friction adds to it or relieves it.",
        "use/signs.html",
    ),
    (
        "wheel.Y_over_Q",
        "Y/Q",
        "Lateral force outwards over vertical force. Nadal: a wheel climbs from (tan δ − μ)/(1 + μ tan δ) on.",
        "use/signs.html",
    ),
    (
        "used_friction",
        "used friction",
        "Creep force over normal force, √(Fx² + Fy²)/N, summed over the patches. It is at most the coefficient of friction.",
        "understand/theory.html",
    ),
    (
        "pressure.max",
        "greatest pressure",
        "Of all patches. A strip of half length a carries p = p₀ √(1 − x²/a²); an ellipse has p₀ = 3N/(2π a b).",
        "understand/theory.html",
    ),
    ("patches.area", "contact area", "Sum over the patches: 2 a dy of every strip.", "understand/theory.html"),
    (
        "slip.ratio",
        "share that slips",
        "Slip area over contact area: where the traction reaches the bound μp, the surfaces slide on one another; elsewhere "
        "they stick. 0 % does not mean no force.",
        "understand/theory.html",
    ),
    (
        "damage.T_gamma",
        "wear number Tγ",
        "|Fx υx| + |Fy υy| of every patch, the energy lost by sliding for each metre rolled [N = J/m], without spin.",
        "understand/damage.html",
    ),
    (
        "damage.energy_index_max",
        "greatest energy index",
        "Largest local energy q·s of the traction q and the slip s, over the patches.",
        "understand/damage.html",
    ),
    (
        "gap_error",
        "gap error",
        "The largest gap or overlap that the pressure leaves inside a patch, over the approach. 0 is exact; above the limit "
        "of the method the largest pressure is doubtful.",
        "check/limits.html",
    ),
)
#: The same for the creepages.
CREEPAGES = (
    "Wheel minus rail over the speed, in the plane of the patch: υx = (V + ω r)/V with the rolling radius r of this patch, "
    "υy from yaw, spin φ = ω sin δ/V. Positive longitudinal creepage brakes.",
    "use/signs.html",
)


#: Names in `contact.geometry.inspection` and `scans` of the numbers by which the page judges a profile file.
RULES = (
    *(
        "NARROWEST",
        "WIDEST",
        "USUAL_WIDTH",
        "FLANGE",
        "FLANGE_BACK",
        "TIP_FROM_TAPE",
        "TIP_SHARE",
        "TIP_RISE",
        "HEAD_DROP",
        "JUMP",
        "LOOPS",
    ),
    *(
        "MOST_SCANS",
        "RETURN",
        "ROUGH",
        "TANGENT_OF_NOISE",
        "HEIGHT",
        "SIDE",
        "CROWN_FROM_GAUGE",
        "GAUGE_DEPTH",
        "TALLER",
    ),
)
#: Width of the parabolas by which the page smooths noisy points [m], with weights (1 - t²)², and the largest number of points.
WINDOW, MOST_POINTS = 5e-3, 3000


def _doubles(numbers: np.ndarray) -> str:
    return base64.b64encode(np.ascontiguousarray(numbers, "<f8").tobytes()).decode()


def _points(given: Profile) -> str:
    """Return the profile as a resource of the kernels: the number of points, then y, z and the angle."""
    return _doubles(np.concatenate(([given.y.size], given.y, given.z, given.angle)))


def _variable(table: Table, row: Variable) -> dict[str, Any]:
    own = str(row.unit)
    unit, factor = UNITS.get(own, (own, 1.0))
    if row.name == "damage.T_gamma":
        unit, factor = own, 1.0  # hundreds of N
    return {
        "at": table.span[row.name].start,
        "description": row.description,
        "unit": unit,
        "factor": factor,
        "parameter": row.causality is Causality.PARAMETER,
        "items": [list(item) for item in row.enumeration.items] if row.enumeration else [],
    }


def _starts(table: Table, rows: Iterable[Variable], n_values: int) -> np.ndarray:
    values = np.zeros(n_values)
    for row in rows:
        start = row.start
        if isinstance(start, str):
            assert row.enumeration is not None
            start = row.enumeration.number(start)
        span = table.span[row.name]
        values[span.start : span.stop] = 0.0 if start is None else start
    return values


def rules() -> dict[str, Any]:
    """Return the numbers by which the page reads and judges a profile file: those of the library."""
    return {
        **{name.lower(): float((vars(scans) | vars(inspection))[name]) for name in RULES},
        "units": inspection.UNITS,
        "usual_slope": {kind: float(slope) for kind, slope in inspection.USUAL_SLOPE.items()},
        "turned_by": {kind: float(angle) for kind, angle in inspection.TURNED_BY.items()},
        "slope_between": {"wheel": inspection.TREAD, "rail": inspection.TOP},
        "nearest": repair.NEAREST,
        "largest_file": files.LARGEST_FILE,
        "window": WINDOW,
        "most": MOST_POINTS,
    }


def bundle(wasm: bytes) -> dict[str, Any]:
    """Return what the page reads as JSON. Arrays are little-endian float64 in base64, and so is the module."""
    interface = wheel_rail_pair.table()
    n_values = interface.span[wheel_rail_pair.ACCUMULATED[0]].start
    rows = [row for row in interface.rows if interface.span[row.name].start < n_values]
    component = components.pair(1.0 / 40.0)
    return {
        "version": contact.__version__,
        "wasm": base64.b64encode(wasm).decode(),
        "variables": {row.name: _variable(interface, row) for row in rows},
        "start": _doubles(_starts(interface, rows, n_values)),
        "room": (len(STRIPS) + (len(FIELDS) + 1) * MOST) * MOST * MAX_PATCHES,
        "stripRows": [row.name for row in STRIPS],
        "fieldRows": [*(row.name for row in FIELDS), "ENERGY"],
        "sliders": [list(row) for row in SLIDERS],
        "choices": [list(row) for row in CHOICES],
        "results": [list(row) for row in RESULTS],
        "creepages": list(CREEPAGES),
        "failures": {int(number): text for number, text in component.failures.items()},
        "untrusted": [int(contact.Status.OUT_OF_RANGE), int(contact.Status.NOT_CONVERGED)],
        "gapLimits": {name: method.gap_limit for name, method in contact.methods().normal.items()},
        "tape": TAPE_FROM_FLANGE_BACK,
        "rules": rules(),
        "wheels": {name: _points(profile.load(name, "wheel")) for name in WHEELS},
        "rails": {name: _points(profile.load(name, "rail", inclination=0.0)) for name in RAILS},
    }
