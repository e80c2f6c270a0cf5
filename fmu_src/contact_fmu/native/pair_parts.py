"""What the native WheelRailPair and WheelRailSurfaces share: from the rows of their tables to a pair's arrays, and back."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

import contact
from contact.core import arranging
from contact.damage import DamageParameters
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK
from contact.kernels import block
from contact.kernels.entries.layout import forget_forged
from contact.kernels.enumerations import FrictionLaw, Height, NoAnswer
from contact.kernels.flexible import solve_flexible
from contact.kernels.jacobian import creepage_step
from contact.kernels.pair_conditions import derive_pair
from contact.kernels.pair_jacobian import NO_SIDE
from contact.kernels.records import (
    CASE,
    CONTACT,
    DAMAGE_PARAMETERS,
    ELASTIC_RAIL,
    GIVEN,
    MAX_PATCHES,
    MOTION,
    TOTAL,
    WHEEL_OFFSET,
)
from contact.kernels.rows import Moved
from ..tables.wheel_rail_pair import LOAD_KIND, PATCHES, SIDE
from ..variables import Table
from .failures import Failure
from .wires import case_reader, choose, constant, reader, references, size_of, writer

_HEIGHTS = {"NormalForce": Height.LOAD, "Position": Height.GIVEN, "VerticalForce": Height.VERTICAL}
#: Values of `Height`, by the number of an item of LOAD_KIND, less 1.
_HEIGHT = np.array([int(_HEIGHTS[name]) for name, _ in LOAD_KIND.items])
_RIGHT = SIDE.number("Right")
_DAMAGE_PARAMETERS = np.array([DamageParameters().record(contact.STEEL, 1.0, 1.0)], DAMAGE_PARAMETERS)


def sizer(table: Table) -> Callable[..., Any]:
    """Return a compiled function that returns the sizes of the workspace for the parameters."""
    at = references(table)

    @arranging
    def size(v):
        n_strips, n_elements = int(v[at.resolution_n_strips]), int(v[at.resolution_n_elements])
        return size_of(int(v[at.method_normal]), n_strips, n_elements, int(v[at.resolution_n_samples]))

    return size


def parameter_setter(table: Table) -> Callable[..., Any]:
    """Return a compiled function that copies the parameters to the pair's arrays."""
    at, rows = references(table), constant(table)
    read_case, read_motion = reader(table, "case", CASE), reader(table, "motion", MOTION)
    read_damage = reader(table, "damage_parameters", DAMAGE_PARAMETERS)
    read_rail = reader(table, "elastic_rail", ELASTIC_RAIL)

    @arranging
    def set_parameters(v, origin_y, origin_z, arrays):
        motion = arrays.search.motion[0]
        read_motion(v, rows, arrays.search.motion)
        motion.tape = 0.5 * v[at.wheel_flange_back] + TAPE_FROM_FLANGE_BACK
        motion.mirror = 1.0 if v[at.side] == _RIGHT else -1.0
        motion.origin_y, motion.origin_z = origin_y, origin_z
        read_case(v, rows, arrays.case)
        choose(int(v[at.method_normal]), int(v[at.method_tangential]), arrays.case[0])
        arrays.search.case[0].G, arrays.search.case[0].nu = arrays.case[0].G, arrays.case[0].nu
        arrays.damage_parameters[0] = _DAMAGE_PARAMETERS[0]
        read_damage(v, rows, arrays.damage_parameters)
        read_rail(v, rows, arrays.rail)

    return set_parameters


def step_solver(table: Table) -> Callable[..., Any]:
    """Return a compiled function that solves the pair for the inputs, and returns 0 or the number of a failure."""
    at, rows = references(table), constant(table)
    read_case = case_reader(table)

    @arranging
    def solve(values, v, piece, arrays):
        """Solve for `v`, which are `values` as an array. `piece` is the size of the memory of a patch."""
        read_case(v, rows, arrays.case)
        arrays.case[0].speed = abs(v[at.velocity_x])
        given, _ = block.records(values, at.pose_y, 1, GIVEN)
        offset, _ = block.records(values, at.offset_x, 1, WHEEL_OFFSET)
        arrays.given[0], arrays.offset[0] = given[0], offset[0]
        for k in range(MAX_PATCHES):
            forget_forged(arrays.memory[1 + k * piece : 1 + (k + 1) * piece])
        mode = _HEIGHT[int(v[at.load_kind]) - 1]
        return _failure(solve_flexible(mode, max(v[at.load_normal_force], 0.0), arrays))

    return solve


