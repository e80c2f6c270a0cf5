"""Put the points of a scan in order, drop its faults, and cut the outline of a whole rail to its head."""

from __future__ import annotations

import numpy as np

from contact.geometry.inspection import Fault, Finding, Kind, Points, order
from contact.geometry.roughness import backward, spikes
from contact.geometry.scans import scans, turning

NEAREST = 1e-6  # least distance of two points [m]
_CLOSED = 0.05  # of the extent: the greatest distance of the ends of a closed outline
_BINS, _DOUBLE, _APART, _FLAT = (
    24,
    0.3,
    0.25,
    0.3,
)  # parts of the width; share of them with two heights, apart as this share
# of the whole height; and least height over width of an outline
_EDGE = 0.15  # of the height: parts at the top and the bottom whose widths are compared
_ALIKE = 0.1  # widths of head and foot that differ less are not told apart
_AT_END, _WEB = 0.75, 0.35  # of the height: from there on ends lie at an end; of the wider end: the width of a web
_HALF = 0.055  # least width of one half of a rail with its foot [m]
_HEAD = 0.1  # of the height: the least height of a head, the foot is flatter
_INWARDS = 0.02  # of the width: by so much an outline turns in below the head
_LOST = 0.02  # of the width: a repair that takes away more is told


def repaired(points: Points) -> Points:
    """Return the points as one scan in order (`in_order`), without back steps and spikes."""
    points = in_order(points)
    for faulty in (spikes, backward, spikes):
        while faulty(points).any() and len(points) > 9:
            points = points[~faulty(points)]
    return distinct(points)


def distinct(points: Points) -> Points:
    """Return the points without those less than a micrometre from the previous one: the tangent between would be noise."""
    kept = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) > NEAREST:
            kept.append(point)
    return np.array(kept)


def in_order(points: Points) -> Points:
    """Return the points as one scan in order.

    Unsorted rows are joined from an end of the profile, each to its nearest neighbour. Of several scans the one with the
    most points is kept, of a scan there and back the longer way.
    """
    for finding in order(points):
        if finding.fault is Fault.UNSORTED:
            points = joined(points)
        elif finding.fault is Fault.SCANS:
            points = max(scans(points), key=len)
    turn = turning(points)
    if turn:
        points = points[: turn + 1] if turn + 1 >= len(points) - turn else points[turn:]
    return points


def joined(points: Points) -> Points:
    """Return the points in the order of their nearest neighbours, from the one with the least y."""
    left = points[np.lexsort(points.T[::-1])]
    chain = [left[0]]
    left = left[1:]
    while len(left):
        k = int(np.argmin(((left - chain[-1]) ** 2).sum(axis=1)))
        chain.append(left[k])
        left = np.delete(left, k, axis=0)
    return np.array(chain)


def narrowed(before: Points, after: Points) -> list[Finding]:
    """Return a finding if a repair has taken away a part of the width."""
    (low, high), (left, right) = ((points[:, 0].min(), points[:, 0].max()) for points in (before, after))
    if right - left >= (1.0 - _LOST) * (high - low):
        return []
    seen = (
        f"repair leaves {1e3 * (right - left):.3g} of {1e3 * (high - low):.3g} mm of the width, "
        f"from y = {1e3 * left:.3g} to {1e3 * right:.3g} mm"
    )
    return [
        Finding(
            Fault.NARROWED,
            seen,
            "look at the points that were dropped; rows=(first, last) chooses a scan",
            after[[0, -1]],
        )
    ]


def is_outline(points: Points, scale: float = 1.0) -> bool:
    """Return whether the points run round a body: over much of their width they have two heights far apart.

    A head with y and z swapped does so too, but it is narrower than half a rail of this `scale`.
    """
    (width, height), n = np.ptp(points, axis=0), len(points)
    if n < 20 or not height > _FLAT * width > 0.0 or (height > width and width < _HALF * scale):
        return False
    fine = _refined(points, width / (2 * _BINS))
    part = np.minimum(((fine[:, 0] - fine[:, 0].min()) / width * _BINS).astype(int), _BINS - 1)
    heights = (np.sort(fine[part == k, 1]) for k in range(_BINS))
    return sum(bool(z.size > 1 and np.diff(z).max() > _APART * height) for z in heights) > _DOUBLE * _BINS


