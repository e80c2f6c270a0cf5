"""One contact problem from separation to forces: the kernel behind `contact.solve`, batches and FMUs."""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Case, Cases, Integers, Matrix, Result, Results, Samples, Workspace
from contact.kernels.conformal import bend, project, surface_at
from contact.kernels.enumerations import Status, Tangential, TangentialFamily
from contact.kernels.friction import of_bodies, of_case, over_profile
from contact.kernels.normal.gap_error import gap_error
from contact.kernels.normal.peak import peak_pressure
from contact.kernels.normal.press import fill_limited, press, share_of
from contact.kernels.rows import Element, Field, Strip
from contact.kernels.tangential.creep_force import creep_force
from contact.kernels.tangential.ellipses import Part, end_of_patch, is_beyond_kalker, place_in_load, stiffness_of
from contact.kernels.tangential.fastrip import fastrip
from contact.kernels.tangential.fastrip_mapped import fastrip_mapped, set_shapes
from contact.kernels.tangential.fastsim import fastsim
from contact.kernels.tangential.pulls import is_divided, set_forces, set_pulls


@kernel
def _limit_pressure(strips, n, limit, elements, fields, N):
    """Limit the pressure in the fields and replace each limited strip by the semi-ellipse of the same load; together N."""
    total = 0.0
    for i in range(n):
        p0 = strips[Strip.P0, i]
        if p0 > limit and i < fields.shape[1]:
            fill_limited(elements, p0, limit, fields[Field.P, i])
        strips[Strip.P0, i] = p0 * share_of(p0, limit)
        total += 0.5 * math.pi * strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
    for i in range(n):  # what the iteration has left over
        strips[Strip.P0, i] *= N / total
        for k in range(elements.shape[1] if i < fields.shape[1] else 0):
            fields[Field.P, i, k] *= N / total


@kernel
def _bears_pressure(case):
    """Return whether the pressure bounds the traction of the method. It does not for force laws and a parabolic bound."""
    family = case.tangential_family
    by_strips = family == TangentialFamily.FASTRIP or family == TangentialFamily.FASTRIP_MAPPED
    return by_strips or case.tangential == Tangential.FASTSIM_ELLIPTIC


@kernel
def _rescale_tractions(strips, n, case, elements, fields, result):
    """Rescale the tractions, which were found under semi-ellipses, to the limited pressure; correct the forces alike.

    In slip the traction changes in the ratio of the pressures. In stick the stiffness of the bodies determines it, so there
    the change decreases with the square of the utilisation of friction. The ratio is at least π/4 (theory.md 8.4), so the
    traction never exceeds friction.
    """
    if n > fields.shape[1]:  # no fields to carry over
        return
    mu = of_case(case)
    for i in range(n):
        y, dy = strips[Strip.Y, i], strips[Strip.DY, i]
        for k in range(elements.shape[1]):
            under = strips[Strip.P0, i] * elements[Element.SINE, k]
            bound = mu * strips[Strip.BOUND, i] * elements[Element.SINE, k]
            qx, qy, x = fields[Field.QX, i, k], fields[Field.QY, i, k], fields[Field.X, i, k]
            if under <= 0.0 or bound <= 0.0:
                continue
            used = min((qx * qx + qy * qy) / (bound * bound), 1.0) if fields[Field.STICK, i, k] > 0.5 else 1.0
            more = used * (fields[Field.P, i, k] / under - 1.0)
            fields[Field.QX, i, k], fields[Field.QY, i, k] = qx + more * qx, qy + more * qy
            load = more * fields[Field.DX, i, k] * dy
            result.Fx += load * qx
            result.Fy += load * qy
            result.Mz += load * (x * qy - y * qx)
            result.power -= load * (qx * fields[Field.SX, i, k] + qy * fields[Field.SY, i, k])


