"""One contact problem from separation to forces: the kernel behind `contact.solve`, batches and FMUs."""

import math

from contact import kalker
from contact._jit import kernel
from contact._layout import (
    CASE_BORDER,
    CASE_BORDER_WIDTH,
    CASE_CONFORMAL,
    CASE_G,
    CASE_GAUGE_FACTOR,
    CASE_MU,
    CASE_PHI,
    CASE_PRESSURE_LIMIT,
    CASE_SLOPE,
    CASE_SLOPE_FAR,
    CASE_TANGENTIAL,
    CASE_VX,
    CASE_VY,
    FIELD_DX,
    FIELD_P,
    FIELD_QX,
    FIELD_QY,
    FIELD_X,
    RES_AREA,
    RES_LENGTH,
    RES_N,
    RES_PATCHES,
    RES_PMAX,
    RES_SLIP_AREA,
    RES_STATUS,
    RES_WIDTH,
    STRIP_A,
    STRIP_ASPECT,
    STRIP_BOUND,
    STRIP_DY,
    STRIP_P0,
    STRIP_PATCH,
    STRIP_PHI,
    STRIP_TO_EXPONENT,
    STRIP_TO_PHI,
    STRIP_TO_X,
    STRIP_TO_Y,
    STRIP_VX,
    STRIP_VY,
    STRIP_XC,
    STRIP_Y,
)
from contact._layout import RES_EDGES as EDGES
from contact.conformal import bend, project
from contact.friction import of_bodies, of_case, over_profile, slope_of_case
from contact.normal.lay import interval_minimum
from contact.normal.press import fill_cut, press, share_of
from contact.quadrature import EL_DX, EL_S, EL_SINE
from contact.registry import (
    CARTER,
    FASTRIP_MAPPED,
    FASTSIM,
    FASTSIM_ONE,
    FASTSIM_STRIPES,
)
from contact.tangential.creep_force import creep_force
from contact.tangential.ellipses import equivalent_ellipse
from contact.tangential.fastrip import fastrip
from contact.tangential.fastrip_mapped import fastrip_mapped
from contact.tangential.fastsim import fastsim


@kernel
def _square_slope(strips, i, first, last):
    """Slope of p0² at strip i from the parabola through it and its neighbours in the patch of strips first … last."""
    k = min(max(i, first + 1), last - 1)
    y, left, right = strips[STRIP_Y, k], strips[STRIP_Y, k - 1], strips[STRIP_Y, k + 1]
    top = strips[STRIP_P0, k] ** 2
    d0 = (top - strips[STRIP_P0, k - 1] ** 2) / (y - left)
    d1 = (strips[STRIP_P0, k + 1] ** 2 - top) / (right - y)
    return d0 + (d1 - d0) / (right - left) * (2.0 * strips[STRIP_Y, i] - left - y)


@kernel
def peak_pressure(strips, n):
    """Largest pressure: top of the cubics through p0² of the strips with three-point slopes (exact for an ellipse)."""
    top, first = 0.0, 0
    while first < n:
        last = first
        while last + 1 < n and strips[STRIP_PATCH, last + 1] == strips[STRIP_PATCH, first]:
            last += 1
        here = _square_slope(strips, first, first, last) if last >= first + 2 else 0.0
        for i in range(first, last + 1):
            square = strips[STRIP_P0, i] ** 2
            top = max(top, square)
            if i == last or last < first + 2:
                continue
            before, here = here, _square_slope(strips, i + 1, first, last)
            if before > 0.0 > here:
                h = strips[STRIP_Y, i + 1] - strips[STRIP_Y, i]
                _, least = interval_minimum(h, -square, -before, -(strips[STRIP_P0, i + 1] ** 2), -here)
                top = max(top, -least)
        first = last + 1
    return math.sqrt(top)


