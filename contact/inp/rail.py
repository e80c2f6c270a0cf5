"""The rail of a pair as CONTACT sees it from a frame: one outline, or one at each place along the track."""

from __future__ import annotations

import math
from functools import cached_property
from typing import NamedTuple

import numpy as np

from contact.arrays import Array, connected
from contact.geometry.surfaces import SurfacePair
from contact.geometry.surfaces.frame import Frame
from contact.geometry.surfaces.spline import slopes
from contact.inp.nodes import MISSED, REST, STEPS
from contact.inp.outline import Outline, Outlines, across, in_frame, over

#: Number of nodes of a cross-section on each side of a range that its spline needs, and steps of Newton's iterations in nodes.
_BESIDE, _STEP = 24, 4.0
#: Points of an outline for each of its nodes.
_FINE = 4


class Rail:
    """A straight rail with an outline, a roller, or the rail with slices of a pair. All in right-side form."""

    def __init__(self, pair: SurfacePair, bodies: Outlines) -> None:
        self._pair, self._outline, self.roller = pair, bodies.rail, bodies.roller
        motion = pair.space.motion[0]
        self._station = float(motion.station)
        self.place = float(motion.rail_y), float(motion.rail_z), float(motion.rail_roll)

    @property
    def straight(self) -> bool:
        """Whether it is the same everywhere."""
        return self._outline is not None

    @cached_property
    def here(self) -> Outline:
        """The outline at x = 0, whose slope counts for the contact angle."""
        if self._outline is not None:
            return self._outline
        points = self._pair.rail.curves(np.array([self._station]))[:, 0].T
        return Outline.through(points[np.isfinite(points[:, 0])])

    def heights(self, frame: Frame, x: Array, y: Array) -> Array:
        """Return the height over the places of a grid in a frame turned about x only, (y, x) [m]; NaN beyond the rail.

        A roller is bent down along x only where the frame is not turned.
        """
        if self._outline is not None:
            height = over(self._outline, y, frame, self.place)[0][:, None]
            return self.bent(frame, x, np.broadcast_to(height, (y.size, x.size)))
        return self.at(frame, x, np.broadcast_to(y[:, None], (y.size, x.size)))

    def at(self, frame: Frame, x: Array, y: Array) -> Array:
        """Return the height over places of a frame: column k of `y` at x[k] [m]. NaN beyond the rail."""
        if self._outline is not None:
            return self.bent(frame, x, over(self._outline, y.ravel(), frame, self.place)[0].reshape(y.shape))
        out = np.full(y.shape, np.nan)
        turn, to = in_frame(frame, self.place)
        axes = frame.axes[1:, 1:] @ turn
        f = self._pair.rail.curves(self._station + frame.origin[0] + x)  # (2, column, path)
        there = np.isfinite(f[0])
        patterns, which = np.unique(there, axis=0, return_inverse=True)
        for k, pattern in enumerate(patterns):
            columns, paths = np.flatnonzero(which.ravel() == k), np.flatnonzero(pattern)
            if paths.size > 3:
                points = np.einsum("ab,bcp->pca", axes, f[:, columns][:, :, paths]) + to
                out[:, columns] = _Sections.of(points, y[:, columns]).heights(y[:, columns])
        return out

    def ground(self, frame: Frame, x: Array, y: Array) -> Array:
        """Return the height over a grid as CONTACT has it for the distance: its roller is made of cones between its points."""
        if self.roller is None or self._outline is None:
            return self.heights(frame, x, y)
        turn, _ = in_frame(frame, self.place)
        points = self._outline.points @ turn.T + np.array(self.place[:2])
        ahead = frame.origin[0] + x
        z = self.roller - np.sqrt((self.roller - points[:, 1, None]) ** 2 - ahead**2)  # (point, x)
        away = np.stack((np.broadcast_to(points[:, :1], z.shape), z)) - frame.origin[1:, None, None]
        across, height = np.einsum("ab,bpx->apx", frame.axes[1:, 1:], away)
        first = int(np.hypot(across, height)[:, x.size // 2].argmin())
        out = np.empty((y.size, x.size))
        for k in range(x.size):
            rising = connected(np.diff(across[:, k]) > 0.0, first)
            out[:, k] = np.interp(y, across[rising, k], height[rising, k], left=np.nan, right=np.nan)
        return out

    def bent(self, frame: Frame, x: Array, height: Array) -> Array:
        """Return heights at x = 0 of the track lowered to those of a roller at `x` [m]."""
        if self.roller is None or frame.axes[2, 2] != 1.0:
            return height
        r = self.roller - (height + frame.origin[2])
        return np.asarray(self.roller - np.sqrt(r**2 - (frame.origin[0] + x) ** 2) - frame.origin[2])

    def slopes(self, frame: Frame, y: Array) -> Array:
        """Return the slope of the outline at x = 0 over rows of a frame [rad]."""
        return over(self.here, y, frame, self.place)[1]

    def top(self, frame: Frame) -> tuple[Array, Array]:
        """Return y and height of the outline at x = 0 in a frame, where y increases from its top outwards [m]."""
        outline = self.here
        points, _ = outline.at(np.linspace(0.0, outline.s[-1], _FINE * outline.s.size))
        turn, to = in_frame(frame, self.place)
        y, z = frame.axes[1:, 1:] @ turn @ points + to[:, None]
        first = int(z.argmin())
        before, behind = np.minimum.accumulate(y[first::-1])[::-1], np.maximum.accumulate(y[first:])
        outwards = np.concatenate((before, behind[1:]))
        new = np.concatenate(([True], np.diff(outwards) > 0.0))
        return outwards[new], z[new]

    def first(self, frame: Frame, k: int) -> float:
        """Return the place across a frame of point `k` of the outline at x = 0 [m]."""
        return float(across(self.here, frame, self.place)[k])


class _Sections(NamedTuple):
    """Cross-sections with the same number of nodes, as cubics over their chords. Arrays have the shape (node, column, 2)."""

    points: Array
    rates: Array

    @classmethod
    def of(cls, points: Array, y: Array) -> _Sections:
        """Return the sections through `points` (y, z), as far as the places `y` need them [m]."""
        low, high = float(y.min()), float(y.max())
        near = ((points[..., 0] >= low) & (points[..., 0] <= high)).any(axis=1) & (abs(points[..., 1]) < 0.05).any(
            axis=1
        )
        k = np.flatnonzero(near)
        if k.size == 0:
            k = np.array([int(abs(points[:, 0, 0] - 0.5 * (low + high)).argmin())])
        points = points[max(k[0] - _BESIDE, 0) : k[-1] + _BESIDE + 1]
        s = np.concatenate((np.zeros((1, points.shape[1])), np.cumsum(np.hypot(*np.diff(points, axis=0).T).T, axis=0)))
        steps = np.diff(s, axis=0)[..., None]
        rates = slopes(np.repeat(s[..., None], 2, axis=2), points)
        # per node, which serves Newton's iterations: the cubics join in direction only
        return cls(points, np.stack((rates[:-1] * steps, rates[1:] * steps)))

    def heights(self, y: Array) -> Array:
        """Return the heights at the places `y`, shape (row, column) [m]; NaN where there is none."""
        n, columns = self.points.shape[:2]
        column = np.broadcast_to(np.arange(columns), y.shape)
        # from the node nearest to the middle on, since an outline may turn back
        away = np.hypot(self.points[..., 0] - 0.5 * (y.min() + y.max()), self.points[..., 1])
        first = np.clip(away.argmin(axis=0), 1, n - 2)
        each = np.arange(columns)
        step = 0.5 * (self.points[first + 1, each, 0] - self.points[first - 1, each, 0])
        start = (y - self.points[first, each, 0]) / np.where(np.abs(step) > 1e-5, step, 1e-5)
        v = np.clip(first + start, 0.0, n - 1.0)
        for _ in range(STEPS):
            k = np.clip(np.floor(v).astype(np.int64), 0, n - 2)
            t = (v - k)[..., None]
            f, g = self.points[k, column], self.points[k + 1, column]
            m, w = self.rates[0][k, column], self.rates[1][k, column]
            rise = g - f
            a, b = m + w - 2.0 * rise, 3.0 * rise - 2.0 * m - w
            here, rate = f + t * (m + t * (b + t * a)), m + t * (2.0 * b + 3.0 * t * a)
            miss = y - here[..., 0]
            if float(np.abs(miss).max()) < REST:
                break
            slope = rate[..., 0]
            v = np.clip(v + np.clip(miss / np.where(np.abs(slope) > 1e-9, slope, 1e-9), -_STEP, _STEP), 0.0, n - 1.0)
        return np.asarray(np.where(np.abs(miss) < MISSED, here[..., 1], math.nan))
