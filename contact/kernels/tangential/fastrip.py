"""FaStrip: strip theory amended by Kalker's coefficients, with FASTSIM's directions in the slip zone (theory.md 4).

Every strip is the central strip of a local ellipse with its own half length a(y), peak pressure p0(y) and aspect ratio.
So the method needs no elliptic patch. On an ellipse it is the published method. Stick-zone forces are integrated in
closed form. In the slip zone the magnitude mu·p is integrated exactly over each element, and only the direction is that
of the element.

`strip_theory` (Haines and Ollerton 1963; Kalker 1967; thesis Eqs. 4.14-4.26) is the same with its own coefficients and
without the march. In slip each strip has one direction: that of the traction where stick ends (4.23) or, where the
whole strip slips, that of the rigid slip at its middle (4.25). So its force jumps where a strip begins to slip under
combined creepage, as published.

The departures from the thesis were each measured on elliptic cases against CONTACT (mean force error over mu N;
accuracy.md; the published method has .0164):

* The longitudinal term of a strip is its C11-scaled local creepage vx - phi·y (moment error .0138 → .0122).
* The stick zone is continued through |psi| = 1 where lateral creepage opposes spin (`strip_theory.stick_zone`; .0175 →
  .0148). It is left gradually where its leading edge begins to slip (.0138 → .0137; forces jumped there, by up to .046
  as spin rises).
* The single flexibility of a slipping leading edge is Vollebregt's weighted mean, L = (vx² + vy² + c²phi²)/(vx²/L1 + …)
  (theory.md 2.5, "crss"). It is blended in instead of switched, which removes a jump from strip to strip (.0148 →
  .0121).
* The direction pass is of second order (`march`): .0136. The result no longer depends on the number of elements. The
  first-order pass had gained the difference by its error.
* A particle that sticks again in the march, because the rigid slip reverses within the strip, bears the same share of
  the bound as there, not all of it (.0137 → .0136). When it was raised to the bound, its traction reversed at once as
  it passed through zero. Then doubling the strips changed forces by .050 % of mu N instead of .021 % in the mean,
  doubling the elements by .032 % instead of .013 %.
* The factor 1 + (1 - a/b)⁴ on N in the direction pass is left out (no measurable benefit, theory.md 4.2).
"""

import math
from enum import auto

from contact.core import kernel
from contact.kernels import kalker
from contact.kernels.enumerations import Tangential
from contact.kernels.rows import Element, Field, Strip
from contact.kernels.tangential.ellipses import equivalent_ellipse
from contact.kernels.tangential.fastsim import NO_FRICTION
from contact.kernels.tangential.lanes import LANES, N_LANE_ROWS, Now, Row, Varying, after, keep, recall
from contact.kernels.tangential.march import Even, March, march
from contact.kernels.tangential.strip_theory import coefficients, inner_resultants, outer_resultants, stick_zone
from contact.kernels.tangential.varying import begin_varying, soften, varies


class _Lane(Row):
    """Rows of `lanes` after those of the march."""

    A = after(March)
    Y = auto()
    XC = auto()
    BOUND = auto()  # mu p0
    C11 = auto()
    C22 = auto()
    C23 = auto()
    ROOT_ASPECT = auto()  # √(a/b) = a/c
    E = auto()  # half length of the slip zone over a
    KAPPA = auto()
    LAMBDA = auto()
    LAMBDA1 = auto()
    LOAD = auto()  # ∫√(1-s²) over the stick zone, and ∫s√(1-s²)
    MOMENT = auto()
    FLEXIBILITY_X = auto()  # strain over s of a traction mu·p (theory.md 4.3)
    FLEXIBILITY_Y = auto()
    VX = auto()
    VY = auto()
    SPIN = auto()  # phi·a
    STRAIN = auto()  # slip velocity after the stick zone over √((1-s)(2e-1-s)), by strip theory (theory.md 4.3)
    FX = auto()  # sums over the slip zone, over mu p0
    FY = auto()
    MZ = auto()
    POWER = auto()


class _Shown(Row):
    """Rows of `Now` in which `_to_fields` puts the slip velocity."""

    SX = Now.SLIP
    SY = Now.SLIDES


#: Squared share of the bound up to which a particle of the slip zone counts as sticking again.
_AT_BOUND = 1.0 - 1e-9