@entry
def set_rolling(strips: Matrix, n: int, case: Case) -> None:
    """Set what the tangential problem of `n` strips starts from: aspect ratios, bounds and the creepages of the plane.

    The bound is the pressure times factors of the bodies' temperature and of the profile.
    """
    factor, bodies = case.gauge_factor, of_bodies(case)
    for i in range(n):
        strips[Strip.ASPECT, i] = strips[Strip.LN_ASPECT, i]
        strips[Strip.VX, i], strips[Strip.VY, i], strips[Strip.PHI, i] = case.vx, case.vy, case.phi
        strips[Strip.BOUND, i] = strips[Strip.P0, i] * bodies
        strips[Strip.TO_X, i], strips[Strip.TO_Y, i], strips[Strip.TO_PHI, i] = 0.0, 0.0, 0.0
        strips[Strip.TO_EXPONENT, i], strips[Strip.TILT, i] = 0.0, 0.0
        strips[Strip.BY_FALL_X, i], strips[Strip.BY_FALL_Y, i] = 0.0, 0.0
        strips[Strip.BY_PULL_X, i], strips[Strip.BY_PULL_Y, i] = 0.0, 0.0
        if factor != 1.0:
            strips[Strip.BOUND, i] *= over_profile(factor, case.border, case.border_width, strips[Strip.Y, i])


@kernel
def _roll_patch(part, n, case, workspace, result):
    """Solve the tangential problem of one patch, of `n` strips in all, by the method of the case."""
    if case.tangential_family == TangentialFamily.FASTSIM:
        fastsim(part, case, workspace, result)
    elif case.tangential_family == TangentialFamily.FASTRIP_MAPPED:
        fastrip_mapped(part, n, case, workspace, result)
    elif case.tangential_family == TangentialFamily.CREEP_FORCE:
        creep_force(part, case, workspace, result)
    else:
        fastrip(part, case, workspace, result)


@kernel
def _reads_kalker(case):
    """Return whether the method reads Kalker's coefficients but not the table of creep forces, which is narrower."""
    law = case.tangential
    closed = law == Tangential.CARTER or law == Tangential.JOHNSON or law == Tangential.VERMEULEN_JOHNSON
    return not (closed or law == Tangential.FASTRIP_MAPPED or law == Tangential.TABLE)


@kernel
def _part(n, first, workspace, result):
    """Return the patch that begins at strip `first`."""
    last = end_of_patch(workspace.strips, n, first)
    share, x, y = place_in_load(workspace.strips, n, first, last)
    return Part(first, last, share * result.N, x, y)


@kernel
def _act_on_each_other(n, case, surface, workspace, result):
    """Set what several shapes do to each other: the forces of all patches first, then by what creepages these pull at each."""
    for pulls in range(2):
        first = 0
        while first < n:
            part = _part(n, first, workspace, result)
            surface.G = stiffness_of(part, case, surface.mu * part.N, workspace)
            if pulls == 0:
                set_forces(workspace.strips, part.first, part.last, (0, n), surface, workspace.tables)
            else:
                set_pulls(workspace.strips, part.first, part.last, (0, n), surface)
            first = part.last


@kernel
def _roll(n, case, workspace, result):
    """Solve the tangential problem patch by patch, with the friction and the creep stiffness of the surface."""
    workspace.space.case[0] = case
    surface = workspace.space.case[0]
    surface.mu = of_case(case)
    if case.tangential_family == TangentialFamily.FASTRIP_MAPPED:
        set_shapes(n, workspace)
        if is_divided(workspace.strips, 0, n):
            _act_on_each_other(n, case, surface, workspace, result)
    first = 0
    while first < n:
        part = _part(n, first, workspace, result)
        surface.G = stiffness_of(part, case, surface.mu * part.N, workspace)
        if _reads_kalker(case) and is_beyond_kalker(workspace.strips, first, part.last):
            result.beyond += part.N / max(result.N, 1e-300)
        _roll_patch(part, n, surface, workspace, result)
        first = part.last


