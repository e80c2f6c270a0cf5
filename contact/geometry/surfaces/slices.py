"""Slices of a rail or a wheel, resampled so that points of equal index lie on the same feature."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, as_array
from contact.errors import ContactError
from contact.geometry.shape import Profile
from contact.geometry.surfaces.sheet import SplineSheet
from contact.geometry.surfaces.spline import approximated, slopes

Slice = Profile | ArrayLike

SPACING = 0.5e-3  # [m] between longitudinal paths, as in CONTACT
CLOSEST = 1e-6  # [m], [rad] least distance of two slices
MOST_SLICES, MOST_PATHS = 2000, 5000
_KINK = np.radians(30.0)  # a slice has a corner where two of its chords differ by more than this angle


class SliceCurve:
    """One slice as a parametric cubic over its chord length `s` [m], from the first point."""

    def __init__(self, points: Slice, name: str) -> None:
        if isinstance(points, Profile):
            self.f = np.stack((points.y, points.z))
        else:
            array = as_array(name, points)
            if array.ndim != 2 or array.shape[1] != 2 or array.shape[0] < 4 or not np.isfinite(array).all():
                raise ContactError(f"{name} has shape {array.shape}; at least 4 finite points (n, 2) are needed")
            self.f = array.T
        steps = np.diff(self.f, axis=1)
        chords = np.hypot(*steps)
        if not (chords > 0.0).all():
            raise ContactError(f"{name}: points {int(np.argmin(chords))} and the next coincide")
        self.s = np.concatenate(([0.0], np.cumsum(chords)))
        self._angle = points.angle if isinstance(points, Profile) else None
        self._start, self._end = np.empty_like(steps), np.empty_like(steps)

    def connect(self, corners: Array) -> None:
        """Compute the cubics. The tangent may jump at the points nearest to `corners` [m], and where chords turn sharply.

        A profile keeps its own tangents.
        """
        if self._angle is not None:
            tangents = np.stack((np.cos(self._angle), np.sin(self._angle)))
            self._start, self._end = tangents[:, :-1], tangents[:, 1:]
            return
        steps = np.diff(self.f, axis=1)
        turns = np.abs(np.diff(np.unwrap(np.arctan2(steps[1], steps[0]))))
        sharp = np.flatnonzero(turns > _KINK) + 1
        given = np.array([int(np.argmin(np.abs(self.s - corner))) for corner in corners], dtype=np.int64)
        cuts = np.unique(np.concatenate(([0], sharp, given, [self.s.size - 1])))
        for low, high in itertools.pairwise(cuts.tolist()):
            rates = slopes(self.s[low : high + 1], self.f[:, low : high + 1].T).T
            self._start[:, low:high], self._end[:, low:high] = rates[:, :-1], rates[:, 1:]

    @property
    def length(self) -> float:
        """Chord length of the whole slice [m]."""
        return float(self.s[-1])

    def at(self, s: Array) -> Array:
        """Return the points (y, z) at chord lengths `s`, shape (2, k) [m]."""
        j = np.clip(np.searchsorted(self.s, s, side="right") - 1, 0, self.s.size - 2)
        h = self.s[j + 1] - self.s[j]
        t = np.clip((s - self.s[j]) / h, 0.0, 1.0)
        w = 1.0 - t
        f0, f1, m0, m1 = self.f[:, j], self.f[:, j + 1], self._start[:, j], self._end[:, j]
        return np.asarray(
            (1.0 + 2.0 * t) * w * w * f0 + t * t * (3.0 - 2.0 * t) * f1 + h * (t * w * w * m0 - t * t * w * m1)
        )


def positions(name: str, values: ArrayLike) -> Array:
    """Return strictly increasing positions of slices as an array."""
    u = as_array(name, values)
    if u.ndim != 1 or not 1 <= u.size <= MOST_SLICES or not np.isfinite(u).all():
        raise ContactError(f"{name} has shape {u.shape}; 1 to {MOST_SLICES} finite positions are needed")
    steps = np.diff(u)
    if not (steps > CLOSEST).all():
        i = int(np.argmin(steps))
        raise ContactError(f"{name} must increase strictly; {name}[{i}] = {u[i]:g}, {name}[{i + 1}] = {u[i + 1]:g}")
    return u


def connect(
    u: Array,
    slices: Sequence[Slice],
    features: ArrayLike | None,
    corners: Sequence[int],
    *,
    interpolating: bool,
    spacing: float,
    period: float | None = None,
) -> SplineSheet:
    """Return the surface through the slices. Parameters as for `contact.geometry.surfaces.RailSurface`."""
    if len(slices) != u.size:
        raise ContactError(f"there are {len(slices)} slices for {u.size} positions")
    curves = [SliceCurve(points, f"slices[{i}]") for i, points in enumerate(slices)]
    marks = _features(features, curves)
    for corner in corners:
        if not 0 < corner < marks.shape[1] - 1:
            raise ContactError(f"corners: {corner} is no inner feature; allowed: 1 … {marks.shape[1] - 2}")
    for curve, row in zip(curves, marks, strict=True):
        at = row[list(corners)]
        curve.connect(at[np.isfinite(at)])
    lengths = np.diff(marks, axis=1)  # NaN where a part is absent
    longest = np.nanmax(np.where(np.isnan(lengths), 0.0, lengths), axis=0)
    counts = 1 + ((longest + 1e-9) / spacing).astype(np.int64)
    firsts = np.concatenate(([0], np.cumsum(counts)))
    if firsts[-1] + 1 > MOST_PATHS:
        raise ContactError(f"spacing = {spacing:g} makes {firsts[-1] + 1} paths; at most {MOST_PATHS} are allowed")
    nodes = np.zeros((2, u.size, firsts[-1] + 1))
    active = np.zeros(nodes.shape[1:], dtype=np.bool_)
    for i, curve in enumerate(curves):
        present = np.flatnonzero(np.isfinite(marks[i]))
        low, high = present[0], present[-1]
        v = np.arange(firsts[low], firsts[high] + 1)
        nodes[:, i, v] = curve.at(np.interp(v, firsts[low : high + 1], marks[i, low : high + 1]))
        active[i, v] = True
    if not interpolating:
        for j in range(active.shape[1]):
            rows = np.flatnonzero(active[:, j])
            if rows.size == rows[-1] - rows[0] + 1:
                closed = period if rows.size == u.size else None
                nodes[:, rows, j] = approximated(u[rows], nodes[:, rows, j].T, closed).T
    return SplineSheet(u, nodes, active, tuple(int(firsts[c]) for c in corners), period)


def _features(features: ArrayLike | None, curves: Sequence[SliceCurve]) -> Array:
    """Return the positions of the features [m], shape (slices, features); NaN where a feature is absent.

    The features of a slice increase, are a run without holes, and end with the slice.
    """
    lengths = np.array([curve.length for curve in curves])
    if features is None:
        return np.stack((np.zeros_like(lengths), lengths), axis=1)
    marks = as_array("features", features)
    if marks.ndim != 2 or marks.shape[0] != len(curves) or marks.shape[1] < 2:
        raise ContactError(f"features has shape {marks.shape}; ({len(curves)}, at least 2) is needed")
    marks = np.where(np.isfinite(marks), marks, -1.0)  # NaN is not compared, which would be a floating-point trap
    marks[marks < 0.0] = np.nan
    for i, row in enumerate(marks):
        present = np.flatnonzero(np.isfinite(row))
        if present.size < 2 or present[-1] - present[0] + 1 != present.size:
            raise ContactError(f"features[{i}] = {row.tolist()}: a run of at least 2 features without holes is needed")
        row[present[-1]] = min(row[present[-1]], lengths[i])
        steps = np.diff(row[present])
        if not (steps > 0.0).all():
            k = int(present[np.argmin(steps)])
            raise ContactError(
                f"features[{i}] must increase strictly and end within the slice of {lengths[i]:g} m; "
                f"features {k} and {k + 1} lie at {row[k]:g} m and {row[k + 1]:g} m"
            )
    return marks
