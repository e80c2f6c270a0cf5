"""Faults along the points of a profile in order: back steps, spikes, kinks, noise."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from contact.arrays import Array

Points = NDArray[np.float64]  # shape (n, 2): y, z [m]

_SPIKE, _OVER_NEIGHBOURS = 2e-5, 8.0  # least deviation of a spike [m], and over the median of the points around it
_KINK, _KINK_OVER = np.radians(8.0), 6.0  # least turn at a kink [rad], and over the median of the turns around it
_SMOOTH = 0.35  # of the turn at a spike: the greatest turn beside it that is left without it
_CHAMFER = 12e-3  # corners nearer to the ends of the profile are chamfers [m]
_STEEPEST = np.radians(75.0)  # steeper parts cannot touch


def backward(points: Points) -> NDArray[np.bool_]:
    """Return which points lie behind the previous one: the step to them goes back against the chord of the points around."""
    step = np.diff(points, axis=0)
    turned = np.zeros(len(points), dtype=bool)
    padded = np.pad(points, ((2, 2), (0, 0)), mode="edge")
    around = padded[4:] - padded[:-4]  # from two points before to two points after
    turned[1:] = (step * (around[1:] + around[:-1])).sum(axis=1) < 0.0
    return turned


def spikes(points: Points) -> NDArray[np.bool_]:
    """Return which points stand off the curve through the others, singly or two together."""
    return spike_heights(points) != 0.0


def spike_heights(points: Points) -> Array:
    """Return how far spikes stand off [m]; 0 for other points.

    A spike is off a parabola fitted robustly to eleven points, and without it the curve goes on smoothly. A corner does not.
    """
    heights = np.zeros(len(points))
    while True:  # spikes beside others are seen without these
        left = np.flatnonzero(heights == 0.0)
        found = _clear_spikes(points[left]) if left.size > 10 else np.zeros(left.size)
        if not found.any():
            return heights
        heights[left] = found


def _clear_spikes(points: Points) -> Array:
    """Return how far those spikes stand off that are seen while all points are there [m]."""
    heights = np.zeros(len(points))
    off = _residuals(points)
    around = np.median(sliding_window_view(np.pad(np.abs(off), 6, mode="edge"), 13), axis=1)
    wild = np.abs(off) > np.maximum(_SPIKE, _OVER_NEIGHBOURS * around)
    wild[[0, -1]] = False
    good = np.flatnonzero(~wild)
    bend_without = np.pad(np.abs(turns(points[good])), 1) if good.size > 2 else np.zeros(good.size)
    bend = np.pad(np.abs(turns(points)), 1)
    for k, (a, b) in enumerate(itertools.pairwise(good)):
        inside = slice(a + 1, b)
        if 1 < b - a < 4 and bend_without[k : k + 2].max() < _SMOOTH * bend[inside].max():
            heights[inside] = np.where(np.abs(off[inside]) > 0.5 * np.abs(off[inside]).max(), off[inside], 0.0)
    return heights


def _residuals(points: Points) -> Array:
    """Return the distance of each point from a parabola through the eleven points around it [m], least absolute deviations."""
    half = 5
    starts = np.clip(np.arange(len(points)) - half, 0, len(points) - 2 * half - 1)
    windows = points[starts[:, None] + np.arange(2 * half + 1)]  # (points, 11, 2)
    ends = np.median(windows[:, -3:], axis=1) - np.median(windows[:, :3], axis=1)
    length = np.hypot(*ends.T)
    along = ends / np.where(length > 0.0, length, 1.0)[:, None]
    arm = (windows - points[:, None]) / np.where(length > 0.0, length, 1.0)[:, None, None]
    u = (arm * along[:, None]).sum(axis=2)
    v = along[:, None, 0] * arm[:, :, 1] - along[:, None, 1] * arm[:, :, 0]
    powers = np.stack((np.ones_like(u), u, u * u), axis=2)
    weights = np.ones_like(u)
    for _ in range(12):  # iterated weights; those of points that stand off vanish
        weighted = powers * weights[:, :, None]
        matrix = np.swapaxes(powers, 1, 2) @ weighted + 1e-12 * np.eye(3)
        fit = np.linalg.solve(matrix, (weighted * v[:, :, None]).sum(axis=1)[:, :, None])
        rest = v - (powers @ fit)[:, :, 0]
        weights = 1.0 / np.maximum(np.abs(rest), 1e-6)
    return np.asarray(-fit[:, 0, 0] * length)


def kinks(points: Points, scale: float = 1.0) -> NDArray[np.intp]:
    """Return the indices of corners where wheel and rail can touch, away from the ends of a profile of this scale."""
    if len(points) < 12:
        return np.zeros(0, dtype=np.intp)
    turn = np.abs(turns(points))
    around = np.median(sliding_window_view(np.pad(turn, 5, mode="edge"), 11), axis=1)
    wild = spikes(points) | backward(points) | np.roll(backward(points), -1)
    free = ~(wild[:-2] | wild[1:-1] | wild[2:])
    upright = steep(points)
    flank = upright & (
        np.roll(upright, 1) | np.roll(upright, -1)
    )  # one steep step between flat ones is a jump, no flank
    along = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
    inner = np.minimum(along, along[-1] - along)[1:-1] > _CHAMFER * scale
    found = (turn > np.maximum(_KINK, _KINK_OVER * around)) & free & inner & ~flank[1:] & ~flank[:-1]
    return np.flatnonzero(found) + 1


def noise(points: Points) -> float:
    """Return the root mean square of the noise across the profile [m]: the rest beside local cubics through nine points."""
    if len(points) < 9:
        return 0.0
    windows = sliding_window_view(points, 9, axis=0)  # (windows, 2, 9)
    along = windows[:, :, -1] - windows[:, :, 0]
    length = np.hypot(*along.T)
    good = length > 0.0
    along, windows = along[good] / length[good, None], windows[good] - windows[good, :, :1]
    u = (along[:, :, None] * windows).sum(axis=1) / length[good, None]
    v = along[:, 0, None] * windows[:, 1] - along[:, 1, None] * windows[:, 0]
    powers = u[:, :, None] ** np.arange(4)
    rest = v - (powers @ (np.linalg.pinv(powers) @ v[:, :, None]))[:, :, 0]
    return float(np.sqrt(np.median((rest**2).sum(axis=1)) / 4.35)) if rest.size else 0.0  # median of χ² with 5 degrees


def turns(points: Points) -> Array:
    """Return the change of direction at every inner point [rad]."""
    direction = np.unwrap(np.arctan2(*np.diff(points, axis=0).T[::-1]))
    return np.diff(direction)


def steep(points: Points) -> NDArray[np.bool_]:
    """Return which segments are too steep to touch."""
    dy, dz = np.abs(np.diff(points, axis=0).T)
    return np.arctan2(dz, dy) > _STEEPEST
