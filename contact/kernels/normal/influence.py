"""Normal displacement by a strip with semi-elliptic pressure: tables and their lookup (strip_halfspace.md 1).

A strip |x| <= a with p = p0·√(1 - (x/a)²) between lateral distances t1·a and t2·a displaces the surface at x = X·a by

    u = p0 a/(pi E*)·[U(X, t2) - U(X, t1)],   U(X, t) = ∫√(1-s²) asinh(t/|X-s|) ds over [-1, 1].

U is odd in t, even in X and finite everywhere, so the displacement of a strip by itself needs no special case. On the
centre line dU/dt has the closed form 2√(1+t²)(K(m) - E(m)), m = 1/(1+t²).
"""

import math

import numpy as np

from contact.core import entry, kernel
from contact.kernels import cubic
from contact.kernels.arrays import Cube, Matrix, Numbers
from contact.kernels.hertz import elliptic_integrals

_LN_T_MIN, _LN_T_MAX = math.log(1e-5), math.log(1e5)
_N_CENTRE = 401
_CENTRE_STEP = (_LN_T_MAX - _LN_T_MIN) / (_N_CENTRE - 1)
_PER_CENTRE_STEP = 1.0 / _CENTRE_STEP

X_MAX, N_X = 4.0, 201
_X_STEP = X_MAX / (N_X - 1)
PER_X_STEP = 1.0 / _X_STEP
#: Below the 150th value of ln t, t = 1.1e-3, U is nearly proportional to t.
_LN_T_HIGH, T_STEP = math.log(1e2), 0.03
_N_PROPORTIONAL, N_T = 150, 534
LN_T_LOW, PER_T_STEP = _LN_T_HIGH - (N_T - 1) * T_STEP, 1.0 / T_STEP

#: Shapes of the two tables. The second has two more rows. Beyond X = 4, U is linear in 1/X² at fixed t/X. These rows hold its
#: values at 1/X² = 0 and 1 over ln(t/X).
CENTRE, PLANE = (_N_CENTRE, 2), (N_X + 2, N_T)

#: Strips of one panel lie at fixed cosines, so their influence depends only on ln(a/half width of the panel). Range and step of
#: the table of this influence, which has one more row at either end.
_LN_A_LOW, _LN_A_HIGH, _LN_A_STEP = -7.0, 4.0, 0.125
N_COLUMNS = round((_LN_A_HIGH - _LN_A_LOW) / _LN_A_STEP) + 3
#: Panels of more strips do not use this table. Its size grows with the square of their number (7 MB at 100).
MOST_TABULATED = 100

_GAUSS_X, _GAUSS_W = np.polynomial.legendre.leggauss(6)


@kernel
def centre_slope(t):
    """Return dU/dt on the centre line, X = 0 (closed form)."""
    root = math.sqrt(1.0 + t * t)
    K, E, _, _ = elliptic_integrals(t / root)  # complementary modulus; K - E = k² D
    return 2.0 * root * (K - E)


@kernel
def _panel(X, t, low, high):
    """Return ∫sin² asinh(t/|X - cos|) over a range of the angle, by six Gauss points."""
    total = 0.0
    for i in range(6):
        angle = 0.5 * (low + high + (high - low) * _GAUSS_X[i])
        sine = math.sin(angle)
        distance = abs(X - math.cos(angle))
        total += _GAUSS_W[i] * sine * sine * math.asinh(t / max(distance, 1e-300))
    return 0.5 * (high - low) * total


@kernel
def quadrature(X, t):
    """Return U(X, t) by Gauss panels graded geometrically towards the singular angle.

    The relative error is 1e-5 or less.
    """
    singular = math.acos(min(X, 1.0))
    total = 0.0
    for side in range(2):
        length = singular if side == 0 else math.pi - singular
        sign = -1.0 if side == 0 else 1.0
        outer = 1.0
        for _ in range(18):
            inner = 0.5 * outer
            total += _panel(X, t, singular + sign * outer * length, singular + sign * inner * length) * -sign
            outer = inner
        total += _panel(X, t, singular + sign * outer * length, singular) * -sign
    return total


@kernel
def fill(centre, plane):
    """Fill the tables of U on the centre line and over (X, ln t), of the shapes CENTRE and PLANE."""
    value = math.exp(_LN_T_MIN) * 2.0 * (math.log(4.0) - _LN_T_MIN)  # U ~ 2t ln(4/t)
    for i in range(_N_CENTRE):
        t = math.exp(_LN_T_MIN + i * _CENTRE_STEP)
        if i > 0:  # six-point Gauss of dU/d(ln t) = t U' over the last interval
            before = _LN_T_MIN + (i - 1) * _CENTRE_STEP
            for k in range(6):
                at = math.exp(before + 0.5 * _CENTRE_STEP * (1.0 + _GAUSS_X[k]))
                value += 0.5 * _CENTRE_STEP * _GAUSS_W[k] * at * centre_slope(at)
        centre[i, 0], centre[i, 1] = value, t * centre_slope(t) * _CENTRE_STEP
    for i in range(N_X):
        for k in range(_N_PROPORTIONAL, N_T):
            plane[i, k] = quadrature(i * _X_STEP, math.exp(LN_T_LOW + k * T_STEP))
        for k in range(_N_PROPORTIONAL):
            plane[i, k] = plane[i, _N_PROPORTIONAL] * math.exp((k - _N_PROPORTIONAL) * T_STEP)
    for k in range(N_T):
        t = math.exp(LN_T_LOW + k * T_STEP)
        plane[N_X, k] = 0.5 * math.pi * math.asinh(t)
        plane[N_X + 1, k] = plane[N_X, k] + math.pi / 16.0 * t * (2.0 + t * t) / (1.0 + t * t) ** 1.5


