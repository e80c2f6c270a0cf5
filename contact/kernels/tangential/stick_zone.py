"""Force of the first stick zone of each strip, and of the slip zones up to its ends (mapped_strip.md 3, step 4).

In stick the mapped traction differs from friction by √(1 - t), which falls to 0 at the ends of the zone. A sum over fixed
elements has a kink like a square root there whenever an end passes an element. So the traction of the zone, which is known
in closed form, is integrated over the zone itself with s = (s_a + s_e)/2 + (s_a - s_e)/2 cos(phi), in which it is smooth. In
slip the sum over elements is completed up to the ends of the zone by the trapezoidal rule with Euler and Maclaurin's
correction. Both are continuous, with their slopes, where an end passes an element.

A strip has at most one such zone. Particles that stick once more later stay with the sum over elements.
"""

import math

from contact.core import kernel
from contact.kernels.rows import Element
from contact.kernels.tangential.lanes import marching
from contact.kernels.tangential.mapped_lanes import Lane
from contact.kernels.tangential.mapping import mapped
from contact.kernels.tangential.march import March

#: 1 + cos(phi) and sin(phi) dphi: Gauss and Legendre's rule in z from 0 to 1, phi = pi (z + .7 z (1 - z)).
_NODES = (
    1.9909717274555447,
    1.793976227511992,
    1.1773327369538231,
    0.47750143528405115,
    0.11028313676956125,
    0.012539450847600239,
    0.00032272168162099753,
)
_WEIGHTS = (
    0.04538636756720337,
    0.4057570126496589,
    0.7579624777615576,
    0.5597827816992204,
    0.19601998918781852,
    0.03335718919644785,
    0.0017341507921020266,
)


@kernel
def _arc(z):
    """Return artanh z, to 1e-5 for z <= 1/2."""
    z2 = z * z
    return z * (15.0 - 4.0 * z2) / (15.0 - 9.0 * z2)


@kernel
def end_zone(place, lanes):
    """Set direction and share of the step of the strips that begin to slide, in most steps one or two."""
    s, step = place[0], place[1]
    before = s + step
    whole = 1.0 if before >= 1.0 else _arc(step / (1.0 - s * before))
    for l in range(marching(lanes)):
        used = lanes[March.TRIAL_USED + l]
        if not (used > 1.0 and lanes[March.SLIPS + l] < 0.5):
            continue
        X, Y, P = lanes[March.X + l], lanes[March.Y + l], 0.5 * lanes[March.Z + l]
        x, y, at_edge = lanes[March.TX + l], lanes[March.TY + l], lanes[Lane.FROM + l] >= 1.0
        first = lanes[Lane.NEXT + l] < -1.5
        if first and at_edge:
            at = lanes[Lane.TO + l] - 1.0
        else:  # interpolate, then one step of Newton's method
            gap = used - lanes[March.USED + l]
            at = before - step * (1.0 - lanes[March.USED + l]) / (gap if gap > 1e-12 else 1.0)
            tx, ty = x - (before - at) * X, y - (before - at) * (Y + P * (before + at))
            bound = 1.0 - at * at
            rise = 2.0 * (tx * X + ty * (Y + 2.0 * P * at)) + 4.0 * at * bound
            at -= (tx * tx + ty * ty - bound * bound) / rise if rise < -1e-12 else 0.0
        at = min(max(at, s), before)
        tx, ty = x - (before - at) * X, y - (before - at) * (Y + P * (before + at))
        per_size = 1.0 / (math.sqrt(tx * tx + ty * ty) + 1e-300)
        lanes[March.EX + l], lanes[March.EY + l] = tx * per_size, ty * per_size
        lanes[March.LEFT + l] = (at - s) / step
        lanes[Lane.ARC + l] = _arc((at - s) / (1.0 - at * s)) / whole
        if first:
            lanes[Lane.TO + l], lanes[Lane.NEXT + l] = 1.0 + at, s


@kernel
def begin_zone(before, s, lanes):
    """Take note of the strips that have slipped from their leading edge and stick within the step from `before` to s."""
    for l in range(marching(lanes)):
        at = lanes[March.AT + l]
        first = at < 1.5 and lanes[Lane.NEXT + l] > 1.5
        over = at - s
        x = lanes[March.TX + l] + over * lanes[March.X + l]
        y = lanes[March.TY + l] + over * (lanes[March.Y + l] + 0.5 * lanes[March.Z + l] * (at + s))
        last_x, last_y, next_s = lanes[March.TRIAL_X + l], lanes[March.TRIAL_Y + l], lanes[Lane.NEXT + l]
        lanes[Lane.FROM + l] = at if first else lanes[Lane.FROM + l]
        lanes[Lane.FROM_X + l] = x if first else lanes[Lane.FROM_X + l]
        lanes[Lane.FROM_Y + l] = y if first else lanes[Lane.FROM_Y + l]
        lanes[Lane.TO + l] = 0.0 if first else lanes[Lane.TO + l]
        lanes[Lane.LAST + l] = (before if before < 1.0 else 2.0) if first else lanes[Lane.LAST + l]
        lanes[Lane.LAST_X + l] = last_x if first else lanes[Lane.LAST_X + l]
        lanes[Lane.LAST_Y + l] = last_y if first else lanes[Lane.LAST_Y + l]
        lanes[Lane.NEXT + l] = -2.0 if first else next_s