@kernel
def _cut(strips, n, limit, elements, fields, N):
    """Cut the pressure at the limit: in the fields, and in the strips by semi-ellipses of the same load; together N."""
    total = 0.0
    for i in range(n):
        p0 = strips[STRIP_P0, i]
        if p0 > limit and i < fields.shape[1]:
            fill_cut(elements, p0, limit, fields[FIELD_P, i])
        strips[STRIP_P0, i] = p0 * share_of(p0, limit)
        total += 0.5 * math.pi * strips[STRIP_P0, i] * strips[STRIP_A, i] * strips[STRIP_DY, i]
    for i in range(n):  # what the iteration has left over
        strips[STRIP_P0, i] *= N / total
        for k in range(elements.shape[1] if i < fields.shape[1] else 0):
            fields[FIELD_P, i, k] *= N / total


@kernel
def _bear(strips, n, elements, fields):
    """Carry the utilisation of friction under the semi-ellipses over to the cut pressure."""
    for i in range(min(n, fields.shape[1])):
        for k in range(elements.shape[1]):
            under = strips[STRIP_P0, i] * elements[EL_SINE, k]
            share = fields[FIELD_P, i, k] / under if under > 0.0 else 0.0
            fields[FIELD_QX, i, k] *= share
            fields[FIELD_QY, i, k] *= share


@kernel
def _set_rolling(strips, n, case):
    """What friction acts on, the pressure times factors of temperature and side of the profile, and the plane's creepages."""
    factor, bodies = case[CASE_GAUGE_FACTOR], of_bodies(case)
    for i in range(n):
        strips[STRIP_VX, i], strips[STRIP_VY, i], strips[STRIP_PHI, i] = case[CASE_VX], case[CASE_VY], case[CASE_PHI]
        strips[STRIP_BOUND, i] = strips[STRIP_P0, i] * bodies
        strips[STRIP_TO_X, i], strips[STRIP_TO_Y, i], strips[STRIP_TO_PHI, i] = 0.0, 0.0, 0.0
        strips[STRIP_TO_EXPONENT, i] = 0.0
        if factor != 1.0:
            strips[STRIP_BOUND, i] *= over_profile(
                factor, case[CASE_BORDER], case[CASE_BORDER_WIDTH], strips[STRIP_Y, i]
            )


@kernel
def _roll(strips, n, case, tables, elements, space, fields, result):
    """Solve the tangential problem with the friction and the creep stiffness of the surface."""
    table = tables.kalker
    static, G = case[CASE_MU], case[CASE_G]
    case[CASE_MU] = of_case(case)
    if case[CASE_SLOPE] != 1.0 or case[CASE_SLOPE_FAR] != 1.0:
        a, b = equivalent_ellipse(strips, n)
        c11 = kalker.coefficients(table, math.log(a / b))[0] if b > 0.0 else 0.0
        case[CASE_G] = G * slope_of_case(case, a, b, c11, case[CASE_MU] * result[RES_N], case[CASE_PHI] * a)
    if case[CASE_TANGENTIAL] == FASTSIM or FASTSIM_ONE <= case[CASE_TANGENTIAL] <= FASTSIM_STRIPES:
        fastsim(strips, n, case, table, elements, space.lanes, space.trace, fields, result)
    elif case[CASE_TANGENTIAL] == FASTRIP_MAPPED:
        fastrip_mapped(strips, n, case, tables, elements, space.lanes, space.trace, fields, result)
    elif case[CASE_TANGENTIAL] >= CARTER:
        creep_force(strips, n, case, tables, fields, result)
    else:
        fastrip(strips, n, case, table, elements, space.lanes, space.trace, fields, result)
    case[CASE_MU], case[CASE_G] = static, G