@entry
def at_centre(centre: Matrix, log_t: float) -> float:
    """Return U(0, t) for t > 0 given by its logarithm. The error is below 1e-7."""
    u = (log_t - _LN_T_MIN) * _PER_CENTRE_STEP
    if not u > 0.0:  # written so that NaN does not become an index, here and below
        t = math.exp(log_t)
        return 2.0 * t * (math.log(4.0) - log_t)
    if u >= _N_CENTRE - 1:
        return centre[_N_CENTRE - 1, 0] + 0.5 * math.pi * (log_t - _LN_T_MAX)
    i = int(u)
    p, q = centre[i], centre[i + 1]
    return cubic.value(1.0, p[0], p[1], q[0], q[1], u - i)


@entry
def fill_columns(cosine_logs: Matrix, centre: Matrix, columns: Cube) -> None:
    """Fill columns[ln(a_j/half width), j, i] with U(0, t2) - U(0, t1) of strip j at the middle of strip i of one panel."""
    n = cosine_logs.shape[0]
    for m in range(columns.shape[0]):
        ln_a = _LN_A_LOW + (m - 1) * _LN_A_STEP
        for j in range(n):
            for i in range(n):
                near, far = at_centre(centre, cosine_logs[i, j] - ln_a), at_centre(centre, cosine_logs[i, j + 1] - ln_a)
                columns[m, j, i] = near + far if i == j else abs(far - near)


@entry
def column(columns: Cube, j: int, ln_a: float, scale: float, factors: Numbers, out: Numbers) -> None:
    """Fill `out` with U(0, t2) - U(0, t1) of strip j at all strips of its panel, times `scale` and `factors`.

    The interpolation is cubic in ln(a_j/half width). Its error is 3e-6.
    """
    u = (ln_a - _LN_A_LOW) * (1.0 / _LN_A_STEP)
    u = u if u > 0.0 else 0.0
    u = min(u, N_COLUMNS - 3.000001)
    m = int(u)
    t = u - m
    f0, f1 = -t * (t - 1.0) * (t - 2.0) / 6.0 * scale, (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0 * scale
    f2, f3 = -(t + 1.0) * t * (t - 2.0) / 2.0 * scale, (t + 1.0) * t * (t - 1.0) / 6.0 * scale
    c0, c1, c2, c3 = columns[m, j], columns[m + 1, j], columns[m + 2, j], columns[m + 3, j]
    for i in range(out.size):
        out[i] = (f0 * c0[i] + f1 * c1[i] + f2 * c2[i] + f3 * c3[i]) * factors[i]


@kernel
def row_at(X, ln_X):
    """Return the row of the plane's table for X >= 0, the share of the next row, and the origin of its ln t (for `in_row`)."""
    if not X < X_MAX:
        return N_X, 1.0 / (X * X), ln_X
    u = X * PER_X_STEP
    i = min(int(u), N_X - 2)
    return i, u - i, 0.0


@kernel
def logarithm(X):
    """Return ln X where `row_at` needs it, else 0."""
    return math.log(X) if X >= X_MAX else 0.0


@kernel
def in_row(plane, i, u, log_t):
    """Return U(X, t) for t > 0 at the row and share given by `row_at`.

    The interpolation is bilinear. Beyond the table's range of t, U is logarithmic.
    """
    v = (log_t - LN_T_LOW) * PER_T_STEP
    v = v if v > 0.0 else 0.0  # written so that NaN does not become an index
    extra = 0.5 * math.pi * T_STEP * max(v - (N_T - 1.0), 0.0)
    v = min(v, N_T - 1.000001)
    k = int(v)
    v -= k
    low = plane[i, k] + v * (plane[i, k + 1] - plane[i, k])
    high = plane[i + 1, k] + v * (plane[i + 1, k + 1] - plane[i + 1, k])
    return low + u * (high - low) + extra


@kernel
def off_line(centre, plane, X, log_far, log_near):
    """Return U(X, t2) - U(X, t1) for t2 > t1 > 0 given by their logarithms.

    Up to X = 4 the table over X gives only what differs from the centre line. Linear interpolation in ln t would put errors
    of up to 1 % into the influence of narrow and distant strips, whose sides lie within one step of the table.
    """
    i, u, ln_X = row_at(X, logarithm(X))
    if i == N_X:
        return in_row(plane, i, u, log_far - ln_X) - in_row(plane, i, u, log_near - ln_X)
    far = at_centre(centre, log_far) + (in_row(plane, i, u, log_far) - in_row(plane, 0, 0.0, log_far))
    return far - (at_centre(centre, log_near) + (in_row(plane, i, u, log_near) - in_row(plane, 0, 0.0, log_near)))


@entry
def anywhere(plane: Matrix, X: float, log_t: float) -> float:
    """Return U(X, t) for X >= 0, t > 0. The error is below 1e-3."""
    i, u, ln_X = row_at(X, logarithm(X))
    return in_row(plane, i, u, log_t - ln_X)