@kernel
def complete_pressure(sep, n, brief, case, workspace, result):
    """Fill what follows from the pressures of `n` > 0 strips: fields, largest pressure, size, and gap error if not `brief`."""
    if not brief:
        result.gap_error = gap_error(sep, n, case, workspace, result)
    elements, strips, fields = workspace.rule.elements, workspace.strips, workspace.fields
    area, x_low, x_high = 0.0, math.inf, -math.inf
    for i in range(n):
        a, xc_i, p0 = strips[Strip.A, i], strips[Strip.XC, i], strips[Strip.P0, i]
        area += 2.0 * a * strips[Strip.DY, i]
        x_low, x_high = min(x_low, xc_i - a), max(x_high, xc_i + a)
        for k in range(elements.shape[1] if i < fields.shape[1] else 0):
            fields[Field.X, i, k] = xc_i + a * elements[Element.S, k]
            fields[Field.DX, i, k] = a * elements[Element.DX, k]
            fields[Field.P, i, k] = p0 * elements[Element.SINE, k]
    count = int(strips[Strip.PATCH, n - 1]) + 1
    result.area, result.n_patches = area, count
    result.pmax = result.pmax if result.pmax > 0.0 else peak_pressure(strips, n)
    if 0.0 < case.pressure_limit < result.pmax:
        result.pmax, result.limited = case.pressure_limit, 1
        _limit_pressure(strips, n, case.pressure_limit, elements, fields, result.N)
    y_low, y_high, least, most = math.inf, -math.inf, math.inf, -math.inf
    for k in range(2 * count):  # all patches of a separation lie in one plane
        at = result.edges[k]
        tilt, _ = surface_at(sep.y, sep.tilt, at)
        y_low, y_high, least, most = min(y_low, at), max(y_high, at), min(least, tilt), max(most, tilt)
    result.length, result.width, result.bend = x_high - x_low, y_high - y_low, math.atan(most) - math.atan(least)


@entry
def press_case(sep: Samples, case: Case, workspace: Workspace, result: Result) -> int:
    """Solve the normal problem; return the strip count."""
    n = press(sep, case, workspace, result)
    if n > 0:
        complete_pressure(sep, n, False, case, workspace, result)
    return n


@kernel
def roll_case(sep, n, case, workspace, result):
    """Solve the tangential problem of `n` > 0 strips, in the plane or on the bent surface. It may be solved again."""
    strips = workspace.strips
    set_rolling(strips, n, case)
    bent = case.conformal != 0 and case.tangential_family != TangentialFamily.CREEP_FORCE
    if bent:
        bend(sep, case, strips, n)
    _roll(n, case, workspace, result)
    if result.limited != 0 and _bears_pressure(case):
        _rescale_tractions(strips, n, case, workspace.rule.elements, workspace.fields, result)
    if not abs(result.Fx) + abs(result.Fy) + abs(result.Mz) + result.N < math.inf:
        result.status = Status.NOT_CONVERGED  # gaps or creepages so large that numbers overflow
    full = result.area * (1.0 - 1e-12)
    if result.status == Status.OK and case.mu > 0.0 and result.slip_area >= full:
        result.status = Status.SATURATED
    if bent:
        project(strips, n, workspace.fields, result)
    for i in range(n):
        strips[Strip.ASPECT, i] = math.exp(strips[Strip.ASPECT, i])


@kernel
def solve_case(sep, cases, workspace, results):
    """Solve one case; fill the strips and fields of `workspace`, and `result`. Return the strip count.

    Parameters
    ----------
    sep : Samples
    cases, results : arrays of one record CASE and RESULT
        The case is only read. An array is cheaper to pass from Python than a record.
    own : Workspace
        `contact.instance.workspace.allocate` makes a fitting one. Where fields have a single row, only strips and result have a
        meaning. A case on a bent surface (`case.conformal`) or with a limit of the pressure needs all rows.
    """
    case, result = cases[0], results[0]
    n = press_case(sep, case, workspace, result)
    if n > 0:
        roll_case(sep, n, case, workspace, result)
    return n


@entry
def solve_cases(
    first: int,
    last: int,
    samples: Samples,
    bounds: Integers,
    which: Integers,
    cases: Cases,
    workspace: Workspace,
    results: Results,
) -> int:
    """Solve cases[first:last] one after the other. Return the strip count of the last one.

    Separation k is samples[bounds[k]:bounds[k+1]], and case c uses which[c]. The first case starts from the workspace's
    memory, all others from nothing.
    """
    y, g, A, x_c, tilt = samples.y, samples.g, samples.A, samples.x_c, samples.tilt
    n = 0
    for c in range(first, last):
        low, high = bounds[which[c]], bounds[which[c] + 1]
        if c > first:
            workspace.space.memory[0] = 0.0
        sep = Samples(y[low:high], g[low:high], A[low:high], x_c[low:high], tilt[low:high])
        n = solve_case(sep, cases[c : c + 1], workspace, results[c : c + 1])
    return n
