"""Slopes of cubic splines for several functions at once, and the values of splines given by control points."""

from __future__ import annotations

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError


def slopes(u: Array, f: Array, period: float | None = None) -> Array:
    """Return df/du at the knots of the C² cubic splines through `f`.

    Parameters
    ----------
    u : ndarray, shape (n,) or (n, ...)
        Knots, strictly increasing along the first axis: the same for all functions, or of the shape of `f`.
    f : ndarray, shape (n, ...)
        Values of any number of functions.
    period : float, optional
        Period of the functions, longer than u[-1] - u[0]; only for common knots. Without it the ends are not-a-knot: the
        first two segments are one cubic, and so are the last two. With three knots the spline is a parabola, with two a
        line, with one constant.
    """
    n = f.shape[0]
    if n == 1:
        return np.zeros_like(f)
    if period is not None:
        return _periodic(u, f.reshape(n, -1), period).reshape(f.shape)
    h = np.diff(u, axis=0).reshape((n - 1,) + (u.shape[1:] or (1,) * (f.ndim - 1)))
    d = np.diff(f, axis=0) / h
    if n == 2:
        return np.repeat(d, 2, axis=0)
    if n == 3:
        inner = (h[1] * d[0] + h[0] * d[1]) / (h[0] + h[1])
        return np.stack((2.0 * d[0] - inner, inner, 2.0 * d[1] - inner))
    middle, upper, right = np.empty((n, *h.shape[1:])), np.empty((n - 1, *h.shape[1:])), np.empty_like(f)
    first, last = h[0] + h[1], h[-1] + h[-2]
    middle[0], upper[0], middle[-1] = h[1], first, h[-2]
    right[0] = ((h[0] + 2.0 * first) * h[1] * d[0] + h[0] ** 2 * d[1]) / first
    right[-1] = ((h[-1] + 2.0 * last) * h[-2] * d[-1] + h[-1] ** 2 * d[-2]) / last
    middle[1:-1], upper[1:] = 2.0 * (h[1:] + h[:-1]), h[:-1]
    right[1:-1] = 3.0 * (h[1:] * d[:-1] + h[:-1] * d[1:])
    for i in range(1, n):  # Thomas' algorithm; the row below the diagonal is h[i], in the last row `last`
        factor = (h[i] if i < n - 1 else last) / middle[i - 1]
        middle[i] -= factor * upper[i - 1]
        right[i] -= factor * right[i - 1]
    right[-1] /= middle[-1]
    for i in range(n - 2, -1, -1):
        right[i] = (right[i] - upper[i] * right[i + 1]) / middle[i]
    return np.asarray(right)


def _periodic(u: Array, f: Array, period: float) -> Array:
    n = u.size
    if n < 3:
        raise ContactError(f"a closed surface has {n} slices; at least 3 are needed")
    h = np.diff(np.append(u, u[0] + period))
    d = (np.roll(f, -1, axis=0) - f) / h[:, None]
    before, here = np.roll(h, 1), np.arange(n)
    matrix = np.zeros((n, n))
    matrix[here, here - 1] += h
    matrix[here, here] += 2.0 * (h + before)
    matrix[here, (here + 1) % n] += before
    right = 3.0 * (h[:, None] * np.roll(d, 1, axis=0) + before[:, None] * d)
    return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)


def approximated(u: Array, f: Array, period: float | None = None) -> Array:
    """Return the values at the knots `u` of the cubic B-splines that have `f` as control points.

    With equal steps the values are means with the weights 1, 4, 1 over 6. The ends of an open spline are kept.
    Parameters as for `slopes`.
    """
    n = u.size
    if n < 3:
        return f.copy()
    if period is None:
        t = np.concatenate(([2.0 * u[0] - u[1]], u, [2.0 * u[-1] - u[-2]]))
        g = np.concatenate((f[:1], f, f[-1:]))
    else:
        t = np.concatenate((u[-2:] - period, u, u[:2] + period))
        g = np.concatenate((f[-2:], f, f[:2]))
    i = np.arange(2, t.size - 2)
    wide = t[i + 1] - t[i - 1]
    before = (t[i + 1] - t[i]) ** 2 / (wide * (t[i + 1] - t[i - 2]))
    after = (t[i] - t[i - 1]) ** 2 / (wide * (t[i + 2] - t[i - 1]))
    shape = (-1,) + (1,) * (f.ndim - 1)
    before, after = before.reshape(shape), after.reshape(shape)
    smooth = before * g[i - 1] + (1.0 - before - after) * g[i] + after * g[i + 1]
    if period is not None:
        return smooth
    return np.concatenate((f[:1], smooth, f[-1:]))
