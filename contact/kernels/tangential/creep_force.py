"""Laws that give forces alone, on every patch of strips: each patch is its equivalent ellipse, rolling at its centre of load.

The ellipse has the area of the patch and the longest strip as semi-axis a; Poisson's ratio, friction and load are the
patch's own. What the law says about the ellipse's middle is taken about the separation's origin. There are no fields; the
power is -(F·v + Mz phi), which in steady rolling is all that friction dissipates, less what a law without moment leaves out.
"""

import math

from contact._jit import kernel
from contact.kernels import kalker
from contact.kernels.layout import Field, Strip, Tangential
from contact.kernels.tangential.carter import carter, creepage_of_full_slip
from contact.kernels.tangential.ellipses import equivalent_ellipse
from contact.kernels.tangential.fastsim import NO_FRICTION
from contact.kernels.tangential.linear import linear, saturated
from contact.kernels.tangential.polach import polach
from contact.kernels.tangential.table import lookup
from contact.kernels.tangential.vermeulen_johnson import vermeulen_johnson


@kernel
def of_ellipse(case, creepage, a, b, limit, tables):
    """Fx, Fy, Mz and the share of slip of one ellipse that rolls with a creepage (vx, vy, phi); `limit` is mu N."""
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
def creep_force(n, case, own, result):
    """Fill the tangential part of `result`; traction and slip of the fields are zero."""
    strips, fields = own.strips, own.fields
    rows = min(n, fields.shape[1])
    fields[Field.QX : Field.STICK + 1, :rows, :] = 0.0
    first = 0
    while first < n:
        last = first
        load, load_y, load_x, bound = 0.0, 0.0, 0.0, 0.0
        while last < n and strips[Strip.PATCH, last] == strips[Strip.PATCH, first]:
            share = 0.5 * math.pi * strips[Strip.P0, last] * strips[Strip.A, last] * strips[Strip.DY, last]
            load += share
            bound += 0.5 * math.pi * strips[Strip.BOUND, last] * strips[Strip.A, last] * strips[Strip.DY, last]
            load_y += share * strips[Strip.Y, last]
            load_x += share * strips[Strip.XC, last]
            last += 1
        a, b = equivalent_ellipse(strips[:, first:last], last - first)
        first = last
        if load <= 0.0 or b <= 0.0:
            continue
        y, x = load_y / load, load_x / load
        vx, vy, phi = case.vx - case.phi * y, case.vy + case.phi * x, case.phi
        limit = case.mu * bound
        if limit <= NO_FRICTION * case.G * a * b:
            limit = 0.0
        Fx, Fy, Mz, slip = of_ellipse(case, (vx, vy, phi), a, b, limit, own.tables)
        result.Fx += Fx
        result.Fy += Fy
        result.Mz += Mz + x * Fy - y * Fx
        result.power += max(-(Fx * vx + Fy * vy + Mz * phi), 0.0)
        result.slip_area += slip * math.pi * a * b