def head_of(points: Points, kind: Kind, downwards: bool, scale: float = 1.0) -> tuple[Points, list[Finding]]:
    """Return the head in the outline of a whole rail, and what was cut off; other points as they are.

    `downwards` says that z is known to point down. The finding is fatal if the outline is that of a wheel, or head and foot
    cannot be told apart; then the points are those given.
    """
    if not is_outline(points, scale):
        return points, []
    width, height = np.ptp(points, axis=0)
    seen = f"the points run round a body {1e3 * width:.3g} mm wide and {1e3 * height:.3g} mm high"
    if kind == "wheel":
        return points, [
            Finding(Fault.OUTLINE, seen, "give the running surface only, as by rows=(first, last)", points[:0])
        ]
    closed = np.hypot(*(points[-1] - points[0])) < _CLOSED * np.hypot(width, height)
    sign = _upwards(points, closed) or float(downwards and closed)
    if not sign:
        cure = "which end is the head is not seen: give the head only, as by rows=(first, last)"
        return points, [Finding(Fault.OUTLINE, seen, cure, points[:0])]
    y, depth = points[:, 0], sign * points[:, 1]
    top = np.flatnonzero(depth < depth.min() + 0.01 * height)
    crown = int(top[np.argmin(np.abs(y[top] - 0.5 * (y[top].min() + y[top].max())))])
    if closed:
        points = np.roll(points, len(points) // 2 - crown, axis=0)
        crown = len(points) // 2
    forwards = points[crown:], points[crown::-1]
    right, left = (_to_the_corner(side, _INWARDS * width) for side in forwards)
    head = points[crown - left : crown + right + 1]
    if np.ptp(head[:, 1]) < _HEAD * height:
        return points, [
            Finding(Fault.OUTLINE, seen, "no head is seen: give the head only, as by rows=(first, last)", points[:0])
        ]
    told = f"kept is its head, {len(head)} of {len(points)} points and {1e3 * np.ptp(head[:, 0]):.3g} mm wide"
    return head, [Finding(Fault.OUTLINE, seen, told, points[:0])]


def _upwards(points: Points, closed: bool) -> float:
    """Return 1 if z points down in a rail's outline, -1 if up, 0 if that is not seen: its head is narrower than its foot.

    The ends of an open outline lie opposite the head, at the web or the foot; those of a grooved rail may lie at its lip.
    """
    y, z = points.T
    low, high = z.min(), z.max()
    edge = _EDGE * (high - low)
    at_low, at_high = (float(np.ptp(y[inside])) for inside in (z < low + edge, z > high - edge))
    clear = abs(at_low - at_high) > _ALIKE * max(at_low, at_high)
    by_width = (1.0 if at_low < at_high else -1.0) if clear else 0.0
    if closed:
        return by_width
    from_low = (z[[0, -1]] - low) / (high - low)
    if from_low.max() - from_low.min() > 0.5:  # from the head to the foot: one half of a rail
        return 0.0
    by_ends = 1.0 if from_low.min() > _AT_END else -1.0 if from_low.max() < 1.0 - _AT_END else 0.0
    if by_ends * by_width < 0.0:  # the narrow end is a piece of the web, or the head of a grooved rail
        return by_ends if min(at_low, at_high) < _WEB * max(at_low, at_high) else by_width
    return by_ends or by_width


def _to_the_corner(side: Points, inwards: float) -> int:
    """Return the index at which a side of a rail, from the crown on, turns in below the head."""
    y = np.abs(side[:, 0] - side[0, 0])
    outwards = np.maximum.accumulate(y)
    turned_in = np.flatnonzero(outwards - y > inwards)
    end = int(turned_in[0]) if turned_in.size else len(y)
    return int(np.flatnonzero(y[:end] >= y[:end].max() - 1e-9)[-1])


def _refined(points: Points, spacing: float) -> Points:
    """Return the points with others between them on the lines that join them, at most `spacing` apart."""
    apart = np.append(True, np.diff(points, axis=0).any(axis=1))  # interpolation divides by what is between two
    points = points[apart]
    length = np.hypot(*np.diff(points, axis=0).T)
    along = np.concatenate(([0.0], np.cumsum(length)))
    count = min(int(along[-1] / spacing) + 2, 20_000)
    s = np.union1d(along, np.linspace(0.0, along[-1], count))
    return np.column_stack([np.interp(s, along, column) for column in points.T])
