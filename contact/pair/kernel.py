"""The whole way from the motion of a wheelset to the forces of one wheel on one rail: the kernel behind API and FMUs."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact._jit import kernel
from contact._layout import (
    APPROACH,
    CASE_BORDER,
    CASE_BORDER_WIDTH,
    CASE_CONFORMAL,
    CASE_LOAD,
    CASE_LOAD_KIND,
    CASE_PHI,
    CASE_TANGENTIAL,
    CASE_VX,
    CASE_VY,
    LOAD,
    MAX_PATCHES,
    RES_APPROACH,
    RES_AREA,
    RES_FX,
    RES_FY,
    RES_MZ,
    RES_N,
    RES_PMAX,
    RES_POWER,
    RES_SLIP_AREA,
    RES_STATUS,
    STRIP_A,
    STRIP_DY,
    STRIP_P0,
    STRIP_XC,
    STRIP_Y,
)
from contact.creepage import LARGEST_CREEPAGE
from contact.damage._kernel import (
    DAMAGE_ARCHARD_VOLUME,
    DAMAGE_DISSIPATION,
    DAMAGE_PEARCE_SHERRATT,
    DAMAGE_T_GAMMA,
    DAMAGE_T_GAMMA_SPIN,
    N_DAMAGE,
    PAR_SPEED,
    PAR_WHEEL_RADIUS,
    damage_kernel,
)
from contact.geometry import layout
from contact.geometry.prepare import move
from contact.geometry.settle import LOAD as UNDER_LOAD
from contact.geometry.settle import settle
from contact.geometry.workspace import Search
from contact.pair.layout import (
    CONTACT_ANGLE,
    CONTACT_APPROACH,
    CONTACT_AREA,
    CONTACT_FX,
    CONTACT_FY,
    CONTACT_LATERAL,
    CONTACT_LONGITUDINAL,
    CONTACT_MX,
    CONTACT_MY,
    CONTACT_MZ,
    CONTACT_N,
    CONTACT_PMAX,
    CONTACT_SPIN,
    CONTACT_STATUS,
    CONTACT_X,
    CONTACT_Y,
    CONTACT_Z,
    TOTAL_AREA,
    TOTAL_COUNT,
    TOTAL_DAMAGE,
    TOTAL_FX,
    TOTAL_FY,
    TOTAL_FZ,
    TOTAL_MX,
    TOTAL_MY,
    TOTAL_MZ,
    TOTAL_PMAX,
    TOTAL_POWER,
    TOTAL_SLIP_AREA,
    TOTAL_STATUS,
    TOTAL_Z,
)
from contact.pair.ledger import Ledger, enter
from contact.pipeline import solve_case, solve_conformal
from contact.registry import CARTER
from contact.workspace import Space, Workspace

Array = NDArray[np.float64]

N_TOTAL = TOTAL_DAMAGE + N_DAMAGE
#: Damage that adds up over the patches; of the rest the greatest counts.
_ADDITIVE = (DAMAGE_T_GAMMA, DAMAGE_T_GAMMA_SPIN, DAMAGE_DISSIPATION, DAMAGE_PEARCE_SHERRATT, DAMAGE_ARCHARD_VOLUME)
_ODD_CONTACT = (CONTACT_FY, CONTACT_MX, CONTACT_MZ, CONTACT_Y, CONTACT_ANGLE, CONTACT_LATERAL, CONTACT_SPIN)
_ODD_TOTAL = (TOTAL_FY, TOTAL_MX, TOTAL_MZ)


class Bench(NamedTuple):
    """All arrays of one pair.

    `search`, `own` and `damage_parameters` hold sizes and constants, `case` methods, material and friction; `memory` is what
    the next call may start from: the number of patches, then one piece for each of MAX_PATCHES. `contacts` and `total`
    are the answer; `ledger` adds up.
    """

    search: Search
    own: Workspace
    case: Array
    memory: Array
    damage_parameters: Array
    damage_fields: Array
    damage: Array
    contacts: Array
    total: Array
    ledger: Ledger


@kernel
def _bounded(creepage):
    """Creepage within its range; a wheelset almost at rest leaves it, deep in full slip."""
    return min(max(creepage, -LARGEST_CREEPAGE), LARGEST_CREEPAGE)


@kernel
def _pressure_centre(strips, n):
    """Moments of the pressure, ∬ y p dA and ∬ x p dA; a strip carries π/2 p0 a a unit of width."""
    by_y, by_x = 0.0, 0.0
    for i in range(n):
        load = 0.5 * math.pi * strips[STRIP_P0, i] * strips[STRIP_A, i] * strips[STRIP_DY, i]
        by_y += load * strips[STRIP_Y, i]
        by_x += load * strips[STRIP_XC, i]
    return by_y, by_x


@kernel
def _report(patch, case, result, by_y, by_x, contact):
    """Fill the contact of one patch, on the right side."""
    contact[CONTACT_N], contact[CONTACT_FX], contact[CONTACT_FY] = result[RES_N], result[RES_FX], result[RES_FY]
    contact[CONTACT_MX], contact[CONTACT_MY], contact[CONTACT_MZ] = -by_y, by_x, result[RES_MZ]
    contact[CONTACT_X], contact[CONTACT_Y] = patch[layout.PATCH_X], patch[layout.PATCH_POINT_Y]
    contact[CONTACT_Z], contact[CONTACT_ANGLE] = patch[layout.PATCH_POINT_Z], patch[layout.PATCH_ANGLE]
    contact[CONTACT_AREA], contact[CONTACT_PMAX] = result[RES_AREA], result[RES_PMAX]
    contact[CONTACT_LONGITUDINAL], contact[CONTACT_LATERAL] = case[CASE_VX], case[CASE_VY]
    contact[CONTACT_SPIN], contact[CONTACT_APPROACH] = case[CASE_PHI], result[RES_APPROACH]
    contact[CONTACT_STATUS] = result[RES_STATUS]


@kernel
def _add_wrench(contact, y_centre, z_centre, total):
    """Add force and moment of a contact about the wheelset's centre (0, y, z), in track coordinates.

    The frame's axes are x, (0, c, s) and (0, -s, c); the pressure acts along -z of the frame.
    """
    c, s = math.cos(contact[CONTACT_ANGLE]), math.sin(contact[CONTACT_ANGLE])
    fx, fy, n = contact[CONTACT_FX], contact[CONTACT_FY], contact[CONTACT_N]
    y_force, z_force = fy * c + n * s, fy * s - n * c
    x, y, z = contact[CONTACT_X], contact[CONTACT_Y] - y_centre, contact[CONTACT_Z] - z_centre
    my, mz = contact[CONTACT_MY], contact[CONTACT_MZ]
    total[TOTAL_FX] += fx
    total[TOTAL_FY] += y_force
    total[TOTAL_FZ] += z_force
    total[TOTAL_MX] += y * z_force - z * y_force + contact[CONTACT_MX]
    total[TOTAL_MY] += z * fx - x * z_force + my * c - mz * s
    total[TOTAL_MZ] += x * y_force - y * fx + my * s + mz * c


@kernel
def _worse(status, other):
    """Status with another patch that carries: full slip when both slip, not trustworthy when one is not."""
    if status == 2.0:  # no contact so far
        return other
    if status >= 4.0 or other >= 4.0:
        return max(status, other)
    return status if status == other else 1.0


@kernel
def _add_results(result, damage, total):
    """Add what belongs to a patch that carries, besides its wrench."""
    first = total[TOTAL_AREA] == 0.0
    total[TOTAL_STATUS] = _worse(total[TOTAL_STATUS], result[RES_STATUS])
    total[TOTAL_PMAX] = max(total[TOTAL_PMAX], result[RES_PMAX])
    total[TOTAL_AREA] += result[RES_AREA]
    total[TOTAL_SLIP_AREA] += result[RES_SLIP_AREA]
    total[TOTAL_POWER] += result[RES_POWER]
    for i in range(N_DAMAGE):
        if i in _ADDITIVE:
            total[TOTAL_DAMAGE + i] += damage[i]
        else:
            total[TOTAL_DAMAGE + i] = damage[i] if first else max(total[TOTAL_DAMAGE + i], damage[i])


@kernel
def solve_pair(mode, amount, given, bench):
    """Find the patches, solve each of them, add up.

    `given` are pose, velocity and irregularity in the order of `geometry.layout`; `mode` and `amount` are those of `settle`.
    Under a load every patch is solved for the normal force that the search has found for it, so the vertical parts of the
    normal forces add up to the load for every normal method; else for its approach. Damage is per patch, with its own
    rolling radius. Fills bench.contacts and bench.total, and enters what the patches do into bench.ledger; returns the number
    of patches or a code of `settle`, in which case there is no answer.
    """
    search, own, case, memory, total = bench.search, bench.own, bench.case, bench.memory, bench.total
    motion = search.motion
    bench.contacts[:, :] = 0.0
    total[:] = 0.0
    total[TOTAL_STATUS] = 2.0
    move(given, motion)
    n = settle(mode, amount, search)
    if n < 0:
        return n
    piece = (memory.size - 1) // MAX_PATCHES
    if memory[0] != n:  # a patch came or went: none starts from another one
        memory[:] = 0.0
        memory[0] = n
    space, strips, fields, result = own.space, own.strips, own.fields, own.result
    parameters, damage = bench.damage_parameters, bench.damage
    case[CASE_LOAD_KIND] = LOAD if mode == UNDER_LOAD else APPROACH
    border, border_width = case[CASE_BORDER], case[CASE_BORDER_WIDTH]
    for k in range(n):
        patch, sep, contact = search.patches[k], search.separations[k], bench.contacts[k]
        case[CASE_LOAD] = patch[layout.PATCH_LOAD] if mode == UNDER_LOAD else patch[layout.PATCH_APPROACH]
        case[CASE_VX], case[CASE_VY] = _bounded(patch[layout.PATCH_VX]), _bounded(patch[layout.PATCH_VY])
        case[CASE_PHI] = _bounded(patch[layout.PATCH_PHI])
        # from the rail's profile into the plane of the patch
        per_cosine = 1.0 / math.cos(patch[layout.PATCH_ANGLE] - motion[layout.RAIL_ROLL])
        case[CASE_BORDER] = (border - patch[layout.PATCH_RAIL_Y]) * per_cosine
        case[CASE_BORDER_WIDTH] = border_width * per_cosine
        of_patch = Space(
            space.grid, space.vectors, space.logs, space.matrix, space.lu, memory[1 + k * piece : 1 + (k + 1) * piece],
            space.lanes, space.trace,
        )  # fmt: skip
        if case[CASE_CONFORMAL] > 0.5 and case[CASE_TANGENTIAL] < CARTER:
            rolling = math.cos(patch[layout.PATCH_ANGLE]) / patch[layout.PATCH_RADIUS]
            n_strips = solve_conformal(
                sep[layout.SEP_Y], sep[layout.SEP_G], sep[layout.SEP_A], sep[layout.SEP_XC], sep[layout.SEP_TILT],
                rolling, case, own.rule, own.tables, of_patch, strips, fields, result,
            )  # fmt: skip
        else:
            n_strips = solve_case(
                sep[layout.SEP_Y], sep[layout.SEP_G], sep[layout.SEP_A], sep[layout.SEP_XC], case, own.rule, own.tables,
                of_patch, strips, fields, result,
            )  # fmt: skip
        parameters[PAR_SPEED], parameters[PAR_WHEEL_RADIUS] = motion[layout.VEL_X], patch[layout.PATCH_RADIUS]
        damage_kernel(strips, n_strips, fields, case, result, parameters, bench.damage_fields, damage)
        by_y, by_x = _pressure_centre(strips, n_strips)
        _report(patch, case, result, by_y, by_x, contact)
        if n_strips > 0:
            _add_wrench(contact, motion[layout.POSE_Y], motion[layout.POSE_Z] - motion[layout.RADIUS], total)
            _add_results(result, damage, total)
            if bench.ledger.bins.shape[2] > 0:
                enter(patch, strips, n_strips, fields, parameters, damage, bench.damage_fields, bench.ledger)
    case[CASE_BORDER], case[CASE_BORDER_WIDTH] = border, border_width
    total[TOTAL_Z], total[TOTAL_COUNT] = motion[layout.POSE_Z], n
    for i in _ODD_TOTAL:
        total[i] *= motion[layout.MIRROR]
    for k in range(n):
        for i in _ODD_CONTACT:
            bench.contacts[k, i] *= motion[layout.MIRROR]
    return n