@kernel
def press_case(y, g, A, xc, case, rule, tables, space, strips, fields, result):
    """The first half of `solve_case`: the normal problem, and the creepages and the bound with which each strip rolls."""
    n = press(y, g, A, xc, case, rule, tables, space, strips, result)
    if n == 0:
        return 0

    elements = rule.elements
    area, x_low, x_high = 0.0, math.inf, -math.inf
    for i in range(n):
        a, xc_i, p0 = strips[STRIP_A, i], strips[STRIP_XC, i], strips[STRIP_P0, i]
        area += 2.0 * a * strips[STRIP_DY, i]
        x_low, x_high = min(x_low, xc_i - a), max(x_high, xc_i + a)
        for k in range(elements.shape[1] if i < fields.shape[1] else 0):
            fields[FIELD_X, i, k] = xc_i + a * elements[EL_S, k]
            fields[FIELD_DX, i, k] = a * elements[EL_DX, k]
            fields[FIELD_P, i, k] = p0 * elements[EL_SINE, k]
    count = int(strips[STRIP_PATCH, n - 1]) + 1
    result[RES_AREA], result[RES_PMAX], result[RES_PATCHES] = area, peak_pressure(strips, n), count
    limit = case[CASE_PRESSURE_LIMIT]
    if 0.0 < limit < result[RES_PMAX]:
        result[RES_PMAX] = limit
        _cut(strips, n, limit, elements, fields, result[RES_N])
    _set_rolling(strips, n, case)
    y_low, y_high = math.inf, -math.inf
    for k in range(count):
        y_low, y_high = min(y_low, result[EDGES + 2 * k]), max(y_high, result[EDGES + 2 * k + 1])
    result[RES_LENGTH], result[RES_WIDTH] = x_high - x_low, y_high - y_low

    return n


@kernel
def roll_case(n, case, rule, tables, space, strips, fields, result):
    """The second half of `solve_case`: the tangential problem of `n` > 0 strips."""
    elements = rule.elements
    _roll(strips, n, case, tables, elements, space, fields, result)
    if result[RES_PMAX] == case[CASE_PRESSURE_LIMIT]:
        _bear(strips, n, elements, fields)
    full = result[RES_AREA] * (1.0 - 1e-12)
    if result[RES_STATUS] == 1.0 and case[CASE_MU] > 0.0 and result[RES_SLIP_AREA] >= full:
        result[RES_STATUS] = 3.0
    for i in range(n):
        strips[STRIP_ASPECT, i] = math.exp(strips[STRIP_ASPECT, i])


@kernel
def solve_case(y, g, A, xc, case, rule, tables, space, strips, fields, result):
    """Solve one case; fill strips, fields and result (see `_layout`). Return the strip count.

    All arrays are the caller's: `workspace.allocate` makes a fitting set. With a single row of fields only strips and result
    are meant to be read.
    """
    n = press_case(y, g, A, xc, case, rule, tables, space, strips, fields, result)
    if n > 0:
        roll_case(n, case, rule, tables, space, strips, fields, result)
    return n


@kernel
def solve_conformal(y, g, A, xc, tilt, rolling, case, rule, tables, space, strips, fields, result):
    """As `solve_case` with fields, on the surface of slope `tilt` (`conformal`)."""
    n = press_case(y, g, A, xc, case, rule, tables, space, strips, fields, result)
    if n > 0:
        bend(y, tilt, rolling, case, strips, n)
        roll_case(n, case, rule, tables, space, strips, fields, result)
        project(strips, n, fields, result)
    return n


@kernel
def solve_cases(
    first, last, y, g, A, xc, tilt, rolling, bounds, which, cases, rule, tables, space, strips, fields, results
):
    """Solve cases[first:last] one after the other; separation k lies at y[bounds[k]:bounds[k+1]], case c uses which[c].

    Cases that say so lie on the surface of slope `tilt`, for which `fields` must have a row for each strip.
    """
    for c in range(first, last):
        low, high = bounds[which[c]], bounds[which[c] + 1]
        if space.memory.size > 1:
            space.memory[0] = 0.0  # no case starts from another one: the order of cases does not matter
        case, result = cases[c], results[c]
        if case[CASE_CONFORMAL] > 0.5:
            solve_conformal(
                y[low:high], g[low:high], A[low:high], xc[low:high], tilt[low:high], rolling[which[c]],
                case, rule, tables, space, strips, fields, result,
            )  # fmt: skip
        else:
            solve_case(
                y[low:high], g[low:high], A[low:high], xc[low:high],
                case, rule, tables, space, strips, fields, result,
            )  # fmt: skip
