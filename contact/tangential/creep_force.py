"""Laws that give forces alone, on every patch of strips: each patch is its equivalent ellipse, rolling at its centre of load.

The ellipse has the area of the patch and the longest strip as semi-axis a; Poisson's ratio, friction and load are the
patch's own. What the law says about the ellipse's middle is taken about the separation's origin. There are no fields; the
power is -(F·v + Mz phi), which in steady rolling is all that friction dissipates, less what a law without moment leaves out.
"""

import math

from contact import kalker
from contact._jit import kernel
from contact._layout import (
    CASE_G,
    CASE_K_A,
    CASE_K_S,
    CASE_MU,
    CASE_NU,
    CASE_PHI,
    CASE_TANGENTIAL,
    CASE_VX,
    CASE_VY,
    FIELD_QX,
    FIELD_STICK,
    RES_FX,
    RES_FY,
    RES_MZ,
    RES_POWER,
    RES_SLIP_AREA,
    STRIP_A,
    STRIP_BOUND,
    STRIP_DY,
    STRIP_P0,
    STRIP_PATCH,
    STRIP_XC,
    STRIP_Y,
)
from contact.registry import CARTER, JOHNSON, LINEAR, POLACH, SHEN_HEDRICK_ELKINS, TABLE, VERMEULEN_JOHNSON
from contact.tangential.carter import carter, creepage_of_full_slip
from contact.tangential.ellipses import equivalent_ellipse
from contact.tangential.fastsim import NO_FRICTION
from contact.tangential.linear import linear, saturated
from contact.tangential.polach import polach
from contact.tangential.table import lookup
from contact.tangential.vermeulen_johnson import vermeulen_johnson


@kernel
def of_ellipse(case, vx, vy, phi, a, b, limit, table, creep):
    """Fx, Fy, Mz and the share of slip of one ellipse that rolls with these creepages; `limit` is mu N."""
    law, G, nu = case[CASE_TANGENTIAL], case[CASE_G], case[CASE_NU]
    if law == CARTER:
        force, slip = carter(vx, creepage_of_full_slip(limit, math.pi * a * b, G, nu))
        return limit * force, 0.0, 0.0, slip
    c = math.sqrt(a * b)
    if law == JOHNSON:
        return vermeulen_johnson(vx, vy, G, c, c, nu, limit)
    if law == VERMEULEN_JOHNSON:
        return vermeulen_johnson(vx, vy, G, a, b, nu, limit)
    log_aspect = math.log(a / b)
    c11, c22, c23, c33 = kalker.coefficients(table, log_aspect)
    if law == TABLE:
        return lookup(vx, vy, phi, G, c, log_aspect, c11, c22, c23, c33, limit, creep)
    if law == POLACH:
        return polach(vx, vy, phi, G, a, b, c11, c22, c23, limit, case[CASE_K_A], case[CASE_K_S])
    Fx, Fy, Mz, slip = linear(vx, vy, phi, G, c, c11, c22, c23, c33)
    if law == LINEAR:
        return Fx, Fy, Mz, slip
    return saturated(Fx, Fy, limit, law == SHEN_HEDRICK_ELKINS)


@kernel
def creep_force(strips, n, case, tables, fields, result):
    """Fill the tangential part of `result`; traction and slip of the fields are zero."""
    rows = min(n, fields.shape[1])
    fields[FIELD_QX : FIELD_STICK + 1, :rows, :] = 0.0
    first = 0
    while first < n:
        last = first
        load, load_y, load_x, bound = 0.0, 0.0, 0.0, 0.0
        while last < n and strips[STRIP_PATCH, last] == strips[STRIP_PATCH, first]:
            share = 0.5 * math.pi * strips[STRIP_P0, last] * strips[STRIP_A, last] * strips[STRIP_DY, last]
            load += share
            bound += 0.5 * math.pi * strips[STRIP_BOUND, last] * strips[STRIP_A, last] * strips[STRIP_DY, last]
            load_y += share * strips[STRIP_Y, last]
            load_x += share * strips[STRIP_XC, last]
            last += 1
        a, b = equivalent_ellipse(strips[:, first:last], last - first)
        first = last
        if load <= 0.0 or b <= 0.0:
            continue
        y, x = load_y / load, load_x / load
        vx, vy, phi = case[CASE_VX] - case[CASE_PHI] * y, case[CASE_VY] + case[CASE_PHI] * x, case[CASE_PHI]
        limit = case[CASE_MU] * bound
        if limit <= NO_FRICTION * case[CASE_G] * a * b:
            limit = 0.0
        Fx, Fy, Mz, slip = of_ellipse(case, vx, vy, phi, a, b, limit, tables.kalker, tables.creep)
        result[RES_FX] += Fx
        result[RES_FY] += Fy
        result[RES_MZ] += Mz + x * Fy - y * Fx
        result[RES_POWER] += max(-(Fx * vx + Fy * vy + Mz * phi), 0.0)
        result[RES_SLIP_AREA] += slip * math.pi * a * b
