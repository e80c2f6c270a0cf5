"""Laws that give only forces. Each patch is its equivalent ellipse, which rolls at its centre of load.

The ellipse has the area of the patch and the longest strip as semi-axis a. Poisson's ratio, friction and load are those
of the patch. Forces and moment of the law act at the middle of the ellipse and are referred to the separation's origin.
There are no fields. The power is -(F·v + Mz phi). In steady rolling this is all that friction dissipates, except for
what a law without moment leaves out.
"""

import math

from contact.core import kernel
from contact.kernels import kalker
from contact.kernels.enumerations import Tangential
from contact.kernels.rows import Field, Strip
from contact.kernels.tangential.carter import carter, creepage_of_full_slip
from contact.kernels.tangential.ellipses import equivalent_ellipse
from contact.kernels.tangential.fastsim import NO_FRICTION
from contact.kernels.tangential.linear import linear, saturated
from contact.kernels.tangential.polach import polach
from contact.kernels.tangential.table import is_beyond, lookup
from contact.kernels.tangential.vermeulen_johnson import vermeulen_johnson


@kernel
def of_ellipse(case, creepage, a, b, limit, tables):
    """Return Fx, Fy, Mz [N, N, N m] and the share of slip of one ellipse.

    The ellipse rolls with the creepage (vx, vy, phi). `limit` is mu N.
    """
    vx, vy, _ = creepage
    law, G, nu = case.tangential, case.G, case.nu
    if law == Tangential.CARTER:
        force, slip = carter(vx, creepage_of_full_slip(limit, math.pi * a * b, G, nu))
        return limit * force, 0.0, 0.0, slip
    c = math.sqrt(a * b)
    if law == Tangential.JOHNSON:
        return vermeulen_johnson(vx, vy, G, c, c, nu, limit)
    if law == Tangential.VERMEULEN_JOHNSON:
        return vermeulen_johnson(vx, vy, G, a, b, nu, limit)
    log_aspect = math.log(a / b)
    coefficients = kalker.coefficients(tables.kalker, log_aspect)
    if law == Tangential.TABLE:
        return lookup(creepage, G, c, log_aspect, coefficients, limit, tables.creep)
    if law == Tangential.POLACH:
        return polach(creepage, G, a, b, coefficients, limit, case.k_A, case.k_S)
    Fx, Fy, Mz, slip = linear(creepage, G, c, coefficients)
    if law == Tangential.LINEAR:
        return Fx, Fy, Mz, slip
    return saturated(Fx, Fy, limit, law == Tangential.SHEN_HEDRICK_ELKINS)


@kernel
def creep_force(part, case, workspace, result):
    """Add forces, power and slip area of one patch to `result`. Set traction and slip of its fields to zero."""
    strips, fields, first, last = workspace.strips, workspace.fields, part.first, part.last
    fields[Field.QX : Field.STICK + 1, first : min(last, fields.shape[1]), :] = 0.0
    load, load_y, load_x, bound = 0.0, 0.0, 0.0, 0.0
    for i in range(first, last):
        share = 0.5 * math.pi * strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
        load += share
        bound += 0.5 * math.pi * strips[Strip.BOUND, i] * strips[Strip.A, i] * strips[Strip.DY, i]
        load_y += share * strips[Strip.Y, i]
        load_x += share * strips[Strip.XC, i]
    a, b = equivalent_ellipse(strips, first, last)
    if load <= 0.0 or b <= 0.0:
        return
    y, x = load_y / load, load_x / load
    vx, vy, phi = case.vx - case.phi * y, case.vy + case.phi * x, case.phi
    limit = case.mu * bound
    if limit <= NO_FRICTION * case.G * a * b:
        limit = 0.0
    if case.tangential == Tangential.TABLE and is_beyond(math.log(a / b)):
        result.beyond += part.N / max(result.N, 1e-300)
    Fx, Fy, Mz, slip = of_ellipse(case, (vx, vy, phi), a, b, limit, workspace.tables)
    result.Fx += Fx
    result.Fy += Fy
    result.Mz += Mz + x * Fy - y * Fx
    result.power += max(-(Fx * vx + Fy * vy + Mz * phi), 0.0)
    result.slip_area += slip * math.pi * a * b