@kernel
def _set_block(part, block, case, c_patch, workspace):
    """Fill `lanes` for the strips from `block` on: amended strip theory (theory.md 4.1) and the input of their march."""
    strips, lanes, table = workspace.strips, workspace.space.lanes, workspace.tables.kalker
    G, nu = case.G, case.nu
    least = NO_FRICTION * G
    for l in range(LANES):
        i = min(block + l, part.last - 1)
        a, bound = strips[Strip.A, i], case.mu * strips[Strip.BOUND, i]
        lanes[_Lane.A + l], lanes[_Lane.Y + l] = a, strips[Strip.Y, i]
        lanes[_Lane.XC + l] = strips[Strip.XC, i] - strips[Strip.OFFSET, i]  # as in `mapped_lanes`
        lanes[_Lane.VX + l], lanes[_Lane.VY + l], lanes[_Lane.SPIN + l] = (
            strips[Strip.VX, i],
            strips[Strip.VY, i],
            strips[Strip.PHI, i],
        )
        lanes[_Lane.BOUND + l] = bound if a > 0.0 and bound > least else 0.0
        c11, c22, c23, _ = kalker.coefficients(table, strips[Strip.ASPECT, i])
        root_aspect = math.exp(0.5 * strips[Strip.ASPECT, i])
        if case.tangential == Tangential.STRIP_THEORY:
            c11, c22, c23 = coefficients(root_aspect, nu)
        lanes[_Lane.C11 + l], lanes[_Lane.C22 + l], lanes[_Lane.C23 + l], lanes[_Lane.ROOT_ASPECT + l] = (
            c11,
            c22,
            c23,
            root_aspect,
        )
    for l in range(LANES):
        a, y, xc, bound = lanes[_Lane.A + l], lanes[_Lane.Y + l], lanes[_Lane.XC + l], lanes[_Lane.BOUND + l]
        c11, c22, c23, root_aspect = (
            lanes[_Lane.C11 + l],
            lanes[_Lane.C22 + l],
            lanes[_Lane.C23 + l],
            lanes[_Lane.ROOT_ASPECT + l],
        )
        rigid_x, rigid_y, phi = lanes[_Lane.VX + l], lanes[_Lane.VY + l], lanes[_Lane.SPIN + l]
        spin2 = (phi * c_patch) ** 2
        at_x, at_y = rigid_x - phi * part.y, rigid_y + phi * part.x  # at the patch's place, about which the spin counts
        live = 1.0 if bound > 0.0 else 0.0
        unit = live * G / (bound + (1.0 - live))  # no slip in a strip that carries no load
        across = c23 / root_aspect
        # directions from the parabola of peak 4/3 mu p0 (theory.md 4.4). Its three stiffnesses, a/(flexibility·bound), are
        # blended into a single one as the leading edge begins to slip. `edge` is the utilisation of the bound there, in the
        # limit where both vanish. Beyond 1 the thesis repeats the strip with one flexibility.
        L1, L2, L3 = 0.28125 * unit * c11, 0.28125 * unit * c22, 3.0 / math.pi * unit * across
        x, z = at_x * L1 - phi * (y - part.y) * L3, at_y * L2 + phi * (xc - part.x + a) * L3
        w = math.sqrt(x * x + z * z) - 1.0  # 2 edge - 1
        w = 0.5 * (w + abs(w))
        w = w if w < 1.0 else 1.0
        single = w * (at_x * at_x + at_y * at_y + spin2) / (at_x * at_x * L1 + at_y * at_y * L2 + spin2 * L3 + 1e-300)
        L1, L2, L3 = L1 / (1.0 - w + single * L1), L2 / (1.0 - w + single * L2), L3 / (1.0 - w + single * L3)
        lanes[March.X + l] = at_x * L1 - phi * (y - part.y) * L3
        lanes[March.Y + l] = at_y * L2 + phi * (xc - part.x) * L3
        lanes[March.Z + l] = phi * a * L3
        vx, vy = rigid_x - phi * y, rigid_y + phi * xc
        lanes[_Lane.VX + l], lanes[_Lane.VY + l], lanes[_Lane.SPIN + l] = vx, vy, phi * a
        lanes[_Lane.FLEXIBILITY_X + l] = 0.5 * math.pi**2 * bound / (G * c11)
        lanes[_Lane.FLEXIBILITY_Y + l] = 0.5 * math.pi**2 * bound / (G * c22)
        amended = -2.0 * (1.0 - nu) / math.pi**2 * unit
        lanes[_Lane.KAPPA + l], lanes[_Lane.LAMBDA + l] = amended * c11 * vx, amended * c22 * vy
        lanes[_Lane.LAMBDA1 + l] = -1.5 / math.pi * a * across * phi * unit  # psi
    for l in range(LANES):
        e, kappa, lam, lam1 = 1.0, 0.0, 0.0, 0.0
        if lanes[_Lane.BOUND + l] > 0.0:
            e, kappa, lam, lam1 = stick_zone(
                lanes[_Lane.KAPPA + l], lanes[_Lane.LAMBDA + l], lanes[_Lane.LAMBDA1 + l], nu
            )
        lanes[_Lane.E + l], lanes[_Lane.KAPPA + l], lanes[_Lane.LAMBDA + l], lanes[_Lane.LAMBDA1 + l] = (
            e,
            kappa,
            lam,
            lam1,
        )
        lanes[_Lane.LOAD + l], lanes[_Lane.MOMENT + l] = outer_resultants(e)
        lanes[_Lane.STRAIN + l] = math.sqrt(
            (lanes[_Lane.FLEXIBILITY_X + l] * kappa) ** 2 + (lanes[_Lane.FLEXIBILITY_Y + l] * lam1) ** 2
        )


