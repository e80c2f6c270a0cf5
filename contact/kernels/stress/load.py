"""Pressure and traction between strips: at points, and on a grid of equal elements.

Along a strip the pressure is semi-elliptic, limited to the material's limit. Across the strips a² and p0·a are interpolated by
the parabola through the nearest three strips or edges. Both vanish at the edges of a patch. This is exact for an ellipse.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import LoadGrid, Numbers, PatchFields, PatchStrips
from contact.kernels.normal.press import share_of

#: Halvings that find the elastic pressure behind a limited one.
_HALVINGS = 50


@kernel
def _parabola(part, low, high, y):
    """Return a² and p0·a of the section at `y` of a patch from `low` to `high`, from the nearest three strips or edges."""
    n, i = part.y.size, 0
    while i < n and part.y[i] < y:
        i += 1
    before, after = part.y[i - 1] if i > 0 else low, part.y[i] if i < n else high
    i = min(max(i + int(y - before > after - y), 1), n) - 1
    u, v, w = part.y[i - 1] if i > 0 else low, part.y[i], part.y[i + 1] if i < n - 1 else high
    of_u = (y - v) * (y - w) / ((u - v) * (u - w)) if i > 0 else 0.0
    of_v = (y - u) * (y - w) / ((v - u) * (v - w))
    of_w = (y - u) * (y - v) / ((w - u) * (w - v)) if i < n - 1 else 0.0
    a, b, c = part.a[max(i - 1, 0)], part.a[i], part.a[min(i + 1, n - 1)]
    p, q, r = part.p0[max(i - 1, 0)], part.p0[i], part.p0[min(i + 1, n - 1)]
    return max(of_u * a * a + of_v * b * b + of_w * c * c, 0.0), max(of_u * p * a + of_v * q * b + of_w * r * c, 0.0)


@kernel
def _elastic(peak, limit):
    """Return the elastic peak whose limited pressure has the load of a semi-ellipse with this peak [Pa]."""
    if not 0.0 < limit < math.inf or peak <= limit:
        return peak
    low, high = peak, 4.0 / math.pi * peak  # the load of an infinite peak is that of a rectangle
    while high * share_of(high, limit) < peak:
        low, high = high, 2.0 * high
        if high > 1e4 * peak:
            return high
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if middle * share_of(middle, limit) < peak:
            low = middle
        else:
            high = middle
    return high


@kernel
def _section(part, low, high, limit, y):
    """Return a² and the peak of the elastic pressure at `y`; a² = 0 outside the patch."""
    if not low < y < high:
        return 0.0, 0.0
    a2, load = _parabola(part, low, high, y)
    if not a2 > 0.0:
        return 0.0, 0.0
    return a2, _elastic(load / math.sqrt(a2), limit)


@kernel
def _pressure(a2, peak, limit, x):
    """Return the pressure at the distance x from the middle of a section."""
    square = a2 - x * x
    if not square > 0.0:
        return 0.0
    p = peak * math.sqrt(square / a2)
    return min(p, limit) if limit > 0.0 else p


@kernel
def _place(values, at, start):
    """Return i and t: `at` is values[i] + t (values[i + 1] - values[i]), or an end beyond it. Values increase from `start`."""
    n, i = values.size, start
    while i < n - 1 and values[i + 1] < at:
        i += 1
    if i == n - 1:
        return i, 0.0
    return i, min(max((at - values[i]) / (values[i + 1] - values[i]), 0.0), 1.0)


@kernel
def _between(values, i, t):
    return values[i] if t == 0.0 else values[i] + t * (values[i + 1] - values[i])


@kernel
def _ratio(p, q, i, k):
    """Return traction over pressure of element k of strip i."""
    return q[i, k] / p[i, k] if p[i, k] > 0.0 else 0.0


@kernel
def _share(p, q, i, t, k, u):
    """Return traction over pressure between strips i, i + 1 and elements k, k - 1."""
    here, next_i, next_k = _ratio(p, q, i, k), i if t == 0.0 else i + 1, k if u == 0.0 else k - 1
    here += t * (_ratio(p, q, next_i, k) - here)
    before = _ratio(p, q, i, next_k)
    before += t * (_ratio(p, q, next_i, next_k) - before)
    return here + u * (before - here)


@entry
def add_pressures(
    part: PatchStrips, low: float, high: float, limit: float, x: Numbers, y: Numbers, out: Numbers
) -> None:
    """Add the pressure [Pa] of one patch from `low` to `high` [m] at points x, y [m]. A `limit` of 0 means none."""
    for k in range(out.size):
        a2, peak = _section(part, low, high, limit, y[k])
        if a2 > 0.0:
            i, t = _place(part.y, y[k], 0)
            out[k] += _pressure(a2, peak, limit, x[k] - _between(part.x_c, i, t))


@entry
def add_load(part: PatchStrips, fields: PatchFields, low: float, high: float, limit: float, load: LoadGrid) -> None:
    """Add pressure and traction of one patch [Pa] at the centres of a grid's elements.

    Traction over pressure is interpolated linearly between the centres of the strips' elements, which lie at the same places
    relative to their strip. So the traction stays within friction.
    """
    m = fields.x.shape[1]
    for row in range(load.y.size):
        a2, peak = _section(part, low, high, limit, load.y[row])
        if not a2 > 0.0:
            continue
        i, t = _place(part.y, load.y[row], 0)
        middle, half, k = _between(part.x_c, i, t), _between(part.a, i, t), m - 1
        for column in range(load.x.size):
            p = _pressure(a2, peak, limit, load.x[column] - middle)
            if not p > 0.0:
                continue
            s = (load.x[column] - middle) / half
            while k > 0 and (fields.x[0, k - 1] - part.x_c[0]) / part.a[0] < s:  # elements begin at the leading edge
                k -= 1
            at, ahead = (
                (fields.x[0, k] - part.x_c[0]) / part.a[0],
                (fields.x[0, max(k - 1, 0)] - part.x_c[0]) / part.a[0],
            )
            u = min(max((s - at) / (ahead - at), 0.0), 1.0) if k > 0 else 0.0
            load.p[row, column] += p
            load.qx[row, column] += p * _share(fields.p, fields.qx, i, t, k, u)
            load.qy[row, column] += p * _share(fields.p, fields.qy, i, t, k, u)


@entry
def place_centres(low: float, high: float, out: Numbers) -> None:
    """Fill the centres of equal elements from `low` to `high`."""
    for i in range(out.size):
        out[i] = low + (i + 0.5) * ((high - low) / out.size)


@entry
def scale_load(load: LoadGrid, N: float) -> bool:
    """Scale pressure and traction so that they carry the normal force `N` [N]. Return False if there is no pressure."""
    ny, nx = load.p.shape
    area = (load.x[nx - 1] - load.x[0]) / (nx - 1) * ((load.y[ny - 1] - load.y[0]) / (ny - 1))
    total = 0.0
    for i in range(ny):
        for j in range(nx):
            total += load.p[i, j]
    if not total > 0.0:
        return False
    factor = N / (total * area)
    for i in range(ny):
        for j in range(nx):
            load.p[i, j] *= factor
            load.qx[i, j] *= factor
            load.qy[i, j] *= factor
    return True
