"""Numbers of a contact and of a pair that a user gives: default and range of each.

Python's checks, the command line, the checks and defaults in C (`contact.compile.c_header`) and the tables of FMUs read them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from contact.errors import require_integer, require_number
from contact.kernels.enumerations import FrictionLaw, Height, LoadKind, SlipVelocity, WearLaw
from contact.kernels.normal.strip_halfspace import MAX_ITERATIONS
from contact.kernels.records import (
    GIVEN,
    LARGEST_ANGLE,
    LARGEST_CREEPAGE,
    LARGEST_RAIL_ROLL,
    MAX_PATCHES,
    SLOWEST,
    WHEEL_OFFSET,
)


class Whole(NamedTuple):
    """Default and range of an integer."""

    usual: int
    least: int
    most: int

    def require(self, name: str, value: object) -> int:
        """Return `value` as an integer in the range, or raise a ContactError that names it."""
        return require_integer(name, value, self.least, self.most)


class Real(NamedTuple):
    """Default and range of a number. With `above` it is greater than `least`, with `endless` it may be infinite in C."""

    usual: float
    least: float = -math.inf
    most: float = math.inf
    above: bool = False
    endless: bool = False

    @property
    def bounds(self) -> tuple[float, float]:
        """The least and the greatest value."""
        return self.least, self.most

    def require(self, name: str, value: object) -> float:
        """Return `value` as a number in the range, or raise a ContactError that names it."""
        return require_number(name, value, self.least, self.most, open_minimum=self.above)


#: Strips per patch and elements per strip. With 20 the normal force on the patches of set D is .06 %, the largest pressure
#: .3 % off CONTACT's.
N_STRIPS, N_ELEMENTS = Whole(20, 4, 1000), Whole(20, 4, 1000)
#: Most iterations of interacting strips.
ITERATIONS = Whole(MAX_ITERATIONS, 1, 1000)
#: Radius of the tape circle, track gauge, distance of the backs of the flanges, depth of the gauge below the rail's top [m].
RADIUS, GAUGE, FLANGE_BACK = Real(0.46, 0.05, 2.0), Real(1.435, 0.1, 3.0), Real(1.36, 0.1, 3.0)
GAUGE_POINT = Real(0.014, 0.0, above=True)
#: Patches that are closer than this [m], and whose angles differ by less [rad], share one plane. Most planes.
COMBINE_DISTANCE, COMBINE_ANGLE = Real(8e-3, 0.0), Real(math.radians(10.0), 0.0)
MOST_PATCHES = Whole(MAX_PATCHES, 1, MAX_PATCHES)
#: Speed below which the creepages of a pair refer to it [m/s].
REFERENCE_SPEED = Real(SLOWEST, 1e-6, 10.0)
#: Samples of each separation of a pair; 41 miss the peaks of crossing noses.
SAMPLES = Whole(81, 5, 2001)
#: Most samples of a separation that a solver of the C interface is given.
SEPARATION_SAMPLES = Whole(101, 3, 100_000)
#: Distance before and behind the axle in which surfaces are searched [m].
REACH = Real(0.06, 0.01, 0.3)
#: Position of the axle along the slices of a rail [m].
STATION = Real(0.0, -1e7, 1e7)
#: Load [N] and approach [m]: sums and squares of much larger ones overflow.
LOAD, APPROACH = Real(0.0, 0.0, 1e15), Real(0.0, -1e15, 1e15)
#: Half curvature [1/m] and shear modulus [Pa]: bodies that are flatter touch within the round-off of their gap, and products of
#: much larger or smaller ones overflow.
CURVATURE, SHEAR_MODULUS = Real(1.0, 1e-6, 1e9), Real(82e9, 1e-3, 1e15)
#: Positions and gaps of a separation [m], its slope, and the least distance of two positions [m].
LENGTH, TILT, LEAST_STEP = Real(0.0, -1e5, 1e5), Real(0.0, -1e3, 1e3), 1e-12
#: Coefficient of friction: above the largest, squares could overflow. Temperatures [K], the last one above all melting points.
FRICTION, ROOM_TEMPERATURE, HOTTEST = Real(0.3, 0.0, 1e6), 293.15, 1e5
#: Temperature of the bodies, at which friction begins to fall, and rise over which it falls [K].
TEMPERATURE, TEMPERATURE_RANGE = Real(ROOM_TEMPERATURE, 0.0, HOTTEST), Real(400.0, 0.0, HOTTEST, above=True)
#: Hardness and yield stress in shear of the softer body [Pa].
HARDNESS, SHEAR_YIELD = Real(2.7e9, 0.0, above=True), Real(300e6, 0.0, above=True)
#: Share of the friction that remains when hot.
HOT_FACTOR = Real(1.0, 0.0, 1.0)
#: Creepage [-] and spin [1/m].
CREEPAGE = Real(0.0, -LARGEST_CREEPAGE, LARGEST_CREEPAGE)
#: Rotation of the wheel about the plane's y axis per metre rolled [1/m]; the largest is that of a radius of 1 mm.
ROLLING = Real(0.0, -1e3, 1e3)
_POSITIVE, _SHARE = Real(1.0, 0.0, above=True), Real(1.0, 0.0, 1.0)
_PART, _SWITCH, _ANGLE = Real(1.0, 0.0, 1.0, above=True), Whole(0, 0, 1), Real(0.0, -LARGEST_ANGLE, LARGEST_ANGLE)
#: Names of the members of the record GIVEN, in their order: of motions, and as inputs of FMUs have them.
MOTION = (
    *(f"pose.{name}" for name in ("y", "z", "roll", "yaw")),
    *(f"velocity.{name}" for name in ("forward", "y", "z", "roll", "yaw", "spin")),
    *(f"irregularity.{name}" for name in ("y", "z", "roll", "y_rate", "z_rate", "roll_rate")),
)
MOTION_INPUTS = tuple(name.replace("forward", "x") for name in MOTION)
_ANGLES = {
    "roll": _ANGLE,
    "pitch": _ANGLE,
    "yaw": _ANGLE,
    "rail_roll": Real(0.0, -LARGEST_RAIL_ROLL, LARGEST_RAIL_ROLL),
}

#: Material and friction of a case: members of the record CASE. Defaults are those of steel.
SURFACE: dict[str, Whole | Real] = {
    "speed": Real(20.0, 0.0),
    "G": SHEAR_MODULUS,
    "nu": Real(0.28, 0.0, 0.5),
    "pressure_limit": Real(math.inf, 0.0, endless=True),
    "max_iterations": ITERATIONS,
    "tolerance": Real(0.0, 0.0, 1e-2),
    "mu": FRICTION,
    "law": Whole(0, 0, len(FrictionLaw) - 1),
    "kinetic": FRICTION,
    "half_speed": _POSITIVE,
    "velocity": Whole(0, 0, len(SlipVelocity) - 1),
    "slope": _PART,
    "slope_far": _SHARE,
    "slope_rate": Real(1.0, 0.0),
    "gauge_factor": Real(1.0, 0.0, 100.0),
    "border": Real(0.0),
    "border_width": Real(5e-3),
    "k_A": _PART,
    "k_S": _PART,
    "drop": Real(0.0, 0.0, 1.0),
    "warm": Real(0.0, -HOTTEST, HOTTEST),
    "warm_range": Real(TEMPERATURE_RANGE.usual, 0.0, above=True),
    "heating": Real(0.0, 0.0),
    "conformal": _SWITCH,
}
#: Records, and structs of the C interface, → members → default and range, in the order in which C checks them.
MEMBERS: dict[str, Mapping[str, Whole | Real]] = {
    "case": {
        **SURFACE,
        "load_kind": Whole(int(LoadKind.LOAD), int(LoadKind.LOAD), int(LoadKind.APPROACH)),
        "amount": APPROACH,
        "vx": CREEPAGE,
        "vy": CREEPAGE,
        "phi": CREEPAGE,
        "rolling": ROLLING,
    },
    "contact_options": {
        "n_strips": N_STRIPS,
        "n_elements": N_ELEMENTS,
        "max_iterations": ITERATIONS,
        "conformal": _SWITCH,
        "shear_modulus": SURFACE["G"],
        "poisson_ratio": SURFACE["nu"],
        "pressure_limit": SURFACE["pressure_limit"],
    },
    "pair_options": {
        "most_patches": MOST_PATCHES,
        "wheel_radius": RADIUS,
        "gauge": GAUGE,
        "flange_back": FLANGE_BACK,
        "gauge_point": GAUGE_POINT,
        "combine_distance": COMBINE_DISTANCE,
        "combine_angle": COMBINE_ANGLE,
        "n_bins": Whole(0, 0, 100000),
        "bin_start": Real(0.0, -1e6, 1e6),
        "bin_width": Real(1e-3, 1e-9, 1e6),
        "reach": REACH,
        "tilted": _SWITCH,
        "reference_speed": REFERENCE_SPEED,
    },
    "pair_input": {
        "height": Whole(int(Height.LOAD), min(map(int, Height)), max(map(int, Height))),
        "amount": LOAD,
        "distance": Real(0.0, 0.0),
        "station": STATION,
        "rotation": Real(0.0, -1e8, 1e8),
    },
    "given": {name: _ANGLES.get(name, Real(0.0)) for name in GIVEN.names or ()},
    "wheel_offset": {name: _ANGLES.get(name, Real(0.0)) for name in WHEEL_OFFSET.names or ()},
    "elastic_rail": {
        "ky": Real(0.0, 0.0),
        "kz": Real(0.0, 0.0),
        "preload_y": Real(0.0),
        "preload_z": Real(0.0),
    },
    "damage_parameters": {
        "speed": Real(1.0, 0.0),
        "wheel_radius": _POSITIVE,
        "hardness": HARDNESS,
        "shear_yield": SHEAR_YIELD,
        "rail_wear": Real(1.0, 0.0, 1e3),
        "with_spin": _SWITCH,
        "wear_law": Whole(0, 0, len(WearLaw) - 1),
    },
}