@arranging
def _failure(code):
    """Return the number of the failure for a value of `NoAnswer`, 0 for none."""
    if code == NoAnswer.NO_OVERLAP:
        return Failure.NO_OVERLAP
    if code == NoAnswer.NOT_SETTLED:
        return Failure.NOT_SETTLED
    if code == NoAnswer.TOO_DEEP:
        return Failure.TOO_DEEP
    if code == NoAnswer.TURNED:
        return Failure.TURNED
    return 0


def reporter(table: Table) -> Callable[..., Any]:
    """Return a compiled function that copies the results to the outputs."""
    at, rows = references(table), constant(table)
    write, write_contact = writer(table, "total", TOTAL), writer(table, "contact", CONTACT)
    write_rail = writer(table, "elastic_rail", ELASTIC_RAIL)

    @arranging
    def report(v, arrays):
        total = arrays.total[0]
        write(v, rows, arrays.total, 0)
        write_rail(v, rows, arrays.rail, 0)
        for k in range(PATCHES):
            write_contact(v, rows, arrays.contacts[k : k + 1], k)
        v[at.slip_ratio] = total.slip_area / total.area if total.area > 0.0 else 0.0
        v[at.power_friction] = max(abs(v[at.velocity_x]), v[at.reference_speed]) * total.power

    return report


def deriver(table: Table) -> Callable[..., Any]:
    """Return a compiled function that fills `derived` from the last solution of a pair (`tables.wheel_rail_pair.DERIVED`)."""
    at = references(table)

    @arranging
    def derive(v, arrays, derivatives, derived):
        n = derive_pair(_HEIGHT[int(v[at.load_kind]) - 1], arrays, derivatives)
        for j in range(derived.shape[1]):
            known = n > 0 and derivatives.sides[j] != NO_SIDE
            if j == Moved.AMOUNT:
                known = known and v[at.load_normal_force] > 0.0
            elif j == Moved.FRICTION:  # the jacobian scales a law of friction as a whole
                known = known and arrays.case[0].law == FrictionLaw.COULOMB
            for i in range(derived.shape[0]):
                derived[i, j] = derivatives.jacobian[i, j] if known else math.nan

    return derive


def differ(table: Table) -> Callable[..., Any]:
    """Return a compiled function that returns the step of a variable for difference quotients."""
    at = references(table)

    @arranging
    def difference(v, reference):
        """Return a step so small that elements hardly ever change from stick to slip within it.

        For velocities it corresponds to a millionth of the creepage at saturation. For positions it is 0.1 µm, for angles
        1e-7 rad. For heights it is 0.01 µm, since the penetration is small. Under a load the height is found to 1e-9 of the
        load. Both sides of a difference are solved from a cold start, so that the tolerance of interacting strips, 1e-4, gives
        the same error on both sides.
        """
        speed = max(abs(v[at.velocity_x]), v[at.reference_speed])
        mu, N, G, area = (
            v[at.friction_coefficient],
            abs(v[at.force_z]),
            v[at.material_shear_modulus],
            v[at.patches_area],
        )
        creepage = creepage_step(mu, N, G, area)[0]
        if reference == at.pose_z or reference == at.irregularity_z or reference == at.offset_z:
            return 1e-8
        if at.pose_y <= reference <= at.pose_yaw or at.irregularity_y <= reference <= at.irregularity_roll:
            return 1e-7
        if at.offset_x <= reference <= at.offset_yaw:
            return 1e-7
        if (
            at.velocity_x <= reference <= at.irregularity_roll_rate
            or at.offset_x_rate <= reference <= at.offset_yaw_rate
        ):
            lever = v[at.wheel_radius] if reference == at.velocity_spin or reference == at.offset_pitch_rate else 1.0
            return creepage * speed / lever
        share = 1e-4 if reference == at.load_normal_force else 1e-6
        return max(share * abs(v[reference]), 1e-12)

    return difference