@kernel
def _turning(s, ex, ey, lanes, l):
    """Return sin²(theta) times the derivative of the direction of slip over theta."""
    r, Xs, Ys, spin = lanes[Lane.R + l], lanes[Lane.XS + l], lanes[Lane.YS + l], lanes[Lane.SPIN + l]
    c = -s * (1.0 - r)
    wx, wy = Xs + c * ex, Ys + 2.0 * spin * s - c * ey
    inside = 1.0 - s * s
    rate = math.sqrt(0.5 * (inside + abs(inside))) * lanes[Lane.RATE + l] / (r * ey * ey + ex * ex + 1e-300)
    across = rate * (wy * ex - wx * ey)
    return across * ey, -across * ex


@kernel
def _slope(s, sine, e, turning):
    """Return the derivative of sin²(theta) times a component of the direction, and of this times cos(theta)."""
    slope = 2.0 * sine * s * e + turning
    return slope, s * slope - sine * sine * sine * e


@kernel
def _rest(node, end, h, lanes, l):
    """Return what the sum over elements from `node` on lacks of the integral of slip from `end` on, in x, y and moment.

    Both have s, sine of theta, and x and y of direction and turning. The sine of the node is 0 if there is none; slip then
    ends at the edge of the strip, beyond the last element.
    """
    s, sine, ex, ey, tx, ty = end
    s_n, sine_n, nx, ny, ux, uy = node
    # angle between them, from the tangent of its half
    half = (sine_n * s - s_n * sine) / (1.0 + s_n * s + sine_n * sine + 1e-300)
    half2 = half * half
    d = 2.0 * half * (15.0 + 4.0 * half2) / (15.0 + 9.0 * half2)
    d = d if d > 0.0 else 0.0
    d = d if d < h else h
    of_end, of_node = 0.5 * d, 0.5 * (d - h)
    slope_end, slope_node = d * d / 12.0, (h * h - d * d) / 12.0
    square, square_n = sine * sine, sine_n * sine_n
    ax, _ = _slope(s, sine, ex, tx)
    ay, am = _slope(s, sine, ey, ty)
    bx, _ = _slope(s_n, sine_n, nx, ux)
    by, bm = _slope(s_n, sine_n, ny, uy)
    Fx = of_end * square * ex + of_node * square_n * nx + slope_end * ax + slope_node * bx
    Fy = of_end * square * ey + of_node * square_n * ny + slope_end * ay + slope_node * by
    M = of_end * square * s * ey + of_node * square_n * s_n * ny + slope_end * am + slope_node * bm
    return Fx, Fy, M


@kernel
def _beyond(end, h, edge_s, edge_sine, lacks):
    """Return the integral of slip from `end` to the edge of the strip beyond the last element, in x, y and moment.

    `lacks` is what `_beyond` would lack of `_rest` at this element, at (edge_s, edge_sine), for a direction that is
    constant, in force and moment. It fades towards the edge, so that the two are continuous there.
    """
    s, sine, ex, ey, tx, ty = end
    square, of_force, of_moment = sine * sine, lacks[0], lacks[1]
    near = square / (edge_sine * edge_sine)
    near2 = near * near
    cubic = sine * square
    force = cubic * (1.0 / 3.0 + square * (0.1 + square * (3.0 / 56.0))) + near2 * of_force
    moment = -cubic / 3.0 + near2 * of_moment
    turn = h * h / 12.0 * near
    return force * ex + turn * tx, force * ey + turn * ty, moment * ey + s * turn * ty


@kernel
def _add_node(node, weight, lanes):
    """Add one node of the rule to the sums of the stick zones."""
    for l in range(marching(lanes)):
        start, to = lanes[Lane.FROM + l], lanes[Lane.TO + l]
        zone = 1.0 if lanes[Lane.NEXT + l] < 1.5 else 0.0
        to = zone * to
        fx, fy = lanes[Lane.FROM_X + l], lanes[Lane.FROM_Y + l]
        half = 0.5 * (1.0 + start - to)
        above, below = to + half * node, (1.0 - start) + half * (2.0 - node)  # 1 + s, 1 - s
        s, over = above - 1.0, half * (2.0 - node)
        bound = above * below + 1e-30
        per_bound = zone / bound  # without a zone `mapped` could overflow
        x = fx - over * lanes[March.X + l]
        y = fy - over * (lanes[March.Y + l] + 0.5 * lanes[March.Z + l] * (start + s))
        qx, qy = mapped(x * per_bound, y * per_bound, lanes[Lane.POLE + l], lanes[Lane.N + l])
        load = zone * weight * half * math.sqrt(bound)
        lanes[Lane.SUM_X + l] += load * qx
        lanes[Lane.SUM_Y + l] += load * qy
        lanes[Lane.SUM_M + l] += load * s * qy


