"""A smooth surface through slices: points (y, z) over the position u of the slices and the index v of longitudinal paths.

The surface is a tensor product of cubic splines. Each slice is a curve over v, and points of equal v on neighbouring slices
are connected along u. A path may be absent on some slices, so the surface may begin, end or have a hole.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.geometry.surfaces.spline import slopes

Mask = NDArray[np.bool_]


class SplineSheet:
    """Bicubic surface y(u, v), z(u, v).

    Parameters
    ----------
    u : ndarray, shape (n,)
        Positions of the slices, strictly increasing.
    nodes : ndarray, shape (2, n, m)
        y and z [m] at v = 0 … m-1 of each slice.
    active : ndarray of bool, shape (n, m)
        Where the surface exists; in each slice a run without holes.
    corners : tuple of int
        Paths v at which the tangent across may jump.
    period : float, optional
        Period along u. Otherwise the surface is constant before the first and after the last slice.
    """

    def __init__(
        self, u: Array, nodes: Array, active: Mask, corners: tuple[int, ...] = (), period: float | None = None
    ) -> None:
        self.u, self.active, self.period = u, active, period
        self._f = np.where(active, nodes, 0.0)
        self._start, self._end = _across(self._f, active, corners)
        fields = np.concatenate((self._f, self._start, self._end), axis=2)
        cover = np.concatenate((active, *(active[:, :-1] & active[:, 1:],) * 2), axis=1)
        rates = _along(u, fields, cover, period)
        m = active.shape[1]
        self._f_u, self._start_u, self._end_u = rates[..., :m], rates[..., m : 2 * m - 1], rates[..., 2 * m - 1 :]
        if period is not None:  # the last interval leads back to the first slice
            self.u = np.append(u, u[0] + period)
            self.active = np.concatenate((active, active[:1]))
            for name in ("_f", "_f_u", "_start", "_start_u", "_end", "_end_u"):
                values = getattr(self, name)
                setattr(self, name, np.concatenate((values, values[:, :1]), axis=1))
        elif u.size == 1:  # a constant surface
            self.u = np.append(u, u[0] + 1.0)
            self.active = np.concatenate((active, active))
            for name in ("_f", "_f_u", "_start", "_start_u", "_end", "_end_u"):
                values = getattr(self, name)
                setattr(self, name, np.concatenate((values, values), axis=1))

    @property
    def constant(self) -> bool:
        """Whether it is the same at every u."""
        return bool((self._f == self._f[:, :1]).all())

    @property
    def paths(self) -> int:
        """Number of longitudinal paths m; v is in 0 … m-1."""
        return int(self.active.shape[1])

    def _interval(self, u: Array) -> tuple[NDArray[np.int64], Array, Array]:
        """Return index, length and position in 0 … 1 of the interval that holds u, or is nearest to it."""
        if self.period is not None:
            u = self.u[0] + np.mod(u - self.u[0], self.period)
        u = np.clip(u, self.u[0], self.u[-1])
        i = np.clip(np.searchsorted(self.u, u, side="right") - 1, 0, self.u.size - 2)
        h = self.u[i + 1] - self.u[i]
        return i, h, (u - self.u[i]) / h

    def curves(self, u: Array) -> Array:
        """Return the nodes (y, z) of the cross-sections at `u`, shape (2, k, m) [m]; NaN where the surface is absent."""
        i, h, t = self._interval(u)
        b0, b1, b2, b3 = (b[:, None] for b in _basis(t))
        h = h[:, None]
        f = b0 * self._f[:, i] + b2 * self._f[:, i + 1] + h * (b1 * self._f_u[:, i] + b3 * self._f_u[:, i + 1])
        # at a slice itself, only that slice needs to have the path
        there = (self.active[i] | (t == 1.0)[:, None]) & (self.active[i + 1] | (t == 0.0)[:, None])
        f[:, ~there] = np.nan
        return np.asarray(f)


def _basis(t: Array) -> tuple[Array, Array, Array, Array]:
    """Return the weights of f0, h·m0, f1 and h·m1 at t in 0 … 1 (`contact.kernels.cubic.basis`, for arrays)."""
    w = 1.0 - t
    return (1.0 + 2.0 * t) * w * w, t * w * w, t * t * (3.0 - 2.0 * t), -t * t * w


def _runs(mask: Mask) -> list[tuple[int, int]]:
    """Return first and end of the runs of true values."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], mask, [False])).astype(np.int8)))
    return [(int(a), int(b)) for a, b in edges.reshape(-1, 2)]


def _across(f: Array, active: Mask, corners: tuple[int, ...]) -> tuple[Array, Array]:
    """Return df/dv at the start and at the end of every segment, shape (2, n, m-1).

    Each slice is a spline over its chord length, which does not oscillate where the distance of the paths changes. With v
    it is smooth in its direction only, so start and end of neighbouring segments differ.
    """
    n, m = active.shape
    start, end = np.zeros((2, n, m - 1)), np.zeros((2, n, m - 1))
    patterns, which = np.unique(active, axis=0, return_inverse=True)
    for k, pattern in enumerate(patterns):
        slices = np.flatnonzero(which.ravel() == k)
        for first, stop in _runs(pattern):
            cuts = [first, *(c for c in corners if first < c < stop - 1), stop - 1]
            for low, high in itertools.pairwise(cuts):
                piece = np.moveaxis(f[:, slices, low : high + 1], 2, 0)
                chords = np.hypot(*np.moveaxis(np.diff(piece, axis=0), 1, 0))
                s = np.concatenate((np.zeros((1, slices.size)), np.cumsum(chords, axis=0)))
                rates = slopes(np.repeat(s[:, None], 2, axis=1), piece)
                start[:, slices, low:high] = np.moveaxis(rates[:-1] * chords[:, None], 0, 2)
                end[:, slices, low:high] = np.moveaxis(rates[1:] * chords[:, None], 0, 2)
    return start, end


def _along(u: Array, f: Array, active: Mask, period: float | None) -> Array:
    """Return df/du of every path, over each run of slices that have it."""
    rates = np.zeros_like(f)
    patterns, which = np.unique(active, axis=1, return_inverse=True)
    for k in range(patterns.shape[1]):
        paths = np.flatnonzero(which.ravel() == k)
        whole = bool(patterns[:, k].all())
        for first, stop in _runs(patterns[:, k]):
            piece = np.moveaxis(f[:, first:stop, paths], 1, 0)
            rate = slopes(u[first:stop], piece, period if whole else None)
            rates[:, first:stop, paths] = np.moveaxis(rate, 0, 1)
    return rates
