"""Kalker's linear-theory creepage coefficients, smooth in the aspect ratio (theory.md 1.2; Kalker 1990 Table E.3)."""

from __future__ import annotations

import functools
import math

import numpy as np
from numpy.typing import NDArray

from contact.errors import require_number
from contact.kernels.kalker import LOG_ASPECT_MAX, N_TABLE, coefficients, fill_table

__all__ = ["coefficients", "constant_table", "piecewise", "published", "table"]

# Rows: a/b = 0.1 … 1, then b/a = 0.9 … 0.1. Columns: C11, C22, C23, C33, each at nu = 0, 1/4, 1/2. The published numbers
# agree with a boundary-element solution in full adhesion to 1.5 % (theory.md 1.2).
_PUBLISHED = """
2.51 3.31 4.85   2.51 2.52 2.53   .334 .473 .731    6.42 8.28 11.7
2.59 3.37 4.81   2.59 2.63 2.66   .483 .603 .809    3.46 4.27 5.66
2.68 3.44 4.80   2.68 2.75 2.81   .607 .715 .889    2.49 2.96 3.72
2.78 3.53 4.82   2.78 2.88 2.98   .720 .823 .977    2.02 2.32 2.77
2.88 3.62 4.83   2.88 3.01 3.14   .827 .929 1.07    1.74 1.93 2.22
2.98 3.72 4.91   2.98 3.14 3.31   .930 1.03 1.18    1.56 1.68 1.86
3.09 3.81 4.97   3.09 3.28 3.48   1.03 1.14 1.29    1.43 1.50 1.60
3.19 3.91 5.05   3.19 3.41 3.65   1.13 1.25 1.40    1.34 1.37 1.42
3.29 4.01 5.12   3.29 3.54 3.82   1.23 1.36 1.51    1.27 1.27 1.27
3.40 4.12 5.20   3.40 3.67 3.98   1.33 1.47 1.63    1.21 1.19 1.16
3.51 4.22 5.30   3.51 3.81 4.16   1.44 1.59 1.77    1.16 1.11 1.06
3.65 4.36 5.42   3.65 3.99 4.39   1.58 1.75 1.94    1.10 1.04 .954
3.82 4.54 5.58   3.82 4.21 4.67   1.76 1.95 2.18    1.05 .965 .852
4.06 4.78 5.80   4.06 4.50 5.04   2.01 2.23 2.50    1.01 .892 .751
4.37 5.10 6.11   4.37 4.90 5.56   2.35 2.62 2.96    .958 .819 .650
4.84 5.57 6.57   4.84 5.48 6.31   2.88 3.24 3.70    .912 .747 .549
5.57 6.34 7.34   5.57 6.40 7.51   3.79 4.32 5.01    .868 .674 .446
6.96 7.78 8.82   6.96 8.14 9.79   5.72 6.63 7.89    .828 .601 .341
10.7 11.7 12.9   10.7 12.8 16.0   12.2 14.6 18.0    .795 .526 .228
"""
_NU = (0.0, 0.25, 0.5)
_BEYOND = (0.02, 0.05)  # axis ratios, below the table's least 0.1, at which the asymptotes are used
# C33 at b/a = 0.02, 0.05: boundary-element values, because the usual asymptote is 13-20 % off there (theory.md 1.2).
_C33_LONG = {0.02: (0.780, 0.450, 0.104), 0.05: (0.783, 0.482, 0.157)}


def _short_asymptote(g: float, nu: float) -> tuple[float, float, float, float]:
    """Return C11, C22, C23, C33 for a/b = g → 0 (theory.md 1.2)."""
    c23 = math.pi * math.sqrt(g) / (3.0 * (1.0 - nu)) * (1.0 + nu * (math.log(16.0 / g) - 5.0))
    return math.pi**2 / (4.0 * (1.0 - nu)), math.pi**2 / 4.0, c23, math.pi**2 / (16.0 * (1.0 - nu) * g)


def _long_asymptote(g: float, nu: float) -> tuple[float, float, float]:
    """Return C11, C22, C23 for b/a = g → 0 (theory.md 1.2)."""
    L = math.log(16.0 / g**2)
    x = L - 2.0 * nu
    q = (1.0 - nu) * L + 2.0 * nu
    excess = 3.0 - math.log(4.0)
    c11 = 2.0 * math.pi / (x * g) * (1.0 + excess / x)
    c22 = 2.0 * math.pi / (g * q) * (1.0 + (1.0 - nu) * excess / q)
    return c11, c22, 2.0 * math.pi / (3.0 * g**1.5 * ((1.0 - nu) * L - 2.0 + 4.0 * nu))