@kernel
def _keep_direction(lanes, trace):
    """Fill `trace` with one direction of slip for each strip, as in strip theory (thesis 4.23-4.26). No march is made."""
    for l in range(LANES):
        lanes[March.START + l], lanes[March.CAME + l] = 0.0, -2.0
        x, y = lanes[_Lane.KAPPA + l], lanes[_Lane.LAMBDA + l]
        if lanes[_Lane.E + l] >= 1.0:
            x, y = -lanes[_Lane.VX + l], -lanes[_Lane.VY + l]
        lanes[Now.X + l], lanes[Now.Y + l], lanes[Now.SLIDES + l] = x, y, 0.0
    for k in range(trace.shape[0]):
        keep(lanes, trace[k])


@kernel
def _slip(lanes, l, s):
    """Return the slip over V at s against the direction of lane l; 0 where the particle sticks again.

    After a stick zone it is strip theory's. In a strip that slips as a whole it is rigid and elastic slip.
    """
    ex, ey = lanes[Now.X + l], lanes[Now.Y + l]
    slides = 1.0 if ex * ex + ey * ey > _AT_BOUND else 0.0
    sx = lanes[_Lane.VX + l] + lanes[_Lane.FLEXIBILITY_X + l] * ex * s
    sy = lanes[_Lane.VY + l] + (lanes[_Lane.SPIN + l] + lanes[_Lane.FLEXIBILITY_Y + l] * ey) * s
    slip = -(sx * ex + sy * ey)
    slip = slip if slip > 0.0 and lanes[_Lane.E + l] >= 1.0 else 0.0
    behind = 2.0 * lanes[_Lane.E + l] - 1.0 - s
    return slides * (slip + lanes[_Lane.STRAIN + l] * math.sqrt((1.0 - s) * 0.5 * (behind + abs(behind))))


