"""Lobes as CONTACT joins them: fully up to the distance D_COMB, in shares up to D_SEP, apart but turned up to D_TURN."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.geometry.surfaces.frame import Frame
from contact.halfspace import Gap
from contact.halfspace.parts import Parts
from contact.inp.mesh import with_distance
from contact.instance.ownership import within
from contact.kernels.geometry.section import AWAY

#: Exponent of the share over the distance, of CONTACT.
_FADING = 0.8


class Lobe(NamedTuple):
    """Range of y in which the bodies overlap [m]."""

    low: float
    high: float


def lobes(gap: Gap, approach: float) -> list[Lobe]:
    """Return the lobes of a patch from low to high y."""
    least = gap.h.min(axis=1) - approach
    edges = np.flatnonzero(np.diff(np.concatenate(([False], least < 0.0, [False])).astype(np.int8))).reshape(-1, 2)
    return [Lobe(_zero(gap.y, least, first - 1, first), _zero(gap.y, least, end, end - 1)) for first, end in edges]


def _zero(y: Array, least: Array, outside: int, inside: int) -> float:
    """Return where the line between two rows is 0 [m]."""
    if not 0 <= outside < y.size:
        return float(y[inside])
    t = least[inside] / (least[inside] - least[outside])
    return float(y[inside] + t * (y[outside] - y[inside]))


def parts(gap: Gap, approach: float, full: float, none: float) -> Parts | None:
    """Return the parts of a patch whose lobes act on each other in shares; None if they act fully.

    The influence is full up to the distance `full` between neighbouring lobes and ends at `none` [m]. CONTACT takes the share
    of the distance between, to the power of .8, and none between lobes that are no neighbours.
    """
    found = lobes(gap, approach)
    borders, shares = [], []
    for a, b in itertools.pairwise(found):
        distance = b.low - a.high
        if distance > full:
            borders.append(0.5 * (a.high + b.low))
            shares.append(max((none - distance) / (none - full), 0.0) ** _FADING if none > full else 0.0)
    if not borders:
        return None
    factor = np.eye(len(shares) + 1) + np.diag(shares, 1) + np.diag(shares, -1)
    return Parts(np.searchsorted(borders, gap.y), factor)


def reaches_over(gap: Gap, approach: float, distance: float) -> bool:
    """Return whether neighbouring lobes of a patch are further apart than `distance` [m]."""
    return any(b.low - a.high > distance for a, b in itertools.pairwise(lobes(gap, approach)))


def turned(
    patches: Sequence[SurfacePatch], pair: SurfacePair, limits: tuple[float, float, float]
) -> list[SurfacePatch]:
    """Return patches whose angles are turned towards each other, as CONTACT turns those that lie near each other.

    From the distance D_TURN to D_SEP [m] the angles of neighbours go from their own to their common mean. `limits` are D_SEP,
    D_TURN and A_SEP; angles that differ by more than A_SEP [rad] are kept.
    """
    apart, near, steepest = limits
    angles = [patch.angle for patch in patches]
    order = sorted(range(len(patches)), key=lambda k: patches[k].position[1])
    for a, b in itertools.pairwise(order):
        one, other = patches[a], patches[b]
        distance = float(np.linalg.norm(_end(one, -1) - _end(other, 0)))
        if near <= apart or not apart <= distance <= near or abs(one.angle - other.angle) > steepest:
            continue
        weights = _weight(one), _weight(other)
        mean = (one.angle * weights[0] + other.angle * weights[1]) / sum(weights)
        share = (near - distance) / (near - apart)
        angles[a] += share * (mean - one.angle)
        angles[b] += share * (mean - other.angle)
    return [
        patch if angle == patch.angle else _at(patch, pair, angle) for patch, angle in zip(patches, angles, strict=True)
    ]


def _end(patch: SurfacePatch, which: int) -> Array:
    """Return the lateral end of the overlap of a patch in track coordinates [m]: 0 that at the lowest y, -1 the other."""
    found = lobes(patch.gap, patch.approach)
    y = found[which][which] if found else 0.0
    return np.asarray((patch.frame.origin + y * patch.frame.axes[1])[1:])


def _weight(patch: SurfacePatch) -> float:
    """Return the integral of the squared vertical depth over x and track y, up to a factor."""
    depth = np.maximum(patch.approach - patch.gap.h, 0.0)
    return float((depth**2).sum()) / math.cos(patch.angle)


def _at(patch: SurfacePatch, pair: SurfacePair, angle: float) -> SurfacePatch:
    """Return a patch in a plane of another angle [rad]."""
    mirror = 1.0 if pair.side == "right" else -1.0
    origin = (patch.frame if mirror > 0.0 else patch.frame.mirrored).origin
    frame = Frame.turned(origin, mirror * angle)
    x, y = patch.gap.x, mirror * patch.gap.y[:: int(mirror)]
    h = within(pair.distance)(frame, x, y)[:: int(mirror)]
    present = h < AWAY
    h = np.where(present, h, h[present].max() + 1e-3)
    patch = with_distance(patch, h)
    seen = frame if mirror > 0.0 else frame.mirrored
    place = np.array(patch.position) + patch.approach * seen.axes[2]
    return replace(
        patch,
        frame=seen,
        angle=angle,
        wheel_position=(float(place[0]), float(place[1]), float(place[2])),
    )