def _knots() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the knots ln(a/b), shape (k,), and coefficients, shape (k, 4, 3): the published table and asymptotes."""
    published = np.array(_PUBLISHED.split(), dtype=np.float64).reshape(19, 4, 3)
    ratio = np.r_[np.arange(1, 11) / 10.0, 1.0 / (np.arange(9, 0, -1) / 10.0)]
    short = [[_short_asymptote(g, nu) for nu in _NU] for g in _BEYOND]
    long = [[(*_long_asymptote(g, nu), _C33_LONG[g][k]) for k, nu in enumerate(_NU)] for g in reversed(_BEYOND)]
    values = np.concatenate([np.swapaxes(short, 1, 2), published, np.swapaxes(long, 1, 2)])
    aspects = np.r_[_BEYOND, ratio, [1.0 / g for g in reversed(_BEYOND)]]
    return np.log(aspects), values


def _monotone_slopes(x: NDArray[np.float64], f: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the slopes of the monotone cubic through f (k, …) at x (k,): Fritsch-Butland weighted harmonic means."""
    h = np.diff(x)[:, None]
    d = np.diff(f, axis=0) / h
    w1, w2 = 2.0 * h[1:] + h[:-1], h[1:] + 2.0 * h[:-1]
    product = d[:-1] * d[1:]
    safe = np.where(product > 0.0, product, 1.0)
    inner = np.where(product > 0.0, (w1 + w2) * safe / np.where(product > 0.0, w1 * d[1:] + w2 * d[:-1], 1.0), 0.0)
    return np.concatenate([d[:1], inner, d[-1:]])


def piecewise(poisson_ratio: float, aspect: float) -> tuple[float, float, float]:
    """Return C11, C22, C23 as CONTACT reads Kalker's table for its simplified theory.

    They are linear in the smaller of a/b and b/a between the rows, and 1/C is a parabola in Poisson's ratio. Below a ratio of
    .101 they are the asymptotes, with a jump of some per cent. Use `coefficients` for anything smooth.
    """
    nu, g = require_number("poisson_ratio", poisson_ratio, 0.0, 0.5), min(aspect, 1.0 / aspect)
    if g < 0.101:
        return _short_asymptote(g, nu)[:3] if aspect <= 1.0 else _long_asymptote(g, nu)
    rows = np.array(_PUBLISHED.split(), dtype=np.float64).reshape(19, 4, 3)[:, :3]
    rows = rows[:10] if aspect <= 1.0 else rows[:8:-1]
    k = min(int(10.0 * g - 0.005), 9) - 1
    t = 10.0 * g - (k + 1)
    c = (1.0 - t) * rows[k] + t * rows[k + 1]
    weights = np.array([8.0 * (nu - 0.25) * (nu - 0.5), -16.0 * nu * (nu - 0.5), 8.0 * nu * (nu - 0.25)])
    c11, c22, c23 = (1.0 / (weights / c).sum(axis=1)).tolist()
    return c11, c22, c23


@functools.cache
def published() -> NDArray[np.float64]:
    """Return C11, C22, C23, C33 at Poisson's ratios 0, 1/4, 1/2 over equidistant ln(a/b), shape (129, 4, 3).

    Between the published rows, ln C is a monotone cubic in ln(a/b). Its slope is continuous, unlike that of CONTACT's
    piecewise table, which jumps by up to 5 %. `fill_table` interpolates the result in the Poisson ratio.
    """
    x, values = _knots()
    logs = np.log(values).reshape(x.size, 12)
    slopes = _monotone_slopes(x, logs)
    grid = np.linspace(-LOG_ASPECT_MAX, LOG_ASPECT_MAX, N_TABLE)
    i = np.clip(np.searchsorted(x, grid, side="right") - 1, 0, x.size - 2)
    h = (x[i + 1] - x[i])[:, None]
    t = (grid - x[i])[:, None] / h
    smooth = (
        (1 + 2 * t) * (1 - t) ** 2 * logs[i]
        + t * (1 - t) ** 2 * h * slopes[i]
        + t**2 * (3 - 2 * t) * logs[i + 1]
        - t**2 * (1 - t) * h * slopes[i + 1]
    )
    result = np.ascontiguousarray(np.exp(smooth).reshape(N_TABLE, 4, 3))
    result.setflags(write=False)
    return result


@functools.lru_cache(maxsize=64)
def table(poisson_ratio: float) -> NDArray[np.float64]:
    """Return the table of C11, C22, C23, C33 over ln(a/b) that `coefficients` reads, for one Poisson ratio (theory.md 1.2).

    Returns
    -------
    ndarray, shape (129, 8)
        The four coefficients, then their slopes times the step, at equidistant ln(a/b). Read-only and cached.
    """
    nu = require_number("poisson_ratio", poisson_ratio, 0.0, 0.5)
    result = np.empty((N_TABLE, 8))
    fill_table(published(), nu, result)
    result.setflags(write=False)
    return result


def constant_table(c11: float, c22: float, c23: float) -> NDArray[np.float64]:
    """Return a table for `coefficients`, shape (129, 8), with the same C11, C22, C23 at every aspect ratio.

    C33 is 0; FASTSIM does not read it.
    """
    result = np.zeros((N_TABLE, 8))
    result[:, :3] = c11, c22, c23
    result.setflags(write=False)
    return result