@kernel
def _slip_zone(elements, lanes, trace, falling, block, n, fields):
    """Sum the slip zones of a block: the magnitude mu·p is exact over each element, the direction is that of the march.

    A particle that sticks again in the march, because the rigid slip reverses, bears the same share of the bound as
    there. After a stick zone the slip is strip theory's. In strips that slip as a whole it is rigid and elastic slip
    against the traction. `fields` of the `n` strips are filled if they have room. `falling` is the case where friction
    varies along the strip, or None. numba compiles each on its own, the second without the code for varying friction.
    """
    for l in range(LANES):
        lanes[_Lane.FX + l], lanes[_Lane.FY + l], lanes[_Lane.MZ + l], lanes[_Lane.POWER + l] = 0.0, 0.0, 0.0, 0.0
    load_before, moment_before = 0.0, 0.0
    for k in range(elements.shape[1]):
        s, weight = elements[Element.S, k], elements[Element.SINE, k] * elements[Element.DX, k]
        load_end, moment_end = elements[Element.LOAD_END, k], elements[Element.MOMENT_END, k]
        recall(lanes, trace[k])
        sticks = 0
        for l in range(lanes.size // N_LANE_ROWS):  # as in `_normalise`, so that it is not unrolled
            sticks += 1 if lanes[Now.SLIDES + l] < 0.5 and load_end > lanes[_Lane.LOAD + l] else 0
        if sticks > 0:
            _normalise(s, lanes)
        if falling is not None:
            for l in range(LANES):
                slip = _slip(lanes, l, s)
                lanes[Varying.SLIP + l], lanes[Varying.FLUX + l] = (
                    slip,
                    lanes[Varying.HEATING + l] * elements[Element.SINE, k] * slip,
                )
                lanes[Now.STICK + l] = 0.0  # the sums take only the part after the stick zone
            soften(falling, k, elements, lanes, trace)
        for l in range(LANES):
            load_from, ex, ey = lanes[_Lane.LOAD + l], lanes[Now.X + l], lanes[Now.Y + l]
            first = load_before if load_before > load_from else load_from
            last = load_end if load_end > load_from else load_from
            moment_from = lanes[_Lane.MOMENT + l]
            moment_start = moment_before if load_before > load_from else moment_from
            share, share_s = last - first, moment_end - moment_start
            share_s = share_s if load_end > load_from else 0.0
            slip, amount = _slip(lanes, l, s), weight
            if falling is not None:
                fall = lanes[Varying.FALL + l]
                share, share_s, amount = share * fall, share_s * fall, weight * fall
            lanes[_Lane.FX + l] += share * ex
            lanes[_Lane.FY + l] += share * ey
            lanes[_Lane.MZ + l] += share_s * ey
            lanes[_Lane.POWER + l] += amount * slip
            lanes[Now.SLIP + l] = slip
        if n <= fields.shape[1]:  # else only forces are wanted
            _to_fields(s, elements[Element.SINE, k], lanes, falling)
            _write(k, block, n, lanes, fields)
        load_before, moment_before = load_end, moment_end


@kernel
def _normalise(s, lanes):
    """Divide the traction that the march leaves in stick by its largest utilisation of the bound so far.

    Before slip that is the present utilisation or that of the leading edge, because the utilisation is convex in 1/(1 +
    s). After slip it is 1.
    """
    for l in range(lanes.size // N_LANE_ROWS):
        x, y, start = lanes[Now.X + l], lanes[Now.Y + l], lanes[March.START + l]
        used = x * x + y * y
        most = used if used > start else start
        most = 1.0 if s < lanes[March.CAME + l] else most
        per_most = 1.0 / (math.sqrt(most) + 1e-300)
        lanes[Now.X + l], lanes[Now.Y + l] = x * per_most, y * per_most


@kernel
def _to_fields(s, sine, lanes, falling):
    """Replace the output of the march by that of the fields: traction over mu p0, slip velocity, and 1 in stick."""
    per_square, sticks = 1.0 / (sine * sine), 0
    for l in range(lanes.size // N_LANE_ROWS):
        ex, ey, slip = lanes[Now.X + l], lanes[Now.Y + l], lanes[Now.SLIP + l]
        stick = 1.0 if s > 2.0 * lanes[_Lane.E + l] - 1.0 else 0.0
        sticks += 1 if stick > 0.5 else 0
        again = 1.0 if ex * ex + ey * ey <= _AT_BOUND else 0.0
        size = sine
        if falling is not None:
            size = sine * lanes[Varying.FALL + l]
        lanes[Now.X + l], lanes[Now.Y + l] = size * ex, size * ey
        lanes[_Shown.SX + l], lanes[_Shown.SY + l] = -slip * ex, -slip * ey
        lanes[Now.STICK + l] = again if again > stick else stick
    if sticks == 0:
        return
    beyond = 0
    for l in range(lanes.size // N_LANE_ROWS):
        e = lanes[_Lane.E + l]
        stick = 1.0 if s > 2.0 * e - 1.0 else 0.0
        S2 = (1.0 - e) * (1.0 - e) - (s - e) * (s - e)
        S = math.sqrt(0.5 * (S2 + abs(S2)))  # no selection: the compiler would make a branch around the root
        qx, qy = lanes[_Lane.KAPPA + l] * (sine - S), lanes[_Lane.LAMBDA + l] * sine - lanes[_Lane.LAMBDA1 + l] * S
        lanes[Now.X + l] += stick * (qx - lanes[Now.X + l])
        lanes[Now.Y + l] += stick * (qy - lanes[Now.Y + l])
        beyond += 1 if stick * (qx * qx + qy * qy) * per_square > 1.0 else 0
    if beyond > 0:
        _scale_to_bound(per_square, lanes)


@kernel
def _scale_to_bound(per_square, lanes):
    """Scale the traction to the bound where that of strip theory's stick zone exceeds it.

    This is for the fields. The closed-form resultants do not need it.
    """
    for l in range(lanes.size // N_LANE_ROWS):
        qx, qy, stick = lanes[Now.X + l], lanes[Now.Y + l], lanes[Now.STICK + l]
        used = stick * (qx * qx + qy * qy) * per_square
        per_excess = 1.0 / math.sqrt(used if used > 1.0 else 1.0)
        lanes[Now.X + l], lanes[Now.Y + l] = qx * per_excess, qy * per_excess


@kernel
def _write(k, block, n, lanes, fields):
    """Fill traction, slip and stick flag of element k of a block's strips. A strip that carries no load gets zeros."""
    for l in range(min(LANES, n - block)):
        row, bound = block + l, lanes[_Lane.BOUND + l]
        live = 1.0 if bound > 0.0 else 0.0
        fields[Field.QX, row, k], fields[Field.QY, row, k] = bound * lanes[Now.X + l], bound * lanes[Now.Y + l]
        fields[Field.SX, row, k], fields[Field.SY, row, k] = live * lanes[_Shown.SX + l], live * lanes[_Shown.SY + l]
        fields[Field.STICK, row, k] = live * lanes[Now.STICK + l]


@kernel
def fastrip(part, case, workspace, result):
    """Fill the traction, slip and stick fields of one patch. Add its forces, power and slip area to `result`."""
    strips, fields, elements, last = workspace.strips, workspace.fields, workspace.rule.elements, part.last
    lanes, trace = workspace.space.lanes, workspace.space.trace
    a0, b0 = equivalent_ellipse(strips, part.first, last)
    c_patch = math.sqrt(a0 * b0)
    Fx, Fy, Mz, power, slip_area = 0.0, 0.0, 0.0, 0.0, 0.0
    for block in range(part.first, last, LANES):
        _set_block(part, block, case, c_patch, workspace)
        if case.tangential == Tangential.STRIP_THEORY:
            _keep_direction(lanes, trace)
        else:
            march(Even(False), elements, lanes, trace)
        if varies(case):
            begin_varying(strips, block, last, case, lanes[_Lane.BOUND : _Lane.BOUND + LANES], lanes)
            _slip_zone(elements, lanes, trace, case, block, last, fields)
        else:
            _slip_zone(elements, lanes, trace, None, block, last, fields)
        for l in range(min(LANES, last - block)):
            i = block + l
            a, dy, y, xc = strips[Strip.A, i], strips[Strip.DY, i], strips[Strip.Y, i], strips[Strip.XC, i]
            bound, e = lanes[_Lane.BOUND + l], lanes[_Lane.E + l]
            slip_area += 2.0 * a * e * dy
            if bound == 0.0:
                continue
            outer, outer_s = lanes[_Lane.LOAD + l], lanes[_Lane.MOMENT + l]
            inner, inner_s = inner_resultants(e)
            strip = bound * a * dy
            fx = strip * (lanes[_Lane.KAPPA + l] * (outer - inner) + lanes[_Lane.FX + l])
            fy = strip * (lanes[_Lane.LAMBDA + l] * outer - lanes[_Lane.LAMBDA1 + l] * inner + lanes[_Lane.FY + l])
            mz = (
                strip
                * a
                * (lanes[_Lane.LAMBDA + l] * outer_s - lanes[_Lane.LAMBDA1 + l] * inner_s + lanes[_Lane.MZ + l])
            )
            Fx += fx
            Fy += fy
            Mz += mz + xc * fy - y * fx
            power += strip * lanes[_Lane.POWER + l]
    result.Fx += Fx
    result.Fy += Fy
    result.Mz += Mz
    result.power += power
    result.slip_area += slip_area