@kernel
def add_zone(elements, lanes):
    """Add the first stick zone of every strip of a block to its sums, and complete the slip zones at its ends."""
    zones, mirrored = 0, 0
    for l in range(marching(lanes)):
        zones += 1 if lanes[Lane.NEXT + l] < 1.5 else 0
        mirrored += 1 if lanes[Lane.FROM + l] < 1.0 else 0
    if zones == 0:
        return
    n = elements.shape[1]
    h = math.pi / n
    edge_s, edge_sine = elements[Element.S, n - 1], elements[Element.SINE, n - 1]
    square, cubic = edge_sine * edge_sine, edge_sine * edge_sine * edge_sine
    slope, slope_m = _slope(edge_s, edge_sine, 1.0, 0.0)
    lacks = (
        0.5 * h * square + h * h / 12.0 * slope - cubic * (1.0 / 3.0 + square * (0.1 + square * (3.0 / 56.0))),
        0.5 * h * square * edge_s + h * h / 12.0 * slope_m + cubic / 3.0,
    )
    for l in range(marching(lanes)):
        start, to, next_s = lanes[Lane.FROM + l], lanes[Lane.TO + l], lanes[Lane.NEXT + l]
        has = 1.0 if next_s < 1.5 else 0.0
        fx, fy = lanes[Lane.FROM_X + l], lanes[Lane.FROM_Y + l]
        X, Y, P = lanes[March.X + l], lanes[March.Y + l], 0.5 * lanes[March.Z + l]
        s = to - 1.0
        over, inside = start - s, to * (2.0 - to)
        sine = math.sqrt(0.5 * (inside + abs(inside)))
        tx, ty = fx - over * X, fy - over * (Y + P * (start + s))
        size = 1.0 / (math.sqrt(tx * tx + ty * ty) + 1e-300)
        ex, ey = tx * size, ty * size
        ux, uy = _turning(s, ex, ey, lanes, l)
        end = (s, sine, ex, ey, ux, uy)
        slides = next_s > -1.5
        s_n = next_s if slides and next_s < 1.5 else edge_s
        sine_n = math.sqrt(1.0 - s_n * s_n)
        nx, ny = lanes[Lane.NEXT_X + l], lanes[Lane.NEXT_Y + l]
        vx, vy = _turning(s_n, nx, ny, lanes, l)
        ax, ay, am = _rest((s_n, sine_n, nx, ny, vx, vy), end, h, lanes, l)
        bx, by, bm = _beyond(end, h, edge_s, edge_sine, lacks)
        lanes[Lane.SUM_X + l] += has * (ax if slides else bx)
        lanes[Lane.SUM_Y + l] += has * (ay if slides else by)
        lanes[Lane.SUM_M + l] += has * (am if slides else bm)
    if mirrored > 0:
        _add_before(h, edge_s, edge_sine, lacks, lanes)
    # one call a node, since an index into a tuple that is not constant could raise an exception
    _add_node(_NODES[0], _WEIGHTS[0], lanes)
    _add_node(_NODES[1], _WEIGHTS[1], lanes)
    _add_node(_NODES[2], _WEIGHTS[2], lanes)
    _add_node(_NODES[3], _WEIGHTS[3], lanes)
    _add_node(_NODES[4], _WEIGHTS[4], lanes)
    _add_node(_NODES[5], _WEIGHTS[5], lanes)
    _add_node(_NODES[6], _WEIGHTS[6], lanes)


@kernel
def _add_before(h, edge_s, edge_sine, lacks, lanes):
    """Complete the slip zones ahead of the stick zones: `_rest` in a mirror."""
    for l in range(marching(lanes)):
        s, last_s = -lanes[Lane.FROM + l], lanes[Lane.LAST + l]
        has = 1.0 if s > -1.0 and lanes[Lane.NEXT + l] < 1.5 else 0.0
        slides = last_s < 1.5
        x, y = lanes[Lane.FROM_X + l], lanes[Lane.FROM_Y + l]
        size = 1.0 / (math.sqrt(x * x + y * y) + 1e-300)
        ex, ey = x * size, y * size
        ux, uy = _turning(-s, ex, ey, lanes, l)
        end = (s, math.sqrt(1.0 - s * s), ex, ey, -ux, -uy)
        s_n = -last_s if slides else edge_s
        nx, ny = lanes[Lane.LAST_X + l], lanes[Lane.LAST_Y + l]
        vx, vy = _turning(-s_n, nx, ny, lanes, l)
        ax, ay, am = _rest((s_n, math.sqrt(1.0 - s_n * s_n), nx, ny, -vx, -vy), end, h, lanes, l)
        bx, by, bm = _beyond(end, h, edge_s, edge_sine, lacks)
        lanes[Lane.SUM_X + l] += has * (ax if slides else bx)
        lanes[Lane.SUM_Y + l] += has * (ay if slides else by)
        lanes[Lane.SUM_M + l] -= has * (am if slides else bm)
