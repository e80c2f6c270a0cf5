"""Hertz contact by complete elliptic integrals, exact for every aspect ratio (theory.md 1.1; thesis Eqs. 2.10-2.12)."""

import math

import numpy as np

from contact.core import entry, kernel
from contact.kernels.cubic import basis


def _elliptic_integrals(g: float) -> tuple[float, float, float, float]:
    """Return K, E, (E - g²K)/k² and (K - E)/k² for the complementary modulus g in ]0, 1].

    The method is the arithmetic-geometric mean.
    """
    k2 = (1.0 - g) * (1.0 + g)
    p, q, weight, total = 1.0, g, 0.5, 0.5 * k2
    for _ in range(40):
        difference = 0.5 * (p - q)
        p, q = 0.5 * (p + q), math.sqrt(p * q)
        weight *= 2.0
        total += weight * difference * difference
        if difference < 1e-17 * p:
            break
    K = 0.5 * math.pi / p
    E = K * (1.0 - total)
    if k2 < 1e-3:  # the differences below cancel, so series in k² with the error k⁸ are used
        B = 0.25 * math.pi * (1.0 + k2 * (0.125 + k2 * (3.0 / 64.0 + k2 * 25.0 / 1024.0)))
        return K, E, B, K - B  # B + D = K
    return K, E, (E - g * g * K) / k2, (K - E) / k2


def _axis_ratio(curvature_ratio: float) -> float:
    """Return minor over major semi-axis of a Hertz ellipse for the ratio lambda = min(A,B)/max(A,B) of curvatures.

    Newton's method on ln(g² D/B) - ln(lambda) in ln g, kept in a bracket. The limit is 60 iterations; 6 are typical.
    """
    target = math.log(curvature_ratio)
    low, high = -60.0, 0.0
    t = 0.6667 * target
    for _ in range(60):
        _, _, B, D = _elliptic_integrals(math.exp(t))
        residual = 2.0 * t + math.log(D / B) - target
        if residual > 0.0:
            high = t
        else:
            low = t
        step = residual / 1.5  # the slope is 1.5 at the circle and tends to 2 for a line
        t_new = t - step
        if not low < t_new < high:
            t_new = 0.5 * (low + high)
        if abs(t_new - t) < 1e-15 * (1.0 + abs(t)):
            break
        t = t_new
    return math.exp(t)


def coefficients(A: float, B: float) -> tuple[float, float, float]:
    """Return Hertz's m, n, r for half curvatures A along x and B along y: a = m(…)^(1/3), b = n(…)^(1/3)."""
    ratio = min(A, B) / max(A, B)
    g = 1.0 if ratio >= 1.0 else _axis_ratio(ratio)
    K, E, _, _ = _elliptic_integrals(g)
    major = (2.0 * E / (math.pi * g * g)) ** (1.0 / 3.0)
    r = 2.0 * K / (math.pi * major)
    if A <= B:
        return major, major * g, r
    return major * g, major, r


# Table of ANALYN's local factors over u = ln(B/A): 1 + alpha, 1 + beta, n r, ln(m/n) as cubic Hermite values and slopes.
# The interpolation error is below 2e-8 (tests/test_hertz.py). A lookup takes 10 ns and needs no root search.
_U_MAX = 16.0
_U_STEP = 0.1


def _build_table() -> np.ndarray:
    half = round(_U_MAX / _U_STEP) + 2  # two more points at each end for the difference formula
    values = np.empty((2 * half + 1, 4))
    for i in range(half + 1):
        B = math.exp(_U_STEP * i)
        m, k, r = coefficients(1.0, B)
        alpha, beta = r * (1.0 + B) / m**2, r * (1.0 + 1.0 / B) / k**2
        values[half + i] = alpha, beta, k * r, math.log(m / k)
        values[half - i] = beta, alpha, m * r, math.log(k / m)  # the same ellipse with its axes exchanged
    slopes = (8.0 * (values[3:-1] - values[1:-3]) - (values[4:] - values[:-4])) / 12.0  # slopes times the step
    return np.ascontiguousarray(np.hstack([values[2:-2], slopes]))


_TABLE = _build_table()


elliptic_integrals = kernel(_elliptic_integrals)


@entry
def local_factors(A: float, B: float) -> tuple[float, float, float, float]:
    """Return 1 + alpha, 1 + beta, n·r and ln(a/b) of Hertz for half curvatures A, B > 0 [1/m] (theory.md 3.1).

    1 + alpha = delta/(A a²) and 1 + beta = delta/(B b²). B/A is clamped to [1.2e-7, 8.8e6].
    """
    u = (math.log(B / A) + _U_MAX) / _U_STEP
    u = min(u, 2.0 * _U_MAX / _U_STEP - 1e-9) if u > 0.0 else 0.0  # NaN, from gaps that overflow, counts as 0
    i = int(u)
    t = u - i
    h00, h10, h01, h11 = basis(t)
    p, q = _TABLE[i], _TABLE[i + 1]
    one_alpha = h00 * p[0] + h10 * p[4] + h01 * q[0] + h11 * q[4]
    one_beta = h00 * p[1] + h10 * p[5] + h01 * q[1] + h11 * q[5]
    nr = h00 * p[2] + h10 * p[6] + h01 * q[2] + h11 * q[6]
    return one_alpha, one_beta, nr, h00 * p[3] + h10 * p[7] + h01 * q[3] + h11 * q[7]
