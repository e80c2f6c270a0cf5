"""Profiles as splines, and where they stand: the height of a rail over rows of a frame, and the turn of a wheel."""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.geometry.records import Pose
from contact.geometry.shape import Profile
from contact.geometry.surfaces import SurfacePair
from contact.geometry.surfaces.frame import Frame
from contact.geometry.surfaces.spline import slopes
from contact.inp.nodes import MISSED, REST, STEPS

_KINK = math.radians(30.0)


class Outline(NamedTuple):
    """A profile as splines through its points over the chord length [m], which break at kinks."""

    s: Array
    points: Array
    starts: Array
    ends: Array

    @classmethod
    def of(cls, profile: Profile) -> Outline:
        """Return the outline of a profile."""
        return cls.through(np.stack((profile.y, profile.z), axis=1))

    @classmethod
    def through(cls, points: Array) -> Outline:
        """Return the outline through points (y, z), shape (n, 2) [m]."""
        s = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
        starts, ends = np.empty((s.size - 1, 2)), np.empty((s.size - 1, 2))
        for low, high in itertools.pairwise([0, *kinks(points), s.size - 1]):
            rates = slopes(s[low : high + 1], points[low : high + 1])
            starts[low:high], ends[low:high] = rates[:-1], rates[1:]
        return cls(s, points, starts, ends)

    def at(self, s: Array) -> tuple[Array, Array]:
        """Return (y, z) at the lengths `s`, and their derivatives, each of shape (2, ...)."""
        k = np.clip(np.searchsorted(self.s, s, side="right") - 1, 0, self.s.size - 2)
        h = self.s[k + 1] - self.s[k]
        t, f, m, w = ((s - self.s[k]) / h)[..., None], self.points, self.starts[k], self.ends[k]
        h = h[..., None]
        rise = f[k + 1] - f[k]
        a, b = h * (m + w) - 2.0 * rise, 3.0 * rise - h * (2.0 * m + w)
        place, rate = f[k] + t * (h * m + t * (b + t * a)), m + t * (2.0 * b + 3.0 * t * a) / h
        return np.moveaxis(place, -1, 0), np.moveaxis(rate, -1, 0)

    def length(self, y: float, z: float) -> float:
        """Return the length s at the lateral position `y`, near the height `z` [m]."""
        s = np.array(self.s[int(np.hypot(*(self.points - (y, z)).T).argmin())])
        for _ in range(STEPS):
            place, rate = self.at(s)
            s = np.clip(
                s + np.clip((y - place[0]) / (rate[0] if abs(rate[0]) > 1e-3 else 1e-3), -1e-3, 1e-3), 0.0, self.s[-1]
            )
        return float(s)


class Outlines(NamedTuple):
    """Outlines of a wheel of revolution and of a straight rail, or of a roller of a radius [m]; None for bodies with slices."""

    wheel: Outline | None
    rail: Outline | None
    roller: float | None = None


def kinks(points: Array) -> list[int]:
    """Return the inner points (y, z) at which the chords turn by more than 30 degrees."""
    steps = np.diff(points, axis=0)
    turn = np.abs(np.diff(np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))))
    return (np.flatnonzero(turn > _KINK) + 1).tolist()


def over(rail: Outline, y: Array, frame: Frame, place: tuple[float, float, float]) -> tuple[Array, Array]:
    """Return height and slope [rad] of a straight rail over rows `y` of a frame [m], NaN beyond its ends.

    `place` is y, z and roll of the rail.
    """
    turn, to = in_frame(frame, place)
    axes = frame.axes[1:, 1:] @ turn
    here = turn.T @ (frame.origin[1:] - np.array(place[:2]))
    at = rail.length(float(here[0]), float(here[1])) + y
    for _ in range(STEPS):
        at = np.clip(at, 0.0, rail.s[-1])
        points, rates = rail.at(at)
        miss = y - (axes[0] @ points + to[0])
        if float(np.abs(miss).max()) < REST:
            break
        rate = axes[0] @ rates
        at = at + np.clip(miss / np.where(np.abs(rate) > 1e-3, rate, 1e-3), -2e-3, 2e-3)
    there = np.abs(miss) < MISSED
    slope = np.arctan2(axes[1] @ rates, axes[0] @ rates)
    return np.asarray(np.where(there, axes[1] @ points + to[1], np.nan)), np.where(there, slope, np.nan)


def across(rail: Outline, frame: Frame, place: tuple[float, float, float]) -> Array:
    """Return the places of a rail's points across a frame [m]."""
    turn, to = in_frame(frame, place)
    return np.asarray((rail.points @ turn.T @ frame.axes[1:, 1:].T + to)[:, 0])


def in_frame(frame: Frame, place: tuple[float, float, float]) -> tuple[Array, Array]:
    """Return the turn of a rail in the track, and the place of its profile's origin in a frame [m]."""
    c, s = math.cos(place[2]), math.sin(place[2])
    return np.array([[c, -s], [s, c]]), frame.axes[1:, 1:] @ (np.array(place[:2]) - frame.origin[1:])


def standing(pair: SurfacePair, pose: Pose) -> tuple[Array, Array]:
    """Return the turn of a wheel that stands in the track, and the place of its profile's origin [m], in right-side form."""
    mirror = 1.0 if pair.side == "right" else -1.0
    turn = to_track(mirror * pose.roll, mirror * pose.yaw)
    middle = np.array([0.0, mirror * pose.y, pair.z - pair.nominal_radius])
    return turn, middle + turn @ np.array([0.0, pair.tape, pair.nominal_radius])


def to_track(roll: float, yaw: float) -> Array:
    """Return the matrix from wheelset to track axes: roll about x, then yaw about z."""
    cr, sr, cy, sy = math.cos(roll), math.sin(roll), math.cos(yaw), math.sin(yaw)
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]])
    about_z = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
    return about_z @ about_x
